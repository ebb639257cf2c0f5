//! The visibility pass on points and VPLs made by hand: all its kernels, and the host.

use crate::common::gather::{visible, visible_in};
use crate::common::tracing::{soup, world_of_triangles};
use crate::common::{self, Rng};
use glam::{Mat3, Vec3};
use gpu_vpl::bvh::{Bvh, Ray};
use gpu_vpl::extremes::checks::gather::{point, vpl};
use gpu_vpl::extremes::checks::rays::cube;
use gpu_vpl::extremes::checks::trace::World;
use gpu_vpl::gpu::{PointRecord, VplRecord};
use gpu_vpl::render::kernels::Tracing;
use gpu_vpl::render::kernels::literals::Literals;
use gpu_vpl::sampling::SURFACE_OFFSET;
use gpu_vpl::scene::Triangle;

/// With literals for small scenes.
fn kernels(bvh: &Bvh) -> Vec<Tracing> {
    let mut kernels = vec![Tracing::Single];
    if common::gpu().has_subgroups() {
        kernels.extend([Tracing::Shaft, Tracing::Rays]);
    }
    if Literals::of_triangles(&bvh.triangles, &[], true).is_some() {
        kernels.push(Tracing::Literals);
    }
    kernels
}

/// A point on some triangle, and the normal of one of its sides.
fn place(rng: &mut Rng, triangles: &[Triangle]) -> (Vec3, Vec3) {
    let triangle = &triangles[rng.below(triangles.len())];
    let normal = triangle.scaled_normal().normalize();
    (rng.on(triangle), if rng.bits().is_multiple_of(2) { normal } else { -normal })
}

fn random(
    rng: &mut Rng,
    triangles: &[Triangle],
    points: usize,
    vpls: usize,
) -> (Vec<PointRecord>, Vec<VplRecord>) {
    let mut points: Vec<_> = (0..points)
        .map(|_| {
            let (position, normal) = place(rng, triangles);
            point(position, normal)
        })
        .collect();
    // Camera rays that hit nothing are among them, in runs and alone, and at the ends.
    for (i, point) in points.iter_mut().enumerate() {
        if i % 11 == 5 || (30..50).contains(&i) {
            point.surface = PointRecord::NOTHING;
            (point.position, point.normal) = ([0.0; 3], [0.0; 3]);
        }
    }
    let vpls = (0..vpls)
        .map(|_| {
            let (position, normal) = place(rng, triangles);
            vpl(position, normal, Vec3::ONE)
        })
        .collect();
    (points, vpls)
}

/// The pass on the host: the bits, and the number of rays.
fn reference(bvh: &Bvh, points: &[PointRecord], vpls: &[VplRecord]) -> (Vec<u32>, u64) {
    let mut bits = vec![0; vpls.len().div_ceil(32) * points.len()];
    let mut rays = 0;
    for (j, vpl) in vpls.iter().enumerate() {
        for (i, point) in points.iter().enumerate() {
            let [x, n, s, m] =
                [point.position, point.normal, vpl.position, vpl.normal].map(Vec3::from_array);
            let between = x - s;
            if point.surface == PointRecord::NOTHING
                || between.dot(n) >= 0.0
                || between.dot(m) <= 0.0
            {
                continue;
            }
            rays += 1;
            let origin = s + SURFACE_OFFSET * m;
            let direction = x + SURFACE_OFFSET * n - origin;
            let seen = !bvh.occluded(&Ray { origin, direction, limit: 1.0 });
            bits[j / 32 * points.len() + i] |= u32::from(seen) << (j % 32);
        }
    }
    (bits, rays)
}

fn differing(one: &[u32], two: &[u32]) -> u32 {
    assert_eq!(one.len(), two.len());
    one.iter().zip(two).map(|(a, b)| (a ^ b).count_ones()).sum()
}

fn scenes(rng: &mut Rng) -> Vec<(&'static str, Vec<Triangle>)> {
    let turned = Mat3::from_rotation_x(0.3) * Mat3::from_rotation_y(1.1);
    let mut furnished = cube(2, Mat3::IDENTITY);
    furnished.extend(soup(rng, 10, 0.3));
    vec![
        ("one triangle", soup(rng, 1, 1.0)),
        ("closed box", cube(1, Mat3::IDENTITY)),
        ("turned box", cube(4, turned)),
        ("soup", soup(rng, 40, 0.6)),
        ("furnished box", furnished),
        ("a few hundred triangles", soup(rng, 450, 0.1)),
        ("many triangles", soup(rng, 2000, 0.05)),
    ]
}

