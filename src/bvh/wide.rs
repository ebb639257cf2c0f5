//! The hierarchy with four children a node, for packets of rays on the device: a packet loads a
//! whole node at once, and visits those of its children that some ray meets, the nearest first.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};

use super::Bvh;
use crate::gpu::NodeRecord;

/// Children of a node.
const WIDTH: usize = 4;
/// The root; what stands before it is no node, as 0 links to none.
const ROOT: usize = 1;
/// Children that a packet keeps to visit later, at most: `Stack` in
/// `shaders/trace/wide_nodes.wgsl` has room for so many.
const MOST_WAITING: usize = 64;

/// A child: its box, and where it is. 32 bytes, two texels of a texture.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct WideChild {
    /// Lower corner of the bounds.
    pub low: [f32; 3],
    /// 8 · node; of a leaf [`NodeRecord::leaf`], which is no multiple of 8; 0 if there is no child.
    pub link: u32,
    /// Upper corner of the bounds.
    pub high: [f32; 3],
    /// Unused.
    pub pad: u32,
}

/// A node: its children, the first of which there is. 128 bytes.
pub type WideNode = [WideChild; WIDTH];

/// A hierarchy of nodes of four children, over the leaves of a [`Bvh`].
#[derive(Debug, Clone)]
pub struct WideBvh {
    /// The root is the second.
    pub nodes: Vec<WideNode>,
}

/// What a child is made of: a subtree, or, where trees are too deep, a run of leaves.
#[derive(Debug, Clone)]
enum Part {
    Tree(usize),
    Leaves(Range<usize>),
}

/// The nodes of a hierarchy, and which of them are leaves.
struct Source<'a> {
    nodes: &'a [NodeRecord],
    leaves: Vec<usize>,
    /// How many leaves stand before each node, and all of them.
    before: Vec<usize>,
}

impl WideBvh {
    /// From a hierarchy of two children a node, whose inner nodes give way to their children, those
    /// with the largest boxes first (Wald, Benthin and Boulos, "Getting Rid of Packets", 2008).
    /// Below where more children might wait to be visited than a packet has room for, the leaves are
    /// split evenly instead.
    pub fn of(bvh: &Bvh) -> Self {
        let source = Source::of(&bvh.nodes);
        let mut nodes: Vec<WideNode> = vec![Zeroable::zeroed(); ROOT + 1];
        // Nodes that have no children yet, what they hold, and how many may wait already.
        let mut open = Vec::new();
        if !bvh.nodes.is_empty() {
            open.push((ROOT, Part::Tree(0), 0));
        }
        while let Some((at, part, waiting)) = open.pop() {
            let children = source.children(&part, waiting);
            let waiting = waiting + children.len() - 1;
            for (slot, child) in children.into_iter().enumerate() {
                let NodeRecord { low, high, leaf, .. } = source.bounds(&child);
                let mut link = leaf;
                if leaf == 0 {
                    link = 8 * nodes.len() as u32;
                    open.push((nodes.len(), child, waiting));
                    nodes.push(Zeroable::zeroed());
                }
                nodes[at][slot] = WideChild { low, link, high, pad: 0 };
            }
        }
        Self { nodes }
    }
}

impl<'a> Source<'a> {
    fn of(nodes: &'a [NodeRecord]) -> Self {
        let leaves: Vec<_> = (0..nodes.len()).filter(|&at| nodes[at].leaf != 0).collect();
        let mut before = Vec::with_capacity(nodes.len() + 1);
        let mut count = 0;
        for node in nodes {
            before.push(count);
            count += usize::from(node.leaf != 0);
        }
        before.push(count);
        Self { nodes, leaves, before }
    }

    /// The children of a node that holds this, at least one.
    fn children(&self, part: &Part, waiting: usize) -> Vec<Part> {
        let leaves = self.leaves_of(part);
        // Split evenly, the leaves take so many levels, of which each lets three more wait.
        let levels = leaves.len().max(1).next_power_of_two().ilog2().div_ceil(2) as usize;
        match part {
            Part::Tree(of) if waiting + (WIDTH - 1) * (levels + 1) <= MOST_WAITING => {
                self.collapsed(*of)
            }
            _ => {
                let at = |part: usize| leaves.start + leaves.len() * part / WIDTH;
                let runs = (0..WIDTH).map(|part| at(part)..at(part + 1));
                runs.filter(|run| !run.is_empty()).map(Part::Leaves).collect()
            }
        }
    }

    fn leaves_of(&self, part: &Part) -> Range<usize> {
        match part {
            Part::Tree(of) => match self.nodes[*of] {
                NodeRecord { leaf: 0, skip, .. } => self.before[*of]..self.before[skip as usize],
                _ => self.before[*of]..self.before[*of] + 1,
            },
            Part::Leaves(run) => run.clone(),
        }
    }

