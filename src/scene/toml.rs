//! The scene file. Every fault is reported with the line of the key or table at fault.

mod camera;
mod light;
mod material;
mod mesh;
mod sphere;

use std::collections::HashMap;
use std::path::Path;

use super::document::Document;
use super::text::read_text;
use super::{Draft, Scene, SceneError};

/// Loads a scene file.
pub fn load(path: &Path) -> Result<Scene, SceneError> {
    let text = read_text(path, None)?;
    let document = Document::new(path, &text.content);
    let table = document.parse()?;
    let root = document.section("the scene file", 1, &table);
    root.only(&["exposure", "camera", "mesh", "sphere", "materials", "light"])?;

    let mut draft = Draft::new(path.display().to_string());
    draft.warnings.extend(text.note(path));
    if let Some(exposure) = root.get("exposure") {
        draft.exposure = exposure.number()?;
    }
    if let Some(camera) = root.get("camera") {
        draft.camera = Some(camera::read(&camera.section("[camera]")?)?);
    }
    let mut materials = HashMap::new();
    if let Some(all) = root.get("materials") {
        for (name, value) in all.section("[materials]")?.values() {
            let section = value.section(&format!("[materials.{name}]"))?;
            let material = material::read(name, &section, &mut draft)?;
            materials.insert(name.to_owned(), draft.add_material(material)?);
        }
    }
    for mesh in root.sections("mesh")? {
        mesh::read(&mesh, &materials, &mut draft)?;
    }
    for sphere in root.sections("sphere")? {
        sphere::read(&sphere, &materials, &mut draft)?;
    }
    for (light, number) in root.sections("light")?.iter().zip(1..) {
        light::read(light, number, &mut draft)?;
    }
    draft.finish()
}
