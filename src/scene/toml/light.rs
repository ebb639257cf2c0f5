//! The `[[light]]` tables.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};

use super::mesh::rotation;
use crate::scene::document::{Section, Value};
use crate::scene::{
    Draft, DraftMaterial, DraftSphere, DraftSpot, Environment, SceneError, environment, normalise,
    polygon,
};

/// Sides of the regular polygon that stands for a disk.
const DISK_SIDES: usize = 64;

/// What a light holds beside its type, and what reads it.
type Kind = (&'static [&'static str], fn(&Section, usize, &mut Draft) -> Result<(), SceneError>);

const KINDS: [(&str, Kind); 7] = [
    ("point", (&["position", "intensity"], point)),
    ("spot", (&["position", "target", "intensity", "angle", "softness"], spot)),
    ("directional", (&["direction", "irradiance"], directional)),
    ("quad", (&["corners", "radiance", "two_sided"], quad)),
    ("disk", (&["center", "normal", "radius", "radiance", "two_sided"], disk)),
    ("sphere", (&["center", "radius", "radiance", "two_sided"], sphere)),
    ("environment", (&["radiance", "texture", "rotate", "scale"], environment)),
];

/// Reads a light, the `number`th of the file.
pub fn read(section: &Section, number: usize, draft: &mut Draft) -> Result<(), SceneError> {
    let kind = section.required("type")?;
    let (keys, read) = kind.choice(&KINDS)?;
    let name = format!("[[light]] of type {:?}", kind.string()?);
    read(&section.only_as(name, &[&["type"], keys].concat())?, number, draft)
}

fn point(section: &Section, _: usize, draft: &mut Draft) -> Result<(), SceneError> {
    let position = section.required("position")?.vector()?;
    draft.point_lights.push((position, section.required("intensity")?.power()?));
    Ok(())
}

/// `angle` is that of the whole cone; over the share `softness` of its half, light fades.
fn spot(section: &Section, _: usize, draft: &mut Draft) -> Result<(), SceneError> {
    let position = section.required("position")?.vector()?;
    let target = section.required("target")?;
    let direction = target.vector()? - position;
    if direction.try_normalize().is_none() {
        return Err(target.fault("must be apart from `position`"));
    }
    let angle = section.required("angle")?;
    let half = 0.5 * angle.number()?;
    if !(half > 0.0 && half <= 180.0) {
        return Err(angle.fault("must be greater than 0, and at most 360 degrees"));
    }
    let softness = match section.get("softness") {
        None => 0.0,
        Some(value) => match value.number()? {
            softness if (0.0..=1.0).contains(&softness) => softness,
            _ => return Err(value.fault("must lie within 0 and 1")),
        },
    };
    let intensity = section.required("intensity")?.power()?;
    let angles = [half * (1.0 - softness), half];
    draft.spot_lights.push(DraftSpot { position, direction, intensity, angles });
    Ok(())
}

fn directional(section: &Section, _: usize, draft: &mut Draft) -> Result<(), SceneError> {
    let direction = direction(section, "direction")?;
    draft.directional_lights.push((direction, section.required("irradiance")?.power()?));
    Ok(())
}

fn sphere(section: &Section, number: usize, draft: &mut Draft) -> Result<(), SceneError> {
    let center = section.required("center")?.vector()?;
    let radius = section.required("radius")?.length()?;
    let material = material(section, number, draft)?;
    draft.spheres.push(DraftSphere { center, radius, material });
    Ok(())
}

fn environment(section: &Section, _: usize, draft: &mut Draft) -> Result<(), SceneError> {
    if draft.environment.is_some() {
        return Err(section.fault("a second environment; a scene has one, add their radiances"));
    }
    let radiance = section.get("radiance").map(|radiance| radiance.power()).transpose()?;
    let scale = section.get("scale").map_or(Ok(1.0), |scale| scale.length())?;
    let radiance = radiance.map(|radiance| scale * radiance);
    let turn = section.get("rotate").map_or(Ok(DQuat::IDENTITY), |value| turn(&value))?;
    let Some(texture) = section.get("texture") else {
        let radiance =
            radiance.ok_or_else(|| section.fault("key `radiance` or `texture` is missing"))?;
        draft.environment = Some(Environment { radiance: normalise::round(radiance), image: None });
        return Ok(());
    };
    let origin = texture.origin();
    let path = texture.path(&mut draft.warnings)?;
    let radiance = radiance.unwrap_or(DVec3::splat(scale));
    let (read, warnings) = environment::read(&path, radiance, turn, &origin);
    draft.environment = Some(read);
    draft.warnings.extend(warnings);
    Ok(())
}

/// A direction other than 0.
fn direction(section: &Section, key: &str) -> Result<DVec3, SceneError> {
    let value = section.required(key)?;
    value.vector()?.try_normalize().ok_or_else(|| value.fault("must not be 0"))
}

/// How surroundings are turned: by degrees about up, or about X, then Y, then Z.
fn turn(value: &Value) -> Result<DQuat, SceneError> {
    match value.is_array() {
        true => rotation(value),
        false => Ok(DQuat::from_rotation_y(value.number()?.to_radians())),
    }
}

/// Adds the black material of an area light.
fn material(section: &Section, number: usize, draft: &mut Draft) -> Result<u32, SceneError> {
    draft.add_material(DraftMaterial {
        name: format!("light {number}"),
        albedo: DVec3::ZERO,
        emission: section.required("radiance")?.power()?,
        two_sided: section.get("two_sided").map_or(Ok(false), |value| value.boolean())?,
        origin: section.origin(),
        ..DraftMaterial::default()
    })
}

/// Two triangles, wound as the corners are.
fn quad(section: &Section, number: usize, draft: &mut Draft) -> Result<(), SceneError> {
    let value = section.required("corners")?;
    let corners: [DVec3; 4] = value.vectors()?;
    let cut = polygon::triangulate(&corners);
    let triangles: Vec<_> = cut.triangles.iter().map(|t| t.map(|i| corners[i])).collect();
    let has_area = |[a, b, c]: &[DVec3; 3]| (b - a).cross(c - a) != DVec3::ZERO;
    if !cut.exact || !triangles.iter().any(has_area) {
        return Err(value.fault("must go around an area, counter-clockwise seen from its front"));
    }
    let material = material(section, number, draft)?;
    draft.triangles.extend(triangles.into_iter().map(|corners| (corners, material)));
    Ok(())
}

/// A regular polygon of the disk's area, so that its power is exact: its circumradius is
/// r √((2π/n) / sin(2π/n)).
fn disk(section: &Section, number: usize, draft: &mut Draft) -> Result<(), SceneError> {
    let center = section.required("center")?.vector()?;
    let axis = direction(section, "normal")?;
    let radius = section.required("radius")?.length()?;
    let step = TAU / DISK_SIDES as f64;
    let circumradius = radius * (step / step.sin()).sqrt();
    let (x, y) = axis.any_orthonormal_pair();
    let corner = |i: usize| {
        let (sin, cos) = (step * (i % DISK_SIDES) as f64).sin_cos();
        center + circumradius * (cos * x + sin * y)
    };
    let material = material(section, number, draft)?;
    let triangles = (0..DISK_SIDES).map(|i| [center, corner(i), corner(i + 1)]);
    draft.triangles.extend(triangles.map(|corners| (corners, material)));
    Ok(())
}
