//! Wavefront OBJ: [`scan`] checks the text, `tobj` reads the polygons, [`polygon`] cuts them.
//! Texture coordinates are the scan's: `tobj` loses count of faces that have none.

mod colors;
mod lines;
mod logical;
mod omitted;
mod scan;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use encoding_rs::Encoding;
use glam::{DAffine3, DVec3, Vec3};

use super::mesh::{DEFAULT_ALBEDO, Library, Mesh, Triangle};
use super::mtl::{self, MtlMaterial};
use super::names::{self, Found};
use super::shape::UNCOLORED;
use super::text::read_text;
use super::{Draft, DraftMaterial, Origin, Scene, SceneError, Warning, bare, polygon};
pub use omitted::OMITTED;
use scan::{Named, Scan};

/// The materials of all libraries, and what `usemtl` asks for.
#[derive(Debug)]
struct Materials {
    file: PathBuf,
    /// A slot each: what `usemtl` names, then what the libraries hold beside.
    names: Vec<Named>,
    described: Vec<MtlMaterial>,
}

/// Loads a mesh without a scene file.
pub fn load_bare(path: &Path) -> Result<Scene, SceneError> {
    let mut draft = Draft::new(path.display().to_string());
    read(path)?.add_to(&mut draft, &HashMap::new(), &DAffine3::IDENTITY)?;
    bare::finish(draft, path)
}

/// Reads a mesh and the materials it names.
pub fn read(file: &Path) -> Result<Mesh, SceneError> {
    let text = read_text(file, None)?;
    let mut scan = scan::scan(file, &text.content)?;
    scan.warnings.extend(text.note(file));
    let described = read_libraries(file, text.encoding, &mut scan)?;
    let mut triangles = read_polygons(file, &mut scan)?;
    let covered = uncolor_textured(&mut triangles, &scan.names, &described);
    if covered > 0 {
        let what = "triangles have colours at their corners and a map_Kd, which alone is shown";
        scan.warnings.push(Warning::note(format!("{}: {covered} {what}", file.display())));
    }
    let Scan { mut names, warnings, without_surface, .. } = scan;
    if triangles.is_empty() {
        let what = "no face of three corners or more: nothing to render";
        return Err(match without_surface {
            Some(line) => SceneError::at(file, line, what),
            None => SceneError::new(file, what),
        });
    }
    for material in &described {
        if names.iter().all(|named| named.name != material.name) {
            names.push(Named { name: material.name.clone(), line: 0 });
        }
    }
    let file = file.to_owned();
    let library = Box::new(Materials { file: file.clone(), names, described });
    Ok(Mesh { file, triangles, library, warnings })
}

/// Takes the colours of corners from triangles that have a map of their colour: of the two, that is
/// what other programs show. Returns from how many.
fn uncolor_textured(
    triangles: &mut [Triangle],
    names: &[Named],
    described: &[MtlMaterial],
) -> usize {
    let first = |named: &Named| described.iter().find(|material| material.name == named.name);
    let textured: Vec<bool> =
        names.iter().map(|named| first(named).is_some_and(MtlMaterial::is_textured)).collect();
    let is_textured = |slot: Option<usize>| slot.is_some_and(|slot| textured[slot]);
    let covered = triangles.iter_mut().filter(|t| t.colors != UNCOLORED && is_textured(t.material));
    covered.map(|triangle| triangle.colors = UNCOLORED).count()
}

/// Reads all libraries. One that is not there changes the image only if a material is missing
/// for it, which is a warning of its own.
fn read_libraries(
    file: &Path,
    encoding: &'static Encoding,
    scan: &mut Scan,
) -> Result<Vec<MtlMaterial>, SceneError> {
    let mut described = Vec::new();
    for Named { name, line } in &scan.libraries {
        match find_libraries(file, name, encoding) {
            Ok(libraries) => {
                let origin = Origin::line(file, *line);
                for Found { path, note } in libraries {
                    scan.warnings.extend(note.map(|note| origin.note(note)));
                    let materials = mtl::read(&path, encoding, &mut scan.warnings)?;
                    scan.warnings.extend(materials.iter().filter_map(MtlMaterial::as_second));
                    described.extend(materials);
                }
            }
            Err(missing) => scan.warnings.extend(missing.iter().map(|name| {
                let file = file.display();
                Warning::note(format!("{file}:{line}: no material library `{name}` here"))
            })),
        }
    }
    Ok(described)
}

