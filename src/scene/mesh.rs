//! A mesh of any format: triangles whose materials are slots of a library until they are
//! added to a draft.

use std::collections::{BTreeSet, HashMap};
use std::fmt::Debug;
use std::path::PathBuf;

use glam::{DAffine3, DMat4, DVec3, Vec2, Vec3};

use super::shape::UNCOLORED;
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
    /// What the corners' colours multiply the albedo by, linear, in [0, 1].
    pub colors: [Vec3; 3],
    /// The slot of its material, if it has one.
    pub material: Option<usize>,
}

/// The affine map of a matrix whose last row is 0, 0, 0, 1, but for the rounding of programs that
/// multiply and invert matrices.
pub fn affine(matrix: DMat4) -> Option<DAffine3> {
    const ROUNDING: f64 = 1e-3;
    let [x, y, z, w] = matrix.row(3).to_array();
    let length = matrix.row(0).length().max(matrix.row(1).length()).max(matrix.row(2).length());
    // What the row moves a point by must be nothing beside the point.
    let still = [x, y, z].iter().all(|value| value.abs() <= 1e-3 * ROUNDING * length.min(1.0));
    (still && (w - 1.0).abs() <= ROUNDING).then(|| DAffine3::from_mat4(matrix * (1.0 / w)))
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
        mut self,
        draft: &mut Draft,
        overrides: &HashMap<String, u32>,
        transform: &DAffine3,
    ) -> Result<(), SceneError> {
        let used: BTreeSet<Option<usize>> =
            self.triangles.iter().map(|triangle| triangle.material).collect();
        let mut indices = HashMap::new();
        let mut replaced = BTreeSet::new();
        for slot in used {
            let index = match slot {
                None => self.add_default(draft)?,
                Some(slot) => match overrides.get(&self.library.name(slot)) {
                    Some(&index) => {
                        replaced.insert(Some(slot));
                        index
                    }
                    None => self.library.add(slot, draft)?,
                },
            };
            indices.insert(slot, index);
        }
        self.uncolor(draft, |slot| replaced.contains(&slot));
        self.add_triangles(draft, transform, |slot| indices[&slot]);
        Ok(())
    }

    /// Adds the mesh, all of one material.
    pub fn add_all_of(mut self, draft: &mut Draft, material: u32, transform: &DAffine3) {
        self.uncolor(draft, |_| true);
        self.add_triangles(draft, transform, |_| material);
    }

    /// Takes the colours of corners from triangles whose material the scene file gives.
    fn uncolor(&mut self, draft: &mut Draft, replaced: impl Fn(Option<usize>) -> bool) {
        let colored = self.triangles.iter_mut();
        let colored = colored.filter(|t| t.colors != UNCOLORED && replaced(t.material));
        let count = colored.map(|triangle| triangle.colors = UNCOLORED).count();
        if count > 0 {
            draft.warnings.push(Warning::note(format!(
                "{}: the colours at the corners of {count} triangles are left out, as the scene \
                 file gives their material",
                self.file.display()
            )));
        }
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
        for Triangle { mut corners, mut uvs, mut colors, material: slot } in self.triangles {
            corners = corners.map(|corner| transform.transform_point3(corner));
            if mirrored {
                corners.swap(1, 2);
                uvs.swap(1, 2);
                colors.swap(1, 2);
            }
            draft.add_triangle(corners, uvs, material(slot));
            draft.color_last(colors);
        }
        draft.warnings.extend(self.warnings);
    }

    /// The material of triangles that have none. Where they have colours, those are their albedo.
    fn add_default(&mut self, draft: &mut Draft) -> Result<u32, SceneError> {
        let bare = || self.triangles.iter().filter(|triangle| triangle.material.is_none());
        let colored = bare().filter(|triangle| triangle.colors != UNCOLORED).count();
        let albedo = if colored == 0 { DEFAULT_ALBEDO } else { DVec3::ONE };
        let all = bare().count();
        if colored > 0 {
            let plain = |t: &&mut Triangle| t.material.is_none() && t.colors == UNCOLORED;
            for triangle in self.triangles.iter_mut().filter(plain) {
                triangle.colors = [DEFAULT_ALBEDO.as_vec3(); 3];
            }
        }
        let origin = Origin::file(&self.file);
        let material = DraftMaterial {
            name: "default".to_owned(),
            albedo,
            origin,
            ..DraftMaterial::default()
        };
        if colored == all {
            return draft.add_material(material);
        }
        draft.warnings.push(Warning::note(format!(
            "{}: triangles without a material; albedo 0.8 is used",
            self.file.display()
        )));
        draft.add_material(material)
    }
}
