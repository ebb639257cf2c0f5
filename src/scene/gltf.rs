//! glTF 2.0: `.gltf` with its buffers beside or in it, and `.glb`.
//!
//! The JSON is read by serde, the buffers by checked arithmetic: every index, range and count
//! is checked where it is used, so that no file panics, recurses or allocates by what it
//! merely claims. Accepted are the nodes of the default scene with their meshes, materials as
//! [`material`] maps them, the first perspective camera, and the lights of
//! `KHR_lights_punctual`. What else changes the image is reported.

mod accessor;
mod extensions;
mod graph;
mod json;
mod lenient;
mod material;
pub mod omitted;
mod source;
mod surface;
mod texture;
mod view;

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use glam::DAffine3;

use super::mesh::{Library, Mesh};
use super::{Draft, Scene, SceneError, Warning, bare};
use source::Source;
use surface::Surfaces;
use view::View;

/// Loads a file as a scene: its camera and lights are used, what lacks is added.
pub fn load_bare(path: &Path) -> Result<Scene, SceneError> {
    let mut draft = Draft::new(path.display().to_string());
    let (mesh, view) = read(path)?;
    view.add_to(&mut draft);
    mesh.add_to(&mut draft, &HashMap::new(), &DAffine3::IDENTITY)?;
    bare::finish(draft, path)
}

/// Reads a file and its buffers: the scene, in its own units, and how it is seen and lit.
pub fn read(path: &Path) -> Result<(Mesh, View), SceneError> {
    let source = Source::open(path)?;
    let mut surfaces = Surfaces::new(&source);
    let mut view = View::default();
    let mut unknown = BTreeMap::<&str, u64>::new();
    for (index, transform) in graph::nodes(&source)? {
        let node = &source.document.nodes[index];
        surfaces.add(node, transform)?;
        view.add(&source, node, transform)?;
        node.extensions.others.keys().for_each(|name| *unknown.entry(name).or_default() += 1);
    }
    let mut warnings = surfaces.warnings();
    warnings.extend(source.notes.iter().map(|note| Warning::note(source.says(note))));
    let left_out = extensions::left_out(&source.document);
    warnings.extend(left_out.iter().map(|what| Warning::changed(source.says(what))));
    let document = &source.document;
    if !document.animations.is_empty() {
        let what = "has animations, which are left out: it is shown at rest";
        warnings.push(Warning::changed(source.says(what)));
    }
    if document.scenes.len() > 1 {
        let what = format!("has {} scenes, of which one is shown", document.scenes.len());
        warnings.push(Warning::note(source.says(&what)));
    }
    warnings.extend(unknown.iter().map(|(name, count)| {
        let what = format!("{count} nodes have {name}, not supported; it is left out");
        Warning::changed(source.says(&what))
    }));
    let triangles = surfaces.triangles;
    if triangles.is_empty() {
        return Err(source.fault("no triangles in the scene it shows: nothing to render"));
    }
    let file = source.path.clone();
    Ok((Mesh { file, triangles, library: Box::new(source), warnings }, view))
}

/// A slot is the index of a material.
impl Library for Source {
    fn name(&self, slot: usize) -> String {
        material::name(self, slot)
    }

    fn find(&self, name: &str) -> Option<usize> {
        (0..self.document.materials.len()).find(|&slot| material::name(self, slot) == name)
    }

    fn add(&self, slot: usize, draft: &mut Draft) -> Result<u32, SceneError> {
        material::add(self, slot, draft)
    }
}
