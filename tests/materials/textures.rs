//! Textures: sampling on host and device, albedo and emission that vary, and holes.

mod filtering;
mod holes;

use std::f64::consts::PI;

use crate::common::{self, Build, Rng, frame, gpu, render_scene};
use glam::{DVec3, Vec2, Vec3, Vec4, dvec3};
use gpu_vpl::bvh::Bvh;
use gpu_vpl::gpu::{Dispatch, Module, Program};
use gpu_vpl::image::Image;
use gpu_vpl::render::kernels::catalogue::{TEXTURE, TYPES};
use gpu_vpl::render::prepared::tables;
use gpu_vpl::render::{Clamp, Clustering, Features, Method, Prepared, Settings, light_paths};
use gpu_vpl::scene::texture::Filter;
use gpu_vpl::scene::{Scene, Texels, Texture, Wrap, texture};

static SAMPLE: Module =
    Module { name: "texture", source: include_str!("texture.wgsl"), feature: None };

fn random_texels(rng: &mut Rng, count: u32) -> Vec<[u8; 4]> {
    (0..count).map(|_| rng.bits().to_le_bytes()).collect()
}

/// A channel of sRGB in linear light.
fn linear(value: u8) -> f64 {
    let value = f64::from(value) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// A scene in which a material for each texture has it.
fn scene_with(images: Vec<Texels>, textures: Vec<Texture>) -> Scene {
    let mut build = Build::new();
    for texture in 0..textures.len() as u32 {
        let material = build.material([0.5; 3], [0.0; 3], false);
        build.draft.materials[material as usize].texture = Some(texture);
    }
    build.draft.images = images;
    build.draft.textures = textures;
    build.textured(0, DVec3::ZERO, DVec3::X, DVec3::Y);
    build.point_light(DVec3::Z, [1.0; 3]);
    build.camera(DVec3::Z, DVec3::NEG_Z, 40.0, [8, 8]);
    build.scene()
}

#[test]
fn host_and_device_sample_alike() {
    let mut rng = Rng(1);
    let wraps = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp];
    let mut images = Vec::new();
    let mut textures = Vec::new();
    for (index, size) in (0..).zip([[1, 1], [2, 3], [16, 5], [1, 64]]) {
        let rgba = random_texels(&mut rng, size[0] * size[1]);
        images.push(Texels { name: String::new(), size, rgba });
        for (across, down) in wraps.into_iter().flat_map(|a| wraps.map(|d| (a, d))) {
            let scale = Vec2::new(rng.unit() * 4.0 - 2.0, rng.unit() + 0.5);
            let offset = Vec2::new(rng.unit(), -rng.unit());
            let filter = Filter::default();
            textures.push(Texture { image: index, wrap: [across, down], filter, scale, offset });
        }
    }
    let scene = scene_with(images, textures);
    let place = |i: usize| {
        let large = if i.is_multiple_of(3) { 100.0 } else { 2.0 };
        let mut uv = Vec2::new(rng.unit(), rng.unit()) * 2.0 * large - large;
        // On borders and on texels' middles too.
        if i.is_multiple_of(5) {
            uv = (uv * 4.0).round() / 4.0;
        }
        [uv.x, uv.y, (i % scene.textures.len()) as f32, 0.0]
    };
    let mut places: Vec<[f32; 4]> = (0..7200).map(place).collect();
    places[3] = [1e30, -1e30, 0.0, 0.0];
    let kernel = Program::new("test textures", vec![&TYPES, &TEXTURE, &SAMPLE]);
    let kernel = gpu().compile(&kernel).unwrap();
    let tables = tables::upload(gpu(), &scene, &Bvh::of(&scene), Features::of(&scene)).unwrap();
    let results = gpu().storage::<[f32; 4]>("results", places.len()).unwrap();
    let input = gpu().storage_of("places", &places).unwrap();
    let mut buffers = vec![("places", &input), ("results", &results)];
    buffers.extend(tables.iter().map(|(name, buffer)| (*name, buffer)));
    let bindings = gpu().bind(&kernel, &buffers).unwrap();
    let workgroups = [places.len().div_ceil(64) as u32, 1];
    gpu().run(&[Dispatch { kernel: &kernel, bindings: &bindings, workgroups }]).unwrap();
    let results: Vec<[f32; 4]> = gpu().read(&results, places.len()).unwrap();
    for (&[u, v, index, _], result) in places.iter().zip(results) {
        let texture = scene.textures[index as usize];
        let host = texture.sample(&scene.images, Vec2::new(u, v));
        let off = (host - Vec4::from_array(result)).abs().max_element();
        // A place of up to 400 texture widths is known to 2⁻¹⁵ of a width of up to 64 texels.
        assert!(off < 0.01 && (u.abs() > 10.0 || off < 1e-4), "{texture:?}, {u} {v}: off by {off}");
    }
}

