//! Text files, as people write them: in any encoding, with any ends of lines.

use std::path::Path;

use chardetng::{EncodingDetector, Iso2022JpDetection, Utf8Detection};
use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

use super::{SceneError, Warning};
use crate::message::location;

/// What pads files, or ends them: NUL, and the Ctrl-Z of DOS.
const PADDING: [char; 2] = ['\0', '\u{1a}'];

/// A text whose lines end in '\n'.
#[derive(Debug)]
pub struct Text {
    /// Without byte order mark and padding.
    pub content: String,
    /// What it was written in.
    pub encoding: &'static Encoding,
}

impl Text {
    /// A note, if it is not in Unicode: what it was taken for is a guess.
    pub fn note(&self, file: &Path) -> Option<Warning> {
        let unicode = [UTF_8, UTF_16LE, UTF_16BE].contains(&self.encoding);
        let message = || {
            let (place, name) = (location(file, None), self.encoding.name());
            format!("{place}: it is not in UTF-8; read as {name}, by a guess")
        };
        (!unicode).then(|| Warning::note(message()))
    }
}

/// Reads a file as text. One that is not in Unicode is taken to be in the encoding `like`, that of a
/// file beside it, so that names in both stay the same, if it can be; else a guess is made.
///
/// # Errors
/// It cannot be read, or is in UTF-32.
pub fn read_text(file: &Path, like: Option<&'static Encoding>) -> Result<Text, SceneError> {
    let bytes = std::fs::read(file).map_err(|error| {
        SceneError::new(file, format!("cannot read it: {error}; check the name and its rights"))
    })?;
    if bytes.starts_with(b"\xff\xfe\0\0") || bytes.starts_with(b"\0\0\xfe\xff") {
        return Err(SceneError::new(file, "a text in UTF-32; save it as UTF-8"));
    }
    let (content, encoding) = decode(&bytes, like);
    let content = content.trim_end_matches(PADDING).replace("\r\n", "\n").replace('\r', "\n");
    Ok(Text { content, encoding })
}

/// The text of some bytes, without a byte order mark, and its encoding.
pub fn decode(bytes: &[u8], like: Option<&'static Encoding>) -> (String, &'static Encoding) {
    let marked = Encoding::for_bom(bytes).map(|(encoding, _)| encoding);
    if let Some(encoding) = marked.or_else(|| wide(bytes)) {
        return (encoding.decode_with_bom_removal(bytes).0.into_owned(), encoding);
    }
    if let Ok(text) = std::str::from_utf8(bytes) {
        return (text.to_owned(), UTF_8);
    }
    let legacy = like.filter(|like| ![UTF_8, UTF_16LE, UTF_16BE].contains(like));
    let guess = || {
        let mut detector = EncodingDetector::new(Iso2022JpDetection::Deny);
        detector.feed(bytes, true);
        detector.guess(None, Utf8Detection::Deny)
    };
    let faithful = |encoding: &'static Encoding| {
        let text = encoding.decode_without_bom_handling_and_without_replacement(bytes)?;
        // Two names must not become one.
        let (back, _, lossy) = encoding.encode(&text);
        (!lossy && *back == *bytes).then(|| (text.into_owned(), encoding))
    };
    let known = legacy.and_then(faithful).or_else(|| faithful(guess()));
    // Which has a character for each byte.
    known.unwrap_or_else(|| {
        (WINDOWS_1252.decode_without_bom_handling(bytes).0.into_owned(), WINDOWS_1252)
    })
}

/// UTF-16 without a byte order mark: of two bytes, one is mostly 0.
fn wide(bytes: &[u8]) -> Option<&'static Encoding> {
    let pairs = bytes.as_chunks::<2>().0;
    let pairs = &pairs[..pairs.len().min(1024)];
    let zeros = |which: usize| pairs.iter().filter(|pair| pair[which] == 0).count();
    let (first, second, most) = (zeros(0), zeros(1), pairs.len() * 3 / 4);
    match pairs.len() {
        0..4 => None,
        _ if second >= most && first == 0 => Some(UTF_16LE),
        _ if first >= most && second == 0 => Some(UTF_16BE),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn utf16(text: &str, mark: bool, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
        let mark = mark.then_some(0xfeff);
        mark.into_iter().chain(text.encode_utf16()).flat_map(bytes).collect()
    }

    #[test]
    fn unicode_is_read_with_and_without_a_mark() {
        let text = "v 1 2 3 # Würfel\n";
        for mark in [true, false] {
            assert_eq!(decode(&utf16(text, mark, u16::to_le_bytes), None).0, text);
            assert_eq!(decode(&utf16(text, mark, u16::to_be_bytes), None).0, text);
        }
        assert_eq!(decode(format!("\u{feff}{text}").as_bytes(), None).0, text);
        assert_eq!(decode(text.as_bytes(), None), (text.to_owned(), UTF_8));
        assert_eq!(decode(b"\0\0\0\0\0\0\0\0", None).1, UTF_8);
    }

    #[test]
    fn other_bytes_keep_their_differences() {
        let (one, two) = (b"usemtl \xba\xec\xc6\xe1", b"usemtl \xc0\xb6\xc6\xe1");
        assert_ne!(decode(one, None).0, decode(two, None).0);
        assert_eq!(decode(b"Gr\xf6\xdfe des Stuhls", None).0, "Größe des Stuhls");
        assert_eq!(decode(one, Some(encoding_rs::GBK)).0, "usemtl 红漆");
        // No encoding has these bytes.
        assert_ne!(decode(b"\xff\x81", None).0, decode(b"\xff\x8d", None).0);
    }
}
