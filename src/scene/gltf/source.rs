//! The file itself: JSON, or a GLB that holds JSON and a buffer; and the buffers.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use encoding_rs::UTF_8;

use super::json::{Buffer, Document};
use super::{extensions, lenient};
use crate::scene::SceneError;
use crate::scene::names::{self, Found};

/// Some writers leave out base64's padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &base64::alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

const TRUNCATED: &str = "the file is truncated; export it again";

/// A document and all its buffers, each as long as the document says.
#[derive(Debug)]
pub struct Source {
    pub path: PathBuf,
    pub document: Document,
    buffers: Vec<Vec<u8>>,
    /// What was read otherwise than it stands.
    pub notes: Vec<String>,
}

impl Source {
    /// Reads the file and its buffers.
    pub fn open(path: &Path) -> Result<Self, SceneError> {
        let bytes = std::fs::read(path).map_err(|error| {
            SceneError::new(path, format!("cannot read it: {error}; check the name and its rights"))
        })?;
        let (json, mut binary) = match bytes.starts_with(b"glTF") {
            true => split_glb(&bytes).map_err(|what| SceneError::new(path, what))?,
            false if is_named_glb(path) => {
                let what = "not a GLB: it does not begin with `glTF`; a JSON file is named .gltf";
                return Err(SceneError::new(path, what));
            }
            false => (&bytes[..], None),
        };
        let mut notes = Vec::new();
        let document = parse(path, json, &mut notes)?;
        let (buffers, of_buffers) = (Vec::new(), Vec::new());
        let mut source = Self { path: path.to_owned(), document, buffers, notes: of_buffers };
        source.check_version()?;
        if let Some(what) = extensions::refused(&source.document) {
            return Err(source.fault(what));
        }
        for (index, buffer) in source.document.buffers.iter().enumerate() {
            // Only the first buffer may be the GLB's own.
            let bytes = source.buffer(index, buffer, binary.take(), &mut notes)?;
            source.buffers.push(bytes);
        }
        source.notes = notes;
        Ok(source)
    }

    /// An error about this file.
    pub fn fault(&self, what: impl Into<String>) -> SceneError {
        SceneError::new(&self.path, what)
    }

    /// A warning's or an error's text, after the file's name.
    pub fn says(&self, what: &str) -> String {
        format!("{}: {what}", self.path.display())
    }

    /// An item of one of the document's lists.
    pub fn item<'a, T>(
        &self,
        list: &'a [T],
        kind: &str,
        index: usize,
    ) -> Result<&'a T, SceneError> {
        list.get(index).ok_or_else(|| {
            self.fault(format!(
                "names {kind} {index}, but there are {}; export it again",
                list.len()
            ))
        })
    }

    /// The bytes of a buffer view, and its stride if it has one.
    pub fn view(&self, index: usize) -> Result<(&[u8], Option<usize>), SceneError> {
        let view = self.item(&self.document.buffer_views, "buffer view", index)?;
        let buffer = self.item(&self.buffers, "buffer", view.buffer)?;
        let end = view.byte_offset.checked_add(view.byte_length);
        let bytes = end.and_then(|end| buffer.get(view.byte_offset..end)).ok_or_else(|| {
            let (number, length) = (view.buffer, buffer.len());
            self.fault(format!(
                "buffer view {index} goes beyond buffer {number} of {length} bytes; export it again"
            ))
        })?;
        Ok((bytes, view.byte_stride))
    }

    fn check_version(&self) -> Result<(), SceneError> {
        let asset = &self.document.asset;
        let version = asset.min_version.as_ref().unwrap_or(&asset.version);
        let known = match asset.min_version {
            Some(_) => version == "2.0",
            None => version == "2" || version.starts_with("2."),
        };
        if known {
            return Ok(());
        }
        Err(self.fault(format!("needs glTF version {version:?}; export it as glTF 2.0")))
    }

    /// The bytes of a buffer: the GLB's own, a data URI's, or those of a file beside this one.
    fn buffer(
        &self,
        index: usize,
        buffer: &Buffer,
        binary: Option<&[u8]>,
        notes: &mut Vec<String>,
    ) -> Result<Vec<u8>, SceneError> {
        let fault = |what: String| self.fault(format!("buffer {index}: {what}"));
        let Buffer { uri, byte_length } = buffer;
        let mut bytes = match (uri, binary) {
            (Some(uri), _) => match uri.strip_prefix("data:") {
                Some(data) => Self::decode(data).map_err(fault)?,
                None => {
                    let (bytes, note) = self.read_beside(uri, *byte_length).map_err(fault)?;
                    notes.extend(note);
                    bytes
                }
            },
            (None, Some(binary)) => binary.to_vec(),
            (None, None) => {
                return Err(fault("neither a URI nor a GLB's buffer; export it again".to_owned()));
            }
        };
        if bytes.len() < *byte_length {
            let there = bytes.len();
            return Err(fault(format!(
                "{there} bytes of {byte_length}: truncated; export it again"
            )));
        }
        bytes.truncate(*byte_length);
        Ok(bytes)
    }

    /// At most `length` bytes of a file.
    fn read_beside(&self, uri: &str, length: usize) -> Result<(Vec<u8>, Option<String>), String> {
        let Found { path, note } = self.beside(uri)?;
        let read = || {
            let mut bytes = Vec::new();
            File::open(&path)?.take(length as u64).read_to_end(&mut bytes)?;
            Ok(bytes)
        };
        let bytes = read().map_err(|error: std::io::Error| {
            format!("cannot read {}: {error}; check its rights", path.display())
        })?;
        Ok((bytes, note))
    }

    /// The file that a URI names.
    pub fn beside(&self, uri: &str) -> Result<Found, String> {
        if uri.contains("://") && !uri.starts_with("file:") {
            return Err(format!("{uri} is not beside this file; download it and export again"));
        }
        let directory = self.path.parent().unwrap_or(Path::new(""));
        // Most writers escape blanks and the like, some do not.
        let plain = unescape(uri);
        let raw = Some(directory.join(uri)).filter(|path| path.is_file());
        let raw = raw.map(|path| Found { path, note: None });
        raw.or_else(|| names::find(directory, &plain, UTF_8).ok()).ok_or_else(|| {
            format!("{} is not there; put it beside this file", directory.join(uri).display())
        })
    }

    /// The bytes of a data URI, after its `data:`.
    pub fn decode(data: &str) -> Result<Vec<u8>, String> {
        let Some((kind, content)) = data.split_once(',') else {
            return Err("its data URI has no comma; export it again".to_owned());
        };
        if !kind.ends_with(";base64") {
            return Err("its data URI is not in base64; export it again".to_owned());
        }
        BASE64
            .decode(content.trim_end())
            .map_err(|error| format!("its data URI is no base64: {error}; export it again"))
    }
}

