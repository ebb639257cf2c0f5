//! The shading kernel: VPLs against closed forms, near and at the point, and sums of many.

use std::f64::consts::PI;

use glam::{DVec3, Vec3, dvec3};

use super::builder::SceneBuilder;
use super::gather::{Matrix, irradiance, point, repeated, vpl};
use super::measure::{at_most, devices, frame_of, none, of, relative};
use super::random::Rng;
use crate::error::Error;
use crate::extremes::{Figure, Scale};
use crate::gpu::{Gpu, PointRecord, VplRecord};
use crate::metrics::largest;
use crate::render::{
    Bounces, Clamp, Clustering, Direct, Method, Prepared, Settings, Vpl, chunk_words, light_paths,
};

/// G of two records, in f64.
fn geometry(x: &PointRecord, s: &VplRecord) -> f64 {
    let wide = |v: [f32; 3]| Vec3::from_array(v).as_dvec3();
    let d = wide(s.position) - wide(x.position);
    let cosines = d.dot(wide(x.normal)).max(0.0) * (-d.dot(wide(s.normal))).max(0.0);
    cosines / d.length_squared().powi(2)
}

/// Inside a sphere of radius R, G is 1 / 4R² for every pair, so that a VPL of exitant flux Φ gives
/// Φ / 4πR².
///
/// Rounding its end to f32 moves a pair's cosines d / 2R by 6e-8 R / d each, relative to them by
/// 1.2e-7 (R/d)²: below 3e-5 at 0.1 R, but 1e-3 at 0.01 R. So nearer pairs are compared with the
/// same formula of the rounded places, in f64: that is what the kernel is to give.
pub fn in_a_sphere(gpu: &Gpu, scale: Scale) -> Result<Vec<Figure>, Error> {
    const FLUX: f32 = 5.0;
    let count = if scale == Scale::Full { 200_000 } else { 20_000 };
    let mut random = Rng(3);
    let mut figures = Vec::new();
    for (kernel, gpu) in devices(gpu) {
        for radius in [0.01f32, 1.0] {
            let on = |random: &mut Rng| {
                let direction = random.direction();
                (radius * direction, -direction)
            };
            let intensity = Vec3::splat(FLUX / std::f32::consts::PI);
            let vpls: Vec<_> = (0..32)
                .map(|_| {
                    let (position, normal) = on(&mut random);
                    vpl(position, normal, intensity)
                })
                .collect();
            // Half of the points are near the VPL that they see.
            let place = |index: usize| {
                let (position, normal) = on(&mut random);
                if index.is_multiple_of(2) {
                    return point(position, normal);
                }
                let away = Vec3::from_array(vpls[index % 32].position) / radius;
                let direction = (away + 0.1 * random.unit() * random.direction()).normalize();
                point(radius * direction, -direction)
            };
            let points: Vec<_> = (0..count).map(place).collect();
            let bits: Vec<u32> = (0..count).map(|i| 1 << (i % 32)).collect();
            let matrix = Matrix { bits: &bits, matrix_word: 0 };
            let got = irradiance(&gpu, None, &points, &vpls, matrix, [0.0; 4])?;
            let closed = f64::from(FLUX) / (4.0 * PI * f64::from(radius).powi(2));
            let (mut far, mut near) = (0.0f64, 0.0f64);
            for (i, (e, x)) in got.iter().zip(&points).enumerate() {
                let s = &vpls[i % 32];
                let distance = Vec3::from(x.position).distance(Vec3::from(s.position)) / radius;
                let off = |expected: f64| (f64::from(e[0]) / expected - 1.0).abs();
                if distance > 0.1 {
                    far = largest([far, off(closed)]);
                }
                if distance > 0.01 {
                    near = largest([near, off(f64::from(s.intensity[0]) * geometry(x, s))]);
                }
            }
            let what = format!("{kernel} kernel, R = {radius}, {count} pairs");
            figures.push(at_most(format!("{what}: Φ/4πR², farther than 0.1 R"), far, 1e-4));
            figures.push(at_most(format!("{what}: G in f64, farther than 0.01 R"), near, 1e-4));
        }
    }
    Ok(figures)
}

/// A VPL at the point itself gives nothing, one beside it what the formula says, or the bound.
pub fn at_the_point(gpu: &Gpu, _: Scale) -> Result<Vec<Figure>, Error> {
    // Further apart than these, no two places of a scene are nearer without being the same, but
    // about its very centre.
    let right: [f32; 6] = [1e-1, 1e-3, 1e-5, 1e-6, 1e-7, 1e-9];
    let beyond: [f32; 4] = [1e-12, 1e-20, 1e-30, 1e-45];
    let distances: Vec<f32> = [0.0].into_iter().chain(right).chain(beyond).collect();
    let at = |d: &f32| point(Vec3::Z * *d, Vec3::NEG_Z);
    let points: Vec<_> = distances.iter().map(at).collect();
    let light = vpl(Vec3::ZERO, Vec3::Z, Vec3::ONE);
    let bits = vec![1u32; points.len()];
    let mut figures = Vec::new();
    for (kernel, gpu) in devices(gpu) {
        for bound in [None, Some(100.0f32)] {
            let matrix = Matrix { bits: &bits, matrix_word: 0 };
            let got = irradiance(&gpu, bound, &points, &[light], matrix, [0.0; 4])?;
            let name = format!("{kernel} kernel, bound {bound:?}");
            let itself = got[0].iter().filter(|value| **value != 0.0).count();
            figures.push(none(format!("{name}: VPL at the point gives something"), itself));
            for ((e, x), d) in got.iter().zip(&points).zip(&distances).skip(1).take(right.len()) {
                let g = geometry(x, &light);
                let expected = bound.map_or(g, |bound| g.min(f64::from(bound)));
                let what = format!("{name}: VPL at distance {d:e}");
                figures.push(relative(what, expected, f64::from(e[0]), 1e-5));
            }
            let unlike = got.as_flattened().iter().filter(|value| !value.is_finite()).count();
            figures.push(none(format!("{name}: values that are no number"), unlike));
        }
    }
    Ok(figures)
}