/// Single rays and packets, small boxes and large, host and device: one answer.
#[test]
fn all_kernels_and_the_host_see_the_same() {
    let mut rng = Rng(1);
    let (mut pairs, mut differ, mut seen, mut blocked) = (0u64, 0u64, 0u64, 0u64);
    for (name, triangles) in scenes(&mut rng) {
        let bvh = Bvh::build(&triangles);
        for (points, vpls) in [(1, 1), (6, 32), (203, 77), (518, 200)] {
            let (points, vpls) = random(&mut rng, &triangles, points, vpls);
            let (expected, rays) = reference(&bvh, &points, &vpls);
            let lit: u64 = expected.iter().map(|word| u64::from(word.count_ones())).sum();
            seen += lit;
            blocked += rays - lit;
            for tracing in kernels(&bvh) {
                // Packets take whole shafts only through small hierarchies.
                if tracing == Tracing::Shaft && bvh.nodes.len() > 1000 {
                    continue;
                }
                let words = vpls.len().div_ceil(32) as u32;
                let got = visible(common::gpu(), tracing, &bvh, &points, &vpls, &[words]);
                let what = format!("{name}, {tracing:?}, {} × {}", points.len(), vpls.len());
                // Nearly every pair is far from the horizon, and a scene's alike: the same
                // cosines are positive but for one in 10⁵.
                assert!(got.1.abs_diff(rays) <= rays / 100_000, "{what}: {} rays, {rays}", got.1);
                let wrong = differing(&got.0, &expected);
                assert!(wrong <= 3, "{what}: {wrong} bits differ from the host's");
                differ += u64::from(wrong);
                pairs += rays;
                // Slices of the matrix, one dispatch each, make the same whole.
                if words > 2 {
                    let slices = [1, words - 2, 1];
                    let sliced = visible(common::gpu(), tracing, &bvh, &points, &vpls, &slices);
                    assert!(sliced == got, "{what}: slices differ from the whole");
                }
            }
        }
    }
    // A ray within rounding of an edge may be answered either way.
    assert!(pairs > 100_000 && differ * 100_000 <= pairs, "{differ} bits of {pairs} differ");
    assert!(seen > 10_000 && blocked > 10_000, "{seen} seen, {blocked} blocked: a weak test");
}

/// In a convex room everyone sees everyone but those on the same wall; the walls are no
/// obstacle to rays that end on them.
#[test]
fn walls_of_a_convex_room_block_nothing() {
    let mut rng = Rng(2);
    let turned = Mat3::from_rotation_x(0.3) * Mat3::from_rotation_y(1.1);
    for turn in [Mat3::IDENTITY, turned] {
        let triangles = cube(3, turn);
        let bvh = Bvh::build(&triangles);
        let inside = |rng: &mut Rng| {
            let (position, normal) = place(rng, &triangles);
            (position, if normal.dot(position) > 0.0 { -normal } else { normal })
        };
        let points: Vec<_> = (0..400).map(|_| inside(&mut rng)).collect();
        let vpls: Vec<_> = (0..96).map(|_| inside(&mut rng)).collect();
        let point_records: Vec<_> = points.iter().map(|&(p, n)| point(p, n)).collect();
        let vpl_records: Vec<_> = vpls.iter().map(|&(p, n)| vpl(p, n, Vec3::ONE)).collect();
        for tracing in kernels(&bvh) {
            let gpu = common::gpu();
            let (bits, _) = visible(gpu, tracing, &bvh, &point_records, &vpl_records, &[3]);
            for (j, &(s, m)) in vpls.iter().enumerate() {
                for (i, &(x, n)) in points.iter().enumerate() {
                    let sees = bits[j / 32 * points.len() + i] >> (j % 32) & 1 == 1;
                    // On the same wall the cosines are rounding, and their sign is chance.
                    if n.dot(m) < 0.99 {
                        assert!(sees, "{tracing:?}: {x} does not see {s}");
                    }
                }
            }
        }
    }
}

