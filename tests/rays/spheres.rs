//! Rays and segments among spheres, against f64.

use glam::{DVec3, Vec3};
use gpu_vpl::bvh::Ray;
use gpu_vpl::extremes::checks::gather::{point, vpl};
use gpu_vpl::extremes::checks::trace::Answer;
use gpu_vpl::render::kernels::Tracing;
use gpu_vpl::sampling::SURFACE_OFFSET;
use gpu_vpl::scene::{Scene, Sphere, Triangle};

use crate::common::gather::visible_in;
use crate::common::tracing::{on_all_of, random_rays, soup, world_of};
use crate::common::{self, Build, Rng};

/// A scene of these shapes, as they are.
fn scene_of(triangles: Vec<Triangle>, spheres: Vec<Sphere>) -> Scene {
    let mut build = Build::new();
    let grey = build.material([0.5; 3], [0.0; 3], false);
    build.sphere(grey, DVec3::ZERO, 1.0);
    build.point_light(DVec3::Z, [1.0; 3]);
    build.camera(DVec3::X, DVec3::NEG_X, 40.0, [8, 8]);
    let mut scene = build.scene();
    scene.materials = vec![scene.materials[0].clone(); 4];
    Scene { triangles, spheres, ..scene }
}

fn random_spheres(rng: &mut Rng, count: usize, most: f32) -> Vec<Sphere> {
    let one = |_| {
        // From most to a hundred-thousandth of it.
        let radius = most * (-11.5 * rng.unit().powi(2)).exp();
        Sphere { center: rng.cube() * (1.0 - radius).max(0.0), radius, material: 2 }
    };
    (0..count).map(one).collect()
}

/// Where a ray enters and leaves a sphere, exactly; `None` if it misses it.
fn reference(ray: &Ray, sphere: &Sphere) -> Option<[f64; 2]> {
    let (o, d) = (ray.origin.as_dvec3() - sphere.center.as_dvec3(), ray.direction.as_dvec3());
    let along = -o.dot(d) / d.length_squared();
    let nearest = (o + along * d).length();
    let half = (f64::from(sphere.radius).powi(2) - nearest.powi(2)).sqrt() / d.length();
    (half >= 0.0).then_some([along - half, along + half])
}

/// What is wrong with an answer among spheres alone.
fn fault(spheres: &[Sphere], ray: &Ray, answer: &Answer) -> Option<String> {
    // By how much a sphere seen from up to 3 away may be off.
    const OFF: f64 = 1e-6;
    let length = f64::from(ray.direction.length());
    let limit = f64::from(ray.limit);
    let roots = |by: f64, sphere: &Sphere| {
        let radius = (f64::from(sphere.radius) + by) as f32;
        reference(ray, &Sphere { radius, ..*sphere }).filter(|_| radius > 0.0)
    };
    // A ray that meets a smaller sphere meets the sphere: no later than this.
    let sure = |sphere: &Sphere| {
        let (small, large) = (roots(-OFF, sphere)?, roots(OFF, sphere)?);
        let later = [small[0].max(large[0]), small[1].max(large[1])];
        let root = usize::from(large[0] * length < OFF);
        (small[root] * length > OFF && later[root] < limit).then_some(later[root])
    };
    let nearest = spheres.iter().filter_map(sure).fold(f64::INFINITY, f64::min);
    if !answer.hits() {
        return (nearest < limit - 1e-3 / length).then(|| format!("misses a hit at {nearest}"));
    }
    let t = f64::from(answer.t);
    let sphere = spheres.get(answer.triangle as usize)?;
    if t > nearest + OFF / length + 1e-6 * nearest {
        return Some(format!("hits at {t} beyond {nearest}"));
    }
    let place = ray.origin.as_dvec3() + t * ray.direction.as_dvec3();
    let radius = place.distance(sphere.center.as_dvec3());
    let off = (radius - f64::from(sphere.radius)).abs();
    // A grazing ray is near the surface for long: there t is worth less.
    if off > 2.0 * OFF {
        return Some(format!("hits {off} beside a sphere of {}", sphere.radius));
    }
    let normal = Vec3::from_array(answer.weights).as_dvec3();
    let placed = sphere.center.as_dvec3() + f64::from(sphere.radius) * normal;
    let lost = ray.origin.as_dvec3() - placed;
    let d = ray.direction.as_dvec3().normalize();
    let beside = (lost - lost.dot(d) * d).length();
    (beside > OFF || (normal.length() - 1.0).abs() > 1e-6)
        .then(|| format!("the normal puts it {beside} beside the ray"))
}

