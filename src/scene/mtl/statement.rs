//! A line of MTL, taken apart.

use std::path::Path;

use glam::DVec3;

use crate::scene::SceneError;

/// A line of the file.
pub struct Statement<'a> {
    pub file: &'a Path,
    pub line: usize,
    pub keyword: &'a str,
    pub words: Vec<&'a str>,
    /// The whole line.
    pub content: &'a str,
}

impl Statement<'_> {
    pub fn is_colour(&self) -> bool {
        ["kd", "ks", "ke"].contains(&self.lowercase().as_str())
    }

    pub fn lowercase(&self) -> String {
        self.keyword.to_ascii_lowercase()
    }

    /// A number; some writers have a comma for the point.
    pub fn number(&self, index: usize) -> Result<f64, SceneError> {
        let word = self.words.get(index).copied().unwrap_or_default();
        let number = word.parse().or_else(|_| word.replacen(',', ".", 1).parse());
        let number = number.ok().filter(|x: &f64| x.is_finite());
        number.ok_or_else(|| self.fault("is followed by no number"))
    }

    /// One number for all channels, or three.
    pub fn colour(&self) -> Result<DVec3, SceneError> {
        match self.words[..] {
            ["spectral" | "xyz", ..] => {
                Err(self.fault("gives a spectrum or XYZ, which is not supported; give r g b"))
            }
            [_] => Ok(DVec3::splat(self.number(0)?)),
            [_, _, _, ..] => Ok(DVec3::new(self.number(0)?, self.number(1)?, self.number(2)?)),
            _ => Err(self.fault("needs three numbers r g b")),
        }
    }

    pub fn fault(&self, what: &str) -> SceneError {
        let Self { file, line, keyword, words, .. } = self;
        SceneError::at(*file, *line, format!("`{keyword} {}`: {keyword} {what}", words.join(" ")))
    }
}
