//! The path tracer against closed forms, to its own standard error.

use std::f64::consts::PI;

use crate::common::paths::{mean_and_error, settings};
use crate::common::{Build, furnace};
use glam::{DVec3, dvec3};
use gpu_vpl::render::{Bounces, Direct, Frame, Method, Settings};

/// The mean of the image is what is expected: to 4 of its standard errors, which are below 2 %,
/// and to 0.5 %, as stratified samples are better than independent ones.
fn assert_mean(frame: &Frame, expected: [f64; 3], what: &str) {
    for (channel, expected) in expected.into_iter().enumerate() {
        let (mean, error) = mean_and_error(frame, channel);
        assert!(error <= 0.02 * expected, "{what}: error {error} of {expected}");
        // Where every sample is the same, rounding is left.
        let most = (4.0 * error + 2e-6 * expected).min(0.005 * expected);
        let off = (mean - expected).abs();
        assert!(off <= most, "{what}, {channel}: {mean}, not {expected}, ± {error}");
    }
}

/// Emission, direct light and B bounces are B + 2 terms of a geometric series.
#[test]
fn furnace_has_the_radiance_of_its_geometric_series() {
    let emission = [1.0, 0.5, 2.0];
    let cases = [
        ([0.2, 0.5, 0.8], Bounces::Finite(0), 1.0),
        ([0.2, 0.5, 0.8], Bounces::Finite(1), 1e-6),
        ([0.2, 0.5, 0.8], Bounces::Finite(2), 1.0),
        ([0.9, 0.5, 1.0], Bounces::Finite(5), 1e6),
        ([0.2, 0.5, 0.8], Bounces::Unlimited, 37.0),
        ([0.5, 0.0, 0.0], Bounces::Unlimited, 1.0),
        ([0.98; 3], Bounces::Unlimited, 1.0),
        ([0.999; 3], Bounces::Finite(300), 1.0),
    ];
    for (albedo, bounces, scale) in cases {
        let mut build = furnace(albedo, emission, scale);
        if bounces == Bounces::Finite(300) {
            // Such paths are long, and hardly deviate.
            build.draft.camera.as_mut().unwrap().size = [8, 8];
        }
        let frame = build.render(&settings(64, bounces));
        let expected = [0, 1, 2].map(|channel| {
            let rho: f64 = albedo[channel];
            let series = match bounces {
                Bounces::Finite(most) => (0..most + 2).map(|k| rho.powi(k as i32)).sum(),
                Bounces::Unlimited => 1.0 / (1.0 - rho),
            };
            emission[channel] * series
        });
        assert_mean(&frame, expected, &format!("ρ {albedo:?}, {bounces:?}"));
    }
}

/// Without the light that comes straight from its source the series lacks its second term.
#[test]
fn a_furnace_without_direct_light_lacks_one_term() {
    for bounces in [Bounces::Finite(0), Bounces::Finite(2), Bounces::Unlimited] {
        let settings = Settings { direct: Direct::Off, ..settings(64, bounces) };
        let frame = furnace([0.6; 3], [1.0; 3], 1.0).render(&settings);
        let series = match bounces {
            Bounces::Finite(0) => 1.0,
            Bounces::Finite(_) => 1.0 + 0.36 + 0.216,
            Bounces::Unlimited => 1.0 / 0.4 - 0.6,
        };
        assert_mean(&frame, [series; 3], &format!("{bounces:?}"));
    }
}

/// The plane z = 0 seen from straight above.
fn plane(scale: f64, fov: f64, size: u32) -> Build {
    let mut build = Build::at(scale, DVec3::ZERO);
    let white = build.material(ALBEDO, [0.0; 3], false);
    let corner = |x, y| dvec3(x, y, 0.0);
    let corners = [corner(-8.0, -8.0), corner(8.0, -8.0), corner(8.0, 8.0), corner(-8.0, 8.0)];
    build.polygon(white, &corners);
    build.camera(dvec3(0.0, 0.0, EYE), DVec3::NEG_Z, fov, [size; 2]);
    build
}

const ALBEDO: [f64; 3] = [0.5, 0.25, 1.0];
const EYE: f64 = 0.45;

/// Irradiance of a polygon of radiance 1, all of it above the horizon (Lambert, 1760).
fn lambert(corners: &[DVec3], at: DVec3) -> f64 {
    let edges = (0..corners.len()).map(|i| {
        let [a, b] = [i, i + 1].map(|i| (corners[i % corners.len()] - at).normalize());
        a.angle_between(b) * a.cross(b).normalize().z
    });
    (0.5 * edges.sum::<f64>()).abs()
}

