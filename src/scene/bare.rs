//! A mesh without a scene file: what it lacks of a camera and of light is added, so that it is seen from
//! three quarters above, where planes and terrain show, and lit from the camera.

use std::f64::consts::PI;
use std::path::Path;

use glam::DVec3;

use super::{Draft, DraftCamera, DraftMaterial, FovAxis, Origin, Scene, SceneError, Warning};

/// The full angle of view, in degrees.
const FOV: f64 = 45.0;

/// From the middle of the mesh to the camera: 30° to the right of its front, which is +Z, and 30° up.
const SIDE: DVec3 = DVec3::new(0.433_012_701_892_219_3, 0.5, 0.75);

/// The size of the image, in pixels, of a file that gives none.
pub const SIZE: [u32; 2] = [512, 512];

/// Surfaces that emit so much, spread over all surfaces, light a mesh: radiance of a white one.
const LEAST_GLOW: f64 = 0.05;

/// Adds a camera and a light where there is none, and finishes the scene.
pub fn finish(mut draft: Draft, path: &Path) -> Result<Scene, SceneError> {
    let bounds = Bounds::of(&draft);
    let camera = draft.camera.get_or_insert_with(|| bounds.frame(path));
    let position = camera.position;
    if !has_lights(&draft) {
        let glow = glow(&draft);
        if glow < LEAST_GLOW {
            // A white surface that faces it from the nearest place has radiance 1. A camera of the file's
            // may be in the midst of the mesh.
            let nearest = position.distance(position.clamp(bounds.low, bounds.high));
            let distance = if nearest > 0.0 { nearest } else { bounds.radius() };
            draft.point_lights.push((position, DVec3::splat(PI * distance * distance)));
            let why = match glow > 0.0 {
                true => "no light but surfaces that glow a little",
                false => "no light",
            };
            draft.warnings.push(Warning::note(format!(
                "{}: {why}; a point light at the camera lights it",
                path.display()
            )));
        }
    }
    draft.finish()
}

/// Opposite corners of what holds all triangles.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    low: DVec3,
    high: DVec3,
}

impl Bounds {
    fn of(draft: &Draft) -> Self {
        let corners = || draft.triangles.iter().flat_map(|(corners, _)| corners);
        let low = corners().fold(DVec3::INFINITY, |low, &corner| low.min(corner));
        let high = corners().fold(DVec3::NEG_INFINITY, |high, &corner| high.max(corner));
        Self { low, high }
    }

    fn center(&self) -> DVec3 {
        0.5 * (self.low + self.high)
    }

    fn radius(&self) -> f64 {
        0.5 * self.low.distance(self.high)
    }

    /// A camera that has the whole sphere around it in view.
    fn frame(&self, path: &Path) -> DraftCamera {
        let distance = self.radius() / (FOV.to_radians() / 2.0).sin();
        DraftCamera {
            position: self.center() + distance * SIDE,
            direction: -SIDE,
            up: DVec3::Y,
            fov: FOV,
            fov_axis: FovAxis::Y,
            size: SIZE,
            origin: Origin::file(path),
        }
    }
}

/// Whether there is a light beside surfaces that emit.
fn has_lights(draft: &Draft) -> bool {
    let shines = |(_, power): &(DVec3, DVec3)| power.max_element() > 0.0;
    draft.point_lights.iter().any(shines)
        || draft.spot_lights.iter().any(|spot| spot.intensity.max_element() > 0.0)
        || draft.directional_lights.iter().any(shines)
}

/// The mean over all surfaces of what they emit: radiance in the strongest channel. Were all of it spread
/// evenly over a closed room, white walls would reflect as much.
fn glow(draft: &Draft) -> f64 {
    let emission: Vec<f64> =
        draft.materials.iter().map(|material| mean_emission(draft, material)).collect();
    let area = |[a, b, c]: &[DVec3; 3]| 0.5 * (*b - *a).cross(*c - *a).length();
    let (mut emitted, mut all) = (0.0, 0.0);
    for (corners, material) in &draft.triangles {
        let sides = if draft.materials[*material as usize].two_sided { 2.0 } else { 1.0 };
        emitted += sides * area(corners) * emission[*material as usize];
        all += area(corners);
    }
    if all > 0.0 { emitted / all } else { 0.0 }
}

/// That of a material, its texture by its mean.
fn mean_emission(draft: &Draft, material: &DraftMaterial) -> f64 {
    let emission = material.emission;
    let Some(texture) = material.emission_texture.filter(|_| emission != DVec3::ZERO) else {
        return emission.max_element();
    };
    let image = &draft.images[draft.textures[texture as usize].image as usize];
    (emission * image.mean()).max_element()
}
