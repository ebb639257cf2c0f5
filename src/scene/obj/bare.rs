//! A mesh without a scene file: framed from the front, lit from the camera if it does not
//! emit.

use std::collections::HashMap;
use std::f64::consts::PI;
use std::path::Path;

use glam::DVec3;

use crate::error::SceneError;
use crate::scene::{Draft, DraftCamera, FovAxis, Origin, Scene, Warning};

/// The full angle of view, in degrees.
const FOV: f64 = 45.0;

/// Loads a mesh without a scene file: framed automatically.
pub fn load(path: &Path) -> Result<Scene, SceneError> {
    let mut draft = Draft::new(path.display().to_string());
    super::read(path)?.add_to(&mut draft, &HashMap::new(), |corners| corners)?;
    let (center, radius) = bounding_sphere(&draft);
    let distance = radius / (FOV.to_radians() / 2.0).sin();
    let position = center + distance * DVec3::Z;
    draft.camera = Some(DraftCamera {
        position,
        direction: -DVec3::Z,
        up: DVec3::Y,
        fov: FOV,
        fov_axis: FovAxis::Y,
        size: [512, 512],
        origin: Origin::file(path),
    });
    let emits =
        |&(_, material): &(_, u32)| draft.materials[material as usize].emission.max_element() > 0.0;
    if !draft.triangles.iter().any(emits) {
        // Irradiance π at the centre: a white surface there has radiance 1.
        draft.point_lights.push((position, DVec3::splat(PI * distance * distance)));
        draft.warnings.push(Warning::note(format!(
            "{}: no light; a point light at the camera lights it",
            path.display()
        )));
    }
    draft.finish()
}

/// The centre of the bounds, and the distance of the farthest corner from it.
fn bounding_sphere(draft: &Draft) -> (DVec3, f64) {
    let corners = || draft.triangles.iter().flat_map(|(corners, _)| corners);
    let low = corners().fold(DVec3::INFINITY, |low, &corner| low.min(corner));
    let high = corners().fold(DVec3::NEG_INFINITY, |high, &corner| high.max(corner));
    let center = 0.5 * (low + high);
    (center, corners().map(|corner| corner.distance(center)).fold(0.0, f64::max))
}
