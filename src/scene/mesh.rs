//! A mesh of any format: triangles whose materials are slots of a library until they are
//! added to a draft.

use std::collections::{BTreeSet, HashMap};
use std::fmt::Debug;
use std::path::PathBuf;

use glam::{DAffine3, DVec3, Vec2};

use super::{Draft, DraftMaterial, Origin, SceneError, Warning};

/// Albedo of what has no material, or a material without colour.
pub const DEFAULT_ALBEDO: DVec3 = DVec3::splat(0.8);

/// A triangle, in the file's units.
#[derive(Debug, Clone, Copy)]
pub struct Triangle {
    /// Wound counter-clockwise seen from its front.
    pub corners: [DVec3; 3],
    /// Texture coordinates of the corners, from the image's top left.
    pub uvs: [Vec2; 3],
    /// The slot of its material, if it has one.
    pub material: Option<usize>,
}

/// The materials that a file describes or asks for, by slot.
pub trait Library: Debug {
    /// The name of a slot.
    fn name(&self, slot: usize) -> String;

    /// The slot of the material of this name, if the file describes one.
    fn find(&self, name: &str) -> Option<usize>;

    /// Adds the material of a slot, with warnings about what of it is not shown.
    ///
    /// # Errors
    /// It says something impossible.
    fn add(&self, slot: usize, draft: &mut Draft) -> Result<u32, SceneError>;
}

/// Triangles and their library.
#[derive(Debug)]
pub struct Mesh {
    /// The file.
    pub file: PathBuf,
    /// At least one.
    pub triangles: Vec<Triangle>,
    /// What their slots mean.
    pub library: Box<dyn Library>,
    /// About the triangles.
    pub warnings: Vec<Warning>,
}

impl Mesh {
    /// Adds the mesh with its own materials, or those of `overrides` of the same name.
    pub fn add_to(
        self,
        draft: &mut Draft,
        overrides: &HashMap<String, u32>,
        transform: &DAffine3,
    ) -> Result<(), SceneError> {
        let used: BTreeSet<Option<usize>> =
            self.triangles.iter().map(|triangle| triangle.material).collect();
        let mut indices = HashMap::new();
        for slot in used {
            let index = match slot {
                None => self.add_default(draft)?,
                Some(slot) => match overrides.get(&self.library.name(slot)) {
                    Some(&index) => index,
                    None => self.library.add(slot, draft)?,
                },
            };
            indices.insert(slot, index);
        }
        self.add_triangles(draft, transform, |slot| indices[&slot]);
        Ok(())
    }

    /// Adds the mesh, all of one material.
    pub fn add_all_of(self, draft: &mut Draft, material: u32, transform: &DAffine3) {
        self.add_triangles(draft, transform, |_| material);
    }

    /// Adds the material of this name that the file describes, if it does.
    pub fn add_material(&self, draft: &mut Draft, name: &str) -> Result<Option<u32>, SceneError> {
        self.library.find(name).map(|slot| self.library.add(slot, draft)).transpose()
    }

    fn add_triangles(
        self,
        draft: &mut Draft,
        transform: &DAffine3,
        material: impl Fn(Option<usize>) -> u32,
    ) {
        // A mirrored mesh must emit to the mirrored side.
        let mirrored = transform.matrix3.determinant() < 0.0;
        for Triangle { mut corners, mut uvs, material: slot } in self.triangles {
            corners = corners.map(|corner| transform.transform_point3(corner));
            if mirrored {
                corners.swap(1, 2);
                uvs.swap(1, 2);
            }
            draft.add_triangle(corners, uvs, material(slot));
        }
        draft.warnings.extend(self.warnings);
    }

    fn add_default(&self, draft: &mut Draft) -> Result<u32, SceneError> {
        draft.warnings.push(Warning::note(format!(
            "{}: triangles without a material; albedo 0.8 is used",
            self.file.display()
        )));
        draft.add_material(DraftMaterial {
            name: "default".to_owned(),
            albedo: DEFAULT_ALBEDO,
            origin: Origin::file(&self.file),
            ..DraftMaterial::default()
        })
    }
}
