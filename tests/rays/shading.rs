//! The shading pass on points and VPLs made by hand: against sums in f64, and against the
//! closed form for the inside of a sphere.

use std::f64::consts::PI;

use crate::common::gather::irradiance;
use crate::common::{self, Rng};
use glam::Vec3;
use gpu_vpl::extremes::checks::gather::{point, vpl};
use gpu_vpl::gpu::{PointRecord, VplRecord};

/// The kernels with and without subgroups, the former where the device has them.
fn kernels() -> Vec<bool> {
    let mut kernels = vec![false];
    kernels.extend(common::gpu().has_subgroups().then_some(true));
    kernels
}

/// G in f64, and how far rounding to f32 may take it.
fn g(x: &PointRecord, s: &VplRecord) -> (f64, f64) {
    /// Half an ulp, for each of the few operations that a factor goes through.
    const ROUNDING: f64 = 4.0 * 6e-8;
    let wide = |v: [f32; 3]| Vec3::from_array(v).as_dvec3();
    let d = wide(s.position) - wide(x.position);
    let [at_x, at_s] = [d.dot(wide(x.normal)), -d.dot(wide(s.normal))].map(|c| c.max(0.0));
    let square = d.length_squared();
    if square == 0.0 {
        return (0.0, 0.0);
    }
    let g = at_x * at_s / (square * square);
    // Coordinates are of order 1, so a difference is off by a rounding, and so are the cosines
    // times distance; 1/d⁴ is off by four roundings over d.
    let cosines = ROUNDING * (1.0 + square.sqrt()) * (at_x + at_s + ROUNDING) / (square * square);
    (g, cosines + ROUNDING * g * (4.0 + 4.0 / square.sqrt()))
}

/// The sum that the kernels compute, in f64, and how far off each component may be.
fn reference(
    bound: Option<f32>,
    x: &PointRecord,
    lights: impl Iterator<Item = VplRecord>,
) -> [(f64, f64); 4] {
    let mut sum = [(0.0, 0.0); 4];
    for light in lights {
        let (g, error) = g(x, &light);
        let kept = bound.map_or(g, |bound| g.min(f64::from(bound)));
        let [r, green, b] = light.intensity.map(f64::from);
        let mean = f64::from(light.mean);
        let terms = [(r, kept), (green, kept), (b, kept), (mean, g - kept)];
        for (sum, (intensity, g)) in sum.iter_mut().zip(terms) {
            sum.0 += intensity * g;
            sum.1 += intensity * error.min(g + error) + 1e-6 * intensity * g;
        }
    }
    sum
}

/// Whether all sums are those expected.
fn agree(got: &[[f32; 4]], expected: &[[(f64, f64); 4]]) -> bool {
    got.len() == expected.len()
        && got
            .as_flattened()
            .iter()
            .zip(expected.as_flattened())
            .all(|(&got, &(expected, error))| (f64::from(got) - expected).abs() <= error)
}

fn random(rng: &mut Rng, points: usize, vpls: usize) -> (Vec<PointRecord>, Vec<VplRecord>) {
    let points: Vec<_> = (0..points).map(|_| point(rng.cube(), rng.direction())).collect();
    let mut vpls: Vec<_> =
        (0..vpls).map(|_| vpl(rng.cube(), rng.direction(), rng.cube().abs())).collect();
    // One is where a point is: it gives that point nothing, not 0 / 0.
    vpls[0].position = points[0].position;
    (points, vpls)
}

