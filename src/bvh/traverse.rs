//! The host's traversal: the twin of `shaders/traverse.wgsl`, line by line.

use glam::Vec3;

use super::Bvh;

/// A ray or segment; `direction` need not be of unit length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3,
    /// Where it goes.
    pub direction: Vec3,
    /// Hits are sought at 0 < t < limit, in lengths of `direction`.
    pub limit: f32,
}

/// Where a ray meets a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Distance in lengths of the ray's direction.
    pub t: f32,
    /// Index of the triangle in the scene.
    pub triangle: u32,
    /// Index of its material.
    pub material: u32,
    /// Barycentric weights of the corners.
    pub weights: [f32; 3],
}

/// Finite stand-in for the reciprocal of a direction's zero component.
const HUGE: f32 = 1e30;
/// 1 + 2 γ(3): widens the far side of a slab by the rounding of its distances (Ize, "Robust
/// BVH Ray Traversal", JCGT 2013).
const WIDEN: f32 = 1.000_000_4;

impl Bvh {
    /// The nearest hit; among equally near ones that of the lowest triangle.
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
            if near > far.min(limit) {
                at = node.skip as usize;
                continue;
            }
            let first = (node.leaf / 8) as usize;
            for record in &self.triangles[first..first + (node.leaf % 8) as usize] {
                let corners = [record.a, record.b, record.c].map(Vec3::from_array);
                let Some((t, weights)) = intersect(ray, corners) else { continue };
                let nearer =
                    t < limit || best.is_some_and(|hit| t == limit && record.index < hit.triangle);
                if nearer {
                    limit = t;
                    let (triangle, material) = (record.index, record.material);
                    best = Some(Hit { t, triangle, material, weights });
                    if any {
                        return best;
                    }
                }
            }
            at += 1;
        }
        best
    }
}

fn reciprocal(x: f32) -> f32 {
    if x.abs() > 1.0 / HUGE { 1.0 / x } else { HUGE.copysign(x) }
}

/// Distance and barycentric weights of a hit, from the volumes that the ray spans with the
/// edges. An edge gives exactly opposite volumes to its two triangles, so that no ray slips
/// between them (Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2013;
/// the form is that of Plücker coordinates, relative to the ray's origin).
fn intersect(ray: &Ray, corners: [Vec3; 3]) -> Option<(f32, [f32; 3])> {
    let [a, b, c] = corners.map(|corner| corner - ray.origin);
    let d = ray.direction;
    let u = (c - b).cross(c + b).dot(d);
    let v = (a - c).cross(a + c).dot(d);
    let w = (b - a).cross(b + a).dot(d);
    if u.min(v).min(w) < 0.0 && u.max(v).max(w) > 0.0 {
        return None;
    }
    let normal = (b - a).cross(c - a);
    let (height, speed) = (normal.dot(a), normal.dot(d));
    let t = height / speed;
    let sum = u + v + w;
    (speed != 0.0 && sum != 0.0 && t > 0.0).then(|| (t, [u / sum, v / sum, w / sum]))
}
