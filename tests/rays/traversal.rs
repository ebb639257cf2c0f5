//! The traversal on host and device against each other and against brute force in f64.
//!
//! A ray within rounding of an edge, of a plane or of its own end may be answered either way.
//! So the f64 reference sorts the triangles of a ray into sure hits, sure misses and the rest,
//! and an answer is right if it contradicts no sure one.

#![allow(clippy::expect_used, clippy::panic, reason = "a helper of tests fails by panicking")]

use crate::common::Rng;
use crate::common::tracing::{on_all, random_rays, soup, triangle};
use glam::{DVec3, Mat3, Vec3};
use gpu_vpl::bvh::{Bvh, Ray};
use gpu_vpl::extremes::checks::rays::cube;
use gpu_vpl::extremes::checks::trace::{Answer, on_host};
use gpu_vpl::gpu::PointRecord;
use gpu_vpl::scene::Triangle;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Sure {
    Miss,
    /// t and its uncertainty.
    Hit(f64, f64),
    Unsure,
}

/// One ray against one triangle, with the rounding of the f32 test bounded from above.
fn reference(ray: &Ray, triangle: &Triangle) -> Sure {
    /// Half an ulp, times the operations of a volume (3 differences, a cross and a dot product)
    /// and some room for a device that rounds divisions worse.
    const ROUNDING: f64 = 16.0 * 6e-8;
    let [a, b, c] = triangle.vertices.map(|v| v.as_dvec3() - ray.origin.as_dvec3());
    let d = ray.direction.as_dvec3();
    let volume = |p: DVec3, q: DVec3| (q - p).cross(q + p).dot(d);
    let volumes = [volume(b, c), volume(c, a), volume(a, b)];
    let reach = a.length().max(b.length()).max(c.length());
    let edge = (b - a).length().max((c - b).length()).max((a - c).length());
    let error = ROUNDING * reach * (edge + reach * ROUNDING) * d.length();
    // What may be 0 by its rounding counts as of either side, so that vertices do not leak. The
    // bound on the rounding is of the largest coordinates; against literals, it is of the distances
    // to the origin of the scene.
    let largest =
        |of: [DVec3; 3]| of.map(|v| v.abs().max_element()).into_iter().fold(0.0, f64::max);
    let farthest = largest(triangle.vertices.map(|v| v.as_dvec3())).max(1.0);
    let origin = ray.origin.as_dvec3().abs().max_element();
    let far = largest([a, b, c]).max((1.0 + origin) * farthest);
    let counted = error + 1.7e-6 * largest([b - a, c - b, a - c]) * far * d.abs().element_sum();
    if volumes.iter().any(|&v| v > counted) && volumes.iter().any(|&v| v < -counted) {
        return Sure::Miss;
    }
    let normal = (b - a).cross(c - a);
    let (height, speed) = (normal.dot(a), normal.dot(d));
    // Corners relative to the origin are rounded at `reach`, so a normal at edge · reach.
    let twist = ROUNDING * edge * reach;
    let (unsure_height, unsure_speed) = (twist * reach, twist * d.length());
    if speed.abs() <= 2.0 * unsure_speed {
        return Sure::Unsure;
    }
    let t = height / speed;
    let unsure = (unsure_height + t.abs() * unsure_speed) / (speed.abs() - unsure_speed);
    if t < -unsure || t > f64::from(ray.limit) + unsure {
        return Sure::Miss;
    }
    let inside = volumes.iter().all(|&v| v > error) || volumes.iter().all(|&v| v < -error);
    let between = t > unsure && t < f64::from(ray.limit) - unsure;
    if inside && between { Sure::Hit(t, unsure) } else { Sure::Unsure }
}