fn is_named_glb(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("glb"))
}

/// Reads the JSON, by its sense where not by the letter, which is a note. The parser bounds its own
/// depth.
fn parse(path: &Path, json: &[u8], notes: &mut Vec<String>) -> Result<Document, SceneError> {
    let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
    let end = json.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1);
    let error = match serde_json::from_slice(&json[..end]) {
        Ok(document) => return Ok(document),
        Err(error) => error,
    };
    if let Some(document) = lenient::read(json) {
        notes.push(format!("is no strict glTF ({error}); read by its sense"));
        return Ok(document);
    }
    let what = format!("no valid glTF: {error}; export it again");
    match error.line() {
        line if line > 0 && !is_named_glb(path) => Err(SceneError::at(path, line, what)),
        _ => Err(SceneError::new(path, what)),
    }
}

/// The JSON chunk of a GLB, and the binary one where there is one.
fn split_glb(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    let version = word(bytes, 4).ok_or(TRUNCATED)?;
    if version != 2 {
        return Err(format!("a GLB of version {version}; export it as glTF 2.0"));
    }
    let length = word(bytes, 8).ok_or(TRUNCATED)?;
    let there = bytes.len();
    let bytes = bytes
        .get(12..length as usize)
        .ok_or_else(|| format!("its header says {length} bytes, {there} are there: {TRUNCATED}"))?;
    let (kind, json, mut rest) = chunk(bytes)?;
    if kind != *b"JSON" {
        return Err("a GLB that does not begin with its JSON; export it again".to_owned());
    }
    // A chunk of another kind is an extension's; what is too short for one pads the file.
    while !rest.iter().all(|&byte| byte == 0 || byte == b' ') {
        let (kind, content, after) = chunk(rest)?;
        if kind == *b"BIN\0" {
            return Ok((json, Some(content)));
        }
        rest = after;
    }
    Ok((json, None))
}

/// The kind and content of a chunk, and what follows it.
type Chunk<'a> = ([u8; 4], &'a [u8], &'a [u8]);

/// The first chunk.
fn chunk(bytes: &[u8]) -> Result<Chunk<'_>, String> {
    let length = word(bytes, 0).ok_or(TRUNCATED)? as usize;
    let kind = word(bytes, 4).ok_or(TRUNCATED)?.to_le_bytes();
    let (content, rest) = bytes[8..].split_at_checked(length).ok_or(TRUNCATED)?;
    Ok((kind, content, rest))
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|bytes| u32::from_le_bytes(*bytes))
}

/// Replaces %20 and the like.
fn unescape(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, after @ ..] = rest {
        let digits = after.first_chunk::<2>().filter(|_| *first == b'%');
        let code = digits.and_then(|digits| std::str::from_utf8(digits).ok());
        let code = code.and_then(|digits| u8::from_str_radix(digits, 16).ok());
        bytes.push(code.unwrap_or(*first));
        rest = if code.is_some() { &after[2..] } else { after };
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
