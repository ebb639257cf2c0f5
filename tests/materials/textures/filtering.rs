//! Textures over what a pixel sees: mip levels, what of them is looked up, what comes of it.

use glam::{DVec3, Vec2, Vec3, dvec3};
use gpu_vpl::bvh::Bvh;
use gpu_vpl::gpu::{Dispatch, Module, Program};
use gpu_vpl::image::Image;
use gpu_vpl::render::kernels::catalogue::{TEXTURE, TEXTURE_FILTERED, TYPES};
use gpu_vpl::render::prepared::tables;
use gpu_vpl::render::{Bounces, Features, Method, Prepared, Settings};
use gpu_vpl::scene::texture::{Filter, Interpolation, level_sizes};
use gpu_vpl::scene::{Bsdf, Texels, Texture, Wrap};

use super::{linear, random_texels, scene_with};
use crate::common::{Build, Rng, gpu};

static SAMPLE: Module =
    Module { name: "filtered", source: include_str!("filtered.wgsl"), feature: None };

const NEAREST: Filter =
    Filter { magnified: Interpolation::Nearest, minified: Interpolation::Nearest, mipmaps: true };
const WITHOUT_MIPS: Filter =
    Filter { magnified: Interpolation::Linear, minified: Interpolation::Linear, mipmaps: false };

/// An image and its mip levels.
fn levels(image: &Texels) -> Vec<Texels> {
    let mips = image.mips(false);
    let mut rest = &mips[..];
    let mut levels = vec![image.clone()];
    for size in level_sizes(image.size).skip(1) {
        let (level, after) = rest.split_at((size[0] * size[1]) as usize);
        levels.push(Texels { name: String::new(), size, rgba: level.to_vec() });
        rest = after;
    }
    assert!(rest.is_empty(), "texels of no level");
    levels
}

/// The twin of `sample_texture_over`, from lookups in levels as in images.
fn sample_over(levels: &[Texels], texture: Texture, uv: Vec2, sides: [Vec2; 2]) -> Vec3 {
    let Filter { magnified, minified, mipmaps } = texture.filter;
    let [width, height] = levels[0].size.map(|extent| extent as f32);
    let texels = sides.map(|side| (side * texture.scale * Vec2::new(width, height)).length());
    let [one, other] = sides;
    let (long, short, along, across) = match texels[1] > texels[0] {
        true => (texels[1], texels[0], other, one),
        false => (texels[0], texels[1], one, other),
    };
    let share = (0.5 * short).max(1.0);
    let (rows, columns) = match mipmaps {
        true => ((short / share).round().clamp(1.0, 2.0), (long / share).round().clamp(1.0, 8.0)),
        false => (1.0, 1.0),
    };
    let level = ((long / columns).max(share).log2() - 0.5).round().max(0.0) as usize;
    let level = if mipmaps { level.min(levels.len() - 1) } else { 0 };
    let interpolation = if long <= 1.0 { magnified } else { minified };
    let filter = Filter { magnified: interpolation, ..texture.filter };
    let lookup = Texture { image: level as u32, filter, ..texture };
    let mut sum = Vec3::ZERO;
    for row in 0..rows as u32 {
        for column in 0..columns as u32 {
            let [x, y] =
                [(column, columns), (row, rows)].map(|(i, of)| (i as f32 + 0.5) / of - 0.5);
            sum += lookup.sample(levels, uv + x * along + y * across).truncate();
        }
    }
    sum / (rows * columns)
}

