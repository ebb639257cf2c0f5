//! The host's traversal: the twin of `shaders/trace/traverse.wgsl`, line by line.

use glam::Vec3;

use super::shape::BEYOND;
use super::{Bvh, Hit, Ray};
use crate::gpu::TriangleRecord;

/// Finite stand-in for the reciprocal of a direction's zero component.
const HUGE: f32 = 1e30;
/// 1 + 2 γ(3): widens the far side of a slab by the rounding of its distances (Ize, "Robust
/// BVH Ray Traversal", JCGT 2013).
const WIDEN: f32 = 1.000_000_4;

impl Bvh {
    /// The nearest hit; among equally near ones that of the lowest shape.
    pub fn closest(&self, ray: &Ray) -> Option<Hit> {
        self.traverse(ray, false)
    }

    /// Whether anything is hit.
    pub fn occluded(&self, ray: &Ray) -> bool {
        self.traverse(ray, true).is_some()
    }

    fn traverse(&self, ray: &Ray, any: bool) -> Option<Hit> {
        let reciprocal = ray.direction.to_array().map(reciprocal);
        let reciprocal = Vec3::from_array(reciprocal);
        let mut best: Option<Hit> = None;
        let mut limit = ray.limit;
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            let t0 = (Vec3::from_array(node.low) - ray.origin) * reciprocal;
            let t1 = (Vec3::from_array(node.high) - ray.origin) * reciprocal;
            let near = t0.min(t1).max_element().max(0.0);
            let far = t0.max(t1).min_element() * WIDEN;
            // What is as near may be in a box that by rounding begins behind it.
            if near > far.min(limit * BEYOND) {
                at = node.skip as usize;
                continue;
            }
            let first = (node.leaf / 8) as usize;
            for record in &self.triangles[first..first + (node.leaf % 8) as usize] {
                let Some((t, weights)) = record.meet(ray) else { continue };
                let nearer =
                    t < limit || best.is_some_and(|hit| t == limit && record.index < hit.shape);
                if nearer && self.opaque(record, weights) {
                    limit = t;
                    let (shape, material) = (record.index, record.material);
                    best = Some(Hit { t, shape, material, weights });
                    if any {
                        return best;
                    }
                }
            }
            at += 1;
        }
        best
    }

    fn opaque(&self, record: &TriangleRecord, weights: [f32; 3]) -> bool {
        self.cutouts.as_ref().is_none_or(|cutouts| cutouts.opaque(record, weights))
    }
}

fn reciprocal(x: f32) -> f32 {
    if x.abs() > 1.0 / HUGE { 1.0 / x } else { HUGE.copysign(x) }
}