/// Spheres from large to tiny, from near and afar, from inside and outside, with directions of any
/// length: host and device are right, and alike.
#[test]
fn rays_meet_spheres() {
    let mut rng = Rng(1);
    for (count, most) in [(1, 1.0), (2, 0.5), (40, 0.5), (2000, 0.1)] {
        let spheres = random_spheres(&mut rng, count, most);
        let mut rays = random_rays(&mut rng, 1000);
        for i in 0..2000 {
            let sphere = &spheres[rng.below(count)];
            let (out, origin) = (rng.direction(), rng.cube());
            let on = sphere.center + sphere.radius * out;
            let ray = match i % 5 {
                // At the sphere, at its rim, from its middle, off its surface to either side.
                0 => (origin, on - origin, f32::MAX),
                1 => (origin, 1e-5 * (on - origin), f32::MAX),
                2 => (sphere.center, 1e5 * out, f32::MAX),
                3 => (on + SURFACE_OFFSET * out, rng.direction(), 3.0),
                _ => (on - SURFACE_OFFSET * out, rng.direction(), 3.0),
            };
            rays.push(Ray { origin: ray.0, direction: ray.1, limit: ray.2 });
        }
        let world = world_of(&scene_of(Vec::new(), spheres.clone()));
        let sides = on_all_of(&world, &rays, false);
        for (side, answers) in &sides {
            for (ray, answer) in rays.iter().zip(answers) {
                let fault = fault(&spheres, ray, answer);
                assert_eq!(fault, None, "{side}, {count} spheres: {ray:?}, {answer:?}");
            }
            let differ = sides[0].1.iter().zip(answers).filter(|(a, b)| a.hits() != b.hits());
            assert!(differ.count() <= 3, "{side} differs from the host");
            assert!(answers.iter().filter(|answer| answer.hits()).count() > 500, "few hits");
            assert!(answers.iter().all(|a| !a.hits() || a.material == 2));
        }
        for (side, any) in on_all_of(&world, &rays, true) {
            let differ = sides[0].1.iter().zip(&any).filter(|(a, b)| a.hits() != b.hits());
            assert!(differ.count() <= 3, "{side}: any hit differs from the closest");
        }
    }
}

/// Among both the nearest is hit, as if they were traced by themselves.
#[test]
fn triangles_and_spheres_in_one_hierarchy() {
    let mut rng = Rng(2);
    let mut hits = [0; 2];
    for (triangles, spheres) in [(1, 1), (1, 50), (300, 3), (500, 500)] {
        let triangles = soup(&mut rng, triangles, 0.3);
        let spheres = random_spheres(&mut rng, spheres, 0.2);
        let rays = random_rays(&mut rng, 3000);
        let trace = |triangles: &[Triangle], spheres: &[Sphere], any| {
            on_all_of(&world_of(&scene_of(triangles.to_vec(), spheres.to_vec())), &rays, any)
        };
        for any in [false, true] {
            let (flat, round) = (trace(&triangles, &[], any), trace(&[], &spheres, any));
            let both = trace(&triangles, &spheres, any);
            for ((side, both), (flat, round)) in both.iter().zip(flat.iter().zip(&round)) {
                for (i, answer) in both.iter().enumerate() {
                    let (flat, mut round) = (flat.1[i], round.1[i]);
                    if any {
                        assert_eq!(answer.hits(), flat.hits() || round.hits(), "{side}");
                        continue;
                    }
                    round.triangle = round.triangle.saturating_add(triangles.len() as u32);
                    let nearer = if !round.hits() || flat.t <= round.t && flat.hits() {
                        flat
                    } else {
                        round
                    };
                    let same = (answer.t, answer.triangle) == (nearer.t, nearer.triangle);
                    assert!(
                        same || !answer.hits() && !nearer.hits(),
                        "{side}: {answer:?}, {nearer:?}"
                    );
                    if answer.hits() {
                        hits[usize::from(answer.triangle as usize >= triangles.len())] += 1;
                    }
                }
            }
        }
    }
    assert!(hits[0] > 1000 && hits[1] > 1000, "{hits:?}");
}