/// Triangles that bound a scene hide nothing in it from anything. Two places in the plane of one,
/// on both its sides, have cosines that are rounding: no light passes between them.
#[test]
fn what_bounds_a_scene_blocks_nothing() {
    let mut rng = Rng(5);
    let turned = Mat3::from_rotation_x(0.3) * Mat3::from_rotation_y(1.1);
    for turn in [Mat3::IDENTITY, turned] {
        let mut triangles = cube(1, turn);
        triangles.extend(soup(&mut rng, 20, 1.5));
        for triangle in &mut triangles[12..] {
            triangle.vertices = triangle.vertices.map(|vertex| turn * (0.3 * vertex));
        }
        let bvh = Bvh::build(&triangles);
        let (points, vpls) = random(&mut rng, &triangles, 500, 96);
        let (expected, _) = reference(&bvh, &points, &vpls);
        let literals = Literals::of_triangles(&bvh.triangles, &[], false).expect("it is small");
        let count = |text: &str| text.matches("nearer").count();
        assert_eq!((count(&literals.all), count(&literals.blockers)), (32, 20));
        let beside =
            Literals::of_triangles(&bvh.triangles, &[turn * Vec3::X], false).expect("it is small");
        assert_eq!(count(&beside.blockers), 22, "a light beyond a wall");

        let literals = Some(literals);
        let world = World { literals, ..world_of_triangles(&bvh) };
        let (bits, _) = visible_in(&world, Tracing::Literals, &points, &vpls);
        let (mut differ, mut blocked) = (0, 0);
        for (j, vpl) in vpls.iter().enumerate() {
            for (i, point) in points.iter().enumerate() {
                let [x, n, s, m] =
                    [point.position, point.normal, vpl.position, vpl.normal].map(Vec3::from_array);
                let at = |bits: &[u32]| bits[j / 32 * points.len() + i] >> (j % 32) & 1;
                if (x - s).dot(n) < -1e-6 && (x - s).dot(m) > 1e-6 {
                    differ += u32::from(at(&bits) != at(&expected));
                    blocked += 1 - at(&expected);
                }
            }
        }
        assert!(blocked > 500, "{blocked} rays are blocked: a weak test");
        assert!(differ <= 3, "{differ} bits differ from the host's");
    }
}

#[test]
fn wrong_bits_are_counted() {
    assert_eq!(differing(&[0b1011, 7], &[0b1011, 7]), 0);
    assert_eq!(differing(&[0b1011, 7], &[0b0010, 7]), 2);
    let triangles = cube(1, Mat3::IDENTITY);
    let (points, vpls) = random(&mut Rng(3), &soup(&mut Rng(4), 30, 1.0), 200, 40);
    let open = reference(&Bvh::build(&triangles[..1]), &points, &vpls);
    let closed = reference(&Bvh::build(&triangles), &points, &vpls);
    assert_eq!(open.1, closed.1);
    assert!(differing(&open.0, &closed.0) > 20, "a box without walls looks closed");
}

/// No VPL inside a closed surface is seen from outside, by no kernel, along rays through vertices and
/// edges to the last bit.
#[test]
fn closed_surfaces_hide_what_is_inside() {
    let mut rng = Rng(6);
    let turn = Mat3::from_rotation_x(0.3) * Mat3::from_rotation_y(1.1);
    for n in [1, 6] {
        let triangles = cube(n, turn);
        let bvh = Bvh::build(&triangles);
        // So short that rays are not moved off by them, while they still tell the side.
        const SHORT: f32 = 1e-20;
        let vpls: Vec<VplRecord> =
            (0..96).map(|_| vpl(0.3 * rng.cube(), SHORT * rng.direction(), Vec3::ONE)).collect();
        let beyond = |rng: &mut Rng, index: usize| {
            let light = &vpls[index % vpls.len()];
            let (from, normal) = (Vec3::from(light.position), Vec3::from(light.normal));
            loop {
                let [a, b, _] = triangles[rng.below(triangles.len())].vertices;
                let target = if index.is_multiple_of(2) { a } else { a + (b - a) * rng.unit() };
                let way = target - from;
                if way.dot(normal) > 0.0 {
                    return point(from + 2.0 * way, -SHORT * way);
                }
            }
        };
        let points: Vec<PointRecord> = (0..9600).map(|i| beyond(&mut rng, i)).collect();
        for kernel in kernels(&bvh) {
            let (bits, rays) = visible(common::gpu(), kernel, &bvh, &points, &vpls, &[3]);
            assert!(rays > 100_000, "{kernel:?}: {rays} rays");
            let seen: u32 = bits.iter().map(|word| word.count_ones()).sum();
            assert_eq!(seen, 0, "{kernel:?}, {n}: some of {rays} rays leak");
        }
        // A surface with a hole hides less.
        let open = Bvh::build(&triangles[1..]);
        let (bits, _) = visible(common::gpu(), Tracing::Single, &open, &points, &vpls, &[3]);
        assert!(bits.iter().any(|&word| word != 0));
    }
}
