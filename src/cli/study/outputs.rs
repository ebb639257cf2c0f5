//! The files of a study.

use std::fs;
use std::path::{Path, PathBuf};

use crate::error::{Error, OutputError};
use crate::extremes::table::{self, Report};
use crate::image::Destination;
use crate::image::output::{Staged, commit};
use crate::study::results::{Against, Metric};
use crate::study::{Results, Study, csv, markdown, page, plot, store_in};

/// The page's file name.
pub const PAGE: &str = "study.html";

/// The file name of the extremes' table.
pub const TABLE: &str = "extremes.md";

/// The directory of plots within that of the study.
const PLOTS: &str = "plots";

/// What is plotted of each scene, and how its file is called.
const PLOTTED: [(&str, Metric, Against); 5] = [
    ("relmse", Metric::Relmse, Against::Total),
    ("rmse", Metric::Rmse, Against::Total),
    ("tile-nrmse", Metric::TileNrmse, Against::Total),
    ("flip", Metric::Flip, Against::Total),
    ("clustering", Metric::Nrmse, Against::Clustering),
];

/// A directory and the files in it, found to be writable.
#[derive(Debug)]
pub struct Outputs {
    directory: Directory,
    html: Destination,
    md: Destination,
    csv: Destination,
    json: Destination,
}

impl Outputs {
    /// Makes the directory, if it is not there.
    ///
    /// # Errors
    /// It, or a file in it, cannot be written.
    pub fn check(directory: &Path) -> Result<Self, OutputError> {
        let made = Directory::make(directory)?;
        let file = |name: &str| Destination::check(&directory.join(name));
        Ok(Self {
            directory: made,
            html: file(PAGE)?,
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
    pub fn write(&self, study: &Study, results: &Results) -> Result<(), Error> {
        let pictures = study.pictures(results);
        let mut staged = vec![
            self.html.stage(|out| page::write(out, results, &pictures))?,
            self.md.stage(|out| markdown::write(out, results))?,
            self.csv.stage(|out| csv::write(out, results))?,
            self.json.stage(|out| {
                serde_json::to_writer_pretty(&mut *out, results)?;
                out.write_all(b"\n")
            })?,
        ];
        staged.extend(self.plots(results)?);
        Ok(commit(staged)?)
    }

    fn plots(&self, results: &Results) -> Result<Vec<Staged>, OutputError> {
        let directory = self.directory.name.join(PLOTS);
        fs::create_dir_all(&directory).map_err(|error| OutputError::Write {
            file: directory.clone(),
            why: error.kind().to_string(),
        })?;
        let mut staged = Vec::new();
        for scene in &results.scenes {
            for (name, metric, against) in PLOTTED {
                let Some(svg) = plot::svg(scene, metric, against) else { continue };
                let file = format!("{}-{name}.svg", file_name(&scene.scene));
                let destination = Destination::check(&directory.join(file))?;
                staged.push(destination.stage(|out| out.write_all(svg.as_bytes()))?);
            }
        }
        Ok(staged)
    }
}

/// The files of the extremes.
#[derive(Debug)]
pub struct Tables {
    directory: Directory,
    md: Destination,
    csv: Destination,
    json: Destination,
}

impl Tables {
    /// Makes the directory, if it is not there.
    ///
    /// # Errors
    /// It, or a file in it, cannot be written.
    pub fn check(directory: &Path) -> Result<Self, OutputError> {
        let made = Directory::make(directory)?;
        let file = |name: &str| Destination::check(&directory.join(name));
        Ok(Self {
            directory: made,
            md: file(TABLE)?,
            csv: file("extremes.csv")?,
            json: file("extremes.json")?,
        })
    }

    /// Where figures are kept.
    pub fn store(&self) -> PathBuf {
        store_in(&self.directory.name)
    }

    /// Writes all files, or none.
    ///
    /// # Errors
    /// The disk is full, or gone.
    pub fn write(&self, report: &Report<'_>) -> Result<(), OutputError> {
        commit(vec![
            self.md.stage(|out| table::markdown(out, report))?,
            self.csv.stage(|out| table::csv(out, report))?,
            self.json.stage(|out| {
                serde_json::to_writer_pretty(&mut *out, &table::json(report))?;
                out.write_all(b"\n")
            })?,
        ])
    }
}

/// A scene's name as part of a file's: that of a file without its directory and ending.
fn file_name(scene: &str) -> String {
    let path = Path::new(scene);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    // Most scene files are called alike, and tell themselves apart by their directory.
    let directory = path.parent().and_then(Path::file_name).unwrap_or_default();
    let whole = format!("{} {stem}", directory.to_string_lossy());
    let plain = |c: char| if c.is_alphanumeric() { c } else { '-' };
    whole.trim().chars().map(plain).collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_names_its_plots() {
        assert_eq!(file_name("builtin:cornell"), "builtin-cornell");
        assert_eq!(file_name("../my scenes/box/scene.toml"), "box-scene");
        assert_eq!(file_name("a.toml"), "a");
    }
}
