//! What rays hit: triangles and spheres, perhaps with holes. The twin of `shaders/trace/shape_any.wgsl`
//! and `shaders/trace/opaque_cutout.wgsl`.

use glam::{Vec2, Vec3};

use super::Ray;
use crate::gpu::TriangleRecord;
use crate::scene::{Scene, Sphere, Texels, Texture, Triangle, texture};

/// Distance along a ray, and barycentric weights of a triangle's corners or the unit normal of a
/// sphere.
pub type Meeting = (f32, [f32; 3]);

impl TriangleRecord {
    /// A triangle, the `index`th shape of the scene.
    pub(super) fn of_triangle(triangle: &Triangle, index: u32, cutout: u32) -> Self {
        let [a, b, c] = triangle.vertices.map(|vertex| vertex.to_array());
        Self { a, material: triangle.material, b, index, c, kind: cutout }
    }

    /// A sphere, the `index`th shape of the scene.
    pub(super) fn of_sphere(sphere: &Sphere, index: u32, kind: u32) -> Self {
        let (a, b) = (sphere.center.to_array(), [sphere.radius, 0.0, 0.0]);
        Self { a, material: sphere.material, b, index, c: [0.0; 3], kind: Self::SPHERE | kind }
    }

    /// Where a ray meets the shape.
    pub(super) fn meet(&self, ray: &Ray) -> Option<Meeting> {
        let [a, b, c] = [self.a, self.b, self.c].map(Vec3::from_array);
        match self.kind & Self::SPHERE {
            0 => meet_triangle(ray, [a, b, c]),
            _ => meet_sphere(ray, a, b.x, self.kind & Self::FAR != 0),
        }
    }
}

/// The rounding of the volume that a ray spans with an edge, over the largest coordinates of the
/// edge and of the corners and the sum of the direction's: a product of two vectors has 2 terms of
/// an edge and twice a corner, and 7 half ulps are lost on the way to the sum.
const VOLUME_ROUNDING: f32 = 1.7e-6;
/// A triangle that a ray meets by that slack alone comes after one at the same place that it meets.
pub(super) const BEYOND: f32 = 1.000_01;

/// From the volumes that the ray spans with the edges. An edge gives exactly opposite volumes to
/// its two triangles, so that no ray slips between them (Woop, Benthin and Wald, "Watertight
/// Ray/Triangle Intersection", JCGT 2013; the form is that of Plücker coordinates, relative to the
/// ray's origin). At a vertex the volumes of all its edges are mere rounding, and any signs: what
/// may be 0 counts as either. But not from the triangle's own plane, or as near to it as an edge may be
/// off: along it all volumes are mere rounding, however far from the ray, or behind it, the triangle
/// is.
fn meet_triangle(ray: &Ray, corners: [Vec3; 3]) -> Option<Meeting> {
    let [a, b, c] = corners.map(|corner| corner - ray.origin);
    let d = ray.direction;
    let u = (c - b).cross(c + b).dot(d);
    let v = (a - c).cross(a + c).dot(d);
    let w = (b - a).cross(b + a).dot(d);
    let edges = (c - b).abs().max((a - c).abs()).max((b - a).abs()).max_element();
    let corners = a.abs().max(b.abs()).max(c.abs()).max_element();
    let slack = VOLUME_ROUNDING * edges * corners;
    let off = slack * d.abs().element_sum();
    if u.min(v).min(w) < -off && u.max(v).max(w) > off {
        return None;
    }
    let normal = (b - a).cross(c - a);
    let (height, speed) = (normal.dot(a), normal.dot(d));
    let strict = u.min(v).min(w) >= 0.0 || u.max(v).max(w) <= 0.0;
    if !strict && height.abs() <= slack * edges {
        return None;
    }
    let t = if strict { height / speed } else { height / speed * BEYOND };
    let side = if u + v + w >= 0.0 { 1.0 } else { -1.0 };
    let [u, v, w] = [u, v, w].map(|volume| (side * volume).max(0.0));
    let sum = u + v + w;
    (speed != 0.0 && sum > 0.0 && t > 0.0).then(|| (t, [u / sum, v / sum, w / sum]))
}

/// Haines, Günther and Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray
/// Tracing Gems, 2019: the discriminant from the ray's nearest point to the centre, and no
/// difference of near numbers in the distance.
fn meet_sphere(ray: &Ray, center: Vec3, radius: f32, far: bool) -> Option<Meeting> {
    let (center, direction) = (center - ray.origin, ray.direction);
    let square = direction.dot(direction);
    let along = center.dot(direction);
    let nearest = direction * (along / square) - center;
    let rest = radius * radius - nearest.dot(nearest);
    let outside = center.dot(center) - radius * radius;
    let root = (square * rest).max(0.0).sqrt();
    let q = along + if along < 0.0 { -root } else { root };
    // One distance is q / square, the other outside / q.
    let enters = outside > 0.0 && !far;
    let t = if enters || along < 0.0 { outside / q } else { q / square };
    let normal = nearest + direction * (if enters { -root } else { root } / square);
    let met = square > 0.0 && rest >= 0.0 && q != 0.0 && t > 0.0;
    met.then(|| (t, normal.normalize().to_array()))
}

/// What cuts holes into the shapes of a scene.
#[derive(Debug, Clone)]
pub struct Cutouts {
    uvs: Vec<[Vec2; 3]>,
    textures: Vec<Texture>,
    images: Vec<Texels>,
}

impl Cutouts {
    /// Those of a scene, if it has any.
    pub fn of(scene: &Scene) -> Option<Self> {
        let used = |image: u32| {
            let mut cutouts = scene.materials.iter().filter_map(|material| material.cutout);
            cutouts.any(|cutout| scene.textures[cutout as usize].image == image)
        };
        scene.materials.iter().any(|material| material.cutout.is_some()).then(|| Self {
            uvs: scene.uvs.clone(),
            textures: scene.textures.clone(),
            // Images that cut nothing out are not looked at.
            images: (0..)
                .zip(&scene.images)
                .map(|(index, image)| match used(index) {
                    true => image.clone(),
                    false => Texels::magenta(""),
                })
                .collect(),
        })
    }

    /// Whether there is a surface at the place where a ray meets a shape.
    pub fn opaque(&self, record: &TriangleRecord, weights: [f32; 3]) -> bool {
        let Some(cutout) = (record.kind & TriangleRecord::CUTOUT).checked_sub(1) else {
            return true;
        };
        let uv = match record.kind & TriangleRecord::SPHERE {
            0 => texture::on_triangle(self.uvs[record.index as usize], weights),
            _ => texture::on_sphere(Vec3::from_array(weights)),
        };
        self.textures[cutout as usize].sample(&self.images, uv).w >= 0.5
    }
}
