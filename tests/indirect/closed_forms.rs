//! Indirect light of whole frames against closed forms.

use std::f64::consts::PI;

use crate::common::{Build, frame, furnace, gpu};
use glam::{DVec3, dvec3};
use gpu_vpl::render::{Bounces, Clamp, Direct, Method, Prepared, Settings, light_paths};

fn settings(light_paths: u32, bounces: u32) -> Settings {
    Settings {
        light_paths,
        bounces: Bounces::Finite(bounces),
        clamp: Clamp::Off,
        light_samples: Some(1024),
        ..Settings::of(Method::Vpl)
    }
}

/// Emission, direct light and B bounces are B + 2 terms of a geometric series.
#[test]
fn furnace_has_the_radiance_of_its_geometric_series() {
    let emission = [1.0, 0.5, 2.0];
    let cases = [
        ([0.5; 3], 0, 1.0),
        ([0.2, 0.5, 0.8], 1, 1.0),
        ([0.8, 0.9, 0.3], 3, 1e-6),
        ([0.95, 0.9, 0.5], 8, 1e6),
        ([1.0, 0.999, 0.0], 5, 37.0),
    ];
    for (albedo, bounces, scale) in cases {
        let build = furnace(albedo, emission, scale);
        let frame = build.render(&settings(6000, bounces));
        for channel in 0..3 {
            let n = frame.image.pixels.len() as f64;
            let sum: f64 = frame.image.pixels.iter().map(|p| f64::from(p[channel])).sum();
            let rho = albedo[channel];
            let terms: f64 = (0..bounces + 2).map(|k| rho.powi(k as i32)).sum();
            let off = sum / n / (emission[channel] * terms) - 1.0;
            // The 1/d² of samples and VPLs near the edges of the box has heavy tails: over seeds,
            // the mean of 1024 pixels deviates by some 0.3 %.
            assert!(off.abs() < 0.01, "ρ {rho}, B {bounces}, scale {scale}: off by {off:.4}");
        }
        assert_eq!(frame.counts.vpls, 6000 * u64::from(bounces), "a closed box keeps every path");
        // What is cut off goes on with ρ^B of the flux of each channel.
        let carried = |b| -> f64 { (0..3).map(|c| emission[c] * f64::powi(albedo[c], b)).sum() };
        let expected = (bounces > 0).then(|| carried(bounces as i32) / carried(0));
        let off =
            frame.counts.truncated_fraction.zip(expected).map(|(got, e)| (got / e - 1.0).abs());
        assert_eq!(frame.counts.truncated_fraction.is_some(), expected.is_some());
        assert!(off.is_none_or(|off| off < 1e-4), "{expected:?}: off by {off:?}");
    }
}

