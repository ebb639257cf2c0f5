//! Direct light on glossy surfaces: light samples and rays of the lobe share what it reflects.

#![allow(clippy::expect_used, clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use crate::common::lights::mean_of;
use crate::common::{Build, frame, gpu};
use glam::{DVec3, Vec3, dvec3};
use gpu_vpl::image::Image;
use gpu_vpl::render::{Bounces, Direct, Method, Prepared, Settings};
use gpu_vpl::scene::environment::pack;
use gpu_vpl::scene::{Bsdf, Environment, EnvironmentImage, Scene};

const SIZE: u32 = 32;

fn phong(specular: f32, shininess: f32) -> Bsdf {
    Bsdf::Phong { specular: Vec3::splat(specular), shininess }
}

/// A room with a block in it, without ceiling and front: floor, walls and block of several lobes.
fn room() -> Build {
    let mut build = Build::open_room();
    build.draft.materials[0].bsdf = phong(0.2, 300.0);
    build.draft.materials[1].bsdf = phong(0.2, 8.0);
    build.camera(dvec3(0.1, -2.6, 0.3), dvec3(0.0, 1.0, -0.15), 50.0, [SIZE, SIZE]);
    build
}

/// Stands up in the room, two-sided, so near to the floor that solid angles count, with a texture.
fn add_lamp(build: &mut Build) {
    let lamp = build.material([0.0; 3], [20.0, 15.0, 10.0], true);
    let rows = (0..16u8).map(|i| [255, 16 * i, 255 - 16 * i, 255]).collect();
    build.draft.materials[lamp as usize].emission_texture = Some(build.texture(4, rows));
    build.textured(lamp, dvec3(-0.8, 0.3, -0.6), 0.3 * DVec3::X, -0.3 * DVec3::Z);
}

fn add_ball(build: &mut Build, two_sided: bool) {
    let ball = build.material([0.0; 3], [9.0, 10.0, 11.0], two_sided);
    build.sphere(ball, dvec3(0.65, -0.2, -0.5), 0.15);
}

fn add_sky(build: &mut Build, image: bool) {
    // A sun in a dim sky.
    let texel = |i: u32| if i == 75 { Vec3::splat(90.0) } else { Vec3::new(0.2, 0.3, 0.5) };
    let size = [32, 16];
    let texels = (0..512).map(|i| pack(texel(i))).collect();
    let image = image.then(|| EnvironmentImage { name: "test".to_owned(), size, texels });
    build.draft.environment = Some(Environment { radiance: Vec3::splat(0.5), image });
}

fn render(prepared: &Prepared, settings: &Settings, seed: u32) -> Image {
    let camera = &prepared.scene.camera;
    gpu_vpl::render::frame(prepared, camera, settings, seed, &|_, _| {}).unwrap().image
}

/// The pixels of a quarter of the image.
fn quarter(quarter: usize) -> impl Iterator<Item = usize> + Clone {
    let (size, half) = (SIZE as usize, SIZE as usize / 2);
    (0..half * half)
        .map(move |i| (quarter / 2 * half + i / half) * size + quarter % 2 * half + i % half)
}

/// The means over quarters of the image of so few light samples that a guide draws them, and of many,
/// are those of paths, which weigh them otherwise.
fn agrees_with_paths(scene: Scene, what: &str) {
    let path =
        Settings { bounces: Bounces::Finite(0), samples: 4096, ..Settings::of(Method::Path) };
    let prepared = Prepared::new(gpu().clone(), scene, &path).unwrap();
    let expected = frame(&prepared, &path);
    let errors = expected.standard_error.unwrap();
    for light_samples in [2, 16] {
        let settings = Settings {
            samples: 16,
            light_samples: Some(light_samples),
            direct_filter: false,
            ..Settings::of(Method::Direct)
        };
        let images: Vec<Image> = (0..6).map(|seed| render(&prepared, &settings, seed)).collect();
        for pixels in (0..4).map(quarter) {
            let count = pixels.clone().count() as f64;
            let variance = |i: usize| f64::from(errors.pixels[i][0]).powi(2);
            let of_paths = pixels.clone().map(variance).sum::<f64>().sqrt() / count;
            let expected = mean_of(&expected.image, pixels.clone()).x;
            let means = images.iter().map(|image| mean_of(image, pixels.clone()).x);
            let mean = means.clone().sum::<f64>() / images.len() as f64;
            let squares: f64 = means.map(|own| (own - mean).powi(2)).sum();
            let own = (squares / (images.len() * (images.len() - 1)) as f64).sqrt();
            let (off, noise) = ((mean - expected).abs(), of_paths.hypot(own));
            let all = format!("{what}, {light_samples}: {mean}, not {expected}, ± {noise}");
            assert!(off < 4.0 * noise + 1e-3 * expected, "{all}");
            assert!(noise < 1e-2 * expected, "{all}");
        }
    }
}

#[test]
fn lamps_on_glossy_surfaces_are_right_in_the_mean() {
    let mut build = room();
    add_lamp(&mut build);
    agrees_with_paths(build.scene(), "a lamp");
}

#[test]
fn spheres_on_glossy_surfaces_are_right_in_the_mean() {
    for two_sided in [false, true] {
        let mut build = room();
        add_ball(&mut build, two_sided);
        agrees_with_paths(build.scene(), "a sphere");
    }
}

