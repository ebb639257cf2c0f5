//! Building a hierarchy, in the layout of the device.

use std::time::Duration;

use glam::Vec3A;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::{build_bvh2, build_bvh2_from_tris};
use obvhs::{BvhBuildParams, aabb::Aabb};

use super::shape::Cutouts;
use crate::gpu::{NodeRecord, TriangleRecord};
use crate::scene::{Scene, Sphere, Triangle};

/// Leaves hold at most so many shapes; [`NodeRecord::leaf`] has room for seven.
const LEAF_SHAPES: u32 = 4;
/// The largest share of the nodes that the builder tries to move at once.
const MOVED_AT_ONCE: f32 = 0.5;

/// A hierarchy over a scene's shapes, in the layout of the device.
#[derive(Debug, Clone)]
pub struct Bvh {
    /// Depth-first nodes; the first is the root.
    pub nodes: Vec<NodeRecord>,
    /// Shapes in leaf order. Spatial splits may name a triangle more than once.
    pub triangles: Vec<TriangleRecord>,
    /// What cuts holes into them.
    pub(super) cutouts: Option<Cutouts>,
}

impl Bvh {
    /// Builds a hierarchy over the triangles and spheres of a scene.
    pub fn of(scene: &Scene) -> Self {
        let cutout = |material: u32| {
            let cutout = scene.materials.get(material as usize).and_then(|m| m.cutout);
            cutout.map_or(0, |texture| texture + 1)
        };
        let cutouts = Cutouts::of(scene);
        Self { cutouts, ..Self::over(&scene.triangles, &scene.spheres, &cutout) }
    }

    /// Builds a hierarchy over triangles, of which there must be at least one.
    pub fn build(triangles: &[Triangle]) -> Self {
        Self::over(triangles, &[], &|_| 0)
    }

    /// `cutout` tells the bits of a material's holes. Triangles and spheres have subtrees of their
    /// own: only triangles are split.
    fn over(triangles: &[Triangle], spheres: &[Sphere], cutout: &dyn Fn(u32) -> u32) -> Self {
        let mut bvh = Self { nodes: Vec::new(), triangles: Vec::new(), cutouts: None };
        let joined = !triangles.is_empty() && !spheres.is_empty();
        if joined {
            bvh.nodes.push(bytemuck::Zeroable::zeroed());
        }
        if !triangles.is_empty() {
            let record = |index: u32| {
                let triangle = &triangles[index as usize];
                TriangleRecord::of_triangle(triangle, index, cutout(triangle.material))
            };
            bvh.flatten(&over_triangles(triangles), &record);
        }
        let second = bvh.nodes.len();
        if !spheres.is_empty() {
            let records = sphere_records(spheres, triangles.len() as u32, cutout);
            bvh.flatten(&over_spheres(&records), &|index| records[index as usize]);
        }
        if joined {
            let (one, two) = (bvh.nodes[1], bvh.nodes[second]);
            let both = |of: fn(f32, f32) -> f32, a: [f32; 3], b: [f32; 3]| {
                std::array::from_fn(|axis| of(a[axis], b[axis]))
            };
            bvh.nodes[0] = NodeRecord {
                low: both(f32::min, one.low, two.low),
                skip: bvh.nodes.len() as u32,
                high: both(f32::max, one.high, two.high),
                leaf: 0,
            };
        }
        bvh
    }

