//! The `[[mesh]]` tables.

use std::collections::HashMap;

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3, EulerRot};

use crate::scene::document::{Section, Value};
use crate::scene::mesh::{Mesh, affine};
use crate::scene::{Draft, SceneError, Warning, gltf, obj};

/// Least volume that a transform may make of a unit cube, over that of the box with edges
/// as long: less is rounding.
const FLATTEST: f64 = 1e-14;

/// Reads a mesh and the file it names.
pub fn read(
    section: &Section,
    materials: &HashMap<String, u32>,
    draft: &mut Draft,
) -> Result<(), SceneError> {
    section.only(&["file", "material", "translate", "rotate", "scale", "matrix"])?;
    let transform = transform(section)?;
    let mesh = load(section, &mut draft.warnings)?;
    let Some(material) = section.get("material") else {
        return mesh.add_to(draft, materials, &transform);
    };
    let name = material.string()?;
    let index = match materials.get(name) {
        Some(&index) => Some(index),
        None => mesh.add_material(draft, name)?,
    };
    let Some(index) = index else {
        let what =
            format!("names no material: `{name}` is not in [materials], nor among the mesh's own");
        return Err(material.fault(&what));
    };
    mesh.add_all_of(draft, index, &transform);
    Ok(())
}

/// Reads a mesh of any format. The camera and lights of a glTF file are not used: the scene
/// file has its own.
fn load(section: &Section, warnings: &mut Vec<Warning>) -> Result<Mesh, SceneError> {
    let file = section.required("file")?;
    let path = file.path(warnings)?;
    let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    match extension.as_deref() {
        Some("obj" | "gltf" | "glb") if !path.exists() => {
            Err(file.fault(&format!("names {}, which is not there", path.display())))
        }
        Some("obj") => obj::read(&path),
        Some("gltf" | "glb") => gltf::read(&path).map(|(mesh, _)| mesh),
        _ => Err(file.fault("names an unknown kind of mesh; give an .obj, .gltf or .glb")),
    }
}

/// Scale, then rotation, then translation; or a matrix.
fn transform(section: &Section) -> Result<DAffine3, SceneError> {
    let transform = match section.get("matrix") {
        Some(value) => {
            if ["translate", "rotate", "scale"].iter().any(|key| section.get(key).is_some()) {
                return Err(value.fault("excludes translate, rotate and scale"));
            }
            matrix(&value)?
        }
        None => DAffine3::from_scale_rotation_translation(
            section.get("scale").map_or(Ok(DVec3::ONE), |value| scale(&value))?,
            section.get("rotate").map_or(Ok(DQuat::IDENTITY), |value| rotation(&value))?,
            section.get("translate").map_or(Ok(DVec3::ZERO), |value| value.vector())?,
        ),
    };
    let DMat3 { x_axis, y_axis, z_axis } = transform.matrix3;
    let volume = transform.matrix3.determinant().abs();
    let of_box = x_axis.length() * y_axis.length() * z_axis.length();
    if volume > FLATTEST * of_box && of_box.is_finite() {
        Ok(transform)
    } else {
        Err(section.fault("its transform is singular: it flattens the mesh, or overflows"))
    }
}

fn scale(value: &Value) -> Result<DVec3, SceneError> {
    if value.is_array() { value.vector() } else { value.number().map(DVec3::splat) }
}

/// About X, then Y, then Z, in degrees.
pub fn rotation(value: &Value) -> Result<DQuat, SceneError> {
    let [x, y, z] = value.vector()?.to_array().map(f64::to_radians);
    Ok(DQuat::from_euler(EulerRot::ZYX, z, y, x))
}

/// Row-major; the last row must be that of an affine map.
fn matrix(value: &Value) -> Result<DAffine3, SceneError> {
    let matrix = DMat4::from_cols_array(&value.numbers()?).transpose();
    affine(matrix).ok_or_else(|| value.fault("must end in the row 0, 0, 0, 1"))
}
