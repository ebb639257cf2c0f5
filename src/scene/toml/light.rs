//! The `[[light]]` tables.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::error::SceneError;
use crate::scene::document::{Section, Value};
use crate::scene::{Draft, DraftMaterial, polygon};

/// Sides of the regular polygon that stands for a disk.
const DISK_SIDES: usize = 64;

#[derive(Clone, Copy)]
enum Kind {
    Point,
    Quad,
    Disk,
    NotYet,
}

const KINDS: [(&str, Kind); 7] = [
    ("point", Kind::Point),
    ("quad", Kind::Quad),
    ("disk", Kind::Disk),
    ("spot", Kind::NotYet),
    ("directional", Kind::NotYet),
    ("sphere", Kind::NotYet),
    ("environment", Kind::NotYet),
];

/// Reads a light, the `number`th of the file.
pub fn read(section: &Section, number: usize, draft: &mut Draft) -> Result<(), SceneError> {
    let kind = section.required("type")?;
    let named = |keys: &[&str]| {
        let name = format!("[[light]] of type {:?}", kind.string()?);
        section.only_as(name, keys)
    };
    match kind.choice(&KINDS)? {
        Kind::Point => {
            let section = named(&["type", "position", "intensity"])?;
            let position = section.required("position")?.vector()?;
            draft.point_lights.push((position, section.required("intensity")?.power()?));
            Ok(())
        }
        Kind::Quad => {
            let section = named(&["type", "corners", "radiance", "two_sided"])?;
            let corners = section.required("corners")?;
            let triangles = quad(&corners)?;
            add(&section, number, triangles, draft)
        }
        Kind::Disk => {
            let section = named(&["type", "center", "normal", "radius", "radiance", "two_sided"])?;
            let triangles = disk(&section)?;
            add(&section, number, triangles, draft)
        }
        Kind::NotYet => {
            let what = format!("{:?} is not supported yet", kind.string()?);
            Err(kind.fault(&(what + "; use a point, quad or disk light")))
        }
    }
}

/// Adds the triangles of an area light under a black material of their own.
fn add(
    section: &Section,
    number: usize,
    triangles: Vec<[DVec3; 3]>,
    draft: &mut Draft,
) -> Result<(), SceneError> {
    let material = draft.add_material(DraftMaterial {
        name: format!("light {number}"),
        albedo: DVec3::ZERO,
        emission: section.required("radiance")?.power()?,
        two_sided: section.get("two_sided").map_or(Ok(false), |value| value.boolean())?,
        origin: section.origin(),
        ..DraftMaterial::default()
    })?;
    draft.triangles.extend(triangles.into_iter().map(|corners| (corners, material)));
    Ok(())
}

/// Two triangles, wound as the corners are.
fn quad(value: &Value) -> Result<Vec<[DVec3; 3]>, SceneError> {
    let corners: [DVec3; 4] = value.vectors()?;
    let cut = polygon::triangulate(&corners);
    let triangles: Vec<_> = cut.triangles.iter().map(|t| t.map(|i| corners[i])).collect();
    let has_area = |[a, b, c]: &[DVec3; 3]| (b - a).cross(c - a) != DVec3::ZERO;
    if !cut.exact || !triangles.iter().any(has_area) {
        return Err(value.fault("must go around an area, counter-clockwise seen from its front"));
    }
    Ok(triangles)
}

/// A regular polygon of the disk's area, so that its power is exact: its circumradius is
/// r √((2π/n) / sin(2π/n)).
fn disk(section: &Section) -> Result<Vec<[DVec3; 3]>, SceneError> {
    let center = section.required("center")?.vector()?;
    let normal = section.required("normal")?;
    let Some(axis) = normal.vector()?.try_normalize() else {
        return Err(normal.fault("must not be 0"));
    };
    let radius = section.required("radius")?;
    let length = radius.number()?;
    if length <= 0.0 {
        return Err(radius.fault("must be greater than 0"));
    }
    let step = TAU / DISK_SIDES as f64;
    let circumradius = length * (step / step.sin()).sqrt();
    let (x, y) = axis.any_orthonormal_pair();
    let corner = |i: usize| {
        let (sin, cos) = (step * (i % DISK_SIDES) as f64).sin_cos();
        center + circumradius * (cos * x + sin * y)
    };
    Ok((0..DISK_SIDES).map(|i| [center, corner(i), corner(i + 1)]).collect())
}
