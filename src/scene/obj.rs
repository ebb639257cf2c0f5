//! Wavefront OBJ: [`scan`] checks the text, `tobj` reads the polygons, [`polygon`] cuts them.

mod scan;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use glam::DVec3;

use super::mtl::{self, MtlMaterial};
use super::{Draft, DraftMaterial, Origin, Scene, Warning, bare, polygon};
use crate::error::SceneError;
use scan::{Named, Scan};

/// Corners, and the index of the material's name where there is one.
type Triangle = ([DVec3; 3], Option<usize>);

/// A mesh whose materials are but names yet.
#[derive(Debug)]
pub struct Mesh {
    triangles: Vec<Triangle>,
    /// Materials that `usemtl` asks for.
    names: Vec<Named>,
    /// Materials of all libraries.
    library: Vec<MtlMaterial>,
    /// Libraries that are not there.
    missing: Vec<Named>,
    file: PathBuf,
    warnings: Vec<Warning>,
}

/// Loads a mesh without a scene file.
pub fn load_bare(path: &Path) -> Result<Scene, SceneError> {
    let mut draft = Draft::new(path.display().to_string());
    read(path)?.add_to(&mut draft, &HashMap::new(), |corners| corners)?;
    bare::finish(draft, path)
}

/// Reads a file as text: bytes that are no UTF-8 are replaced, lines end in '\n'.
pub fn read_text(file: &Path) -> Result<String, SceneError> {
    let bytes = std::fs::read(file).map_err(|error| {
        SceneError::new(file, format!("cannot read it: {error}; check the name and its rights"))
    })?;
    let text = String::from_utf8_lossy(&bytes);
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    Ok(text.replace("\r\n", "\n").replace('\r', "\n"))
}

/// Reads a mesh and the materials it names.
pub fn read(file: &Path) -> Result<Mesh, SceneError> {
    let scan = scan::scan(file, &read_text(file)?)?;
    let (mut library, mut missing) = (Vec::new(), Vec::new());
    for named in &scan.libraries {
        match find_libraries(file, &named.name) {
            Ok(paths) => {
                for path in paths {
                    library.extend(mtl::read(&path)?);
                }
            }
            Err(names) => {
                missing.extend(names.into_iter().map(|name| Named { name, line: named.line }));
            }
        }
    }
    let Scan { text, names, mut warnings, without_surface, .. } = scan;
    let triangles = read_polygons(file, &text, names.len(), &mut warnings)?;
    if triangles.is_empty() {
        let what = "no face of three corners or more: nothing to render";
        return Err(match without_surface {
            Some(line) => SceneError::at(file, line, what),
            None => SceneError::new(file, what),
        });
    }
    Ok(Mesh { triangles, names, library, missing, file: file.to_owned(), warnings })
}

/// The files of an `mtllib` line: one whose name may hold blanks, or several, of which some
/// must exist. Blanks may also be escaped.
fn find_libraries(obj: &Path, line: &str) -> Result<Vec<PathBuf>, Vec<String>> {
    let directory = obj.parent().unwrap_or(Path::new(""));
    let whole = directory.join(line);
    if whole.is_file() {
        return Ok(vec![whole]);
    }
    let names: Vec<String> =
        line.replace("\\ ", "\0").split_whitespace().map(|name| name.replace('\0', " ")).collect();
    let found: Vec<PathBuf> =
        names.iter().map(|name| directory.join(name)).filter(|path| path.is_file()).collect();
    if found.is_empty() { Err(names) } else { Ok(found) }
}

