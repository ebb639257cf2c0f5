//! What a ray on the host has hit, and where others start there: the twin of
//! `shaders/trace/hit_point.wgsl` and `shaders/trace/ray_offset.wgsl`.

use glam::Vec3;

use crate::bvh::{Hit, Ray};
use crate::sampling::SURFACE_OFFSET;
use crate::scene::{Scene, texture};

/// As in `shaders/trace/ray_offset.wgsl`.
const MOST_ALONG: f32 = 1000.0;
const MOST_OF_RAY: f32 = 0.5;
const BEHIND: f32 = 0.25;

/// A place and the way that a surface faces there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facet {
    /// Where it is.
    pub position: Vec3,
    /// Unit geometric normal of the side that is lit.
    pub normal: Vec3,
}

/// A place on a surface, on the side from which a ray came.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Where it is.
    position: Vec3,
    /// From there to the start of rays: off the surface, on the ray that found it, so that nothing is
    /// between, however close a wall comes to its foot.
    back: Vec3,
    /// The same for rays that went through.
    through: Vec3,
    /// Unit geometric normal of that side.
    pub normal: Vec3,
    /// Whether that side is the front.
    pub front: bool,
    /// Diffuse reflectance there.
    pub albedo: Vec3,
    /// Index of the material.
    pub material: u32,
}

impl Surface {
    /// What a ray of this unit direction has hit.
    pub fn of(scene: &Scene, hit: &Hit, direction: Vec3) -> Self {
        let (position, normal) = place(scene, hit);
        let facing = normal.dot(direction);
        let front = facing <= 0.0;
        let normal = if front { normal } else { -normal };
        let along = direction.reject_from_normalized(normal);
        let back = SURFACE_OFFSET / facing.abs().max(1.0 / MOST_ALONG);
        let material = &scene.materials[hit.material as usize];
        let texture = textured(scene, material.texture, hit);
        Self {
            position,
            back: SURFACE_OFFSET * normal - back.min(MOST_OF_RAY * hit.t) * along,
            through: -SURFACE_OFFSET * (normal + BEHIND * along),
            normal,
            front,
            albedo: material.albedo * texture * vertex_color(scene, hit),
            material: hit.material,
        }
    }

    /// Where a VPL is put: from there, rays start straight above.
    pub fn vpl_position(&self) -> Vec3 {
        self.position + (self.back - SURFACE_OFFSET * self.normal)
    }

    /// Where a VPL is put, and the way that the surface faces there.
    pub fn facet(&self) -> Facet {
        Facet { position: self.vpl_position(), normal: self.normal }
    }

    /// A ray that stays on this side.
    pub fn spawn_ray(&self, direction: Vec3) -> Ray {
        Ray { origin: self.position + self.back, direction, limit: f32::MAX }
    }

    /// A ray that goes on behind.
    pub fn spawn_transmitted_ray(&self, direction: Vec3) -> Ray {
        Ray { origin: self.position + self.through, direction, limit: f32::MAX }
    }
}

/// Where a hit is, and the unit normal of the front.
fn place(scene: &Scene, hit: &Hit) -> (Vec3, Vec3) {
    match scene.triangles.get(hit.shape as usize) {
        Some(triangle) => {
            let [a, b, c] = triangle.vertices;
            let position = a * hit.weights[0] + b * hit.weights[1] + c * hit.weights[2];
            (position, triangle.scaled_normal().normalize())
        }
        None => {
            let sphere = &scene.spheres[hit.shape as usize - scene.triangles.len()];
            let normal = Vec3::from_array(hit.weights);
            (sphere.center + sphere.radius * normal, normal)
        }
    }
}

/// What the colours of corners multiply by where a ray has hit. The twin of
/// `shaders/materials/vertex_color.wgsl`.
fn vertex_color(scene: &Scene, hit: &Hit) -> Vec3 {
    let Some([a, b, c]) = scene.colors.get(hit.shape as usize) else { return Vec3::ONE };
    let color = *a + (*b - *a) * hit.weights[1] + (*c - *a) * hit.weights[2];
    color.clamp(Vec3::ZERO, Vec3::ONE)
}

/// What a texture multiplies by where a ray has hit.
fn textured(scene: &Scene, used: Option<u32>, hit: &Hit) -> Vec3 {
    let Some(used) = used else { return Vec3::ONE };
    let uv = match scene.uvs.get(hit.shape as usize) {
        Some(corners) => texture::on_triangle(*corners, hit.weights),
        None => texture::on_sphere(Vec3::from_array(hit.weights)),
    };
    scene.textures[used as usize].sample(&scene.images, uv).truncate()
}

/// What the radiance of an emitting triangle is multiplied by at a place. The twin of
/// `shaders/lights/light_scale_textured.wgsl`.
pub fn light_emission_scale(scene: &Scene, triangle: u32, weights: [f32; 3]) -> Vec3 {
    let material = &scene.materials[scene.triangles[triangle as usize].material as usize];
    let uv = || texture::on_triangle(scene.uvs[triangle as usize], weights);
    let sample = |used: u32| scene.textures[used as usize].sample(&scene.images, uv());
    if material.cutout.is_some_and(|cutout| sample(cutout).w < 0.5) {
        return Vec3::ZERO;
    }
    material.emission_texture.map_or(Vec3::ONE, |used| sample(used).truncate())
}