/// In a convex room with a point light every pixel is a sum over known VPLs, all of them seen.
#[test]
fn every_pixel_is_the_sum_over_the_vpls() {
    let (low, high) = (dvec3(-1.0, -0.8, -0.6), dvec3(1.0, 0.8, 0.6));
    let eye = dvec3(-0.3, 0.2, 0.1);
    let albedo = [0.8, 0.5, 0.2];
    for (paths, bounces, bound) in [(1, 1, None), (77, 3, None), (77, 3, Some(0.2)), (700, 1, None)]
    {
        let mut build = Build::new();
        let wall = build.material(albedo, [0.0; 3], false);
        build.cuboid(wall, low, high, true);
        build.point_light(dvec3(0.5, 0.1, 0.3), [1.0, 2.0, 3.0]);
        let size = 24;
        build.camera(eye, DVec3::X, 90.0, [size, size]);
        let settings = Settings {
            direct: Direct::Off,
            clamp: bound.map_or(Clamp::Off, Clamp::At),
            edge_samples: 1,
            ..settings(paths, bounces)
        };
        let prepared = Prepared::new(gpu().clone(), build.scene(), &settings).unwrap();
        assert_eq!(prepared.scene.units.scale, 1.0, "positions below are in the file's units");
        let vpls = light_paths(&prepared, &settings, 1);
        assert_eq!(vpls.len() as u32, paths * bounces);
        let frame = frame(&prepared, &settings);
        assert_eq!(frame.counts.clamp.map(|b| b as f32), bound.map(|b| b as f32));
        let mut clamped = 0;
        for (i, pixel) in (0..).zip(&frame.image.pixels) {
            let at = |i: u32| (2.0 * f64::from(i) + 1.0) / f64::from(size) - 1.0;
            // Looking along x with z up, the image's right is -y.
            let direction = dvec3(1.0, -at(i % size), -at(i / size));
            let (t, normal) = wall_of_box(eye, direction, low, high);
            let position = eye + t * direction;
            let mut expected = DVec3::ZERO;
            // Positions are f32: a cosine is off by a rounding over the distance.
            let mut error = 1e-6;
            for vpl in &vpls {
                let d = vpl.position.as_dvec3() - position;
                let square = d.length_squared();
                let cosines = d.dot(normal).max(0.0) * -d.dot(vpl.normal.as_dvec3());
                let cosines = if vpl.normal.as_dvec3().dot(normal) > 0.9 { 0.0 } else { cosines };
                let g = cosines.max(0.0) / square.powi(2);
                let kept = bound.map_or(g, |bound| g.min(bound));
                clamped += u32::from(kept < g);
                let albedo = DVec3::from_array(albedo);
                expected += vpl.flux.as_dvec3() * albedo / PI * kept * albedo / PI;
                error += 1e-6 * vpl.flux.as_dvec3().x / square;
            }
            for (got, expected) in pixel.iter().zip(expected.to_array()) {
                let off = (f64::from(*got) - expected).abs();
                assert!(off <= 1e-5 * expected + 4.0 * error, "{i}: {got}, not {expected}");
            }
            assert!(expected.length() > 0.0 || paths == 1);
        }
        assert_eq!(clamped > 0, bound.is_some(), "{clamped} pairs clamped");
        assert_eq!(frame.counts.clamped_fraction > 0.0, bound.is_some());
        let pairs = u64::from(size * size) * vpls.len() as u64;
        assert_eq!(frame.counts.shading_terms, pairs);
        assert!(frame.counts.shadow_rays < pairs && frame.counts.shadow_rays > 0);
    }
}

/// Distance to the wall that a ray from inside a box meets, and its inward normal.
fn wall_of_box(eye: DVec3, direction: DVec3, low: DVec3, high: DVec3) -> (f64, DVec3) {
    let mut best = (f64::INFINITY, DVec3::ZERO);
    for axis in 0..3 {
        let up = direction[axis] > 0.0;
        let t = (if up { high[axis] } else { low[axis] } - eye[axis]) / direction[axis];
        if t > 0.0 && t < best.0 {
            let mut normal = DVec3::ZERO;
            normal[axis] = if up { -1.0 } else { 1.0 };
            best = (t, normal);
        }
    }
    best
}

/// Black walls hold no VPLs; what is left is emission.
#[test]
fn black_surfaces_reflect_nothing() {
    let frame = furnace([0.0; 3], [1.0, 0.5, 2.0], 1.0).render(&settings(500, 4));
    assert_eq!(frame.counts.vpls, 0);
    assert!(frame.image.pixels.iter().all(|pixel| *pixel == [1.0, 0.5, 2.0]));
}

/// Light that meets nothing leaves direct light alone.
#[test]
fn without_vpls_there_is_direct_light() {
    let build = |bounces| {
        let mut build = Build::new();
        let white = build.material([0.5; 3], [0.0; 3], false);
        build.polygon(white, &[dvec3(-1.0, -1.0, 0.0), dvec3(1.0, -1.0, 0.0), DVec3::Y]);
        build.point_light(dvec3(0.0, 0.0, 1e4), [1e8; 3]);
        build.camera(dvec3(0.0, 0.0, 1.0), DVec3::NEG_Z, 20.0, [4, 4]);
        build.render(&settings(20, bounces))
    };
    let (with, without) = (build(2), build(0));
    assert_eq!((with.counts.vpls, without.counts.vpls), (0, 0));
    assert_eq!(with.image, without.image);
    let expected = 0.5 / PI;
    assert!(with.image.pixels.iter().all(|p| (f64::from(p[0]) / expected - 1.0).abs() < 1e-5));
}
