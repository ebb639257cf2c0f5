//! Where the library of Open Image Denoise is looked for.

use std::env;
use std::io;
use std::path::{self, Path, PathBuf};

/// The environment variable that names the library's file, or the folder that it is in.
pub const VARIABLE: &str = "OIDN_LIBRARY";

/// The file names of version 2, the more specific first.
const NAMES: &[&str] = if cfg!(windows) {
    &["OpenImageDenoise.dll"]
} else if cfg!(target_os = "macos") {
    &["libOpenImageDenoise.2.dylib", "libOpenImageDenoise.dylib"]
} else {
    &["libOpenImageDenoise.so.2", "libOpenImageDenoise.so"]
};

/// The files to try one after the other: those that the variable names, or, where it is unset or
/// empty, plain names, for which the system's loader looks in its own places.
///
/// # Errors
/// The variable is a relative path, and there is no current folder.
pub fn candidates() -> io::Result<Vec<PathBuf>> {
    match env::var_os(VARIABLE).filter(|named| !named.is_empty()) {
        // A plain name would be looked for in the loader's places, and not here.
        Some(named) => Ok(within(&path::absolute(named)?)),
        None => Ok(NAMES.iter().map(PathBuf::from).collect()),
    }
}

/// A file, or the libraries that may be in a folder.
fn within(named: &Path) -> Vec<PathBuf> {
    match named.is_dir() {
        true => NAMES.iter().map(|name| named.join(name)).collect(),
        false => vec![named.to_owned()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_searched_and_a_file_is_taken_as_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let found = within(folder.path());
        assert_eq!(found.len(), NAMES.len());
        assert!(found.iter().all(|file| file.parent() == Some(folder.path())));
        let file = folder.path().join("denoiser.so.9");
        assert_eq!(within(&file), std::slice::from_ref(&file));
    }
}