    /// Appends the nodes of a tree depth first, and its shapes, of which `record` tells the
    /// record. Not recursive, as the tree may be as deep as the scene has shapes.
    fn flatten(&mut self, built: &Bvh2, record: &dyn Fn(u32) -> TriangleRecord) {
        enum Step {
            Enter(usize),
            /// The subtree that began at this node is complete.
            Leave(usize),
        }
        self.nodes.reserve(built.nodes.len());
        self.triangles.reserve(built.primitive_indices.len());
        let mut steps = vec![Step::Enter(0)];
        while let Some(step) = steps.pop() {
            match step {
                Step::Leave(at) => self.nodes[at].skip = self.nodes.len() as u32,
                Step::Enter(from) => {
                    let node = &built.nodes[from];
                    let at = self.nodes.len();
                    let leaf = match node.is_leaf() {
                        true => self.push_leaf(built, node.first_index, node.prim_count, record),
                        false => 0,
                    };
                    let low = node.min.to_array().map(|x| x - slack(x));
                    let high = node.max.to_array().map(|x| x + slack(x));
                    self.nodes.push(NodeRecord { low, skip: 0, high, leaf });
                    steps.push(Step::Leave(at));
                    if !node.is_leaf() {
                        let first = node.first_index as usize;
                        steps.extend([Step::Enter(first + 1), Step::Enter(first)]);
                    }
                }
            }
        }
    }

    fn push_leaf(
        &mut self,
        built: &Bvh2,
        first: u32,
        count: u32,
        record: &dyn Fn(u32) -> TriangleRecord,
    ) -> u32 {
        let leaf = 8 * self.triangles.len() as u32 + count;
        let from = first as usize..(first + count) as usize;
        self.triangles.extend(built.primitive_indices[from].iter().map(|&index| record(index)));
        leaf
    }
}

/// Splitting the boxes of long triangles, and moving subtrees to where they make the whole
/// smaller, pay on every ray but cost build time. A shadow ray through the room tests 196 boxes
/// with a share of 0.2 moved at once (obvhs's preset), 63 with 0.5.
fn params(shapes: usize) -> BvhBuildParams {
    let preset = match shapes {
        0..500_000 => BvhBuildParams::very_slow_build(),
        _ => BvhBuildParams::medium_build(),
    };
    BvhBuildParams {
        reinsertion_batch_ratio: preset.reinsertion_batch_ratio.min(MOVED_AT_ONCE),
        // obvhs's presets suit a wide hierarchy. With leaves of at most 2 the room's shadow rays
        // are a tenth slower, of 1 a quarter; with leaves of 7 they are no faster.
        max_prims_per_leaf: LEAF_SHAPES,
        collapse_traversal_cost: 2.0,
        ..preset
    }
}

fn over_triangles(triangles: &[Triangle]) -> Bvh2 {
    let shapes: Vec<_> = triangles
        .iter()
        .map(|triangle| {
            let [v0, v1, v2] = triangle.vertices.map(Vec3A::from);
            obvhs::triangle::Triangle { v0, v1, v2 }
        })
        .collect();
    build_bvh2_from_tris(&shapes, params(shapes.len()), &mut Duration::default())
}

/// The records of spheres, the first of them the `first`th shape of the scene. A sphere with holes
/// has two: a ray that enters by a hole still meets the far side.
fn sphere_records(
    spheres: &[Sphere],
    first: u32,
    cutout: &dyn Fn(u32) -> u32,
) -> Vec<TriangleRecord> {
    let mut records = Vec::with_capacity(spheres.len());
    for (index, sphere) in (first..).zip(spheres) {
        let cutout = cutout(sphere.material);
        records.push(TriangleRecord::of_sphere(sphere, index, cutout));
        if cutout != 0 {
            let kind = cutout | TriangleRecord::FAR;
            records.push(TriangleRecord::of_sphere(sphere, index, kind));
        }
    }
    records
}

fn over_spheres(records: &[TriangleRecord]) -> Bvh2 {
    let bounds = |record: &TriangleRecord| {
        let (center, radius) = (Vec3A::from_array(record.a), Vec3A::splat(record.b[0]));
        Aabb::new(center - radius, center + radius)
    };
    let bounds: Vec<_> = records.iter().map(bounds).collect();
    build_bvh2(&bounds, params(bounds.len()), &mut Duration::default())
}

/// By how much a box is widened: rays along its faces, where a slab test has 0 · ∞, are then
/// inside or outside of it, and what spatial splits have rounded is made good.
fn slack(coordinate: f32) -> f32 {
    f32::EPSILON * (1.0 + coordinate.abs())
}