/// All kernels of the visibility pass, and the host, among triangles and spheres.
#[test]
fn visibility_among_spheres() {
    let mut rng = Rng(3);
    let (triangles, spheres) = (soup(&mut rng, 20, 0.4), random_spheres(&mut rng, 20, 0.3));
    let world = world_of(&scene_of(triangles, spheres.clone()));
    let mut place = || {
        let (sphere, out) = (&spheres[rng.below(spheres.len())], rng.direction());
        (sphere.center + sphere.radius * out, if rng.unit() < 0.8 { out } else { -out })
    };
    let points: Vec<_> = (0..300).map(|_| place()).collect();
    let vpls: Vec<_> = (0..64).map(|_| place()).collect();
    let point_records: Vec<_> = points.iter().map(|&(p, n)| point(p, n)).collect();
    let vpl_records: Vec<_> = vpls.iter().map(|&(p, n)| vpl(p, n, Vec3::ONE)).collect();
    let subgroups = common::gpu().has_subgroups();
    let packets = [Tracing::Shaft, Tracing::Rays].into_iter().filter(|_| subgroups);
    for tracing in [Tracing::Single].into_iter().chain(packets) {
        let (bits, _) = visible_in(&world, tracing, &point_records, &vpl_records);
        let (mut seen, mut blocked, mut wrong) = (0, 0, 0);
        for (j, &(s, m)) in vpls.iter().enumerate() {
            for (i, &(x, n)) in points.iter().enumerate() {
                let faces = (x - s).dot(n) < 0.0 && (x - s).dot(m) > 0.0;
                let (origin, end) = (s + SURFACE_OFFSET * m, x + SURFACE_OFFSET * n);
                let ray = Ray { origin, direction: end - origin, limit: 1.0 };
                let expected = faces && !world.bvh.occluded(&ray);
                let got = bits[j / 32 * points.len() + i] >> (j % 32) & 1 == 1;
                wrong += u32::from(got != expected);
                *(if expected { &mut seen } else { &mut blocked }) += u32::from(faces);
            }
        }
        assert!(wrong <= 2, "{tracing:?}: {wrong} bits differ from the host");
        assert!(seen > 500 && blocked > 500, "{seen} seen, {blocked} blocked");
    }
}

#[test]
fn wrong_answers_are_seen() {
    let spheres = [Sphere { center: Vec3::ZERO, radius: 0.5, material: 2 }];
    let ray = Ray { origin: Vec3::new(0.1, 0.2, 2.0), direction: Vec3::NEG_Z, limit: f32::MAX };
    let world = world_of(&scene_of(Vec::new(), spheres.to_vec()));
    let right = on_all_of(&world, &[ray], false)[0].1[0];
    assert_eq!(fault(&spheres, &ray, &right), None);
    assert!(fault(&spheres, &ray, &Answer { t: right.t * 1.00001, ..right }).is_some());
    let turned = [right.weights[1], right.weights[0], right.weights[2]];
    assert!(fault(&spheres, &ray, &Answer { weights: turned, ..right }).is_some());
    assert!(fault(&spheres, &ray, &Answer { triangle: u32::MAX, ..right }).is_some());
}
