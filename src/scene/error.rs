//! What can go wrong with a scene.

use std::path::PathBuf;

use crate::message::{location, one_line};

/// A scene, mesh or material file that cannot be read, or that says something impossible.
#[derive(Debug, thiserror::Error)]
#[error("{}: {what}", location(.file, *.line))]
pub struct SceneError {
    /// The file, or the name of a built-in scene.
    pub file: PathBuf,
    /// The line in it, counted from 1, where there is one.
    pub line: Option<usize>,
    /// What is wrong and what to do.
    pub what: String,
}

impl SceneError {
    /// An error about a whole file.
    pub fn new(file: impl Into<PathBuf>, what: impl Into<String>) -> Self {
        Self { file: file.into(), line: None, what: one_line(what.into()) }
    }

    /// An error at a line, counted from 1.
    pub fn at(file: impl Into<PathBuf>, line: usize, what: impl Into<String>) -> Self {
        Self { file: file.into(), line: Some(line), what: one_line(what.into()) }
    }
}