#[test]
fn samples_by_hand() {
    let rgba = vec![[0, 0, 0, 0], [255, 255, 255, 255], [255, 0, 0, 255], [10, 200, 128, 0]];
    let images = [Texels { name: String::new(), size: [2, 2], rgba }];
    let sample = |wrap: Wrap, u: f32, v: f32| {
        Texture { wrap: [wrap; 2], ..Texture::of(0) }.sample(&images, Vec2::new(u, v))
    };
    // Middles of texels, in linear light.
    assert_eq!(sample(Wrap::Repeat, 0.25, 0.25), Vec4::ZERO);
    assert_eq!(sample(Wrap::Clamp, 0.25, 0.75), Vec4::new(1.0, 0.0, 0.0, 1.0));
    let last = sample(Wrap::Mirror, 0.75, 0.75);
    for (got, value) in last.to_array().into_iter().zip([10, 200, 128]) {
        assert!((f64::from(got) - linear(value)).abs() < 1e-6, "{got}, {value}");
    }
    // Half way between two; beyond borders.
    assert_eq!(sample(Wrap::Clamp, 0.5, 0.25), Vec4::splat(0.5));
    assert_eq!(sample(Wrap::Repeat, 0.0, 0.25), Vec4::splat(0.5));
    assert_eq!(sample(Wrap::Clamp, 0.0, 0.25), Vec4::ZERO);
    assert_eq!(sample(Wrap::Repeat, 1.75, -0.75), Vec4::ONE);
    assert_eq!(sample(Wrap::Mirror, 1.25, 0.25), Vec4::ONE);
    assert_eq!(sample(Wrap::Clamp, 7.0, -7.0), Vec4::ONE);
}

/// A square that the camera sees exactly, each of its texels as a pixel.
fn picture(size: u32, rgba: Vec<[u8; 4]>, albedo: [f64; 3]) -> Build {
    let mut build = Build::new();
    let material = build.material(albedo, [0.0; 3], false);
    let texture = build.texture(size, rgba);
    build.draft.materials[material as usize].texture = Some(texture);
    build.textured(material, dvec3(-1.0, 1.0, 0.0), 2.0 * DVec3::X, -2.0 * DVec3::Y);
    build.camera(DVec3::Z, DVec3::NEG_Z, 90.0, [size, size]);
    // The camera's up is +z elsewhere; here it looks along z.
    build.point_light(dvec3(0.3, -0.2, 0.5), [2.0, 3.0, 4.0]);
    build
}

fn expected_albedo(texels: &[[u8; 4]], albedo: [f64; 3], pixel: usize) -> [f64; 3] {
    std::array::from_fn(|channel| linear(texels[pixel][channel]) * albedo[channel])
}

fn assert_near(image: &Image, tolerance: f64, expected: impl Fn(usize) -> [f64; 3]) {
    for (index, pixel) in image.pixels.iter().enumerate() {
        for (got, right) in pixel.iter().zip(expected(index)) {
            let off = (f64::from(*got) - right).abs();
            assert!(off <= tolerance * (right + 0.01), "pixel {index}: {got}, not {right}");
        }
    }
}

const ALBEDO: [f64; 3] = [0.8, 1.0, 0.5];

#[test]
fn the_albedo_image_of_a_textured_square() {
    for size in [2, 16] {
        let texels = random_texels(&mut Rng(2), size * size);
        let build = picture(size, texels.clone(), ALBEDO);
        let settings = Settings { edge_samples: 1, ..Settings::of(Method::Albedo) };
        let image = build.render(&settings).image;
        // Where texels' middles are seen, up to rounding of a texel's thousandth.
        assert_near(&image, 1e-3, |i| expected_albedo(&texels, ALBEDO, i));
    }
}

