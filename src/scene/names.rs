//! The files that a file names, found by one rule: a name is tried
//!
//! 1. as it stands, from the directory of the file that names it;
//! 2. with `/` for `\`, without quotes, and with what an escape made of a `\` undone;
//! 3. as its bytes stand, or in another encoding of them;
//! 4. with letters of any case, and however accents are composed;
//! 5. without the directories that lead to it, one after the other: last, beside the file.
//!
//! What is found by more than 2 is told.

use std::path::{Path, PathBuf};

use encoding_rs::{BIG5, EUC_JP, EUC_KR, Encoding, GBK, SHIFT_JIS, UTF_8, WINDOWS_1252};
use unicode_normalization::UnicodeNormalization as _;

/// Other encodings that a name's bytes may be in.
const ENCODINGS: [&Encoding; 7] = [UTF_8, GBK, SHIFT_JIS, BIG5, EUC_KR, EUC_JP, WINDOWS_1252];

/// A file that a name was found to mean.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// The file.
    pub path: PathBuf,
    /// That it is another than the name says by the letter, if it is.
    pub note: Option<String>,
}

impl Found {
    fn as_named(path: PathBuf) -> Self {
        Self { path, note: None }
    }

    fn instead(name: &str, path: PathBuf) -> Self {
        let note = format!("`{name}` is not there; {} is read", path.display());
        Self { path, note: Some(note) }
    }
}

/// The file of a name, as a text in `encoding` has it.
///
/// # Errors
/// There is none: where it would be.
pub fn find(directory: &Path, name: &str, encoding: &'static Encoding) -> Result<Found, PathBuf> {
    let names = spellings(name);
    let there = |name: &String| Some(directory.join(name)).filter(|path| path.is_file());
    if let Some(path) = names.iter().find_map(there) {
        return Ok(Found::as_named(path));
    }
    let slashed = names.last().cloned().unwrap_or_default();
    let recoded = recoded(&slashed, encoding);
    #[cfg(unix)]
    if let Some(path) = as_bytes(directory, &slashed, encoding) {
        return Ok(Found::as_named(path));
    }
    if let Some(path) = recoded.iter().find_map(there) {
        return Ok(Found::instead(name, path));
    }
    let all: Vec<String> = std::iter::once(slashed.clone()).chain(recoded).collect();
    let alike = |name: &String| any_case(&directory.join(name));
    let shorter = |name: &String| tails(name).find_map(|tail| alike(&tail));
    let found = all.iter().find_map(alike).or_else(|| all.iter().find_map(shorter));
    found.map(|path| Found::instead(name, path)).ok_or_else(|| directory.join(slashed))
}

/// A name as it stands, and as it was meant.
fn spellings(name: &str) -> Vec<String> {
    let plain = name.trim().trim_matches('"');
    let plain = plain.strip_prefix("file://").unwrap_or(plain);
    // Strings of some formats make these of `\b`, `\t`, `\n`, `\f`, `\r` and `\e`.
    let escapes = [
        ('\u{8}', "\\b"),
        ('\t', "\\t"),
        ('\n', "\\n"),
        ('\u{c}', "\\f"),
        ('\r', "\\r"),
        ('\u{1b}', "\\e"),
    ];
    let unescaped =
        escapes.iter().fold(plain.to_owned(), |name, (made, of)| name.replace(*made, of));
    let mut names = vec![name.to_owned()];
    for spelling in [plain.to_owned(), unescaped.replace('\\', "/")] {
        if !names.contains(&spelling) {
            names.push(spelling);
        }
    }
    names
}

/// A name that is not in ASCII, its bytes taken to be in other encodings.
fn recoded(name: &str, encoding: &'static Encoding) -> Vec<String> {
    if name.is_ascii() {
        return Vec::new();
    }
    let (bytes, ..) = encoding.encode(name);
    let decoded = ENCODINGS
        .iter()
        .filter_map(|e| e.decode_without_bom_handling_and_without_replacement(&bytes));
    decoded.map(std::borrow::Cow::into_owned).filter(|other| other != name).collect()
}

/// The file whose name has the bytes that the text has.
#[cfg(unix)]
fn as_bytes(directory: &Path, name: &str, encoding: &'static Encoding) -> Option<PathBuf> {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt as _;
    let (bytes, _, lossy) = encoding.encode(name);
    let path = directory.join(OsStr::from_bytes(&bytes));
    (!lossy && path.is_file()).then_some(path)
}

/// What is left of a name without the first, the first two directories and so on.
fn tails(name: &str) -> impl Iterator<Item = String> {
    let parts: Vec<String> = name
        .split('/')
        .filter(|part| !part.is_empty() && *part != ".")
        .map(str::to_owned)
        .collect();
    (1..parts.len()).filter_map(move |first| {
        let tail = &parts[first..];
        (!tail.iter().any(|part| part == "..")).then(|| tail.join("/"))
    })
}

/// The file at a path whose letters may be of the other case. Of several, the first by name.
fn any_case(path: &Path) -> Option<PathBuf> {
    if path.is_file() {
        return Some(path.to_owned());
    }
    let mut at = PathBuf::new();
    for part in path.components() {
        let next = at.join(part);
        if next.exists() || !matches!(part, std::path::Component::Normal(_)) {
            at = next;
            continue;
        }
        let wanted = folded(&part.as_os_str().to_string_lossy());
        let here = if at.as_os_str().is_empty() { Path::new(".") } else { &at };
        let entries = std::fs::read_dir(here).ok()?.flatten().map(|entry| entry.file_name());
        let alike = entries.filter(|entry| folded(&entry.to_string_lossy()) == wanted);
        at.push(alike.min()?);
    }
    at.is_file().then_some(at)
}

/// The same for names that differ in case, or in how accents are composed.
fn folded(name: &str) -> String {
    name.nfc().flat_map(char::to_lowercase).collect()
}
