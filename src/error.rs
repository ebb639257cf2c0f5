//! What can go wrong, one enum a boundary; [`Error`] joins them and knows the exit code.

use std::path::PathBuf;

use crate::gpu::GpuError;

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

/// Everything that ends a command early.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The command line asks for something that cannot be done.
    #[error("{0}")]
    Usage(String),
    /// The scene cannot be read.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An image cannot be read.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The device cannot be used, or failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The result cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Figures of a study are not what they must be.
    #[error("{0}")]
    Wrong(String),
    /// The user asked to stop.
    #[error("{0}")]
    Interrupted(String),
    /// `--strict` and the image is not what was asked for.
    #[error("{0}")]
    Strict(String),
    /// Images differ by more than a limit allows.
    #[error("{0}")]
    OverLimit(String),
}

impl Error {
    /// The process's exit code: 1 failed while running, 2 usage or an unreadable scene or
    /// image, 3 no usable adapter, 4 over a limit, 130 interrupted.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Usage(_)
            | Self::Scene(_)
            | Self::Image(_)
            | Self::Output(OutputError::UnknownFormat(_)) => 2,
            Self::Gpu(error) if error.is_missing_adapter() => 3,
            Self::Gpu(_) | Self::Output(_) | Self::Strict(_) | Self::Wrong(_) => 1,
            Self::OverLimit(_) => 4,
            Self::Interrupted(_) => 130,
        }
    }
}

/// A file, or a line of one.
pub(crate) fn location(file: &std::path::Path, line: Option<usize>) -> String {
    let file = one_line(file.display().to_string());
    match line {
        Some(line) => format!("{file}:{line}"),
        None => file,
    }
}

/// File and material names, and the messages of libraries, may hold line breaks.
pub(crate) fn one_line(text: String) -> String {
    if !text.contains(char::is_control) {
        return text;
    }
    text.replace(char::is_control, " ")
}
