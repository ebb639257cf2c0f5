//! The bounding volume hierarchy: built by obvhs, flattened to depth-first nodes with skip
//! pointers for the device, and traversed on the host for light paths.
//!
//! A traversal needs no stack: it goes to the next node where a box is hit, else to the
//! node's skip pointer (Smits, "Efficiency Issues for Ray Tracing", 1998). The WGSL twin is
//! `shaders/traverse.wgsl`; a test holds the two against each other.

mod traverse;

use std::time::Duration;

use glam::Vec3A;
use obvhs::{BvhBuildParams, bvh2::Bvh2, bvh2::builder::build_bvh2_from_tris};

use crate::gpu::{NodeRecord, TriangleRecord};
use crate::scene::Triangle;

pub use traverse::{Hit, Ray};

/// Leaves hold at most so many triangles; [`NodeRecord::leaf`] has room for seven.
const LEAF_TRIANGLES: u32 = 4;
/// The largest share of the nodes that the builder tries to move at once.
const MOVED_AT_ONCE: f32 = 0.5;

/// A hierarchy over a scene's triangles, in the layout of the device.
#[derive(Debug, Clone)]
pub struct Bvh {
    /// Depth-first nodes; the first is the root.
    pub nodes: Vec<NodeRecord>,
    /// Triangles in leaf order. Spatial splits may name a triangle more than once.
    pub triangles: Vec<TriangleRecord>,
}

impl Bvh {
    /// Builds a hierarchy over triangles, of which there must be at least one.
    pub fn build(triangles: &[Triangle]) -> Self {
        let shapes: Vec<_> = triangles
            .iter()
            .map(|triangle| {
                let [v0, v1, v2] = triangle.vertices.map(Vec3A::from);
                obvhs::triangle::Triangle { v0, v1, v2 }
            })
            .collect();
        // Splitting the boxes of long triangles, and moving subtrees to where they make the
        // whole smaller, pay on every ray but cost build time. A shadow ray through the room
        // tests 196 boxes with a share of 0.2 moved at once (obvhs's preset), 63 with 0.5.
        let mut params = match triangles.len() {
            0..500_000 => BvhBuildParams::very_slow_build(),
            _ => BvhBuildParams::medium_build(),
        };
        params.reinsertion_batch_ratio = params.reinsertion_batch_ratio.min(MOVED_AT_ONCE);
        // obvhs's presets suit a wide hierarchy. With leaves of at most 2 the room's shadow rays
        // are a tenth slower, of 1 a quarter; with leaves of 7 they are no faster.
        params.max_prims_per_leaf = LEAF_TRIANGLES;
        params.collapse_traversal_cost = 2.0;
        let built = build_bvh2_from_tris(&shapes, params, &mut Duration::default());

        let mut bvh = Self {
            nodes: Vec::with_capacity(built.nodes.len()),
            triangles: Vec::with_capacity(built.primitive_indices.len()),
        };
        bvh.flatten(&built, triangles);
        bvh
    }

    /// Writes the nodes depth first. Not recursive, as the tree may be as deep as the scene
    /// has triangles.
    fn flatten(&mut self, built: &Bvh2, triangles: &[Triangle]) {
        enum Step {
            Enter(usize),
            /// The subtree that began at this node is complete.
            Leave(usize),
        }
        let mut steps = vec![Step::Enter(0)];
        while let Some(step) = steps.pop() {
            match step {
                Step::Leave(at) => self.nodes[at].skip = self.nodes.len() as u32,
                Step::Enter(from) => {
                    let node = &built.nodes[from];
                    let at = self.nodes.len();
                    let leaf = match node.is_leaf() {
                        true => self.push_leaf(built, node.first_index, node.prim_count, triangles),
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

    fn push_leaf(&mut self, built: &Bvh2, first: u32, count: u32, triangles: &[Triangle]) -> u32 {
        let leaf = 8 * self.triangles.len() as u32 + count;
        let from = first as usize..(first + count) as usize;
        self.triangles.extend(built.primitive_indices[from].iter().map(|&index| {
            let Triangle { vertices, material } = triangles[index as usize];
            let [a, b, c] = vertices.map(|vertex| vertex.to_array());
            TriangleRecord { a, material, b, index, c, pad: 0 }
        }));
        leaf
    }
}

/// By how much a box is widened: rays along its faces, where a slab test has 0 · ∞, are then
/// inside or outside of it, and what spatial splits have rounded is made good.
fn slack(coordinate: f32) -> f32 {
    f32::EPSILON * (1.0 + coordinate.abs())
}