/// Every pixel is right to 5 standard errors, for one or two sides, alone (B = 0) and with the
/// weights of multiple importance sampling (a black lamp reflects nothing).
#[test]
fn a_quad_light_by_lamberts_formula() {
    let (center, u, v) = (dvec3(0.4, -0.1, 1.2), dvec3(0.5, 0.1, 0.2), dvec3(0.0, 0.6, -0.3));
    let quad = [center - u - v, center - u + v, center + u + v, center + u - v];
    let size = 4;
    for (two_sided, bounces) in [(false, 0), (true, 0), (false, 1), (true, 1)] {
        let mut build = plane(37.0, 1.0, size);
        let lamp = build.material([0.0; 3], [4.0, 2.0, 1.0], two_sided);
        build.polygon(lamp, &quad);
        let frame = build.render(&settings(1024, Bounces::Finite(bounces)));
        let error = frame.standard_error.unwrap();
        for (pixel, error) in frame.image.pixels.iter().zip(&error.pixels) {
            for channel in 0..3 {
                // The camera sees next to nothing but the origin.
                let radiance = [4.0, 2.0, 1.0][channel];
                let expected = ALBEDO[channel] / PI * radiance * lambert(&quad, DVec3::ZERO);
                let (got, error) = (f64::from(pixel[channel]), f64::from(error[channel]));
                assert!(error < 0.02 * expected, "{error} of {expected}");
                assert!((got - expected).abs() < 4.0 * error, "{got}, not {expected}, ± {error}");
            }
        }
    }
}

/// E = I h / (h² + x²)^1.5 of every light; which of the lights is chance.
#[test]
fn point_lights_over_a_plane() {
    let lights = [(dvec3(0.3, -0.2, 0.7), 2.0), (dvec3(-1.0, 0.5, 1.5), 9.0)];
    let irradiance = |light: DVec3| light.z / light.length().powi(3);
    for count in [1, 2] {
        let mut build = plane(1e-3, 1e-3, 4);
        for (light, intensity) in &lights[..count] {
            build.point_light(*light, [*intensity; 3]);
        }
        let frame = build.render(&settings(256, Bounces::Finite(2)));
        let sum: f64 = lights[..count].iter().map(|(at, i)| i * irradiance(*at)).sum();
        assert_mean(&frame, ALBEDO.map(|albedo| albedo / PI * sum), "point lights");
        assert_eq!(frame.counts.shadow_rays, 16 * 256, "one shadow ray a vertex");
    }
}

/// Unit squares opposite each other at distance 1 have the form factor 0.1998 (Howell, C-11): the
/// mean irradiance of one is π L times that. The camera sees all of the floor, and nothing else.
#[test]
fn the_form_factor_of_opposite_squares() {
    let mut build = Build::new();
    let floor = build.material([0.5; 3], [0.0; 3], false);
    let lamp = build.material([0.0; 3], [1.0; 3], false);
    let square = |z| [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| dvec3(x, y, z));
    build.polygon(floor, &square(0.0));
    let mut ceiling = square(1.0);
    ceiling.reverse();
    build.polygon(lamp, &ceiling);
    build.camera(dvec3(0.5, 0.5, 0.5), DVec3::NEG_Z, 90.0, [16, 16]);
    for bounces in [0, 3] {
        let frame = prepare_and_render(&build, &settings(256, Bounces::Finite(bounces)));
        assert_mean(&frame, [0.5 * 0.199_825; 3], "form factor");
    }
}

fn prepare_and_render(build: &Build, settings: &Settings) -> Frame {
    let build = Build { draft: build.draft.clone(), ..*build };
    build.render(settings)
}

/// Emission is what the other methods show, edges and backs of lights included.
#[test]
fn emission_is_that_of_the_other_methods() {
    for method in [Method::Path, Method::Direct] {
        let mut build = Build::new();
        let lamps = [false, true].map(|two| build.material([0.5; 3], [4.0, 5.0, 6.0], two));
        for (x, lamp) in [(-0.5, lamps[0]), (0.5, lamps[1])] {
            let corner = |y, z| dvec3(x, y, z);
            build.triangle(lamp, [corner(-0.2, -0.2), corner(0.2, -0.2), corner(0.0, 0.3)]);
        }
        let settings = Settings {
            direct: Direct::Off,
            bounces: Bounces::Finite(0),
            samples: 1,
            edge_samples: 1,
            ..Settings::of(method)
        };
        // The triangles face +x: from there both are lit, from behind the two-sided one alone.
        for (from, direction, lit) in [
            (3.0, DVec3::NEG_X, 2),
            (0.0, DVec3::NEG_X, 1),
            (0.0, DVec3::X, 1),
            (-3.0, DVec3::X, 0),
        ] {
            build.camera(dvec3(from, 0.0, 0.0), direction, 1.0, [1, 1]);
            let frame = prepare_and_render(&build, &settings);
            let expected = if lit > 0 { [4.0, 5.0, 6.0] } else { [0.0; 3] };
            assert_eq!(frame.image.pixels, [expected], "{method:?} from {from}");
            assert_eq!(frame.standard_error, None);
        }
    }
}
