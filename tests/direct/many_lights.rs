//! Lights without extent, so many that samples are drawn of them: right in the mean, for a few rays,
//! with little noise.

#![allow(clippy::expect_used, clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use crate::common::lights::mean_of;
use crate::common::{Build, Rng, gpu};
use glam::{DVec3, Vec3, dvec3};
use gpu_vpl::image::Image;
use gpu_vpl::render::{Direct, Method, Plan, Prepared, Settings};
use gpu_vpl::scene::{Bsdf, Environment, Scene};

const SIZE: u32 = 24;

fn settings(light_samples: u32) -> Settings {
    Settings {
        edge_samples: 1,
        light_samples: Some(light_samples),
        direct_filter: false,
        ..Settings::of(Method::Direct)
    }
}

/// So many rays that every light without extent has its own.
fn exact() -> Settings {
    settings(1024)
}

fn render(prepared: &Prepared, settings: &Settings, seed: u32) -> Image {
    let camera = &prepared.scene.camera;
    gpu_vpl::render::frame(prepared, camera, settings, seed, &|_, _| {}).unwrap().image
}

/// A room with a block in it, seen from the front; lights are added.
fn room(add: impl Fn(&mut Build)) -> Scene {
    let mut build = Build::open_room();
    build.camera(dvec3(0.1, -2.6, 0.3), dvec3(0.0, 1.0, -0.15), 50.0, [SIZE, SIZE]);
    add(&mut build);
    build.scene()
}

/// Adds so many lights off the walls, whose strength spans two orders of magnitude: every third a
/// spot, if there are to be, and the last infinitely far away.
fn add_lights(build: &mut Build, count: usize, mixed: bool) {
    let mut rng = Rng(5);
    for i in 0..count {
        let mut random = || 1.6 * f64::from(rng.unit()) - 0.8;
        // Above the block: near to a surface, a light is seen by few of the points of its pixels.
        let place = dvec3(random(), random(), 0.35 + 0.5 * random());
        let strength = 10f64.powf(1.25 * random()) / count as f64;
        let intensity = [strength, 0.5 * strength, 0.8 * strength];
        match i % 3 {
            _ if mixed && i + 1 == count => {
                build.directional_light(dvec3(-0.4, 0.5, -0.7), [0.2, 0.3, 0.1]);
            }
            2 if mixed => {
                let direction = dvec3(random(), random(), -1.0);
                build.spot_light(place, direction, intensity, [20.0, 35.0]);
            }
            _ => build.point_light(place, intensity),
        }
    }
}

/// Over frames of few samples, the mean of each quarter of the image is that of exact rays.
fn is_right_in_the_mean(scene: Scene, what: &str) {
    let few = settings(2);
    let prepared = Prepared::new(gpu().clone(), scene, &few).unwrap();
    let expected = render(&prepared, &exact(), 99);
    let frames: Vec<Image> = (0..48).map(|seed| render(&prepared, &few, seed)).collect();
    let (size, half) = (SIZE as usize, SIZE as usize / 2);
    for quarter in 0..4 {
        let place =
            |i: usize| (quarter / 2 * half + i / half) * size + quarter % 2 * half + i % half;
        let of = |image: &Image| mean_of(image, (0..half * half).map(place));
        let means: Vec<DVec3> = frames.iter().map(of).collect();
        let mean = means.iter().sum::<DVec3>() / means.len() as f64;
        let spread: DVec3 = means.iter().map(|own| (own - mean).powf(2.0)).sum();
        let error = (spread / (means.len() * (means.len() - 1)) as f64).map(f64::sqrt);
        let expected = of(&expected);
        for c in 0..3 {
            let off = (mean[c] - expected[c]).abs();
            let all = format!("{what}, {quarter}: {} ± {}, not {}", mean[c], error[c], expected[c]);
            assert!(off < 4.0 * error[c] + 1e-3 * expected[c], "{all}");
            assert!(error[c] < 0.04 * expected[c], "{all}");
        }
    }
}

#[test]
fn many_lights_are_right_in_the_mean() {
    is_right_in_the_mean(room(|build| add_lights(build, 60, false)), "points");
    is_right_in_the_mean(room(|build| add_lights(build, 60, true)), "all without extent");
    // Several lights a stratum.
    is_right_in_the_mean(room(|build| add_lights(build, 700, true)), "very many");
}

#[test]
fn many_lights_beside_lamps_and_sky_are_right_in_the_mean() {
    let scene = room(|build| {
        add_lights(build, 20, true);
        let lamp = build.material([0.0; 3], [20.0; 3], false);
        build.sphere(lamp, dvec3(0.7, -0.2, 0.2), 0.1);
        let corner = |x, y| dvec3(x, y, 0.95);
        build.polygon(lamp, &[corner(-0.8, 0.3), corner(-0.8, 0.5), corner(-0.6, 0.5)]);
        build.draft.environment = Some(Environment { radiance: Vec3::splat(0.1), image: None });
    });
    is_right_in_the_mean(scene, "beside lamps and sky");
}

#[test]
fn many_lights_on_glossy_surfaces_are_right_in_the_mean() {
    let scene = room(|build| {
        build.draft.materials[0].bsdf = Bsdf::Phong { specular: Vec3::splat(0.2), shininess: 40.0 };
        add_lights(build, 40, true);
    });
    is_right_in_the_mean(scene, "glossy");
}