#[test]
fn host_and_device_filter_alike() {
    let mut rng = Rng(11);
    let (mut images, mut textures) = (Vec::new(), Vec::new());
    let filters = [Filter::default(), NEAREST, WITHOUT_MIPS];
    for (index, size) in (0..).zip([[1, 1], [64, 32], [37, 21], [1, 50]]) {
        let rgba = random_texels(&mut rng, size[0] * size[1]);
        images.push(Texels { name: String::new(), size, rgba });
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            for filter in filters {
                let scale = Vec2::new(rng.unit() * 4.0 - 2.0, rng.unit() + 0.5);
                let offset = Vec2::new(rng.unit(), -rng.unit());
                textures.push(Texture { image: index, wrap: [wrap; 2], filter, scale, offset });
            }
        }
    }
    let scene = scene_with(images, textures);
    let held: Vec<_> = scene.images.iter().map(levels).collect();
    let mut places = Vec::new();
    let mut sides = Vec::new();
    for i in 0..9000 {
        // Of less than a texel, or as large as several images.
        let side = |rng: &mut Rng| {
            let length = (-7.0 + 8.0 * rng.unit()).exp2();
            length * (Vec2::new(rng.unit(), rng.unit()) * 2.0 - 1.0)
        };
        let texture = (i % scene.textures.len()) as f32;
        places.push([rng.unit() * 3.0 - 1.0, rng.unit() * 3.0 - 1.0, texture, 0.0]);
        sides.push([side(&mut rng), side(&mut rng)]);
    }
    let program =
        Program::new("test filtering", vec![&TYPES, &TEXTURE, &TEXTURE_FILTERED, &SAMPLE]);
    let kernel = gpu().compile(&program).unwrap();
    let tables = tables::upload(gpu(), &scene, &Bvh::of(&scene), Features::of(&scene)).unwrap();
    let results = gpu().storage::<[f32; 4]>("results", places.len()).unwrap();
    let input = gpu().storage_of("places", &places).unwrap();
    let of_sides: Vec<[f32; 4]> = sides.iter().map(|[a, b]| [a.x, a.y, b.x, b.y]).collect();
    let of_sides = gpu().storage_of("sides", &of_sides).unwrap();
    let mut buffers = vec![("places", &input), ("sides", &of_sides), ("results", &results)];
    buffers.extend(tables.iter().map(|(name, buffer)| (*name, buffer)));
    let bindings = gpu().bind(&kernel, &buffers).unwrap();
    let workgroups = [places.len().div_ceil(64) as u32, 1];
    gpu().run(&[Dispatch { kernel: &kernel, bindings: &bindings, workgroups }]).unwrap();
    let results: Vec<[f32; 4]> = gpu().read(&results, places.len()).unwrap();
    let mut wrong = Vec::new();
    for ((&[u, v, index, _], &sides), result) in places.iter().zip(&sides).zip(results) {
        let texture = scene.textures[index as usize];
        let host = sample_over(&held[texture.image as usize], texture, Vec2::new(u, v), sides);
        let off = (host - Vec3::from_slice(&result)).abs().max_element();
        if off > 1e-4 {
            wrong.push(format!("{texture:?}, {u} {v}, {sides:?}: off by {off}"));
        }
    }
    // Nearest texels, levels and numbers of lookups are steps, of which rounding may choose the
    // other side.
    assert!(wrong.len() < 9000 / 500, "{} of 9000: {:?}", wrong.len(), &wrong[..5]);
}

/// The mean of an image in linear light.
fn mean(image: &Texels) -> DVec3 {
    let of = |texel: &[u8; 4]| dvec3(linear(texel[0]), linear(texel[1]), linear(texel[2]));
    image.rgba.iter().map(of).sum::<DVec3>() / image.rgba.len() as f64
}

#[test]
fn mip_levels_keep_the_mean_of_images_of_any_size() {
    for size in [[1, 1], [64, 64], [63, 17], [100, 3], [5, 1], [1, 31]] {
        let rgba = random_texels(&mut Rng(12), size[0] * size[1]);
        let image = Texels { name: String::new(), size, rgba };
        let right = mean(&image);
        for level in &levels(&image)[1..] {
            // A code is half a 255th off at most, which is 1 % in bright light.
            let off = (mean(level) - right).abs().max_element();
            let most = 0.005 / f64::from(level.size[0] * level.size[1]).sqrt() + 1e-3;
            assert!(off < most, "{size:?}, level {:?}: off by {off}", level.size);
        }
    }
}

/// What is clear does not colour what is not.
#[test]
fn mip_levels_of_images_with_holes_weigh_by_alpha() {
    let leaf =
        |i: u32| if (i % 9).is_multiple_of(4) { [20, 200, 40, 255] } else { [255, 255, 255, 0] };
    let image = Texels { name: String::new(), size: [9, 9], rgba: (0..81).map(leaf).collect() };
    for [r, g, b, alpha] in image.mips(true) {
        let off = [r, g, b].iter().zip([20, 200, 40]).map(|(a, b)| a.abs_diff(b)).max();
        assert!(off <= Some(1), "{r} {g} {b}");
        assert!((50..120).contains(&alpha), "{alpha}");
    }
    let white = image.mips(false);
    assert!(white.iter().all(|texel| texel[0] > 150), "{white:?}");
}