    fn collapsed(&self, of: usize) -> Vec<Part> {
        let is_inner = |at: usize| self.nodes[at].leaf == 0;
        let pair = |of: usize| [of + 1, self.nodes[of + 1].skip as usize];
        let mut children = if is_inner(of) { pair(of).to_vec() } else { vec![of] };
        while children.len() < WIDTH {
            let area = |at: usize| self.nodes[children[at]].half_area();
            let inner = (0..children.len()).filter(|&at| is_inner(children[at]));
            let Some(largest) = inner.max_by(|&a, &b| area(a).total_cmp(&area(b))) else { break };
            let own = pair(children[largest]);
            children.splice(largest..=largest, own);
        }
        children.into_iter().map(Part::Tree).collect()
    }

    /// The box of a part, and of a single leaf what it holds.
    fn bounds(&self, part: &Part) -> NodeRecord {
        match part {
            Part::Tree(of) => self.nodes[*of],
            Part::Leaves(run) if run.len() == 1 => self.nodes[self.leaves[run.start]],
            Part::Leaves(run) => {
                let nodes = self.leaves[run.clone()].iter().map(|&at| self.nodes[at]);
                let both = |of: fn(f32, f32) -> f32, a: [f32; 3], b: [f32; 3]| {
                    std::array::from_fn(|axis| of(a[axis], b[axis]))
                };
                let empty =
                    NodeRecord { low: [f32::MAX; 3], skip: 0, high: [f32::MIN; 3], leaf: 0 };
                nodes.fold(empty, |all, node| NodeRecord {
                    low: both(f32::min, all.low, node.low),
                    high: both(f32::max, all.high, node.high),
                    ..empty
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    /// Leaves that are reached, and how many children may wait at once.
    fn walk(wide: &WideBvh) -> (Vec<u32>, usize) {
        let (mut leaves, mut most) = (Vec::new(), 0);
        let mut open = vec![(ROOT, None, 0)];
        while let Some((at, parent, waiting)) = open.pop() {
            let children: Vec<_> = wide.nodes[at].iter().filter(|child| child.link != 0).collect();
            let waiting = waiting + children.len() - 1;
            most = most.max(waiting);
            for child in children {
                let inside = |of: &WideChild| {
                    (0..3).all(|k| child.low[k] >= of.low[k] && child.high[k] <= of.high[k])
                };
                assert!(parent.as_ref().is_none_or(inside), "{child:?} in {parent:?}");
                match child.link % 8 {
                    0 => open.push((child.link as usize / 8, Some(*child), waiting)),
                    _ => leaves.push(child.link),
                }
            }
        }
        leaves.sort_unstable();
        (leaves, most)
    }

    fn check(bvh: &Bvh) -> (usize, usize) {
        let wide = WideBvh::of(bvh);
        let mut expected: Vec<_> = bvh.nodes.iter().map(|node| node.leaf).collect();
        expected.retain(|&leaf| leaf != 0);
        expected.sort_unstable();
        let (leaves, waiting) = walk(&wide);
        assert_eq!(leaves, expected);
        assert!(waiting <= MOST_WAITING, "{waiting}");
        (wide.nodes.len(), waiting)
    }

    #[test]
    fn every_leaf_is_reached_once_within_its_boxes() {
        let (nodes, _) = check(&Bvh::of(&Scene::load("builtin:room").unwrap()));
        let leaves = Bvh::of(&Scene::load("builtin:room").unwrap()).quality().leaves;
        assert!(nodes < leaves * 6 / 10, "{nodes} nodes for {leaves} leaves are hardly filled");
        check(&Bvh::of(&Scene::load("builtin:cornell").unwrap()));
    }

    /// A chain: each inner node has a leaf and the rest.
    fn chain(leaves: u32) -> Bvh {
        let all = 2 * leaves - 1;
        let node = |at: u32| {
            let k = at.div_ceil(2) as f32;
            let is_leaf = at % 2 == 1 || at + 1 == all;
            let high = if is_leaf { k + 1.0 } else { leaves as f32 + 2.0 };
            let skip = if is_leaf { at + 1 } else { all };
            let leaf = if is_leaf { 8 * at + 1 } else { 0 };
            NodeRecord { low: [k, 0.0, 0.0], skip, high: [high, 1.0, 1.0], leaf }
        };
        Bvh { nodes: (0..all).map(node).collect(), triangles: Vec::new(), cutouts: None }
    }

    #[test]
    fn chains_are_split_before_too_many_children_wait() {
        for leaves in [1, 2, 3, 5, 64, 65, 1000, 50_000] {
            check(&chain(leaves));
        }
        assert!(check(&chain(50_000)).1 > MOST_WAITING / 2);
    }
}