#[test]
fn shading_is_the_sum_over_the_vpls_seen() {
    let mut rng = Rng(1);
    for subgroups in kernels() {
        for (points, vpls) in [(1, 1), (3, 31), (64, 32), (65, 33), (203, 77), (518, 320)] {
            let (points, vpls) = random(&mut rng, points, vpls);
            let words = vpls.len().div_ceil(32);
            let bits: Vec<u32> = (0..words * points.len()).map(|_| rng.bits()).collect();
            for (bound, skipped) in [(None, 0), (Some(0.3), 0), (Some(1e9), 0), (None, words / 2)] {
                // The matrix may begin with a later word.
                let bits = &bits[skipped * points.len()..];
                let seen = |i: usize, j: usize| {
                    let word = (j / 32).checked_sub(skipped);
                    word.is_some_and(|word| bits[word * points.len() + i] >> (j % 32) & 1 == 1)
                };
                let expected: Vec<_> = (0..points.len())
                    .map(|i| {
                        let lights = (0..vpls.len()).filter(|&j| seen(i, j)).map(|j| vpls[j]);
                        reference(bound, &points[i], lights)
                    })
                    .collect();
                let matrix = (bits, skipped as u32);
                let run = |before| {
                    let gpu = common::gpu();
                    irradiance(gpu, subgroups, bound, &points, &vpls, matrix, before)
                };
                let got = run([0.0; 4]);
                let what = format!("{}, {} VPLs, {bound:?}", points.len(), vpls.len());
                assert!(agree(&got, &expected), "{what}, subgroups = {subgroups}");
                if bound == Some(0.3) && points.len() > 1 {
                    assert!(got.iter().any(|e| e[3] > 0.0), "nothing was clamped");
                }
                // Sums are added to what is there.
                let twice = run([1.0, 2.0, 3.0, 4.0]);
                assert_eq!(twice[0], [0, 1, 2, 3].map(|k| got[0][k] + (k + 1) as f32));
            }
        }
    }
}

#[test]
fn sums_that_are_wrong_are_seen() {
    let (points, vpls) = random(&mut Rng(2), 10, 32);
    let right: Vec<_> =
        points.iter().map(|x| reference(Some(0.3), x, vpls.iter().copied())).collect();
    let got: Vec<[f32; 4]> = right.iter().map(|e| e.map(|(c, _)| c as f32)).collect();
    assert!(agree(&got, &right));
    for component in 0..4 {
        let mut bad = got.clone();
        bad[7][component] += 1e-3 * (1.0 + bad[7][component]);
        assert!(!agree(&bad, &right));
    }
    assert!(!agree(&got[1..], &right));
    assert!(!agree(&[[f32::NAN; 4]; 10], &right));
    // Half the lights are not all of them.
    let dark: Vec<_> =
        points.iter().map(|x| reference(Some(0.3), x, vpls[..16].iter().copied())).collect();
    assert!(!agree(&got, &dark));
}

/// Inside a sphere G is 1 / 4R² for every pair, so a VPL of exitant flux Φ gives Φ / 4πR².
#[test]
fn a_vpl_lights_the_inside_of_a_sphere_evenly() {
    let mut rng = Rng(3);
    let on_sphere = |rng: &mut Rng, radius: f32| {
        let direction = rng.direction();
        (radius * direction, -direction)
    };
    for (subgroups, radius) in kernels().into_iter().flat_map(|k| [(k, 1.0), (k, 0.01), (k, 2.0)]) {
        let radius: f32 = radius;
        let flux = 5.0f32;
        let points: Vec<_> = (0..2000)
            .map(|_| {
                let (position, normal) = on_sphere(&mut rng, radius);
                point(position, normal)
            })
            .collect();
        let vpls: Vec<_> = (0..32)
            .map(|_| {
                let (position, normal) = on_sphere(&mut rng, radius);
                vpl(position, normal, Vec3::splat(flux / std::f32::consts::PI))
            })
            .collect();
        // Each point sees one of the VPLs.
        let bits: Vec<u32> = (0..points.len()).map(|i| 1 << (i % 32)).collect();
        let gpu = common::gpu();
        let got = irradiance(gpu, subgroups, None, &points, &vpls, (&bits, 0), [0.0; 4]);
        let expected = f64::from(flux) / (4.0 * PI * f64::from(radius).powi(2));
        let mut near = 0;
        for (i, (e, x)) in got.iter().zip(&points).enumerate() {
            let distance = Vec3::from(x.position).distance(Vec3::from(vpls[i % 32].position));
            let d = f64::from(distance / radius);
            // A position is a rounding of 6e-8 R off the sphere, which each of the two cosines
            // d / 2R sees over the distance: 4 · 6e-8 / d², and 20 more for the arithmetic.
            let allowed = 4e-7 / (d * d) + 2e-6;
            near += usize::from(d < 0.1);
            assert!(e[..3].iter().all(|&e| (f64::from(e) / expected - 1.0).abs() < allowed), "{d}");
            assert_eq!(e[3], 0.0);
        }
        assert!((1..50).contains(&near), "{near} pairs are near");
    }
}