/// What is wrong with an answer; nothing if it may be right. `unsure` counts the answers that
/// rest on a triangle of which the reference is not sure.
fn judge(
    triangles: &[Triangle],
    ray: &Ray,
    any: bool,
    answer: &Answer,
    unsure: &mut usize,
) -> Option<String> {
    let sure: Vec<Sure> = triangles.iter().map(|triangle| reference(ray, triangle)).collect();
    let hits =
        || sure.iter().filter_map(|s| if let Sure::Hit(t, e) = *s { Some((t, e)) } else { None });
    let nearest = hits().map(|(t, e)| t + e).fold(f64::INFINITY, f64::min);
    if !answer.hits() {
        return (nearest < f64::INFINITY).then(|| format!("misses a hit at {nearest}"));
    }
    if any {
        *unsure += usize::from(nearest == f64::INFINITY);
        let excused = sure.iter().any(|&s| s != Sure::Miss);
        return (!excused).then(|| "is blocked by nothing".to_owned());
    }
    let t = f64::from(answer.t);
    match sure.get(answer.triangle as usize) {
        None => Some("hits a triangle that is not there".to_owned()),
        Some(Sure::Miss) => Some(format!("hits triangle {}, which it misses", answer.triangle)),
        Some(&Sure::Hit(right, error)) if (t - right).abs() > error => {
            Some(format!("hits at {t}, not at {right}"))
        }
        // A sure hit that is nearer, by more than what the two may be off.
        Some(&Sure::Hit(_, error)) if t - error > nearest => Some(format!("passes {nearest}")),
        Some(Sure::Hit(..)) => misplaced(&triangles[answer.triangle as usize], ray, answer),
        Some(Sure::Unsure) => {
            *unsure += 1;
            None
        }
    }
}

/// Whether the weights give another point than t does.
fn misplaced(triangle: &Triangle, ray: &Ray, answer: &Answer) -> Option<String> {
    let at = ray.origin.as_dvec3() + ray.direction.as_dvec3() * f64::from(answer.t);
    let corners = triangle.vertices.map(|v| v.as_dvec3());
    let by_weights: DVec3 =
        corners.iter().zip(answer.weights).map(|(&v, w)| v * f64::from(w)).sum();
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let flatness = normal.length() / (corners[1] - corners[0]).length_squared().max(1e-30);
    let slant = normal.normalize().dot(ray.direction.as_dvec3().normalize()).abs();
    let reach = corners.iter().map(|c| c.distance(ray.origin.as_dvec3())).fold(0.0, f64::max);
    // Rounding grows with slant, and along slivers; there only t is judged.
    let bound = 1e-5 * reach / slant;
    let off = at.distance(by_weights);
    (flatness > 0.01 && slant > 0.01 && off > bound)
        .then(|| format!("weights {:?} are {off:e} off, allowed {bound:e}", answer.weights))
}

/// Both sides, closest and any, all rays: no wrong answer, few unsure ones, and few on which
/// host and device differ.
fn check(name: &str, triangles: &[Triangle], rays: &[Ray], most_unsure: usize) {
    let bvh = Bvh::build(triangles);
    for any in [false, true] {
        let host = on_host(&bvh, rays, any);
        assert!(host.iter().any(Answer::hits), "{name}: nothing is hit");
        for (side, answers) in on_all(&bvh, rays, any) {
            let mut unsure = 0;
            for (ray, answer) in rays.iter().zip(&answers) {
                let fault = judge(triangles, ray, any, answer, &mut unsure);
                assert_eq!(fault, None, "{name}, {side}, any = {any}: {ray:?}");
            }
            let differ = host.iter().zip(&answers).filter(|(h, d)| h.hits() != d.hits()).count();
            assert!(unsure <= most_unsure, "{name}: {unsure} answers rest on unsure triangles");
            assert!(differ <= most_unsure / 2, "{name}: host and {side} differ on {differ} rays");
        }
    }
}

/// Rays that traversals get wrong.
fn nasty_rays(rng: &mut Rng, triangles: &[Triangle]) -> Vec<Ray> {
    let mut rays = Vec::new();
    for _ in 0..100 {
        let [a, b, c] = triangles[rng.below(triangles.len())].vertices;
        let inside = rng.on(&triangle([a, b, c]));
        let (from, limit) = (rng.cube(), f32::MAX);
        let mut push = |origin, direction, limit| rays.push(Ray { origin, direction, limit });
        // Along axes, with zeros of both signs; from a corner's coordinates, so in the plane of
        // a box's face.
        for axis in 0..3 {
            let mut along = [0.0, -0.0, 0.0];
            along[axis] = if rng.bits().is_multiple_of(2) { 1.0 } else { -1.0 };
            let along = Vec3::from_array(along);
            push(from, along, limit);
            push(inside - 2.0 * along, along, limit);
            push(a - 2.0 * along, along, limit);
            let mut across = from - a;
            across[axis] = 0.0;
            push(a + 2.0 * across, -across, limit);
        }
        // Through corners and edges; ending on, at, or before a surface; starting on one.
        push(from, a - from, limit);
        push(from, 0.5 * (a + b) - from, limit);
        push(from, inside - from, 1.0);
        push(from, inside - from, 0.999);
        push(from, inside - from, 0.0);
        push(inside, rng.direction(), limit);
        push(a, b - a, limit);
        // From afar, and with directions of extreme lengths.
        push(inside + 1e4 * rng.direction(), Vec3::ZERO, limit);
        let far = inside + 1e3 * rng.direction();
        push(far, (inside - far).normalize(), limit);
        push(from, (inside - from) * 1e-10, limit);
        push(from, (inside - from) * 1e10, limit);
    }
    rays
}

