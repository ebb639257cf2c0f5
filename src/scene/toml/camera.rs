//! The `[camera]` table.

use glam::DVec3;

use crate::scene::document::{Section, Value};
use crate::scene::{Camera, DraftCamera, FovAxis, SceneError};

const AXES: [(&str, FovAxis); 4] = [
    ("x", FovAxis::X),
    ("y", FovAxis::Y),
    ("smaller", FovAxis::Smaller),
    ("larger", FovAxis::Larger),
];

/// Reads the camera.
pub fn read(section: &Section) -> Result<DraftCamera, SceneError> {
    section.only(&["position", "target", "direction", "up", "fov", "fov_axis", "size"])?;
    let position = section.required("position")?.vector()?;
    let direction = match (section.get("target"), section.get("direction")) {
        (Some(target), None) => target.vector()? - position,
        (None, Some(direction)) => direction.vector()?,
        (Some(_), Some(_)) => return Err(section.fault("give target or direction, not both")),
        (None, None) => return Err(section.fault("key `target` or `direction` is missing")),
    };
    let fov = section.required("fov")?;
    let degrees = fov.number()?;
    if !(degrees > 0.0 && degrees < 180.0) {
        return Err(fov.fault("must lie between 0 and 180 degrees, both excluded"));
    }
    Ok(DraftCamera {
        position,
        direction,
        up: section.get("up").map_or(Ok(DVec3::Y), |up| up.vector())?,
        fov: degrees,
        fov_axis: section
            .get("fov_axis")
            .map_or(Ok(FovAxis::default()), |axis| axis.choice(&AXES))?,
        size: section.get("size").map_or(Ok([512, 512]), |value| size(&value))?,
        origin: section.origin(),
    })
}

fn size(value: &Value) -> Result<[u32; 2], SceneError> {
    let size: [f64; 2] = value.numbers()?;
    let possible = 1.0..=f64::from(Camera::MAX_EXTENT);
    if size.iter().any(|extent| !possible.contains(extent) || extent.fract() != 0.0) {
        return Err(value.fault("must be two whole numbers of pixels from 1 to 65536"));
    }
    Ok(size.map(|extent| extent as u32))
}
