//! How fast shadow rays are: a measurement, so it runs only when it is asked for, by
//! `cargo test --release --test rays -- --ignored --nocapture`.

#![allow(clippy::expect_used, reason = "a helper of tests fails by panicking")]
#![allow(clippy::print_stdout, reason = "a measurement prints what it finds")]

use std::time::{Duration, Instant};

use crate::common::gather::VisibilityDispatch;
use crate::common::gpu;
use glam::{Vec3, Vec3A};
use gpu_vpl::bvh::{Bvh, Ray};
use gpu_vpl::cluster::{Options, Points, kmeans};
use gpu_vpl::extremes::checks::gather::{point, vpl};
use gpu_vpl::gpu::{PointRecord, VplRecord};
use gpu_vpl::render::kernels::Tracing;
use gpu_vpl::render::{Bounces, Clustering, LightPaths, Lights};
use gpu_vpl::sampling::SURFACE_OFFSET;
use gpu_vpl::scene::Scene;
use obvhs::BvhBuildParams;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::rt_triangle::RtTriangle;
use rayon::prelude::*;

/// What the camera sees at the centres of its pixels, in blocks of 8 × 8.
fn visible_points(scene: &Scene, bvh: &Bvh) -> Vec<PointRecord> {
    let camera = scene.camera;
    let ([width, height], [tx, ty]) = (camera.size, camera.half_tangents());
    let blocks = (0..height / 8).flat_map(|y| (0..width / 8).map(move |x| (x, y)));
    let pixels = blocks.flat_map(|(x, y)| (0..64).map(move |k| (8 * x + k % 8, 8 * y + k / 8)));
    let hit = |(x, y): (u32, u32)| {
        let u = (2.0 * x as f32 + 1.0) / width as f32 - 1.0;
        let v = 1.0 - (2.0 * y as f32 + 1.0) / height as f32;
        let direction = camera.forward + u * tx * camera.right + v * ty * camera.up;
        let ray = Ray { origin: camera.position, direction, limit: f32::MAX };
        let hit = bvh.closest(&ray)?;
        let normal = scene.triangles[hit.shape as usize].scaled_normal().normalize();
        let side = -normal.dot(direction).signum();
        Some(point(camera.position + hit.t * direction, side * normal))
    };
    pixels.filter_map(hit).collect()
}

/// A few of the points that stand for all, as the renderer chooses and orders them.
fn representatives(points: &[PointRecord], clusters: u32) -> Vec<PointRecord> {
    let positions: Vec<Vec3> = points.iter().map(|p| p.position.into()).collect();
    let normals: Vec<Vec3> = points.iter().map(|p| p.normal.into()).collect();
    let defaults = Clustering::default();
    let options = Options {
        clusters,
        iterations: defaults.point_iterations,
        normal_threshold: defaults.normal_threshold,
        stride: defaults.stride,
        seed: 0,
    };
    let found = kmeans(&Points { positions: &positions, normals: &normals }, &options);
    let mut rows: Vec<_> =
        found.clusters.iter().map(|c| points[c.representative as usize]).collect();
    rows.sort_by_key(|row| morton(row.position));
    rows
}

fn light_paths(scene: &Scene, bvh: &Bvh, count: u32) -> Vec<VplRecord> {
    let lights = &Lights::of(scene);
    let paths = LightPaths { scene, bvh, lights, count, bounces: Bounces::Finite(2), seed: 0 };
    let vpls = paths.trace();
    let mut vpls: Vec<_> = vpls.iter().map(|v| vpl(v.position, v.normal, Vec3::ONE)).collect();
    vpls.sort_by_key(|vpl| morton(vpl.position));
    vpls
}

/// Interleaved bits of a position in [-2, 2]³, 16 an axis.
fn morton(position: [f32; 3]) -> u64 {
    let cells = position.map(|x| ((x + 2.0) * 16384.0) as u64);
    (0..48).map(|bit| (cells[bit % 3] >> (bit / 3) & 1) << bit).sum()
}