/// Direct light on it, in the methods that have each their own way to the albedo.
#[test]
fn a_textured_square_in_the_light() {
    let texels = random_texels(&mut Rng(3), 16 * 16);
    for method in [Method::Direct, Method::Path, Method::Vpl, Method::Both] {
        let scene = picture(16, texels.clone(), ALBEDO).scene();
        let settings =
            Settings { edge_samples: 1, samples: 1, light_paths: 50, ..Settings::of(method) };
        let image = render_scene(scene, &settings).image;
        assert_near(&image, 2e-3, |i| {
            let at = |i: usize| (2.0 * i as f64 + 1.0) / 16.0 - 1.0;
            let to_light = dvec3(0.3, -0.2, 0.5) - dvec3(at(i % 16), -at(i / 16), 0.0);
            let albedo = expected_albedo(&texels, ALBEDO, i);
            let factor = 0.5 / to_light.length().powi(3) / PI;
            std::array::from_fn(|c| albedo[c] * [2.0, 3.0, 4.0][c] * factor)
        });
    }
}

/// A box whose floor has a texture, and a textured ball on it.
fn textured_room(size: [u32; 2]) -> Build {
    let mut build = common::room(1.0, DVec3::ZERO, size);
    let mut rng = Rng(4);
    let floor = build.material([0.9; 3], [0.0; 3], false);
    let texture = build.texture(8, random_texels(&mut rng, 64));
    build.draft.materials[floor as usize].texture = Some(texture);
    build.textured(floor, dvec3(-0.95, -0.95, -0.9), 1.9 * DVec3::X, 1.9 * DVec3::Y);
    build.sphere(floor, dvec3(0.2, -0.5, -0.5), 0.3);
    build
}

/// VPLs have the albedo of their places.
#[test]
fn vpls_have_the_albedo_of_their_places() {
    let settings = Settings { light_paths: 2000, ..Settings::of(Method::Vpl) };
    let prepared = Prepared::new(gpu().clone(), textured_room([8, 8]).scene(), &settings).unwrap();
    let scene = &prepared.scene;
    assert_eq!(scene.units.scale, 1.0, "positions below are in the file's units");
    let (mut flat, mut round) = (0, 0);
    for vpl in light_paths(&prepared, &settings, 1) {
        if scene.materials[vpl.material as usize].texture.is_none() {
            continue;
        }
        let Vec3 { x, y, z } = vpl.position;
        let on_floor = (z + 0.9).abs() < 1e-5;
        *(if on_floor { &mut flat } else { &mut round }) += 1;
        let uv = match on_floor {
            true => Vec2::new(x + 0.95, y + 0.95) / 1.9,
            false => texture::on_sphere((vpl.position - Vec3::new(0.2, -0.5, -0.5)) / 0.3),
        };
        let expected = 0.9 * scene.textures[0].sample(&scene.images, uv).truncate();
        assert!((vpl.albedo - expected).abs().max_element() < 1e-3, "{vpl:?}, not {expected}");
    }
    assert!(flat > 100 && round > 30, "{flat} and {round} VPLs");
}

/// Albedos go with their points where those are clustered before they are shaded: clusters of one
/// give the image of all VPLs, for two samples a pixel.
#[test]
fn clustered_points_keep_their_albedo() {
    let settings = |method| {
        let clustering = Clustering { points: 1 << 20, vpls: 1 << 20, ..Clustering::default() };
        Settings {
            light_paths: 300,
            samples: 2,
            clustering,
            interleave: 1,
            candidates: 1,
            ..Settings::of(method)
        }
    };
    for gpu in [gpu().clone(), gpu().clone().without_subgroups()] {
        let scene = textured_room([40, 24]).scene();
        let prepared = Prepared::new(gpu, scene, &settings(Method::Vpl)).unwrap();
        let all = frame(&prepared, &settings(Method::Vpl)).image;
        for method in [Method::Vpc, Method::Both] {
            let image = frame(&prepared, &settings(method)).image;
            let off = common::difference(&image.pixels, &all.pixels);
            assert!(off < 1e-3, "{method:?}: off by {off}");
        }
    }
}