#[test]
fn random_triangles() {
    let mut rng = Rng(1);
    for (count, size) in [(1, 1.0), (3, 1.0), (20, 0.7), (300, 0.3), (3000, 0.1)] {
        let triangles = soup(&mut rng, count, size);
        let rays = random_rays(&mut rng, 1500);
        // Edges are within rounding of a random ray once in some 10⁴ times.
        check("random", &triangles, &rays, 10);
    }
}

#[test]
fn slivers_duplicates_and_boxes() {
    let mut rng = Rng(2);
    let mut slivers: Vec<_> = (0..200)
        .map(|_| {
            let (a, along) = (rng.cube(), rng.direction());
            triangle([a, a + along, a + 0.5 * along + 1e-4 * rng.direction()])
        })
        .collect();
    slivers.extend(soup(&mut rng, 10, 0.5));
    let level: Vec<_> = soup(&mut rng, 100, 0.5)
        .into_iter()
        .map(|t| triangle(t.vertices.map(|v| Vec3::new(v.x, v.y, 0.25))))
        .collect();
    let mut twins = soup(&mut rng, 50, 0.5);
    twins.extend_from_within(..);
    let scenes = [
        ("slivers", slivers),
        ("coplanar", level),
        ("twins", twins),
        ("box", cube(1, Mat3::IDENTITY)),
        ("boxes", cube(5, Mat3::IDENTITY)),
    ];
    for (name, triangles) in scenes {
        check(name, &triangles, &random_rays(&mut rng, 1500), 30);
        let rays = nasty_rays(&mut rng, &triangles);
        // Most of these rays are meant to be within rounding of something.
        check(name, &triangles, &rays, rays.len());
    }
}

/// A wall of the room next door ends a millimetre from the wall between, and a ray starts in its plane
/// but for rounding, going away from it: the volumes it spans with the wall's edges are rounding too.
#[test]
fn rays_along_the_plane_of_a_triangle_behind_them_miss_it() {
    const RAYS: usize = 20_000;
    let wall = triangle([
        Vec3::new(-0.5, -0.5, -0.25),
        Vec3::new(-1e-3, -0.5, -0.25),
        Vec3::new(-1e-3, 0.5, -0.25),
    ]);
    let mut rng = Rng(9);
    let rays: Vec<Ray> = (0..RAYS)
        .map(|_| {
            let origin = Vec3::new(4e-6, rng.unit() - 0.5, -0.25 + 5e-7 * rng.unit());
            let direction = Vec3::new(1.0, rng.unit() - 0.5, -5e-4 * rng.unit()).normalize();
            Ray { origin, direction, limit: f32::MAX }
        })
        .collect();
    for (side, answers) in on_all(&Bvh::build(&[wall]), &rays, false) {
        let wrong = answers.iter().filter(|answer| answer.hits()).count();
        // Those whose volumes are all of one sign, by chance.
        assert!(wrong < RAYS / 200, "{side}: {wrong} of {RAYS} hit what is behind them");
    }
}

#[test]
fn the_judge_sees_wrong_answers() {
    let triangles = [triangle([Vec3::ZERO, Vec3::X, Vec3::Y])];
    let ray = Ray { origin: Vec3::new(0.2, 0.2, 1.0), direction: Vec3::NEG_Z, limit: f32::MAX };
    let right = on_host(&Bvh::build(&triangles), &[ray], false)[0];
    let fault = |answer: Answer| judge(&triangles, &ray, false, &answer, &mut 0);
    assert_eq!(fault(right), None);
    assert!(fault(Answer { t: 1.001, ..right }).is_some());
    assert!(fault(Answer { weights: [0.2, 0.6, 0.2], ..right }).is_some());
    assert!(fault(Answer { triangle: 1, ..right }).is_some());
    assert!(fault(Answer { triangle: PointRecord::NOTHING, ..right }).is_some());
    let short = Ray { limit: 0.5, ..ray };
    assert!(judge(&triangles, &short, false, &right, &mut 0).is_some());
    assert!(judge(&triangles, &short, true, &right, &mut 0).is_some());
}
