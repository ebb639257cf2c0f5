//! Every BSDF by itself: reciprocity, energy, sampling against its density, and the device against
//! the host.

#![allow(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use std::f64::consts::{PI, TAU};

use crate::common::{Rng, gpu};
use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use gpu_vpl::gpu::{Dispatch, Module, Program};
use gpu_vpl::render::kernels::catalogue::{
    BSDF, GATHERED_PHONG, GLASS, HEMISPHERE, LOBE_ENERGY, LOBE_SAMPLE, LOBES_PHONG, MIRROR, PHONG,
    SAMPLE_SPECULAR_EITHER, SCATTER_PHONG, SPECULAR_SAMPLE, TYPES, VIEW_DIRECTION,
};
use gpu_vpl::render::materials::bsdf::{
    ShadingPoint, TransportMode, bsdf_record, fresnel, lobe_probability, sample_specular,
};
use gpu_vpl::sampling::{cosine_hemisphere, uniform_sphere};
use gpu_vpl::scene::{Bsdf, Material};

fn material(albedo: f32, bsdf: Bsdf) -> Material {
    Material { albedo: Vec3::splat(albedo), bsdf, ..Material::default() }
}

fn phong(specular: f32, shininess: f32) -> Bsdf {
    Bsdf::Phong { specular: Vec3::splat(specular), shininess }
}

fn place(albedo: f32, bsdf: Bsdf) -> ShadingPoint {
    let lobe_probability = lobe_probability(&material(albedo, bsdf));
    ShadingPoint { normal: Vec3::Z, albedo: Vec3::splat(albedo), bsdf, lobe_probability }
}

/// The BSDFs with a density, from dull to sharp.
fn places() -> Vec<ShadingPoint> {
    vec![
        place(0.7, Bsdf::Diffuse),
        place(0.3, phong(0.5, 0.0)),
        place(0.3, phong(0.5, 8.0)),
        place(0.0, phong(1.0, 60.0)),
        place(0.9, phong(0.1, 400.0)),
    ]
}

fn above(random: &mut Rng) -> Vec3 {
    cosine_hemisphere(Vec3::Z, [random.unit(), random.unit()])
}

#[test]
fn brdfs_are_reciprocal() {
    let mut random = Rng(1);
    for place in places() {
        for _ in 0..1000 {
            let (view, toward) = (above(&mut random), above(&mut random));
            let (one, other) = (place.brdf(view, toward), place.brdf(toward, view));
            assert!((one - other).length() <= 2e-4 * one.length() + 1e-6, "{place:?}");
        }
    }
}

/// Reflected share of white light that comes from everywhere, by quadrature over the hemisphere.
fn reflectance(place: &ShadingPoint, view: Vec3) -> f64 {
    let (rows, columns) = (400, 800);
    let mut sum = 0.0;
    for i in 0..rows {
        // Uniform in the squared sine: cos dω is constant.
        let square = (f64::from(i) + 0.5) / f64::from(rows);
        for j in 0..columns {
            let turn = TAU * (f64::from(j) + 0.5) / f64::from(columns);
            let (sine, cosine) = (square.sqrt(), (1.0 - square).sqrt());
            let toward =
                Vec3::new((sine * turn.cos()) as f32, (sine * turn.sin()) as f32, cosine as f32);
            sum += f64::from(place.brdf(view, toward).x);
        }
    }
    sum * PI / f64::from(rows * columns)
}

#[test]
fn no_brdf_reflects_more_than_it_gets() {
    for place in places() {
        let specular = match place.bsdf {
            Bsdf::Phong { specular, .. } => specular.x,
            _ => 0.0,
        };
        let most = f64::from(place.albedo.x + specular);
        // The model says so: from straight above, the lobe reflects k_s.
        let straight = reflectance(&place, Vec3::Z);
        assert!((straight / most - 1.0).abs() < 2e-3, "{place:?}: {straight} of {most}");
        for cosine in [0.9f32, 0.5, 0.2, 0.02] {
            let view = Vec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
            let got = reflectance(&place, view);
            assert!(got <= most * 1.002, "{place:?} at {cosine}: {got} of {most}");
            if place.bsdf == Bsdf::Diffuse {
                assert!((got / most - 1.0).abs() < 1e-5);
            }
        }
    }
}

