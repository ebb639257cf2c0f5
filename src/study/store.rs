//! What is measured already, kept on disk so that a study goes on where it was broken off.

use std::collections::HashMap;
use std::fs::{self, File, OpenOptions};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::Measured;
use crate::image::exr::{self, Plane};
use crate::image::{Destination, Image, OutputError, read};

/// A directory of measurements, a line each, and of images in full precision.
#[derive(Debug)]
pub struct Store<M = Measured> {
    directory: PathBuf,
    log: File,
    measured: HashMap<String, M>,
}

/// A line of the log.
#[derive(Debug, Serialize, Deserialize)]
struct Line<K, M> {
    key: K,
    measured: M,
}

/// What stands beside an image, so that a changed one is noticed.
#[derive(Debug, Serialize, Deserialize)]
struct Seal {
    hash: String,
}

const LOG: &str = "measured.jsonl";
const IMAGES: &str = "images";

/// The place of what is kept within the directory of a study.
pub fn store_in(directory: &Path) -> PathBuf {
    directory.join("measured")
}

impl<M: Serialize + DeserializeOwned> Store<M> {
    /// Opens a directory, made if it is not there; `fresh` forgets what it holds.
    ///
    /// # Errors
    /// It cannot be written, or the log not be read.
    pub fn open(directory: &Path, fresh: bool) -> Result<Self, OutputError> {
        let refuse = |error: io::Error| OutputError::Write {
            file: directory.to_owned(),
            why: error.to_string(),
        };
        let log = directory.join(LOG);
        if fresh && log.exists() {
            fs::remove_file(&log).map_err(refuse)?;
            let images = directory.join(IMAGES);
            if images.exists() {
                fs::remove_dir_all(&images).map_err(refuse)?;
            }
        }
        fs::create_dir_all(directory).map_err(refuse)?;
        let mut log =
            OpenOptions::new().read(true).append(true).create(true).open(log).map_err(refuse)?;
        let mut text = Vec::new();
        log.read_to_end(&mut text).map_err(refuse)?;
        if text.last().is_some_and(|last| *last != b'\n') {
            // The last line was cut off; it is measured again.
            log.write_all(b"\n").map_err(refuse)?;
        }
        let measured = lines(&text).map(|line| (line.key, line.measured)).collect();
        Ok(Self { directory: directory.to_owned(), log, measured })
    }

    /// What was measured under a key.
    pub fn get(&self, key: &str) -> Option<&M> {
        self.measured.get(key)
    }

    /// Keeps a measurement.
    ///
    /// # Errors
    /// The disk is full, or gone.
    pub fn put(&mut self, key: &str, measured: M) -> Result<(), OutputError> {
        let refuse = |error: io::Error| OutputError::Write {
            file: self.directory.join(LOG),
            why: error.to_string(),
        };
        let mut line = serde_json::to_vec(&Line { key, measured: &measured })
            .map_err(|error| refuse(error.into()))?;
        line.push(b'\n');
        self.log.write_all(&line).and_then(|()| self.log.sync_data()).map_err(refuse)?;
        self.measured.insert(key.to_owned(), measured);
        Ok(())
    }

    /// An image kept under a name; none if it is not there, or is not what was kept.
    pub fn image(&self, name: &str) -> Option<Image> {
        let image = read(&self.file(name, "exr")).ok()?;
        let seal: Seal = serde_json::from_slice(&fs::read(self.file(name, "json")).ok()?).ok()?;
        (seal.hash == hash_of_image(&image)).then_some(image)
    }

    /// Whether there is an image of that name, sound or not.
    pub fn has_image(&self, name: &str) -> bool {
        self.file(name, "json").exists()
    }

    /// Keeps an image, bit for bit.
    ///
    /// # Errors
    /// The disk is full, or gone.
    pub fn put_image(&self, name: &str, image: &Image) -> Result<(), OutputError> {
        let directory = self.directory.join(IMAGES);
        fs::create_dir_all(&directory).map_err(|error| OutputError::Write {
            file: directory.clone(),
            why: error.kind().to_string(),
        })?;
        let planes = [Plane { layer: "", channels: "RGB", image }];
        let file = Destination::check(&self.file(name, "exr"))?
            .stage(|out| exr::write(out, &planes, &Vec::new()))?;
        let seal = Seal { hash: hash_of_image(image) };
        let seal = Destination::check(&self.file(name, "json"))?
            .stage(|out| Ok(serde_json::to_writer(out, &seal)?))?;
        crate::image::output::commit(vec![file, seal])
    }

