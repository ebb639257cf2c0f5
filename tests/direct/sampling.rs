//! Light samples: whatever guides them, their mean is the light; and what combines them over pixels
//! takes noise away and leaves the edges of shadows.

#![allow(clippy::expect_used, reason = "a helper of tests fails by panicking")]

use crate::common::lights::mean_of;
use crate::common::{Build, gpu};
use glam::{DVec3, Vec3, dvec3};
use gpu_vpl::image::Image;
use gpu_vpl::render::{Method, Prepared, Settings};
use gpu_vpl::scene::{Environment, Scene};

const SIZE: u32 = 48;

/// A room with a block in it, under lamps, an emitting sphere and an even sky, which a wall hides in
/// part.
fn room() -> Scene {
    let mut build = Build::open_room();
    build.draft.environment = Some(Environment { radiance: Vec3::splat(0.3), image: None });
    let wall = build.material([0.5; 3], [0.0; 3], false);
    let lamp = build.material([0.0; 3], [20.0; 3], false);
    let corner = |x, y| dvec3(x, y, 0.95);
    for x in [-0.8, 0.5] {
        let corners = [corner(x, 0.3), corner(x, 0.5), corner(x + 0.2, 0.5), corner(x + 0.2, 0.3)];
        build.polygon(lamp, &corners);
    }
    build.sphere(lamp, dvec3(0.7, -0.2, 0.2), 0.1);
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z];
    build.polygon(wall, &[-x - y + z, -x + y + z, 0.1 * x + y + z, 0.1 * x - y + z]);
    build.camera(dvec3(0.1, -2.6, 0.3), dvec3(0.0, 1.0, -0.15), 50.0, [SIZE, SIZE]);
    build.scene()
}

fn settings() -> Settings {
    Settings { edge_samples: 1, ..Settings::of(Method::Direct) }
}

fn render(prepared: &Prepared, settings: &Settings, seed: u32) -> Image {
    let camera = &prepared.scene.camera;
    gpu_vpl::render::frame(prepared, camera, settings, seed, &|_, _| {})
        .expect("the frame renders")
        .image
}

fn squared_error(image: &Image, reference: &Image, of: impl Fn(usize) -> bool) -> f64 {
    let off = |i: usize| {
        let pair = image.pixels[i].iter().zip(&reference.pixels[i]);
        pair.map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>()
    };
    let chosen: Vec<usize> = (0..image.pixels.len()).filter(|&i| of(i)).collect();
    chosen.iter().map(|&i| off(i)).sum::<f64>() / chosen.len() as f64
}

/// The mean of many frames of few samples, which a guide draws, is what many samples give that a guide
/// hardly moves: everywhere, so that no place is left out that sees a light.
#[test]
fn guided_samples_are_right_in_the_mean() {
    let prepared = Prepared::new(gpu().clone(), room(), &settings()).unwrap();
    let few = Settings { light_samples: Some(2), direct_filter: false, ..settings() };
    let many = Settings { light_samples: Some(4096), ..few };
    let reference = render(&prepared, &many, 1000);
    let frames: Vec<Image> = (0..48).map(|seed| render(&prepared, &few, seed)).collect();
    let all = |i: usize| i < reference.pixels.len();
    let expected = mean_of(&reference, 0..reference.pixels.len());
    let means: Vec<DVec3> =
        frames.iter().map(|image| mean_of(image, 0..image.pixels.len())).collect();
    let mean = means.iter().sum::<DVec3>() / means.len() as f64;
    let spread: DVec3 = means.iter().map(|own| (own - mean).powf(2.0)).sum();
    let error = (spread / (means.len() * (means.len() - 1)) as f64).map(f64::sqrt);
    for c in 0..3 {
        let off = (mean[c] - expected[c]).abs();
        assert!(off < 4.0 * error[c], "{} instead of {}", mean[c], expected[c]);
        assert!(error[c] < 3e-3 * expected[c], "{} says little", error[c]);
    }
    // And pixel by pixel: noise falls as that of independent frames does.
    let average = |count: usize| {
        let mut image = frames[0].clone();
        for (i, pixel) in image.pixels.iter_mut().enumerate() {
            for (c, channel) in pixel.iter_mut().enumerate() {
                let sum: f32 = frames[..count].iter().map(|frame| frame.pixels[i][c]).sum();
                *channel = sum / count as f32;
            }
        }
        squared_error(&image, &reference, all)
    };
    let errors = frames.iter().map(|image| squared_error(image, &reference, all));
    let (one, all) = (errors.sum::<f64>() / frames.len() as f64, average(frames.len()));
    assert!(all < 2.0 * one / 48.0, "{one} falls to {all}");
}

/// Combined over pixels, samples are less noisy; beside the edges of shadows, too.
#[test]
fn combining_takes_noise_and_leaves_edges() {
    let prepared = Prepared::new(gpu().clone(), room(), &settings()).unwrap();
    let off = Settings { light_samples: Some(4), direct_filter: false, ..settings() };
    let on = Settings { direct_filter: true, ..off };
    let reference = render(&prepared, &Settings { light_samples: Some(4096), ..off }, 1000);
    // Where neighbours in a row differ much.
    let level = |i: usize| reference.pixels[i].iter().sum::<f32>();
    let is_edge = |i: usize| {
        let near = (i.saturating_sub(2)..(i + 3).min(reference.pixels.len())).map(level);
        let (low, high) = near
            .fold((f32::MAX, 0.0), |(low, high): (f32, f32), own| (low.min(own), high.max(own)));
        high > 1.5 * low
    };
    let error = |settings: &Settings, of: &dyn Fn(usize) -> bool| {
        let errors =
            (0..6).map(|seed| squared_error(&render(&prepared, settings, seed), &reference, of));
        errors.sum::<f64>() / 6.0
    };
    let everywhere = [&off, &on].map(|settings| error(settings, &|_| true));
    let at_edges = [&off, &on].map(|settings| error(settings, &is_edge));
    assert!(everywhere[1] < 0.4 * everywhere[0], "{everywhere:?}");
    assert!(at_edges[1] < at_edges[0], "{at_edges:?}");
}

/// Of many samples, which leave little noise, nothing is combined, and the light is no worse.
#[test]
fn combining_leaves_many_samples_alone() {
    let prepared = Prepared::new(gpu().clone(), room(), &settings()).unwrap();
    let off = Settings { light_samples: Some(256), direct_filter: false, ..settings() };
    let reference = render(&prepared, &Settings { light_samples: Some(8192), ..off }, 1000);
    let on = Settings { direct_filter: true, ..off };
    let [off, on] = [off, on]
        .map(|settings| squared_error(&render(&prepared, &settings, 1), &reference, |_| true));
    assert!(on <= off, "{on}, and without {off}");
}
