//! A mesh without a scene file: what it lacks of a camera and of light is added, so that it
//! is framed from the front, and lit from the camera.

use std::f64::consts::PI;
use std::path::Path;

use glam::DVec3;

use super::{Draft, DraftCamera, FovAxis, Origin, Scene, SceneError, Warning};

/// The full angle of view, in degrees.
const FOV: f64 = 45.0;

/// The size of the image, in pixels, of a file that gives none.
pub const SIZE: [u32; 2] = [512, 512];

/// Adds a camera and a light where there is none, and bsdfs the scene.
pub fn finish(mut draft: Draft, path: &Path) -> Result<Scene, SceneError> {
    let (center, radius) = bounding_sphere(&draft);
    let camera = draft.camera.get_or_insert_with(|| frame(center, radius, path));
    let position = camera.position;
    if !is_lit(&draft) {
        // Irradiance π at the centre: a white surface there has radiance 1. A camera of the
        // file's may be nearer than the mesh is large.
        let distance = position.distance(center).max(radius);
        draft.point_lights.push((position, DVec3::splat(PI * distance * distance)));
        draft.warnings.push(Warning::note(format!(
            "{}: no light; a point light at the camera lights it",
            path.display()
        )));
    }
    draft.finish()
}

/// A camera that looks along -Z and has the whole sphere in view.
fn frame(center: DVec3, radius: f64, path: &Path) -> DraftCamera {
    let distance = radius / (FOV.to_radians() / 2.0).sin();
    DraftCamera {
        position: center + distance * DVec3::Z,
        direction: -DVec3::Z,
        up: DVec3::Y,
        fov: FOV,
        fov_axis: FovAxis::Y,
        size: SIZE,
        origin: Origin::file(path),
    }
}

fn is_lit(draft: &Draft) -> bool {
    let emits =
        |&(_, material): &(_, u32)| draft.materials[material as usize].emission.max_element() > 0.0;
    let shines = |(_, power): &(DVec3, DVec3)| power.max_element() > 0.0;
    draft.triangles.iter().any(emits)
        || draft.point_lights.iter().any(shines)
        || draft.spot_lights.iter().any(|spot| spot.intensity.max_element() > 0.0)
        || draft.directional_lights.iter().any(shines)
}

/// The centre of the bounds, and the distance of the farthest corner from it.
fn bounding_sphere(draft: &Draft) -> (DVec3, f64) {
    let corners = || draft.triangles.iter().flat_map(|(corners, _)| corners);
    let low = corners().fold(DVec3::INFINITY, |low, &corner| low.min(corner));
    let high = corners().fold(DVec3::NEG_INFINITY, |high, &corner| high.max(corner));
    let center = 0.5 * (low + high);
    (center, corners().map(|corner| corner.distance(center)).fold(0.0, f64::max))
}