/// Of all rays that a pixel could have to one light each, those to lights without extent are few; the
/// error of four of them is far below that of four lights drawn uniformly, which is known exactly:
/// (n Σ f² - (Σ f)²) / 4 of what each light gives.
#[test]
fn few_rays_to_many_lights_leave_little_noise() {
    const COUNT: usize = 30;
    let scene = room(|build| add_lights(build, COUNT, false));
    let few = settings(4);
    let prepared = Prepared::new(gpu().clone(), scene, &few).unwrap();
    let reference = render(&prepared, &exact(), 1);
    let (mut squares, mut sums) =
        (vec![0.0; reference.pixels.len()], vec![0.0; reference.pixels.len()]);
    for light in 0..COUNT {
        let scene = room(|build| {
            add_lights(build, COUNT, false);
            build.draft.point_lights = vec![build.draft.point_lights[light]];
        });
        let prepared = Prepared::new(gpu().clone(), scene, &few).unwrap();
        for (i, pixel) in render(&prepared, &few, 1).pixels.iter().enumerate() {
            let own = f64::from(pixel[0]);
            squares[i] += own * own;
            sums[i] += own;
        }
    }
    let uniform =
        squares.iter().zip(&sums).map(|(own, sum)| (COUNT as f64 * own - sum * sum) / 4.0);
    let uniform: f64 = uniform.sum();
    let seeds = 4;
    let guided: f64 = (0..seeds)
        .flat_map(|seed| render(&prepared, &few, seed).pixels.into_iter().zip(&reference.pixels))
        .map(|(a, b)| f64::from(a[0] - b[0]).powi(2) / f64::from(seeds))
        .sum();
    assert!(guided < 0.1 * uniform, "{guided}, drawn uniformly {uniform}");
}

fn labels(scene: &Scene, settings: &Settings) -> Vec<&'static str> {
    let plan = Plan::new(scene.clone(), settings, true);
    plan.programs(settings).iter().map(|program| program.label).collect()
}

/// A few lights have a ray each, as all have where samples are many; else none has.
#[test]
fn rays_do_not_grow_with_lights() {
    let linked = |count, settings: Settings, label: &str| {
        labels(&room(|build| add_lights(build, count, true)), &settings).contains(&label)
    };
    let own = ["direct light, points", "direct light, spots", "direct light, directional"];
    for (count, settings, are_exact) in [
        (8, settings(4), true),
        (9, settings(4), false),
        (500, settings(4), false),
        (500, exact(), true),
    ] {
        for label in own {
            assert_eq!(linked(count, settings, label), are_exact, "{count}: {label}");
        }
        assert_eq!(linked(count, settings, "direct light, samples"), !are_exact, "{count}");
    }
    // Points whose visibility clusters share are not among them.
    let clustered = Settings { direct: Direct::Clustered, ..settings(4) };
    let clustered = Settings { method: Method::Vpc, ..clustered };
    assert!(linked(12, clustered, "direct light, spots"));
    assert!(!linked(60, clustered, "direct light, spots"));
}

/// A scene file with more lights than have a ray each, of all kinds, is shown as light by light.
#[test]
fn a_scene_file_of_many_lights() {
    let head = "[camera]\nposition = [0, 0, 3]\ntarget = [0, 0, 0]\nfov = 50\nsize = [24, 24]\n\
        [materials.white]\nalbedo = [0.8, 0.8, 0.8]\n\
        [[sphere]]\ncenter = [0, 0, 0]\nradius = 0.8\nmaterial = \"white\"\n";
    let point = |i: f64| {
        format!(
            "[[light]]\ntype = \"point\"\nposition = [{}, 1, 2]\nintensity = [1, 2, {i}]\n",
            i - 2.0
        )
    };
    let spot = |i: f64| {
        format!(
            "[[light]]\ntype = \"spot\"\nposition = [{}, -1, 2]\ntarget = [0, 0, 0]\n\
             intensity = [{i}, 3, 1]\nangle = 40\nsoftness = 0.5\n",
            i - 2.0
        )
    };
    let directional = |i: f64| {
        format!(
            "[[light]]\ntype = \"directional\"\ndirection = [{}, 0, -1]\nirradiance = [{i}, 1, 0.5]\n",
            i - 2.0
        )
    };
    let others = "[[light]]\ntype = \"environment\"\nradiance = [0.2, 0.3, 0.4]\n\
        [[light]]\ntype = \"sphere\"\ncenter = [1.5, 1.5, 1.5]\nradius = 0.1\nradiance = [20, 10, 10]\n";
    let lights: Vec<String> = (1..=4)
        .map(f64::from)
        .flat_map(|i| [point(i), spot(i), directional(i)])
        .chain([others.to_owned()])
        .collect();
    let folder = tempfile::tempdir().unwrap();
    let shown = |name: &str, lights: &[String]| {
        let file = folder.path().join(name);
        std::fs::write(&file, [head, &lights.concat()].concat()).unwrap();
        let scene = Scene::load(file.to_str().unwrap()).unwrap();
        let many = Settings { direct_filter: false, ..settings(48) };
        let prepared = Prepared::new(gpu().clone(), scene, &many).unwrap();
        let frames = (0..8).map(|seed| render(&prepared, &many, seed));
        frames.map(|image| mean_of(&image, 0..image.pixels.len())).sum::<DVec3>() / 8.0
    };
    let together = shown("together.toml", &lights);
    let one_by_one: DVec3 = lights
        .iter()
        .enumerate()
        .map(|(i, light)| shown(&format!("{i}.toml"), std::slice::from_ref(light)))
        .sum();
    let off = (together / one_by_one - DVec3::ONE).abs().max_element();
    assert!(off < 5e-3, "{together} together, {one_by_one} one by one");
}