/// The levels are where the device has its texels, and only where they are used.
#[test]
fn mip_levels_are_counted() {
    let texels = |edit: &dyn Fn(&mut Build, u32)| {
        let mut build = Build::new();
        let material = build.material([0.5; 3], [0.0; 3], false);
        let texture = build.texture(5, random_texels(&mut Rng(13), 15));
        build.draft.materials[material as usize].texture = Some(texture);
        edit(&mut build, material);
        build.textured(material, DVec3::ZERO, DVec3::X, DVec3::Y);
        build.point_light(DVec3::Z, [1.0; 3]);
        build.camera(DVec3::Z, DVec3::NEG_Z, 40.0, [8, 8]);
        let prepared = Prepared::new(gpu().clone(), build.scene(), &Settings::default()).unwrap();
        let planned: u64 = prepared.tables().iter().map(|(_, bytes)| bytes).sum();
        assert_eq!(planned, prepared.table_bytes());
        prepared.tables().iter().find(|(name, _)| *name == "texels").unwrap().1
    };
    // 5 × 3, 2 × 1 and 1 × 1.
    assert_eq!(texels(&|_, _| {}), 4 * 18);
    assert_eq!(texels(&|build, _| build.draft.textures[0].filter = WITHOUT_MIPS), 4 * 15);
    let cut_out = |build: &mut Build, material: u32| {
        let material = &mut build.draft.materials[material as usize];
        material.cutout = material.texture.take();
    };
    assert_eq!(texels(&cut_out), 4 * 15);
}

/// A floor of black and white squares to the horizon.
fn checkered_floor(filter: Filter, samples: u32) -> Image {
    let mut build = Build::new();
    let material = build.material([1.0; 3], [0.0; 3], false);
    let is_white = |i: u32| (i % 16 / 8 + i / 16 / 8).is_multiple_of(2);
    let texels = (0..256).map(|i| if is_white(i) { [255; 4] } else { [0, 0, 0, 255] });
    let texture = build.texture(16, texels.collect());
    build.draft.materials[material as usize].texture = Some(texture);
    build.draft.textures[texture as usize].filter = filter;
    let far = 500.0;
    build.textured(material, dvec3(-far, -far, 0.0), 2.0 * far * DVec3::X, 2.0 * far * DVec3::Y);
    for uvs in &mut build.draft.uvs {
        *uvs = uvs.map(|uv| uv * 2000.0);
    }
    build.point_light(DVec3::Z, [1.0; 3]);
    build.camera(dvec3(0.03, 0.07, 1.0), dvec3(0.1, 1.0, -0.15), 60.0, [64, 48]);
    let settings = Settings { samples, edge_samples: 1, ..Settings::of(Method::Albedo) };
    build.render(&settings).image
}

/// The mean squared error of the rows of an image in which the floor is seen.
fn error(image: &Image, right: &Image, rows: std::ops::Range<usize>) -> f64 {
    let part = |image: &Image| -> Vec<f64> {
        let width = image.width as usize;
        image.pixels[rows.start * width..rows.end * width]
            .iter()
            .map(|pixel| f64::from(pixel[0]))
            .collect()
    };
    let (image, right) = (part(image), part(right));
    let squares = image.iter().zip(&right).map(|(a, b)| (a - b) * (a - b));
    squares.sum::<f64>() / image.len() as f64
}

