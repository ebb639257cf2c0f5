//! Files written whole or not at all: checked before the work, staged under a temporary name
//! in the same directory, renamed once everything of a run is staged.

mod temporary;

use std::fs::{self, File};
use std::io::{self, BufWriter, Cursor, Seek, Write};
use std::path::{Path, PathBuf};

use super::OutputError;
pub use temporary::discard_all;
use temporary::{Temporary, persist_all};

/// What an encoder writes to.
pub trait Sink: Write + Seek {}

impl<W: Write + Seek> Sink for W {}

/// The format of an image file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// 8-bit sRGB.
    Png,
    /// 32-bit linear floats.
    Exr,
}

/// Where an output goes, found writable when it was made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Destination {
    /// As the user named it.
    name: PathBuf,
    kind: Kind,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Kind {
    Stdout,
    /// A device or a pipe, which cannot be replaced by a file.
    Direct,
    /// A file by its full path, symbolic links resolved.
    File(PathBuf),
}

impl Destination {
    /// Checks that an output can be written: `-` is standard output, devices and pipes are
    /// written directly, anything else is a file to be made or replaced.
    ///
    /// # Errors
    /// It is a directory, read-only, or its directory is missing or not writable.
    pub fn check(name: &Path) -> Result<Self, OutputError> {
        let kind = if name == Path::new("-") { Kind::Stdout } else { kind_of(name)? };
        if let Kind::File(path) = &kind {
            // Made and removed at once: whether a file can be made here is asked of the system.
            Temporary::beside(path).map_err(|error| cannot_write(name, &error))?;
        }
        Ok(Self { name: name.to_owned(), kind })
    }

    /// The format its name asks for; PNG for what is not a file.
    ///
    /// # Errors
    /// The ending is of no format we write.
    pub fn format(&self) -> Result<Format, OutputError> {
        let extension = self.name.extension().and_then(|extension| extension.to_str());
        match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("png") => Ok(Format::Png),
            Some("exr") => Ok(Format::Exr),
            _ if !self.is_file() => Ok(Format::Png),
            _ => Err(OutputError::UnknownFormat(self.name.clone())),
        }
    }

    /// As the user named it.
    pub fn name(&self) -> &Path {
        &self.name
    }

    /// Whether it is standard output.
    pub fn is_stdout(&self) -> bool {
        self.kind == Kind::Stdout
    }

    /// Whether it is a file, as against standard output, a device or a pipe.
    pub fn is_file(&self) -> bool {
        matches!(self.kind, Kind::File(_))
    }

    /// Whether the other one names the same file, or both are standard output.
    pub fn clashes_with(&self, other: &Self) -> bool {
        self.kind == other.kind && self.kind != Kind::Direct
    }

    /// Encodes the output to a temporary place, from which [`commit`] moves it.
    ///
    /// # Errors
    /// The encoder or the file system refuses; nothing is left behind.
    pub fn stage(
        &self,
        encode: impl FnOnce(&mut dyn Sink) -> io::Result<()>,
    ) -> Result<Staged, OutputError> {
        let content = match &self.kind {
            Kind::Stdout | Kind::Direct => in_memory(encode),
            Kind::File(path) => in_file(path, encode),
        };
        let content = content.map_err(|error| cannot_write(&self.name, &error))?;
        Ok(Staged { destination: self.clone(), content })
    }
}

/// An output that is encoded and waits to be moved to its place. Dropping it removes it.
#[derive(Debug)]
pub struct Staged {
    destination: Destination,
    content: Content,
}

#[derive(Debug)]
enum Content {
    Memory(Vec<u8>),
    File(Temporary, PathBuf),
}

/// Moves all outputs of a run to their places: first what goes to devices and standard output,
/// as that is likelier to fail, then the files.
///
/// # Errors
/// One of them cannot be written; the files moved until then are removed.
pub fn commit(staged: Vec<Staged>) -> Result<(), OutputError> {
    let mut files = Vec::new();
    for Staged { destination, content } in staged {
        match content {
            Content::Memory(bytes) => write_directly(&destination, &bytes)
                .map_err(|error| cannot_write(&destination.name, &error))?,
            Content::File(file, path) => files.push((destination, Some(file), path)),
        }
    }
    let (destinations, moves): (Vec<_>, Vec<_>) = files
        .iter_mut()
        .map(|(destination, file, path)| (destination, (file.take(), &**path)))
        .unzip();
    let moves = moves.into_iter().filter_map(|(file, path)| Some((file?, path))).collect();
    persist_all(moves).map_err(|(index, error)| cannot_write(&destinations[index].name, &error))
}

fn kind_of(name: &Path) -> Result<Kind, OutputError> {
    match fs::metadata(name) {
        Ok(found) if found.is_dir() => Err(refuse(name, "it is a directory; name a file in it")),
        Ok(found) if !found.is_file() => Ok(Kind::Direct),
        // Renaming replaces a read-only file without asking, and root may write it as well.
        Ok(found) if found.permissions().readonly() => {
            Err(refuse(name, "it is read-only; make it writable or name another file"))
        }
        Ok(_) => fs::canonicalize(name).map(Kind::File).map_err(|e| cannot_write(name, &e)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => new_file(name),
        Err(error) => Err(cannot_write(name, &error)),
    }
}

fn new_file(name: &Path) -> Result<Kind, OutputError> {
    let ends_in_slash =
        name.as_os_str().as_encoded_bytes().last().is_some_and(|&b| b == b'/' || b == b'\\');
    let (Some(parent), Some(file), false) = (name.parent(), name.file_name(), ends_in_slash) else {
        return Err(refuse(name, "it names no file; add a file name"));
    };
    let parent = if parent.as_os_str().is_empty() { Path::new(".") } else { parent };
    match fs::canonicalize(parent) {
        Ok(parent) => Ok(Kind::File(parent.join(file))),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let why = format!("the directory {} does not exist; create it first", parent.display());
            Err(refuse(name, &why))
        }
        Err(error) => Err(cannot_write(name, &error)),
    }
}

fn in_memory(encode: impl FnOnce(&mut dyn Sink) -> io::Result<()>) -> io::Result<Content> {
    let mut bytes = Cursor::new(Vec::new());
    encode(&mut bytes)?;
    Ok(Content::Memory(bytes.into_inner()))
}

fn in_file(
    path: &Path,
    encode: impl FnOnce(&mut dyn Sink) -> io::Result<()>,
) -> io::Result<Content> {
    let mut file = Temporary::beside(path)?;
    let mut buffered = BufWriter::new(file.file()?);
    encode(&mut buffered)?;
    buffered.flush()?;
    drop(buffered);
    Ok(Content::File(file, path.to_owned()))
}

fn write_directly(destination: &Destination, bytes: &[u8]) -> io::Result<()> {
    if destination.is_stdout() {
        let mut out = io::stdout().lock();
        out.write_all(bytes)?;
        out.flush()
    } else {
        File::options().write(true).open(&destination.name)?.write_all(bytes)
    }
}

fn cannot_write(name: &Path, error: &io::Error) -> OutputError {
    refuse(name, &error.to_string())
}

fn refuse(name: &Path, why: &str) -> OutputError {
    OutputError::Write { file: name.to_owned(), why: why.to_owned() }
}

#[cfg(test)]
mod tests;