#[test]
fn glass_and_mirrors_lose_nothing() {
    let normal = Vec3::Z;
    for ior in [1.0, 1.33, 1.5, 2.4, 0.7] {
        for i in 0..200 {
            let cosine = (i as f32 + 0.5) / 200.0;
            let direction = -Vec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
            for front in [false, true] {
                let glass = Bsdf::Glass { specular: Vec3::ONE, ior };
                let eta = if front { ior } else { 1.0 / ior };
                let reflected = fresnel(cosine, eta);
                assert!((0.0..=1.0).contains(&reflected));
                for (u, carried) in [
                    (0.0, TransportMode::Flux),
                    (0.9999, TransportMode::Flux),
                    (0.9999, TransportMode::Radiance),
                ] {
                    let sample =
                        sample_specular(&glass, normal, front, direction, u, carried).unwrap();
                    assert_eq!(sample.reflected, u < reflected);
                    let dense = !sample.reflected && carried == TransportMode::Radiance;
                    let weight = if dense { 1.0 / (eta * eta) } else { 1.0 };
                    assert!((sample.weight.x / weight - 1.0).abs() < 1e-6);
                    if !sample.reflected {
                        // Snell: the tangential part over the index is kept.
                        assert!((sample.direction.x * eta - direction.x).abs() < 1e-5);
                        assert!(sample.direction.z < 0.0);
                        // Stokes: as much goes through from the other side.
                        let back = fresnel(-sample.direction.z, 1.0 / eta);
                        assert!((back - reflected).abs() < 2e-3, "{ior} {cosine}");
                    }
                }
            }
        }
    }
    let mirror = Bsdf::Mirror { specular: Vec3::splat(0.9) };
    let direction = Vec3::new(0.6, 0.0, -0.8);
    let sample =
        sample_specular(&mirror, normal, true, direction, 0.5, TransportMode::Radiance).unwrap();
    assert_eq!((sample.direction, sample.weight), (Vec3::new(0.6, 0.0, 0.8), Vec3::splat(0.9)));
    // Straight on, (n - 1)² / (n + 1)²; at Brewster's angle half of that across.
    assert!((fresnel(1.0, 1.5) - 0.04).abs() < 1e-6);
    assert!((fresnel(0.0, 1.5) - 1.0).abs() < 1e-6);
}

