//! How messages name files: whatever a name holds, a message stays one line.

use std::path::Path;

/// A file, or a line of one.
pub(crate) fn location(file: &Path, line: Option<usize>) -> String {
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