/// The shortest of three times of the same work.
fn best<T>(mut work: impl FnMut() -> T) -> (T, Duration) {
    let mut timed = || {
        let start = Instant::now();
        (work(), start.elapsed())
    };
    // The first run compiles, and fills the caches.
    let _: (T, Duration) = timed();
    [timed(), timed(), timed()].into_iter().min_by_key(|(_, time)| *time).expect("three of them")
}

/// Shadow rays between cluster representatives and VPLs in the room: the device, and obvhs's
/// own eight-wide hierarchy on the host's cores.
#[test]
#[ignore = "a measurement"]
fn shadow_rays_of_representatives_in_the_room() {
    let scene = Scene::load("builtin:room").expect("it is built in");
    let bvh = Bvh::build(&scene.triangles);
    let points = representatives(&visible_points(&scene, &bvh), 2600);
    let vpls = light_paths(&scene, &bvh, 2000);
    println!("{} representatives, {} VPLs, {} nodes", points.len(), vpls.len(), bvh.nodes.len());

    let words = vpls.len().div_ceil(32) as u32;
    let slices: Vec<u32> = (0..words).step_by(24).map(|word| 24.min(words - word)).collect();
    let pass = VisibilityDispatch::new(gpu(), Tracing::Rays, &bvh, &points, &vpls);
    // As in the renderer.
    let mut at_once = 16;
    let run = || loop {
        match pass.run(&slices, at_once) {
            Some(found) => return found,
            None => at_once /= 2,
        }
    };
    let ((bits, rays), time) = best(run);
    let lit: u64 = bits.iter().map(|word| u64::from(word.count_ones())).sum();
    let occluded = 1.0 - lit as f64 / rays as f64;
    let rate = |rays: u64, time: Duration| rays as f64 / time.as_secs_f64() / 1e6;
    println!("device: {rays} rays, {occluded:.4} occluded, {:.3} Mrays/s", rate(rays, time));

    let ((host_rays, blocked), time) = best(host(&scene, &points, &vpls));
    let host_occluded = blocked as f64 / host_rays as f64;
    let host_rate = rate(host_rays, time);
    println!("obvhs: {host_rays} rays, {host_occluded:.4} occluded, {host_rate:.3} Mrays/s");
    assert!(rays.abs_diff(host_rays) <= rays / 10_000, "not the same rays");
    assert!((occluded - host_occluded).abs() < 0.005, "not the same answers");
}

/// The same rays by obvhs alone, in as many threads as there are cores: how many there are, and
/// how many are blocked.
fn host(scene: &Scene, points: &[PointRecord], vpls: &[VplRecord]) -> impl FnMut() -> (u64, u64) {
    let shapes: Vec<_> = scene
        .triangles
        .iter()
        .map(|triangle| {
            let [v0, v1, v2] = triangle.vertices.map(Vec3A::from);
            obvhs::triangle::Triangle { v0, v1, v2 }
        })
        .collect();
    let params =
        BvhBuildParams { reinsertion_batch_ratio: 0.5, ..BvhBuildParams::very_slow_build() };
    let built = build_cwbvh_from_tris(&shapes, params, &mut Duration::default());
    let indices = &built.primitive_indices;
    let triangles: Vec<RtTriangle> =
        indices.iter().map(|&index| (&shapes[index as usize]).into()).collect();
    move || {
        let of_vpl = |vpl: &VplRecord| {
            let (mut rays, mut blocked) = (0, 0);
            for point in points {
                let [x, n, s, m] =
                    [point.position, point.normal, vpl.position, vpl.normal].map(Vec3A::from);
                if (x - s).dot(n) >= 0.0 || (x - s).dot(m) <= 0.0 {
                    continue;
                }
                let origin = s + SURFACE_OFFSET * m;
                let direction = x + SURFACE_OFFSET * n - origin;
                let ray = obvhs::ray::Ray::new(origin, direction, 0.0, 1.0);
                let miss = built.ray_traverse_miss(ray, |ray, at| triangles[at].intersect(ray));
                rays += 1;
                blocked += u64::from(!miss);
            }
            (rays, blocked)
        };
        vpls.par_iter().map(of_vpl).reduce(|| (0, 0), |a, b| (a.0 + b.0, a.1 + b.1))
    }
}
