//! Temporary files, which a process that is told to end removes.

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

/// Those that are there. Who holds it may make, move and remove them.
static FILES: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn files() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A temporary file, removed when it is dropped, or when [`discard_all`] is called.
#[derive(Debug)]
pub struct Temporary(Option<NamedTempFile>);

impl Temporary {
    /// Makes one in the directory of a path.
    ///
    /// # Errors
    /// The system refuses.
    pub fn beside(path: &Path) -> io::Result<Self> {
        let directory = path.parent().unwrap_or(Path::new("."));
        let mut builder = tempfile::Builder::new();
        builder.prefix(".gpu-vpl-").suffix(".tmp");
        // As any program creates a file, so that the umask decides; tempfile's default is private.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut files = files();
        // The kind alone: the temporary name that tempfile adds says nothing to the user.
        let file = builder.tempfile_in(directory).map_err(|error| io::Error::from(error.kind()))?;
        files.insert(file.path().to_owned());
        Ok(Self(Some(file)))
    }

    /// The file, for writing.
    pub fn file(&mut self) -> io::Result<&mut std::fs::File> {
        let file = self.0.as_mut().map(NamedTempFile::as_file_mut);
        file.ok_or_else(|| io::Error::other("the temporary file is gone"))
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(file) = self.0.take() {
            let mut files = files();
            files.remove(file.path());
            // It is removed while nobody else may.
            drop(file);
        }
    }
}

/// Moves files to their places: all of them, if one can be.
///
/// # Errors
/// The index of the first that cannot be moved, and why; those before it are removed.
pub fn persist_all(temporary: Vec<(Temporary, &Path)>) -> Result<(), (usize, io::Error)> {
    // Until all are in their places, a process that is told to end waits.
    let mut files = files();
    let mut done: Vec<&Path> = Vec::new();
    for (index, (mut temporary, path)) in temporary.into_iter().enumerate() {
        let Some(file) = temporary.0.take() else { continue };
        files.remove(file.path());
        if let Err(error) = file.persist(path) {
            for path in done {
                // Nothing more can be done about a file that cannot be removed either.
                let _ = std::fs::remove_file(path);
            }
            // What is left is dropped, for which the lock is taken again.
            drop(files);
            return Err((index, error.error));
        }
        done.push(path);
    }
    Ok(())
}

/// Removes all temporary files, for good: no other is made, and none is moved to its place. For a process
/// that ends at once.
pub fn discard_all() {
    let files = files();
    for file in files.iter() {
        let _ = std::fs::remove_file(file);
    }
    std::mem::forget(files);
}
