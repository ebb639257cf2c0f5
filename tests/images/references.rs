//! Whole images: against references, and against each other where they have to be the same.

use std::env;
use std::path::Path;

use crate::common::compare::{Tolerance, check, compare, load, references, save};
use crate::common::{Rng, difference, frame, gpu, room};
use glam::{DVec3, dvec3};
use gpu_vpl::image::Image;
use gpu_vpl::render::{Clamp, Method, Prepared, Settings};
use gpu_vpl::scene::Scene;

/// The pixels' rounding differs from device to device, by some 1e-6; a bit of visibility that
/// flips at an edge changes a pixel by one VPL of 300, which is what the few pixels are for.
const TOLERANCE: Tolerance = Tolerance { relative: 1e-3, absolute: 1e-4, pixels: 5 };

fn settings(method: Method) -> Settings {
    Settings::of_vpls(method, 150)
}

#[test]
fn scenes_look_as_they_did() {
    let bless = env::var_os("GPU_VPL_BLESS").is_some_and(|value| value == "1");
    let mut faults = Vec::new();
    let gallery = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/gallery.toml");
    let scenes = [
        ("cornell", "builtin:cornell", [32, 32]),
        ("cornell-point", "builtin:cornell-point", [32, 32]),
        ("gallery", gallery, [48, 36]),
    ];
    for (scene, source, size) in scenes {
        let mut loaded = Scene::load(source).unwrap();
        loaded.camera.size = size;
        let prepared = Prepared::new(gpu().clone(), loaded, &settings(Method::Vpl)).unwrap();
        let methods = [
            Method::Vpl,
            Method::Both,
            Method::Direct,
            Method::Normal,
            Method::Depth,
            Method::Albedo,
        ];
        for method in methods {
            let image = frame(&prepared, &settings(method)).image;
            let name = format!("{scene}-{}", method.name());
            // Depth is in the scene's units, hundreds of them.
            faults.extend(check(&references(), &name, &image, TOLERANCE, bless).err());
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// More camera rays at edges, each with the light of a visible point around, come near to as
/// many whole samples.
#[test]
fn antialiased_edges_are_near_those_of_many_samples() {
    for gpu in [gpu().clone(), gpu().clone().without_subgroups()] {
        let scene = room(1.0, DVec3::ZERO, [40, 24]).scene();
        let prepared = Prepared::new(gpu, scene, &Settings::default()).unwrap();
        let direct = |samples, edge_samples| {
            let light_samples = Some(256 / samples);
            let method = Method::Direct;
            let settings =
                Settings { method, samples, edge_samples, light_samples, ..settings(method) };
            frame(&prepared, &settings).image
        };
        let many = direct(256, 1);
        let error = |image: &Image| {
            let pairs = image.pixels.iter().flatten().zip(many.pixels.iter().flatten());
            pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>().sqrt()
        };
        for samples in [1, 4] {
            let (plain, smooth) = (error(&direct(samples, 1)), error(&direct(samples, 64)));
            assert!(smooth < 0.35 * plain, "{samples} samples: {smooth} against {plain}");
        }
    }
}

#[test]
fn a_comparison_fails_where_it_should() {
    let ramp = |x: u32| [0.1 + x as f32 / 64.0, 0.5, 2.0];
    let good = Image { width: 16, height: 4, pixels: (0..64).map(ramp).collect() };
    let exact = Tolerance { pixels: 0, ..TOLERANCE };
    let mut close = good.clone();
    close.pixels.iter_mut().flatten().for_each(|c| *c *= 1.0005);
    assert_eq!(compare(&good, &close, exact), Ok(()));

    let mut brighter = good.clone();
    brighter.pixels.iter_mut().flatten().for_each(|c| *c *= 1.01);
    assert!(compare(&good, &brighter, TOLERANCE).is_err());
    for wrong in [[0.0; 3], [0.2, 0.5, 2.01], [f32::NAN; 3], [f32::INFINITY; 3]] {
        let mut one = good.clone();
        one.pixels[40] = wrong;
        let report = compare(&good, &one, exact).expect_err("a wrong pixel");
        assert!(report.contains("1 pixels of 64") && report.contains("(8, 2)"), "{report}");
        // The count of failing pixels is apart.
        assert_eq!(compare(&good, &one, TOLERANCE), Ok(()));
        one.pixels[..5].fill(wrong);
        assert!(compare(&good, &one, TOLERANCE).is_err());
    }
    let turned = Image { width: 4, height: 16, ..good.clone() };
    assert!(compare(&good, &turned, TOLERANCE).is_err());
    let empty = Image { width: 0, height: 0, pixels: Vec::new() };
    assert!(compare(&empty, &empty, TOLERANCE).is_err());
}

#[test]
fn a_missing_reference_fails_and_a_written_one_is_read_back() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("references");
    let _ = std::fs::remove_dir_all(&folder);
    let pixels = (0..15).map(|i| [i as f32, 0.1, 1e9]).collect();
    let mut image = Image { width: 5, height: 3, pixels };
    let report = check(&folder, "new", &image, TOLERANCE, false).expect_err("none is there");
    assert!(report.contains("GPU_VPL_BLESS=1"), "{report}");
    save(&folder.join("new.exr"), &image);
    assert_eq!(load(&folder.join("new.exr")), image);
    assert_eq!(check(&folder, "new", &image, TOLERANCE, false), Ok(()));
    image.pixels[3..].fill([7.0; 3]);
    assert!(check(&folder, "new", &image, TOLERANCE, false).is_err());
    let left = Path::new(env!("CARGO_TARGET_TMPDIR")).join("images");
    assert_eq!(load(&left.join("new.actual.exr")), image);
    assert!(left.join("new.difference.exr").exists());
    assert_eq!(check(&folder, "new", &image, TOLERANCE, true), Ok(()));
    assert_eq!(load(&folder.join("new.exr")), image);
}

fn render(scale: f64, offset: DVec3, size: [u32; 2], settings: &Settings) -> Image {
    room(scale, offset, size).render(settings).image
}

#[test]
fn threads_change_no_bit() {
    let scene = room(1.0, DVec3::ZERO, [40, 24]).scene();
    let settings = Settings { samples: 2, ..settings(Method::Vpl) };
    let prepared = Prepared::new(gpu().clone(), scene, &settings).unwrap();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| frame(&prepared, &settings).image.pixels)
    };
    let one = with(1);
    assert!(one.as_flattened().iter().any(|&c| c > 0.0));
    assert_eq!(one, with(2));
    assert_eq!(one, with(1));
}

