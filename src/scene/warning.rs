//! What the user should know about the input.

use crate::message::one_line;

/// Something about the input that the user should know.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// One line; names file and line where there are any.
    pub message: String,
    /// Whether the image is not what the file asks for (an error under `--strict`).
    pub changes_image: bool,
}

impl Warning {
    /// A warning about something that leaves the image as the file asks for it.
    pub fn note(message: impl Into<String>) -> Self {
        Self { message: one_line(message.into()), changes_image: false }
    }

    /// A warning that the image is not what the file asks for.
    pub fn changed(message: impl Into<String>) -> Self {
        Self { message: one_line(message.into()), changes_image: true }
    }
}