/// Lets `tobj` read the checked text, and cuts its polygons to triangles.
fn read_polygons(
    file: &Path,
    text: &str,
    names: usize,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Triangle>, SceneError> {
    let library = || {
        let material = |i: usize| tobj::Material { name: i.to_string(), ..Default::default() };
        let materials = (0..names).map(material).collect();
        Ok((materials, (0..names).map(|i| (i.to_string(), i)).collect()))
    };
    let mut lines = scan::CountLines::new(text);
    let options =
        tobj::LoadOptions { ignore_points: true, ignore_lines: true, ..Default::default() };
    let (models, _) = tobj::load_obj_buf(&mut lines, &options, |_| library())
        .map_err(|error| SceneError::at(file, lines.line(), error.to_string()))?;
    let mut triangles = Vec::new();
    let mut inexact = 0;
    for tobj::Model { mesh, .. } in models {
        let position = |&i: &u32| DVec3::from_slice(&mesh.positions[3 * i as usize..]);
        let arities = mesh.face_arities.iter().map(|&arity| arity as usize);
        let arities: Vec<usize> = match mesh.face_arities.is_empty() {
            true => vec![3; mesh.indices.len() / 3],
            false => arities.collect(),
        };
        let mut start = 0;
        for arity in arities {
            let corners: Vec<DVec3> =
                mesh.indices[start..start + arity].iter().map(position).collect();
            start += arity;
            let cut = polygon::triangulate(&corners);
            inexact += u64::from(!cut.exact);
            let corners = cut.triangles.iter().map(|indices| indices.map(|i| corners[i]));
            triangles.extend(corners.map(|corners| (corners, mesh.material_id)));
        }
    }
    if inexact > 0 {
        let file = file.display();
        warnings.push(Warning::changed(format!(
            "{file}: {inexact} polygons cross themselves or are too large to cut; fanned"
        )));
    }
    Ok(triangles)
}

impl Mesh {
    /// Adds the mesh, moved by `place`, with its own materials, or those of `overrides` of the
    /// same name.
    pub fn add_to(
        self,
        draft: &mut Draft,
        overrides: &HashMap<String, u32>,
        place: impl Fn([DVec3; 3]) -> [DVec3; 3],
    ) -> Result<(), SceneError> {
        let used: Vec<bool> = {
            let mut used = vec![false; self.names.len()];
            self.triangles.iter().filter_map(|&(_, name)| name).for_each(|name| used[name] = true);
            used
        };
        let mut lost = false;
        let mut indices = Vec::with_capacity(self.names.len());
        for (named, used) in self.names.iter().zip(used) {
            indices.push(match overrides.get(&named.name) {
                _ if !used => 0,
                Some(&index) => index,
                None => match self.library_material(draft, &named.name)? {
                    Some(index) => index,
                    None => {
                        lost = true;
                        self.unknown_material(draft, named)?
                    }
                },
            });
        }
        let bare = self.triangles.iter().any(|(_, name)| name.is_none());
        let default = if bare { self.default_material(draft)? } else { 0 };
        draft.triangles.extend(
            self.triangles.iter().map(|&(corners, name)| {
                (place(corners), name.map_or(default, |name| indices[name]))
            }),
        );
        self.warn(draft, lost);
        Ok(())
    }

    /// Adds the mesh, moved by `place`, all of one material.
    pub fn add_all_of(
        self,
        draft: &mut Draft,
        material: u32,
        place: impl Fn([DVec3; 3]) -> [DVec3; 3],
    ) {
        let place = |&(corners, _): &([DVec3; 3], _)| (place(corners), material);
        draft.triangles.extend(self.triangles.iter().map(place));
        draft.warnings.extend(self.warnings);
    }

    /// Adds the material of this name in the mesh's own libraries.
    pub fn library_material(
        &self,
        draft: &mut Draft,
        name: &str,
    ) -> Result<Option<u32>, SceneError> {
        let Some(material) = self.library.iter().find(|material| material.name == name) else {
            return Ok(None);
        };
        let (material, warning) = material.to_draft();
        draft.warnings.extend(warning);
        draft.add_material(material).map(Some)
    }

    fn unknown_material(&self, draft: &mut Draft, named: &Named) -> Result<u32, SceneError> {
        let Named { name, line } = named;
        draft.warnings.push(Warning::changed(format!(
            "{}:{line}: no material `{name}` in any library; albedo 0.8 is used",
            self.file.display()
        )));
        draft.add_material(DraftMaterial {
            name: name.clone(),
            albedo: mtl::DEFAULT_ALBEDO,
            origin: Origin::line(&self.file, *line),
            ..DraftMaterial::default()
        })
    }

    fn default_material(&self, draft: &mut Draft) -> Result<u32, SceneError> {
        draft.warnings.push(Warning::note(format!(
            "{}: faces without a material; albedo 0.8 is used",
            self.file.display()
        )));
        draft.add_material(DraftMaterial {
            name: "default".to_owned(),
            albedo: mtl::DEFAULT_ALBEDO,
            origin: Origin::file(&self.file),
            ..DraftMaterial::default()
        })
    }

    /// A library that is not there matters only if a material is missing.
    fn warn(self, draft: &mut Draft, lost: bool) {
        draft.warnings.extend(self.warnings);
        draft.warnings.extend(self.missing.iter().map(|Named { name, line }| {
            let message =
                format!("{}:{line}: no material library `{name}` here", self.file.display());
            Warning { changes_image: lost, ..Warning::note(message) }
        }));
    }
}