/// Pearson's χ² over cells of the sphere, of so many draws against the integral of the density.
fn chi_squared(place: &ShadingPoint, view: Vec3) -> (f64, f64) {
    const ROWS: usize = 20;
    const COLUMNS: usize = 40;
    const DRAWS: u32 = 400_000;
    let cell = |w: Vec3| {
        let row = (f64::from(w.z + 1.0) / 2.0 * ROWS as f64) as usize;
        let turn = (f64::from(w.y).atan2(f64::from(w.x)) / TAU + 1.0).fract();
        row.min(ROWS - 1) * COLUMNS + ((turn * COLUMNS as f64) as usize).min(COLUMNS - 1)
    };
    let mut found = vec![0.0; ROWS * COLUMNS];
    let mut random = Rng(7);
    for _ in 0..DRAWS {
        found[cell(place.scatter(view, [random.unit(), random.unit()]).direction)] += 1.0;
    }
    // A midpoint rule with so many points along each side of a cell.
    let fine = 24;
    let mut expected = vec![0.0; ROWS * COLUMNS];
    for i in 0..ROWS * fine {
        let z = 2.0 * (i as f64 + 0.5) / (ROWS * fine) as f64 - 1.0;
        for j in 0..COLUMNS * fine {
            let turn = TAU * (j as f64 + 0.5) / (COLUMNS * fine) as f64;
            let r = (1.0 - z * z).sqrt();
            let w = Vec3::new((r * turn.cos()) as f32, (r * turn.sin()) as f32, z as f32);
            let area = 4.0 * PI / (ROWS * COLUMNS * fine * fine) as f64;
            expected[cell(w)] += f64::from(DRAWS) * area * f64::from(place.density(view, w));
        }
    }
    // Cells of few draws are put together.
    let (mut sum, mut degrees) = (0.0, -1.0);
    let (mut few_found, mut few_expected) = (0.0, 0.0);
    for (&found, &expected) in found.iter().zip(&expected) {
        if expected >= 10.0 {
            sum += (found - expected) * (found - expected) / expected;
            degrees += 1.0;
        } else {
            few_found += found;
            few_expected += expected;
        }
    }
    if few_expected > 1.0 {
        sum += (few_found - few_expected) * (few_found - few_expected) / few_expected;
        degrees += 1.0;
    } else {
        assert!(few_found < 20.0, "{few_found} draws where the density is {few_expected}");
    }
    (sum, degrees)
}

#[test]
fn directions_are_drawn_with_their_density() {
    for place in places() {
        // A lobe of 400 is narrower than a cell, whose integral is then poor.
        if matches!(place.bsdf, Bsdf::Phong { shininess, .. } if shininess > 100.0) {
            continue;
        }
        for cosine in [1.0f32, 0.7, 0.3] {
            let view = Vec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
            let (sum, degrees) = chi_squared(&place, view);
            // Four standard deviations of χ²: chance in 1 of 30,000.
            assert!(sum < degrees + 4.0 * (2.0 * degrees).sqrt(), "{place:?}: {sum} of {degrees}");
        }
    }
}

#[test]
fn weights_are_brdf_times_cosine_over_density() {
    let mut random = Rng(3);
    for place in places() {
        for _ in 0..1000 {
            let view = above(&mut random);
            let scattered = place.scatter(view, [random.unit(), random.unit()]);
            let cosine = scattered.direction.z;
            let density = place.density(view, scattered.direction);
            assert!((scattered.density / density - 1.0).abs() < 1e-5);
            let expected = place.brdf(view, scattered.direction) * cosine.max(0.0) / density;
            assert!((scattered.weight - expected).length() <= 1e-4, "{place:?}");
        }
    }
}

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Query {
    normal: [f32; 3],
    surface: u32,
    direction: [f32; 3],
    u: f32,
    toward: [f32; 3],
    v: f32,
    albedo: [f32; 3],
    pad: f32,
}

#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Answer {
    brdf: [f32; 3],
    density: f32,
    direction: [f32; 3],
    drawn: f32,
    weight: [f32; 3],
    side: f32,
    turned: [f32; 3],
    turned_weight: f32,
}