    /// Forgets an image; no matter if there is none.
    pub fn remove_image(&self, name: &str) {
        for ending in ["json", "exr"] {
            // A file that stays behind takes room and does no harm.
            let _ = fs::remove_file(self.file(name, ending));
        }
    }

    fn file(&self, name: &str, ending: &str) -> PathBuf {
        self.directory.join(IMAGES).join(format!("{name}.{ending}"))
    }
}

impl<M> Drop for Store<M> {
    /// A store in which nothing was ever kept leaves nothing behind.
    fn drop(&mut self) {
        let log = self.directory.join(LOG);
        if fs::metadata(&log).is_ok_and(|log| log.len() == 0) {
            // What cannot be removed, a directory that holds images first of all, stays.
            let images = self.directory.join(IMAGES);
            let _ = fs::remove_dir(&images);
            if !images.exists() {
                let _ = fs::remove_file(log).and_then(|()| fs::remove_dir(&self.directory));
            }
        }
    }
}

/// The lines that can be read; others are of another version, or were cut off.
fn lines<M: DeserializeOwned>(text: &[u8]) -> impl Iterator<Item = Line<String, M>> {
    text.split(|byte| *byte == b'\n').filter_map(|line| serde_json::from_slice(line).ok())
}

/// A name for what has a key, of 16 letters.
pub fn name_of(key: &impl Hash) -> String {
    // This hash differs from one version of the program to another, as keys do.
    let mut hasher = DefaultHasher::new();
    key.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

/// A name for this build of the program, as figures depend on all of it.
pub fn name_of_program() -> String {
    name_of(&std::env::current_exe().and_then(fs::read).unwrap_or_default())
}

/// A name for the bits of an image.
pub fn hash_of_image(image: &Image) -> String {
    let bits: &[u32] = bytemuck::cast_slice(&image.pixels);
    name_of(&(image.width, image.height, bits))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::FrameTimes;

    #[test]
    fn what_is_kept_is_there_again_whatever_was_cut_off() {
        let place = tempfile::tempdir().unwrap();
        let measured = Measured {
            times: FrameTimes { seconds: 0.1 + 0.2, ..FrameTimes::default() },
            ..Measured::default()
        };
        let mut store: Store = Store::open(place.path(), false).unwrap();
        store.put("a", measured.clone()).unwrap();
        store.put("b", Measured::default()).unwrap();
        let log = place.path().join(LOG);
        let text = fs::read(&log).unwrap();
        fs::write(&log, &text[..text.len() - 9]).unwrap();
        let mut store: Store = Store::open(place.path(), false).unwrap();
        assert_eq!((store.get("a"), store.get("b")), (Some(&measured), None));
        store.put("c", measured.clone()).unwrap();
        let store = Store::open(place.path(), false).unwrap();
        assert_eq!((store.get("a"), store.get("c")), (Some(&measured), Some(&measured)));
        assert_eq!(Store::<Measured>::open(place.path(), true).unwrap().get("a"), None);
        let nothing = place.path().join("nothing");
        drop(Store::<Measured>::open(&nothing, false).unwrap());
        assert!(!nothing.exists());
    }

    #[test]
    fn an_image_that_was_changed_is_noticed() {
        let place = tempfile::tempdir().unwrap();
        let store: Store = Store::open(place.path(), false).unwrap();
        let mut image = Image { width: 2, height: 1, pixels: vec![[0.1, 1e-8, 3e5], [0.0; 3]] };
        store.put_image("x", &image).unwrap();
        assert_eq!(store.image("x").as_ref(), Some(&image));
        image.pixels[0][0] *= 1.01;
        let other: Store = Store::open(&place.path().join("other"), false).unwrap();
        other.put_image("x", &image).unwrap();
        fs::copy(other.file("x", "exr"), store.file("x", "exr")).unwrap();
        assert_eq!(store.image("x"), None);
        assert!(store.has_image("x"));
        store.remove_image("x");
        assert!(!store.has_image("x"));
    }
}