/// A pixel that gathers a million VPLs, whose power spans nine orders of magnitude, against the
/// sum in f64.
///
/// Terms are summed by words of 32, words by chunks, then chunks: each addition may be off by 6e-8
/// of the sum so far, and rounding goes both ways.
pub fn many_terms(gpu: &Gpu, scale: Scale) -> Result<Vec<Figure>, Error> {
    const ALBEDO: [f64; 3] = [0.9, 0.03, 0.001];
    const BOUNCES: u32 = 4;
    let paths = if scale == Scale::Full { 250_000 } else { 25_000 };
    let mut figures = Vec::new();
    let everyone = Clustering { points: u32::MAX, vpls: u32::MAX, ..Clustering::default() };
    for (kernel, gpu) in devices(gpu) {
        let mut builder = SceneBuilder::at(1.0, DVec3::ZERO);
        let wall = builder.material(ALBEDO, [0.0; 3])?;
        builder.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
        builder.point_light(dvec3(0.3, 0.2, 0.4), [1.0, 2.0, 3.0]);
        // All of the pixel is within 1e-6 of the middle of the floor.
        builder.camera(DVec3::ZERO, DVec3::NEG_Z, 1e-4, [1, 1]);
        let settings = |method: Method, fuzzy: u32, clamp: Clamp| Settings {
            light_paths: paths,
            bounces: Bounces::Finite(BOUNCES),
            direct: Direct::Off,
            edge_samples: 1,
            interleave: 1,
            candidates: 1,
            clustering: Clustering { fuzzy, probes: 0, ..everyone },
            clamp,
            ..Settings::of(method)
        };
        let prepared = Prepared::new(gpu, builder.scene()?, &settings(Method::Vpl, 1, Clamp::Off))?;
        let vpls = light_paths(&prepared, &settings(Method::Vpl, 1, Clamp::Off), 1);
        let some = |method: Method, fuzzy: u32| {
            let clamps = [Clamp::Off, Clamp::At(0.2)];
            clamps.map(|clamp| (settings(method, fuzzy, clamp), clamp))
        };
        let ways = [
            (Method::Vpl, 1),
            (Method::Vplc, 1),
            (Method::Vpc, 1),
            (Method::Both, 1),
            (Method::Both, 4),
        ];
        for (settings, clamp) in ways.into_iter().flat_map(|(method, fuzzy)| some(method, fuzzy)) {
            let got = frame_of(&prepared, &settings)?.image.pixels[0];
            let bound = if let Clamp::At(bound) = clamp { bound } else { f64::INFINITY };
            let expected = reflected(&vpls, ALBEDO, bound);
            for channel in 0..3 {
                let what = format!(
                    "{} terms, {kernel} kernel, fuzzy {}, {clamp:?}, channel {channel}",
                    vpls.len(),
                    settings.clustering.fuzzy
                );
                let measured = f64::from(got[channel]);
                figures
                    .push(of(settings.method, relative(what, expected[channel], measured, 1e-5)));
            }
        }
        figures.extend(equal_terms(kernel, &prepared.gpu, vpls.len())?);
    }
    Ok(figures)
}

/// Terms that are all the same are the worst: while a sum stays between two powers of two, each
/// rounds it the same way. Points at different distances have terms of different roundings.
fn equal_terms(kernel: &str, gpu: &Gpu, count: usize) -> Result<Vec<Figure>, Error> {
    /// Points, for whose rows the renderer's bit matrix would be as for a small image.
    const POINTS: u32 = 512;
    let light = vpl(Vec3::Z, Vec3::NEG_Z, Vec3::new(1.0, 0.3, 7.0));
    let at = |i: u32| point(Vec3::Z * (i as f32 / 1024.0), Vec3::Z);
    let points: Vec<_> = (0..POINTS).map(at).collect();
    // A dispatch adds a chunk of the renderer's bit matrix to what is there.
    let words = chunk_words(count.div_ceil(32) as u32, POINTS) as usize;
    let lights = vec![light; 32 * words];
    let bits = vec![u32::MAX; words * points.len()];
    let matrix = Matrix { bits: &bits, matrix_word: 0 };
    let chunks = count.div_ceil(32 * words);
    let terms = chunks * 32 * words;
    let sums = repeated(gpu, &points, &lights, matrix, chunks as u32)?;
    let mut off = 0.0f64;
    for (sum, x) in sums.iter().zip(&points) {
        for (got, intensity) in sum.iter().zip(light.intensity) {
            let term = f64::from(intensity) * geometry(x, &light);
            off = largest([off, (f64::from(*got) / (term * terms as f64) - 1.0).abs()]);
        }
    }
    let what = format!("{terms} equal terms, {kernel} kernel, {POINTS} points");
    Ok(vec![at_most(what, off, 1e-5)])
}

/// What the middle of the floor reflects of VPLs, all of which it sees.
fn reflected(vpls: &[Vpl], albedo: [f64; 3], bound: f64) -> DVec3 {
    let x = point(Vec3::NEG_Z, Vec3::Z);
    let sum: DVec3 = vpls
        .iter()
        .map(|of| {
            let intensity = of.flux.as_dvec3() * of.albedo.as_dvec3() / PI;
            let g = geometry(&x, &vpl(of.position, of.normal, Vec3::ONE));
            intensity * if g.is_nan() { 0.0 } else { g.min(bound) }
        })
        .sum();
    sum * DVec3::from_array(albedo) / PI
}