#[test]
fn plain_kernels_give_the_image_of_those_with_subgroups() {
    for clamp in [Clamp::Auto, Clamp::Off] {
        let settings = Settings { clamp, ..settings(Method::Vpl) };
        let images = [gpu().clone(), gpu().clone().without_subgroups()].map(|gpu| {
            let scene = room(1.0, DVec3::ZERO, [40, 24]).scene();
            let prepared = Prepared::new(gpu, scene, &settings).unwrap();
            frame(&prepared, &settings)
        });
        let [a, b] = &images;
        assert!(!a.image.pixels.is_empty() && a.counts.shadow_rays == b.counts.shadow_rays);
        let off = difference(&a.image.pixels, &b.image.pixels);
        assert!(off < 1e-5, "{clamp:?}: they differ by {off:e}");
    }
}

#[test]
fn odd_sizes_render() {
    for size in [[1, 1], [1, 257], [65, 3], [8, 8]] {
        for method in [Method::Vpl, Method::Depth] {
            let image = render(1.0, DVec3::ZERO, size, &settings(method));
            assert_eq!([image.width, image.height], size);
            assert_eq!(image.pixels.len() as u32, size[0] * size[1]);
            assert_eq!(image.first_nonfinite(), None);
            // Inside of a closed room every pixel shows something.
            assert!(image.pixels.iter().all(|p| p.iter().all(|&c| c > 0.0)), "{size:?}");
        }
    }
}

#[test]
fn neither_scale_nor_place_changes_the_image() {
    let size = [32, 32];
    let settings = settings(Method::Vpl);
    let base = render(1.0, DVec3::ZERO, size, &settings);
    for scale in [1024.0, 1.0 / 1024.0] {
        let image = render(scale, DVec3::ZERO, size, &settings);
        let off = difference(&image.pixels, &base.pixels);
        assert!(off <= 1e-6, "scale {scale}: off by {off:e}");
    }
    // Other scales and places round positions otherwise, to some 1e-7 and 1e-10 of the room:
    // only edges may show it.
    let edges = Tolerance { relative: 2e-3, absolute: 1e-3, pixels: 20 };
    for (scale, offset) in
        [(1.0, dvec3(1e6, -1e6, 1e6)), (1e-6, DVec3::ZERO), (1e6, dvec3(0.0, 3e11, 0.0))]
    {
        let image = render(scale, offset, size, &settings);
        if let Err(what) = compare(&base, &image, edges) {
            panic!("scale {scale}, offset {offset}: {what}");
        }
    }
    // Another room is another image.
    let mut other = room(1.0, DVec3::ZERO, size);
    other.draft.materials[0].albedo *= 0.999;
    assert!(difference(&other.render(&settings).image.pixels, &base.pixels) > 1e-4);
}

/// Thousands of slivers across a room, in boxes as large as the room: a ray meets nearly all
/// of the boxes, so that the loops of an invocation with many rays run for hundreds of
/// thousands of rounds. Drivers that leave them early (llvmpipe does after 65,535) must not
/// change the image.
#[test]
fn long_loops_are_run_to_their_end() {
    let mut build = room(1.0, DVec3::ZERO, [16, 8]);
    let black = build.material([0.0; 3], [0.0; 3], false);
    let mut random = Rng(5);
    for _ in 0..2500 {
        let near = |x: f64, random: &mut Rng| x * 0.9 + 0.05 * f64::from(random.unit());
        let ends = [-1.0, 1.0]
            .map(|x| dvec3(near(x, &mut random), near(x, &mut random), near(x, &mut random)));
        build.triangle(black, [ends[0], ends[1], ends[1] + dvec3(1e-4, 0.0, 0.0)]);
    }
    let settings = Settings { light_paths: 64, ..settings(Method::Vpl) };
    let scene = build.scene();
    let images = [gpu().clone(), gpu().clone().without_subgroups()].map(|gpu| {
        let prepared = Prepared::new(gpu, scene.clone(), &settings).unwrap();
        frame(&prepared, &settings)
    });
    let [a, b] = &images;
    assert_eq!(a.counts.shadow_rays, b.counts.shadow_rays);
    // A ray within rounding of a sliver's edge may see or not see its VPL.
    let pixels = a.image.pixels.iter().zip(&b.image.pixels);
    let off = pixels.filter(|(a, b)| (a[0] - b[0]).abs() > 1e-3 * b[0]).count();
    assert!(off <= a.image.pixels.len() / 50, "{off} pixels differ");
}
