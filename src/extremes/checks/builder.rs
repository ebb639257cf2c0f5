//! Scenes of checks: given in tame units, then scaled and moved in f64.

use glam::{DVec3, dvec3};

use crate::error::SceneError;
use crate::scene::{Draft, DraftCamera, DraftMaterial, FovAxis, Origin, Scene};

/// A scene under construction.
#[derive(Debug)]
pub struct SceneBuilder {
    /// What there is so far.
    pub draft: Draft,
    scale: f64,
    offset: DVec3,
}

impl SceneBuilder {
    /// Of this scale, about this place.
    pub fn at(scale: f64, offset: DVec3) -> Self {
        Self { draft: Draft::new("check"), scale, offset }
    }

    fn place(&self, point: DVec3) -> DVec3 {
        point * self.scale + self.offset
    }

    /// A diffuse material that may emit.
    pub fn material(&mut self, albedo: [f64; 3], emission: [f64; 3]) -> Result<u32, SceneError> {
        self.draft.add_material(DraftMaterial {
            name: format!("material {}", self.draft.materials.len()),
            albedo: DVec3::from_array(albedo),
            emission: DVec3::from_array(emission),
            ..DraftMaterial::default()
        })
    }

    /// A quad, counter-clockwise from its front.
    pub fn quad(&mut self, material: u32, corners: [DVec3; 4]) {
        let [a, b, c, d] = corners.map(|corner| self.place(corner));
        self.draft.triangles.extend([([a, b, c], material), ([a, c, d], material)]);
    }

    /// An axis-aligned box whose normals point inwards or outwards.
    pub fn cuboid(&mut self, material: u32, low: DVec3, high: DVec3, inward: bool) {
        for axis in 0..3 {
            for side in 0..2 {
                let corner = |u: usize, v: usize| {
                    let mut point = [0.0; 3];
                    for (k, s) in [(axis, side), ((axis + 1) % 3, u), ((axis + 2) % 3, v)] {
                        point[k] = [low, high][s][k];
                    }
                    DVec3::from_array(point)
                };
                let mut face = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                if (side == 0) != inward {
                    face.reverse();
                }
                self.quad(material, face);
            }
        }
    }

    /// A point light; its intensity grows with the scene, so that irradiance stays.
    pub fn point_light(&mut self, position: DVec3, intensity: [f64; 3]) {
        let intensity = DVec3::from_array(intensity) * self.scale * self.scale;
        self.draft.point_lights.push((self.place(position), intensity));
    }

    /// The camera.
    pub fn camera(&mut self, position: DVec3, direction: DVec3, fov: f64, size: [u32; 2]) {
        let up = if direction.x == 0.0 && direction.y == 0.0 { DVec3::Y } else { DVec3::Z };
        let (position, fov_axis) = (self.place(position), FovAxis::Y);
        let origin = Origin::default();
        let camera = DraftCamera { position, direction, up, fov, fov_axis, size, origin };
        self.draft.camera = Some(camera);
    }

    /// All of it.
    pub fn scene(self) -> Result<Scene, SceneError> {
        self.draft.finish()
    }
}

/// The closed room [-1, 1]³ with a block in it, lit by a lamp under the ceiling that the camera
/// does not see and by a point light.
pub fn room(scale: f64, size: [u32; 2]) -> Result<SceneBuilder, SceneError> {
    let mut builder = SceneBuilder::at(scale, DVec3::ZERO);
    let wall = builder.material([0.7, 0.6, 0.5], [0.0; 3])?;
    let block = builder.material([0.2, 0.5, 0.8], [0.0; 3])?;
    let lamp = builder.material([0.5; 3], [9.0, 8.0, 7.0])?;
    builder.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
    builder.cuboid(block, dvec3(-0.3, 0.1, -1.0), dvec3(0.4, 0.7, 0.2), false);
    let corner = |x, y| dvec3(x, y, 0.875);
    let quad = [corner(-0.25, -0.25), corner(-0.25, 0.25), corner(0.25, 0.25), corner(0.25, -0.25)];
    builder.quad(lamp, quad);
    builder.point_light(dvec3(0.7, -0.6, 0.3), [0.4, 0.5, 0.6]);
    builder.camera(dvec3(-0.9, -0.8, 0.1), dvec3(0.7, 0.65, -0.3), 60.0, size);
    Ok(builder)
}