#[test]
fn the_device_scatters_as_the_host() {
    static MAIN: Module =
        Module { name: "scattering", source: include_str!("scattering.wgsl"), feature: None };
    let modules = vec![
        &TYPES,
        &HEMISPHERE,
        &GATHERED_PHONG,
        &VIEW_DIRECTION,
        &BSDF,
        &PHONG,
        &LOBE_ENERGY,
        &LOBES_PHONG,
        &LOBE_SAMPLE,
        &SCATTER_PHONG,
        &SPECULAR_SAMPLE,
        &MIRROR,
        &GLASS,
        &SAMPLE_SPECULAR_EITHER,
        &MAIN,
    ];
    let materials: Vec<Material> = [
        (0.7, Bsdf::Diffuse),
        (0.3, phong(0.5, 0.0)),
        (0.2, phong(0.5, 20.0)),
        (0.0, phong(0.9, 300.0)),
        (0.0, Bsdf::Mirror { specular: Vec3::splat(0.8) }),
        (0.0, Bsdf::Glass { specular: Vec3::splat(0.9), ior: 1.5 }),
    ]
    .map(|(albedo, bsdf)| material(albedo, bsdf))
    .into();
    let mut random = Rng(5);
    let queries: Vec<Query> = (0..6000)
        .map(|i| {
            let normal = uniform_sphere([random.unit(), random.unit()]);
            let direction = -cosine_hemisphere(normal, [random.unit(), random.unit()]);
            let toward = cosine_hemisphere(normal, [random.unit(), random.unit()]);
            let index = i % materials.len() as u32;
            let front = if random.unit() < 0.5 { 1 << 31 } else { 0 };
            Query {
                normal: normal.to_array(),
                surface: index | front,
                direction: direction.to_array(),
                u: random.unit(),
                toward: toward.to_array(),
                v: random.unit(),
                albedo: materials[index as usize].albedo.to_array(),
                pad: 0.0,
            }
        })
        .collect();
    let gpu = gpu().clone();
    let kernel = gpu.compile(&Program::new("scattering", modules)).unwrap();
    let bsdfs: Vec<_> = materials.iter().map(bsdf_record).collect();
    let bsdfs = gpu.storage_of("bsdfs", &bsdfs).unwrap();
    let asked = gpu.storage_of("queries", &queries).unwrap();
    let answers = gpu.storage::<Answer>("answers", queries.len()).unwrap();
    let buffers = [("bsdfs", &bsdfs), ("queries", &asked), ("answers", &answers)];
    let bindings = gpu.bind(&kernel, &buffers).unwrap();
    let workgroups = [queries.len().div_ceil(64) as u32, 1];
    gpu.run(&[Dispatch { kernel: &kernel, bindings: &bindings, workgroups }]).unwrap();
    let answers: Vec<Answer> = gpu.read(&answers, queries.len()).unwrap();
    for (query, answer) in queries.iter().zip(&answers) {
        let material = &materials[(query.surface & !(1 << 31)) as usize];
        let [normal, direction, toward] =
            [query.normal, query.direction, query.toward].map(Vec3::from_array);
        let front = query.surface >> 31 == 1;
        let place = ShadingPoint {
            normal,
            albedo: material.albedo,
            bsdf: material.bsdf,
            lobe_probability: lobe_probability(material),
        };
        if material.bsdf.is_specular() {
            let carried = TransportMode::Radiance;
            let sample =
                sample_specular(&material.bsdf, normal, front, direction, query.u, carried)
                    .unwrap();
            assert_eq!(answer.side > 0.0, sample.reflected);
            assert!(Vec3::from_array(answer.turned).distance(sample.direction) < 1e-4);
            assert!((answer.turned_weight / sample.weight.x - 1.0).abs() < 1e-5);
            continue;
        }
        // A view of 16 bits a coordinate moves a lobe of 300 by 1 % where it is steep.
        let near = |got: f32, expected: f32, of: f32| {
            (got - expected).abs() <= 0.02 * expected.abs() + 1e-3 * of
        };
        let peak = match material.bsdf {
            Bsdf::Phong { shininess, .. } => shininess + 2.0,
            _ => 1.0,
        };
        let brdf = place.brdf(-direction, toward);
        assert!(near(answer.brdf[0], brdf.x, peak), "{:?}: {} {}", place, answer.brdf[0], brdf.x);
        assert!(near(answer.density, place.density(-direction, toward), peak));
        let scattered = place.scatter(-direction, [query.u, query.v]);
        assert!(
            Vec3::from_array(answer.direction).distance(scattered.direction) < 2e-3,
            "{place:?}"
        );
        if scattered.direction.dot(normal) > 1e-2 {
            assert!(near(answer.drawn, scattered.density, peak));
            assert!(near(answer.weight[0], scattered.weight.x, 1.0), "{place:?}");
        }
    }
}
