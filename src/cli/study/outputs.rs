//! The files of a study.

use std::fs;
use std::path::{Path, PathBuf};

use crate::error::{Error, OutputError};
use crate::image::Destination;
use crate::image::output::commit;
use crate::study::{Plan, Results, Study, csv, markdown, store_in};

/// The page's file name.
pub const PAGE: &str = "study.html";

/// A directory and the files in it, found to be writable.
#[derive(Debug)]
pub struct Outputs {
    directory: Directory,
    md: Destination,
    csv: Destination,
    json: Destination,
}

impl Outputs {
    /// Makes the directory, if it is not there.
    ///
    /// # Errors
    /// It, or a file in it, cannot be written.
    pub fn check(directory: &Path, _plan: &Plan) -> Result<Self, OutputError> {
        let made = Directory::make(directory)?;
        let file = |name: &str| Destination::check(&directory.join(name));
        Ok(Self {
            directory: made,
            md: file("study.md")?,
            csv: file("study.csv")?,
            json: file("study.json")?,
        })
    }

    /// Where measurements are kept.
    pub fn store(&self) -> PathBuf {
        store_in(&self.directory.name)
    }

    /// Writes all files, or none.
    ///
    /// # Errors
    /// The disk is full, or gone.
    pub fn write(&self, _study: &Study, results: &Results) -> Result<(), Error> {
        let staged = vec![
            self.md.stage(|out| markdown::write(out, results))?,
            self.csv.stage(|out| csv::write(out, results))?,
            self.json.stage(|out| {
                serde_json::to_writer_pretty(&mut *out, results)?;
                out.write_all(b"\n")
            })?,
        ];
        Ok(commit(staged)?)
    }
}

/// The directory of the outputs; removed again if it was made here and nothing came of it.
#[derive(Debug)]
struct Directory {
    name: PathBuf,
    made: bool,
}

impl Directory {
    fn make(name: &Path) -> Result<Self, OutputError> {
        let refuse = |why: String| OutputError::Write { file: name.to_owned(), why };
        let mut directory = Self { name: name.to_owned(), made: false };
        if name.is_dir() {
            return Ok(directory);
        }
        if fs::symlink_metadata(name).is_ok() {
            return Err(refuse("it is no directory; name one, or one to be made".to_owned()));
        }
        fs::create_dir(name).map_err(|error| refuse(error.kind().to_string()))?;
        directory.made = true;
        Ok(directory)
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        if self.made {
            // A directory with files in it is not removed: nothing came of an empty one.
            let _ = fs::remove_dir(&self.name);
        }
    }
}
