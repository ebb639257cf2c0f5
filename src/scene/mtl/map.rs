//! The statements of MTL that name an image: options, then the rest of the line.

use std::path::{Path, PathBuf};

use encoding_rs::{Encoding, UTF_8};
use glam::DVec2;

use super::statement::Statement;
use crate::scene::{Origin, SceneError, Texture, Warning, Wrap, names};

/// An image, and how it is laid on.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// The statement, as it is written.
    pub keyword: String,
    pub line: usize,
    /// As it is written, and a comment.
    file: String,
    /// Coordinates from the bottom left, as the file has them, are multiplied by the one, and
    /// moved by the other.
    scale: DVec2,
    offset: DVec2,
    clamp: bool,
    /// Options that would change the image.
    pub ignored: Vec<String>,
}

/// What follows an option.
#[derive(Clone, Copy)]
enum Values {
    /// From so many numbers to so many.
    Numbers(usize, usize),
    Word,
}

const OPTIONS: [(&str, Values); 14] = [
    ("-o", Values::Numbers(1, 3)),
    ("-s", Values::Numbers(1, 3)),
    ("-t", Values::Numbers(1, 3)),
    ("-mm", Values::Numbers(1, 2)),
    ("-bm", Values::Numbers(1, 1)),
    ("-boost", Values::Numbers(1, 1)),
    ("-texres", Values::Numbers(1, 1)),
    ("-blendu", Values::Word),
    ("-blendv", Values::Word),
    ("-cc", Values::Word),
    ("-clamp", Values::Word),
    ("-imfchan", Values::Word),
    ("-type", Values::Word),
    ("-colorspace", Values::Word),
];

impl Map {
    /// Reads a statement; none if it names no file.
    pub fn parse(statement: &Statement) -> Result<Option<Self>, SceneError> {
        let mut map = Self {
            keyword: statement.keyword.to_owned(),
            line: statement.line,
            file: String::new(),
            scale: DVec2::ONE,
            offset: DVec2::ZERO,
            clamp: false,
            ignored: Vec::new(),
        };
        let after = statement.content.trim_start().get(statement.keyword.len()..);
        let mut rest = after.unwrap_or_default().trim();
        while let Some((name, values, after)) = option(rest) {
            rest = map.take(statement, name, values, after)?;
        }
        map.file = rest.to_owned();
        Ok((!without_comment(rest).is_empty()).then_some(map))
    }

    /// Takes the values of an option, and gives what follows them. The last word is always
    /// the file's.
    fn take<'a>(
        &mut self,
        statement: &Statement,
        name: &str,
        values: Values,
        mut rest: &'a str,
    ) -> Result<&'a str, SceneError> {
        let mut numbers = Vec::new();
        let mut word = "";
        match values {
            Values::Word => {
                if let Some((first, after)) = split_word(rest) {
                    (word, rest) = (first, after);
                }
            }
            Values::Numbers(least, most) => {
                while let Some((first, after)) = split_word(rest).filter(|_| numbers.len() < most) {
                    let Ok(number) = first.parse::<f64>() else { break };
                    numbers.push(number);
                    rest = after;
                }
                if numbers.len() < least || numbers.iter().any(|number| !number.is_finite()) {
                    return Err(statement.fault(&format!("has an option {name} without a number")));
                }
            }
        }
        self.apply(name, &numbers, word);
        Ok(rest)
    }

    /// Filtering, resolution and the strength of bumps are nothing that is shown.
    fn apply(&mut self, name: &str, numbers: &[f64], word: &str) {
        let number = |i: usize, default: f64| numbers.get(i).copied().unwrap_or(default);
        let changes = match name {
            "-o" => {
                self.offset = DVec2::new(number(0, 0.0), number(1, 0.0));
                false
            }
            "-s" => {
                self.scale = DVec2::new(number(0, 1.0), number(1, 1.0));
                false
            }
            "-clamp" => {
                self.clamp = word.eq_ignore_ascii_case("on");
                false
            }
            "-mm" => [number(0, 0.0), number(1, 1.0)] != [0.0, 1.0],
            "-t" => numbers.iter().any(|&number| number != 0.0),
            "-cc" => word.eq_ignore_ascii_case("on"),
            "-imfchan" => {
                !(self.keyword.eq_ignore_ascii_case("map_d") && word.eq_ignore_ascii_case("m"))
            }
            "-boost" => number(0, 0.0) != 0.0,
            "-colorspace" => !word.eq_ignore_ascii_case("srgb"),
            "-type" => true,
            _ => false,
        };
        if changes {
            self.ignored.push(name.to_owned());
        }
    }

    /// The image's file, from the library that names it; a comment may follow the name, or be part of
    /// it. Where another file is meant than is named, that is a note.
    pub fn path(
        &self,
        library: &Path,
        encoding: Option<&'static Encoding>,
        warnings: &mut Vec<Warning>,
    ) -> PathBuf {
        let directory = library.parent().unwrap_or(Path::new(""));
        let whole = directory.join(&self.file);
        if whole.is_file() {
            return whole;
        }
        let name = without_comment(&self.file);
        match names::find(directory, name, encoding.unwrap_or(UTF_8)) {
            Ok(found) => {
                let origin = Origin::line(library, self.line);
                let note = found.note.map(|note| origin.note(note));
                warnings.extend(note.filter(|note| !warnings.contains(note)));
                found.path
            }
            Err(path) => path,
        }
    }

    /// The texture of the image, whose coordinates are from the top left.
    pub fn texture(&self, image: u32) -> Texture {
        let wrap = if self.clamp { Wrap::Clamp } else { Wrap::Repeat };
        let offset = DVec2::new(self.offset.x, 1.0 - self.offset.y - self.scale.y);
        let (scale, offset) = (self.scale.as_vec2(), offset.as_vec2());
        Texture { wrap: [wrap; 2], scale, offset, ..Texture::of(image) }
    }
}

/// The option that a text begins with, and what follows it.
fn option(text: &str) -> Option<(&'static str, Values, &str)> {
    let (word, rest) = split_word(text)?;
    let known = OPTIONS.iter().find(|(name, _)| word.eq_ignore_ascii_case(name));
    known.map(|&(name, values)| (name, values, rest))
}

/// The first word of a text and the rest, which must not be empty.
fn split_word(text: &str) -> Option<(&str, &str)> {
    let (word, rest) = text.split_once(char::is_whitespace)?;
    Some((word, rest.trim_start()))
}

/// A comment begins with a word; a name may hold what looks like one.
fn without_comment(text: &str) -> &str {
    let mut starts = text.match_indices('#').map(|(at, _)| &text[..at]);
    let comment = starts.find(|before| before.is_empty() || before.ends_with(char::is_whitespace));
    comment.unwrap_or(text).trim_end()
}
