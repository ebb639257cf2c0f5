//! How good a hierarchy is.

use super::Bvh;
use crate::gpu::NodeRecord;

/// What a hierarchy is like.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Quality {
    /// Nodes, leaves among them.
    pub nodes: usize,
    /// Nodes with shapes.
    pub leaves: usize,
    /// Nodes on the longest way from the root to a leaf.
    pub depth: usize,
    /// Shapes in a leaf, on average. Splits may put a triangle into several.
    pub mean_leaf_size: f64,
    /// What a ray through the root's box is expected to cost by the surface area heuristic
    /// (Goldsmith and Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing", 1987),
    /// where a box and a shape cost 1 each.
    pub sah_cost: f64,
}

impl Bvh {
    /// What it is like.
    pub fn quality(&self) -> Quality {
        let leaves = self.nodes.iter().filter(|node| node.leaf != 0).count();
        let cost = |node: &NodeRecord| node.half_area() * (1.0 + f64::from(node.leaf % 8));
        let root = self.nodes.first().map_or(0.0, NodeRecord::half_area);
        let cost: f64 = self.nodes.iter().map(cost).sum();
        Quality {
            nodes: self.nodes.len(),
            leaves,
            depth: self.depth(),
            mean_leaf_size: self.triangles.len() as f64 / leaves.max(1) as f64,
            sah_cost: if root > 0.0 { cost / root } else { 0.0 },
        }
    }

    fn depth(&self) -> usize {
        // Where the subtrees end that hold the node.
        let mut ends: Vec<u32> = Vec::new();
        let mut depth = 0;
        for (at, node) in (0u32..).zip(&self.nodes) {
            while ends.last().is_some_and(|&end| end <= at) {
                ends.pop();
            }
            ends.push(node.skip);
            depth = depth.max(ends.len());
        }
        depth
    }
}

impl NodeRecord {
    /// Half of the surface of its box.
    pub(super) fn half_area(&self) -> f64 {
        let [x, y, z] = std::array::from_fn(|axis| f64::from(self.high[axis] - self.low[axis]));
        x * y + y * z + z * x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn node(low: [f32; 3], high: [f32; 3], skip: u32, leaf: u32) -> NodeRecord {
        NodeRecord { low, high, skip, leaf }
    }

    #[test]
    fn a_small_hierarchy_by_hand() {
        let bvh = Bvh {
            nodes: vec![
                node([0.0; 3], [2.0, 1.0, 1.0], 5, 0),
                node([0.0; 3], [1.0; 3], 2, 2),
                node([1.0, 0.0, 0.0], [2.0, 1.0, 1.0], 5, 0),
                node([1.0, 0.0, 0.0], [2.0, 1.0, 0.0], 4, 8 * 2 + 1),
                node([1.0, 0.0, 1.0], [2.0, 1.0, 1.0], 5, 8 * 3 + 3),
            ],
            triangles: vec![bytemuck::Zeroable::zeroed(); 6],
            cutouts: None,
        };
        let expected = Quality {
            nodes: 5,
            leaves: 3,
            depth: 3,
            mean_leaf_size: 2.0,
            sah_cost: (5.0 + 3.0 * 3.0 + 3.0 + 2.0 + 4.0) / 5.0,
        };
        assert_eq!(bvh.quality(), expected);
    }
}