/// The files of an `mtllib` line: one whose name may hold blanks, or several, of which some
/// must exist. Blanks may also be escaped. Where none is there, a library that has the mesh's name is
/// taken: files are renamed together.
fn find_libraries(
    obj: &Path,
    line: &str,
    encoding: &'static Encoding,
) -> Result<Vec<Found>, Vec<String>> {
    let directory = obj.parent().unwrap_or(Path::new(""));
    let find = |name: &str| names::find(directory, name, encoding).ok();
    if let Some(whole) = find(line) {
        return Ok(vec![whole]);
    }
    let names: Vec<String> =
        line.replace("\\ ", "\0").split_whitespace().map(|name| name.replace('\0', " ")).collect();
    let found: Vec<Found> = names.iter().filter_map(|name| find(name)).collect();
    if !found.is_empty() {
        return Ok(found);
    }
    let renamed = obj.with_extension("mtl");
    match renamed.is_file() {
        true => {
            let note = format!("no library `{line}` here; {} is read", renamed.display());
            Ok(vec![Found { path: renamed, note: Some(note) }])
        }
        false => Err(names),
    }
}

/// Lets `tobj` read the checked text, and cuts its polygons to triangles.
fn read_polygons(file: &Path, scan: &mut Scan) -> Result<Vec<Triangle>, SceneError> {
    let names = scan.names.len();
    let library = || {
        let material = |i: usize| tobj::Material { name: i.to_string(), ..Default::default() };
        let materials = (0..names).map(material).collect();
        Ok((materials, (0..names).map(|i| (i.to_string(), i)).collect()))
    };
    let mut lines = lines::CountLines::new(&scan.text);
    let options =
        tobj::LoadOptions { ignore_points: true, ignore_lines: true, ..Default::default() };
    let (models, _) = tobj::load_obj_buf(&mut lines, &options, |_| library())
        .map_err(|error| SceneError::at(file, lines.line(), error.to_string()))?;
    let mut triangles = Vec::new();
    let mut inexact = 0;
    // The corners of all faces, in the file's order, as are those of the models.
    let mut uvs = scan.corner_uvs();
    let mut colors = scan.corner_colors();
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
            let uvs: Vec<_> = uvs.by_ref().take(arity).collect();
            let colors: Vec<_> = colors.by_ref().take(arity).collect();
            let cut = polygon::triangulate(&corners);
            inexact += u64::from(!cut.exact);
            triangles.extend(cut.triangles.iter().map(|indices| Triangle {
                corners: indices.map(|i| corners[i]),
                uvs: indices.map(|i| uvs.get(i).copied().unwrap_or_default()),
                colors: indices.map(|i| colors.get(i).copied().unwrap_or(Vec3::ONE)),
                material: mesh.material_id,
            }));
        }
    }
    drop((uvs, colors));
    if inexact > 0 {
        let file = file.display();
        scan.warnings.push(Warning::changed(format!(
            "{file}: {inexact} polygons cross themselves or are too large to cut; fanned"
        )));
    }
    Ok(triangles)
}

impl Library for Materials {
    fn name(&self, slot: usize) -> String {
        self.names[slot].name.clone()
    }

    fn find(&self, name: &str) -> Option<usize> {
        self.described(name)?;
        self.names.iter().position(|named| named.name == name)
    }

    fn add(&self, slot: usize, draft: &mut Draft) -> Result<u32, SceneError> {
        let named = &self.names[slot];
        match self.described(&named.name) {
            Some(material) => material.add_to(draft),
            None => self.add_unknown(named, draft),
        }
    }
}

impl Materials {
    fn described(&self, name: &str) -> Option<&MtlMaterial> {
        self.described.iter().find(|material| material.name == name)
    }

    fn add_unknown(
        &self,
        Named { name, line }: &Named,
        draft: &mut Draft,
    ) -> Result<u32, SceneError> {
        let origin = Origin::line(&self.file, *line);
        let what = format!("no material `{name}` in any library; albedo 0.8 is used");
        draft.warnings.push(origin.changed(what));
        draft.add_material(DraftMaterial {
            name: name.clone(),
            albedo: DEFAULT_ALBEDO,
            origin,
            ..DraftMaterial::default()
        })
    }
}
