//! glTF 2.0: `.gltf` with its buffers beside or in it, and `.glb`.
//!
//! The JSON is read by serde, the buffers by checked arithmetic: every index, range and count
//! is checked where it is used, so that no file panics, recurses or allocates by what it
//! merely claims. Accepted are the nodes of the default scene with their meshes, the first
//! perspective camera, and the point lights of `KHR_lights_punctual`, whose candelas are
//! taken as W/sr. What else changes the image is reported.

mod accessor;
mod graph;
mod json;
mod material;
mod source;
mod surface;
mod view;

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;

use glam::DVec3;

use super::mtl::DEFAULT_ALBEDO;
use super::{Draft, DraftCamera, DraftMaterial, Origin, Scene, Warning, bare};
use crate::error::SceneError;
use source::Source;
use surface::{Surfaces, Triangle};
use view::View;

/// The scene of a file, in its own units.
#[derive(Debug)]
pub struct Gltf {
    source: Source,
    triangles: Vec<Triangle>,
    warnings: Vec<Warning>,
    camera: Option<DraftCamera>,
    point_lights: Vec<(DVec3, DVec3)>,
    /// About cameras and lights.
    view_warnings: Vec<Warning>,
}

/// Loads a file as a scene: its camera and lights are used, what lacks is added.
pub fn load_bare(path: &Path) -> Result<Scene, SceneError> {
    let mut draft = Draft::new(path.display().to_string());
    let mut gltf = read(path)?;
    draft.camera = gltf.camera.take();
    draft.point_lights = std::mem::take(&mut gltf.point_lights);
    draft.warnings = std::mem::take(&mut gltf.view_warnings);
    gltf.add_to(&mut draft, &HashMap::new(), |corners| corners)?;
    bare::finish(draft, path)
}

/// Reads a file and its buffers.
pub fn read(path: &Path) -> Result<Gltf, SceneError> {
    let source = Source::open(path)?;
    let mut surfaces = Surfaces::new(&source);
    let mut view = View::new(&source);
    let mut unknown = BTreeMap::<&str, u64>::new();
    for (index, transform) in graph::nodes(&source)? {
        let node = &source.document.nodes[index];
        surfaces.add(node, transform)?;
        view.add(node, transform)?;
        node.extensions.others.keys().for_each(|name| *unknown.entry(name).or_default() += 1);
    }
    let mut warnings = surfaces.warnings();
    warnings.extend(unknown.iter().map(|(name, count)| {
        let what = format!("{count} nodes have {name}, not supported; it is left out");
        Warning::changed(source.says(&what))
    }));
    let triangles = surfaces.triangles;
    if triangles.is_empty() {
        return Err(source.fault("no triangles in the scene it shows: nothing to render"));
    }
    let View { camera, point_lights, warnings: view_warnings, .. } = view;
    Ok(Gltf { triangles, warnings, camera, point_lights, view_warnings, source })
}

impl Gltf {
    /// Adds the triangles, moved by `place`, with their own materials, or those of
    /// `overrides` of the same name. Cameras and lights are not added.
    pub fn add_to(
        self,
        draft: &mut Draft,
        overrides: &HashMap<String, u32>,
        place: impl Fn([DVec3; 3]) -> [DVec3; 3],
    ) -> Result<(), SceneError> {
        let used: BTreeSet<Option<usize>> = self.triangles.iter().map(|&(_, used)| used).collect();
        let mut indices = HashMap::new();
        for used in used {
            let index = match used {
                None => self.default_material(draft)?,
                Some(used) => match overrides.get(&material::name(&self.source, used)) {
                    Some(&index) => index,
                    None => self.add_material(draft, used)?,
                },
            };
            indices.insert(used, index);
        }
        let place = |&(corners, used): &Triangle| (place(corners), indices[&used]);
        draft.triangles.extend(self.triangles.iter().map(place));
        draft.warnings.extend(self.warnings);
        Ok(())
    }

    /// Adds the triangles, moved by `place`, all of one material.
    pub fn add_all_of(
        self,
        draft: &mut Draft,
        material: u32,
        place: impl Fn([DVec3; 3]) -> [DVec3; 3],
    ) {
        let place = |&(corners, _): &Triangle| (place(corners), material);
        draft.triangles.extend(self.triangles.iter().map(place));
        draft.warnings.extend(self.warnings);
    }

    /// Adds the file's material of this name.
    pub fn library_material(
        &self,
        draft: &mut Draft,
        name: &str,
    ) -> Result<Option<u32>, SceneError> {
        let materials = 0..self.source.document.materials.len();
        let named = |&index: &usize| material::name(&self.source, index) == name;
        materials.into_iter().find(named).map(|index| self.add_material(draft, index)).transpose()
    }

    fn add_material(&self, draft: &mut Draft, index: usize) -> Result<u32, SceneError> {
        let (material, warning) = material::to_draft(&self.source, index)?;
        draft.warnings.extend(warning);
        draft.add_material(material)
    }

    fn default_material(&self, draft: &mut Draft) -> Result<u32, SceneError> {
        let what = "triangles without a material; albedo 0.8 is used";
        draft.warnings.push(Warning::note(self.source.says(what)));
        draft.add_material(DraftMaterial {
            name: "default".to_owned(),
            albedo: DEFAULT_ALBEDO,
            origin: Origin::file(&self.source.path),
            ..DraftMaterial::default()
        })
    }
}