#[test]
fn skies_on_glossy_surfaces_are_right_in_the_mean() {
    for image in [false, true] {
        let mut build = room();
        add_sky(&mut build, image);
        agrees_with_paths(build.scene(), "a sky");
    }
}

#[test]
fn all_lights_on_glossy_surfaces_are_right_in_the_mean() {
    let mut build = room();
    add_lamp(&mut build);
    add_ball(&mut build, false);
    add_sky(&mut build, true);
    agrees_with_paths(build.scene(), "all");
}

/// A glossy plane that reflects by its lobe alone, under a light, seen at an angle.
fn black_plane(shininess: f32, light: impl Fn(&mut Build)) -> Prepared {
    let mut build = Build::new();
    let plane = build.finished([0.0; 3], phong(0.5, shininess));
    let corner = |x, y| dvec3(8.0 * x, 8.0 * y, 0.0);
    build.polygon(
        plane,
        &[corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
    );
    light(&mut build);
    build.camera(dvec3(0.0, -2.0, 2.0), dvec3(0.0, 1.0, -1.0), 30.0, [SIZE, SIZE]);
    let settings = Settings { edge_samples: 1, ..Settings::of(Method::Direct) };
    Prepared::new(gpu().clone(), build.scene(), &settings).unwrap()
}

fn few(light_samples: u32) -> Settings {
    Settings {
        edge_samples: 1,
        light_samples: Some(light_samples),
        direct_filter: false,
        ..Settings::of(Method::Direct)
    }
}

/// A narrow lobe sees the sky evenly: k_s (n + 2) / (n + 1) times the mean of its cosines. Samples
/// of the sky by the cosine would spread by some (n + 2) / (2 √(2 n)), which is six times the light.
#[test]
fn a_narrow_lobe_shows_no_specks_of_the_sky() {
    let prepared = black_plane(250.0, |build| add_sky(build, false));
    let [image, reference] = [few(4), few(4096)].map(|settings| render(&prepared, &settings, 1));
    for (pixel, expected) in image.pixels.iter().zip(&reference.pixels) {
        assert!((pixel[0] / expected[0] - 1.0).abs() < 0.3, "{pixel:?} instead of {expected:?}");
    }
}

/// A wide lobe sees a small lamp: its own rays would hit it one time in a hundred.
#[test]
fn a_wide_lobe_shows_no_specks_of_a_small_lamp() {
    let prepared = black_plane(4.0, |build| {
        let lamp = build.material([0.0; 3], [100.0; 3], false);
        build.sphere(lamp, dvec3(0.0, 1.0, 1.5), 0.1);
    });
    let [image, reference] = [few(4), few(4096)].map(|settings| render(&prepared, &settings, 1));
    let mean = mean_of(&reference, 0..reference.pixels.len()).x as f32;
    for (pixel, expected) in image.pixels.iter().zip(&reference.pixels) {
        assert!((pixel[0] - expected[0]).abs() < 0.1 * mean, "{pixel:?}, not {expected:?}");
    }
}

/// The reflection of a lamp, of which few of the pixels are at its edge, is as sharp as without the
/// filter.
#[test]
fn combining_leaves_reflections_sharp() {
    let prepared = black_plane(20_000.0, |build| {
        let lamp = build.material([0.0; 3], [10.0; 3], true);
        let corner = |x, z| dvec3(x, 3.0, z);
        for x in [-0.9, -0.5, -0.1, 0.3, 0.7] {
            let corners =
                [corner(x, 2.2), corner(x, 3.8), corner(x + 0.2, 3.8), corner(x + 0.2, 2.2)];
            build.polygon(lamp, &corners);
        }
    });
    let off = few(4);
    let reference = render(&prepared, &few(1024), 9);
    let brightest = reference.pixels.iter().map(|pixel| pixel[0]).fold(0.0, f32::max);
    assert!(brightest > 3.0, "the lamps are not seen: {brightest}");
    let error = |settings: &Settings| {
        let of = |seed| squared_error(&render(&prepared, settings, seed), &reference);
        (0..4).map(of).sum::<f64>()
    };
    let [off, on] = [off, Settings { direct_filter: true, ..off }].map(|settings| error(&settings));
    assert!(on < 1.1 * off, "{on}, and {off} without the filter");
}

fn squared_error(image: &Image, reference: &Image) -> f64 {
    let pairs = image.pixels.as_flattened().iter().zip(reference.pixels.as_flattened());
    pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum()
}

/// Clusters share the visibility of lamps; rays of the lobe leave these alone, and find the sky.
#[test]
fn rays_of_the_lobe_leave_clustered_lamps_alone() {
    let mut build = room();
    add_lamp(&mut build);
    add_sky(&mut build, true);
    let scene = build.scene();
    let own = Settings {
        bounces: Bounces::Finite(0),
        light_samples: Some(1024),
        ..Settings::of(Method::Vpc)
    };
    let clustered = Settings { direct: Direct::Clustered, interleave: 1, candidates: 1, ..own };
    let prepared = Prepared::new(gpu().clone(), scene, &own).unwrap();
    let [own, clustered] =
        [own, clustered].map(|settings| render(&prepared, &settings, 1)).map(|image| {
            let pixels = 0..image.pixels.len();
            mean_of(&image, pixels).x
        });
    assert!((clustered / own - 1.0).abs() < 0.03, "{clustered} instead of {own}");
}