/// u goes around the y axis, v from its top to its bottom.
#[test]
fn the_texture_of_a_sphere() {
    let quarters = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255; 4]];
    let bands = [[255, 0, 0, 255], [0, 0, 255, 255]];
    let see = |width, rgba: &[[u8; 4]], from: DVec3| {
        let mut build = Build::new();
        let ball = build.material([1.0; 3], [0.0; 3], false);
        let texture = build.texture(width, rgba.to_vec());
        build.draft.textures[texture as usize].wrap = [Wrap::Clamp; 2];
        build.draft.materials[ball as usize].texture = Some(texture);
        build.sphere(ball, dvec3(1.0, 2.0, 3.0), 0.5);
        build.point_light(DVec3::ZERO, [1.0; 3]);
        build.camera(dvec3(1.0, 2.0, 3.0) + 2.0 * from, -from, 1.0, [1, 1]);
        let settings = Settings { edge_samples: 1, ..Settings::of(Method::Albedo) };
        build.render(&settings).image.pixels[0].map(|value| (value * 1000.0).round() / 1000.0)
    };
    let slant = |x: f64, z: f64| dvec3(x, 0.0, z).normalize();
    // Eastwards from -z: the middles of the quarters of the image's width.
    assert_eq!(see(4, &quarters, slant(-1.0, -1.0)), [1.0, 0.0, 0.0]);
    assert_eq!(see(4, &quarters, slant(-1.0, 1.0)), [0.0, 1.0, 0.0]);
    assert_eq!(see(4, &quarters, slant(1.0, 1.0)), [0.0, 0.0, 1.0]);
    assert_eq!(see(4, &quarters, slant(1.0, -1.0)), [1.0; 3]);
    assert_eq!(see(1, &bands, dvec3(0.3, 0.95, 0.0)), [1.0, 0.0, 0.0]);
    assert_eq!(see(1, &bands, dvec3(0.0, -0.95, 0.3)), [0.0, 0.0, 1.0]);
    assert_eq!(see(1, &bands, DVec3::X), [0.5, 0.0, 0.5]);
}

/// A lamp with a texture of two halves, of which one may be a hole, over a floor: the light of each
/// half is that of a plain lamp of its size.
#[test]
fn lamps_that_vary() {
    let size = 12;
    let render = |textured: bool, hole: bool, method: Method| {
        let mut build = Build::new();
        let white = build.material([0.7; 3], [0.0; 3], false);
        let corner = |x: f64, y: f64| dvec3(x, y, 0.0);
        build.polygon(
            white,
            &[corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
        );
        // From below, so that its normal is down.
        let (corner, down) = (dvec3(-0.5, -0.4, 0.6), 0.8 * DVec3::Y);
        match textured {
            true => {
                let lamp = build.material([0.0; 3], [8.0; 3], false);
                let second = if hole { [255, 255, 255, 0] } else { [128, 128, 128, 255] };
                let rgba = (0..64).map(|i| if i < 32 { [255; 4] } else { second });
                let texture = build.texture(64, rgba.collect());
                let material = &mut build.draft.materials[lamp as usize];
                material.emission_texture = Some(texture);
                material.cutout = hole.then_some(texture);
                build.textured(lamp, corner, DVec3::X, down);
                build.draft.triangles.iter_mut().skip(2).for_each(|(corners, _)| corners.reverse());
                build.draft.uvs.iter_mut().skip(2).for_each(|uvs| uvs.reverse());
            }
            false => {
                let second = if hole { 0.0 } else { 8.0 * linear(128) };
                for (x, emission) in [(0.0, 8.0), (0.5, second)] {
                    let lamp = build.material([0.0; 3], [emission; 3], false);
                    let [a, b] = [x, x + 0.5].map(|x| corner + x * DVec3::X);
                    if emission > 0.0 {
                        build.polygon(lamp, &[a, a + down, b + down, b]);
                    }
                }
            }
        }
        build.camera(dvec3(0.0, -0.9, 0.3), dvec3(0.0, 1.0, 0.1), 80.0, [size; 2]);
        // A path has one shadow ray a vertex.
        let (samples, light_samples) =
            if method == Method::Path { (256, None) } else { (1, Some(2048)) };
        let settings = Settings {
            samples,
            light_paths: 20_000,
            light_samples,
            clamp: Clamp::Off,
            ..Settings::of(method)
        };
        build.render(&settings).image
    };
    for (method, hole) in
        [(Method::Direct, false), (Method::Path, false), (Method::Vpl, true), (Method::Path, true)]
    {
        let [textured, plain] = [true, false].map(|textured| render(textured, hole, method));
        let sum = |image: &Image| image.pixels.as_flattened().iter().map(|&v| f64::from(v)).sum();
        let (one, two): (f64, f64) = (sum(&textured), sum(&plain));
        assert!((one / two - 1.0).abs() < 0.02, "{method:?}, hole {hole}: {one}, not {two}");
        // And by pixels, but for those that see the rim of a half, where texels blend.
        let near = |(a, b): &(&[f32; 3], &[f32; 3])| (a[0] - b[0]).abs() <= 0.1 * b[0] + 0.01;
        let near = textured.pixels.iter().zip(&plain.pixels).filter(near).count();
        assert!(near >= 120, "{method:?}, hole {hole}: {near} of 144 pixels are near");
    }
}
