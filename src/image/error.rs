//! What can go wrong with images and other outputs.

use std::path::PathBuf;

use crate::message::{location, one_line};

/// An image that cannot be read, or not as what it is wanted for.
#[derive(Debug, thiserror::Error)]
#[error("{}: {what}", location(.file, None))]
pub struct ImageError {
    /// The file.
    pub file: PathBuf,
    /// What is wrong and what to do.
    pub what: String,
}

impl ImageError {
    /// An error about a file.
    pub fn new(file: impl Into<PathBuf>, what: impl Into<String>) -> Self {
        Self { file: file.into(), what: one_line(what.into()) }
    }
}

/// An output that cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The file name's ending is of no format we write.
    #[error("{}: unknown image format; name the output .png or .exr", .0.display())]
    UnknownFormat(PathBuf),
    /// The file system or the encoder said no.
    #[error("{}: cannot write: {why}", .file.display())]
    Write {
        /// The output asked for.
        file: PathBuf,
        /// The reason, as the system gives it.
        why: String,
    },
}
