//! The crate's errors as those of files.

use std::io;

/// An error of the `exr` crate.
pub fn io_error(error: exr::error::Error) -> io::Error {
    match error {
        exr::error::Error::Io(error) => error,
        other => io::Error::other(other.to_string()),
    }
}
