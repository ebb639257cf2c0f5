//! A material as MTL tells it.

use std::path::PathBuf;

use encoding_rs::Encoding;
use glam::DVec3;

use super::map::Map;

/// A material as the file gives it; colours are linear.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MtlMaterial {
    /// Its name.
    pub name: String,
    pub(super) file: PathBuf,
    pub(super) line: usize,
    /// That of the file.
    pub(super) encoding: Option<&'static Encoding>,
    /// Whether a comment of the file names Blender.
    pub(super) says_blender: bool,
    /// The first statements, in the file's order.
    pub(super) order: Vec<&'static str>,
    pub(super) ambient: Option<DVec3>,
    pub(super) diffuse: Option<DVec3>,
    pub(super) specular: DVec3,
    pub(super) emission: Option<DVec3>,
    pub(super) shininess: f64,
    pub(super) dissolve: Option<f64>,
    pub(super) transparency: Option<f64>,
    pub(super) illumination: Option<f64>,
    pub(super) refraction: Option<f64>,
    pub(super) transmission: Option<DVec3>,
    pub(super) diffuse_map: Option<Map>,
    pub(super) opacity_map: Option<Map>,
    pub(super) emission_map: Option<Map>,
    /// Whether another of this name came before.
    pub(super) again: bool,
    /// Rows of [`OMITTED`](super::omitted::OMITTED) that its statements are of, and the statements.
    pub(super) omitted: Vec<(usize, String)>,
}

impl MtlMaterial {
    /// Notes a statement that is not shown, if a row of what is not is given.
    pub(super) fn omit(&mut self, row: Option<usize>, statement: &str) {
        self.omitted.extend(row.map(|row| (row, statement.to_owned())));
    }
}