#[test]
fn a_checkerboard_becomes_grey_at_the_horizon() {
    let right = checkered_floor(Filter::default(), 256);
    let plain = checkered_floor(WITHOUT_MIPS, 1);
    let filtered = checkered_floor(Filter::default(), 1);
    // The horizon is in row 17.
    let [before, after] = [&plain, &filtered].map(|image| error(image, &right, 19..48));
    eprintln!("mean squared error {before:.5} without, {after:.5} with mip levels");
    assert!(before > 0.05, "{before}: nothing aliases");
    assert!(after < 0.03 * before, "{after}, of {before} without mip levels");
    // Some squares a pixel: grey, with the little that 256 samples leave of them.
    let far = error(&filtered, &right, 19..24);
    assert!(far < 2e-3, "{far}");
    let grey = filtered.pixels[64 * 19..64 * 20].iter().map(|pixel| pixel[0]);
    assert!(grey.clone().all(|value| (value - 0.5).abs() < 0.05), "{:?}", grey.collect::<Vec<_>>());
    // Several samples see a part of the pixel each.
    let [plain, filtered] =
        [WITHOUT_MIPS, Filter::default()].map(|filter| checkered_floor(filter, 4));
    let [before, after] = [&plain, &filtered].map(|image| error(image, &right, 19..48));
    eprintln!("with four samples {before:.5} and {after:.5}");
    assert!(after < 0.3 * before, "{after} of four samples, of {before} without mip levels");
}

#[test]
fn nearest_texels_are_not_interpolated() {
    let texels = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255, 255, 255, 255]];
    // Magnified 8 times, or of 256 texels 16 a pixel.
    for (copies, filter) in [(1, NEAREST), (128, Filter { mipmaps: false, ..NEAREST })] {
        let mut build = super::picture(2, texels.to_vec(), [1.0; 3]);
        build.draft.textures[0].filter = filter;
        build.draft.textures[0].scale = Vec2::splat(copies as f32);
        build.draft.camera.as_mut().unwrap().size = [16, 16];
        let settings = Settings { edge_samples: 1, ..Settings::of(Method::Albedo) };
        let image = build.render(&settings).image;
        for (i, pixel) in image.pixels.iter().enumerate() {
            let code = pixel.map(|value| (255.0 * value).round() as u8);
            let is = texels.iter().any(|texel| texel[..3] == code);
            let whole = pixel.iter().all(|v| (v - v.round()).abs() < 1e-6);
            assert!(is && whole, "{copies}, pixel {i}: {pixel:?}");
            if copies == 1 {
                let (x, y) = (i % 16 / 8, i / 16 / 8);
                assert_eq!(code, texels[x + 2 * y][..3], "pixel {i}");
            }
        }
    }
}

/// A textured lamp is filtered in a flat mirror as from behind it.
#[test]
fn cones_go_on_at_mirrors() {
    let see = |mirrored: bool| {
        let mut build = Build::new();
        let lamp = build.material([0.0; 3], [1.0; 3], true);
        let texture = build.texture(64, random_texels(&mut Rng(14), 64 * 64));
        build.draft.materials[lamp as usize].emission_texture = Some(texture);
        build.textured(lamp, dvec3(-1.0, 3.0, -1.0), 2.0 * DVec3::X, 2.0 * DVec3::Z);
        let mirror = build.finished([0.0; 3], Bsdf::Mirror { specular: Vec3::ONE });
        let at = |x: f64, z: f64| dvec3(x, -2.0, z);
        if mirrored {
            build.polygon(mirror, &[at(-9.0, -9.0), at(9.0, -9.0), at(9.0, 9.0), at(-9.0, 9.0)]);
        }
        let (eye, way) = match mirrored {
            true => (dvec3(0.1, 1.0, 0.2), DVec3::NEG_Y),
            false => (dvec3(0.1, -5.0, 0.2), DVec3::Y),
        };
        build.camera(eye, way, 20.0, [24, 24]);
        let settings = Settings {
            edge_samples: 1,
            samples: 1,
            bounces: Bounces::Finite(0),
            ..Settings::of(Method::Direct)
        };
        build.render(&settings).image
    };
    let (straight, mirrored) = (see(false), see(true));
    let mut contrast = 0.0f32;
    for y in 0..24 {
        for x in 0..24 {
            let [a, b] = [straight.pixels[24 * y + x], mirrored.pixels[24 * y + 23 - x]];
            let off = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(off < 1e-3, "pixel {x}, {y}: {a:?} and {b:?}");
            contrast = contrast.max((a[0] - straight.pixels[0][0]).abs());
        }
    }
    assert!(contrast > 0.05, "nothing is seen of the texture");
}
