//! TOML tables whose faults know their line.

use std::ops::Range;
use std::path::{Path, PathBuf};

use encoding_rs::UTF_8;
use glam::DVec3;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{SceneError, Warning, names};
use crate::scene::Origin;

/// A TOML file.
pub struct Document<'a> {
    pub file: &'a Path,
    text: &'a str,
}

impl<'a> Document<'a> {
    pub fn new(file: &'a Path, text: &'a str) -> Self {
        Self { file, text }
    }

    /// Parses the text.
    pub fn parse(&self) -> Result<DeTable<'a>, SceneError> {
        DeTable::parse(self.text).map(Spanned::into_inner).map_err(|error| {
            let line = self.line(error.span().unwrap_or_default());
            let text = self.text.lines().nth(line - 1).unwrap_or_default();
            let hint = match text.split('"').skip(1).any(|quoted| quoted.contains('\\')) {
                true => "; in double quotes a backslash begins an escape, so write / in names",
                false => "",
            };
            let what = format!("not valid TOML: {}{hint}", error.message());
            SceneError::at(self.file, line, what)
        })
    }

    /// A table of it under a name for messages.
    pub fn section(
        &'a self,
        name: impl Into<String>,
        line: usize,
        table: &'a DeTable<'a>,
    ) -> Section<'a> {
        Section { document: self, name: name.into(), line, table }
    }

    fn line(&self, span: Range<usize>) -> usize {
        let before = self.text.as_bytes().get(..span.start).unwrap_or(self.text.as_bytes());
        1 + before.iter().filter(|&&byte| byte == b'\n').count()
    }
}

/// A table, its name for messages, and the line where it begins.
pub struct Section<'a> {
    document: &'a Document<'a>,
    name: String,
    line: usize,
    table: &'a DeTable<'a>,
}

/// The value of a key.
pub struct Value<'a> {
    document: &'a Document<'a>,
    section: String,
    key: &'a str,
    line: usize,
    value: &'a DeValue<'a>,
}

impl<'a> Section<'a> {
    /// The same table under another name, refusing any key but these.
    pub fn only_as(&self, name: String, known: &[&str]) -> Result<Section<'a>, SceneError> {
        let section = self.document.section(name, self.line, self.table);
        section.only(known)?;
        Ok(section)
    }

    pub fn file(&self) -> &'a Path {
        self.document.file
    }

    pub fn origin(&self) -> Origin {
        Origin::line(self.document.file, self.line)
    }

    /// An error about the whole table.
    pub fn fault(&self, what: impl AsRef<str>) -> SceneError {
        self.origin().error(format!("{}: {}", self.name, what.as_ref()))
    }

    /// Refuses any key but these, naming the first.
    pub fn only(&self, known: &[&str]) -> Result<(), SceneError> {
        let unknown = self.values().filter(|(key, _)| !known.contains(key));
        match unknown.min_by_key(|(_, value)| value.line) {
            None => Ok(()),
            Some((key, value)) => {
                let (name, known) = (&self.name, known.join(", "));
                let what = format!("unknown key `{key}` in {name}; it may hold {known}");
                Err(SceneError::at(self.file(), value.line, what))
            }
        }
    }

    /// All keys and values.
    pub fn values(&self) -> impl Iterator<Item = (&'a str, Value<'a>)> {
        self.table.iter().map(|(key, value)| {
            let value = Value {
                document: self.document,
                section: self.name.clone(),
                key: key.get_ref(),
                line: self.document.line(key.span()),
                value: value.get_ref(),
            };
            (value.key, value)
        })
    }

    /// The value of a key that may be missing.
    pub fn get(&self, key: &str) -> Option<Value<'a>> {
        self.values().find(|(name, _)| *name == key).map(|(_, value)| value)
    }

    /// The value of a key that must be there.
    pub fn required(&self, key: &str) -> Result<Value<'a>, SceneError> {
        self.get(key).ok_or_else(|| self.fault(format!("key `{key}` is missing")))
    }

    /// The tables of an array of tables that may be missing.
    pub fn sections(&self, key: &str) -> Result<Vec<Section<'a>>, SceneError> {
        let Some(value) = self.get(key) else { return Ok(Vec::new()) };
        let name = format!("[[{key}]]");
        let not_tables = || value.fault(&format!("must be tables, each under {name}"));
        let DeValue::Array(items) = value.value else { return Err(not_tables()) };
        let section = |item: &'a Spanned<DeValue<'a>>| match item.get_ref() {
            DeValue::Table(table) => {
                Ok(self.document.section(name.clone(), self.document.line(item.span()), table))
            }
            _ => Err(not_tables()),
        };
        items.iter().map(section).collect()
    }
}

impl<'a> Value<'a> {
    pub fn origin(&self) -> Origin {
        Origin::line(self.document.file, self.line)
    }

    /// An error about this value.
    pub fn fault(&self, what: &str) -> SceneError {
        let Self { document, section, key, line, .. } = self;
        SceneError::at(document.file, *line, format!("{section}: `{key}` {what}"))
    }

    pub fn section(&self, name: &str) -> Result<Section<'a>, SceneError> {
        match self.value {
            DeValue::Table(table) => Ok(self.document.section(name, self.line, table)),
            _ => Err(self.fault("must be a table")),
        }
    }

    pub fn string(&self) -> Result<&'a str, SceneError> {
        match self.value {
            DeValue::String(string) => Ok(string),
            _ => Err(self.fault("must be a string in quotes")),
        }
    }

    /// The file that a string names, from the directory of this one; where it is another than is named,
    /// that is a note. One that is not there is where it would be.
    pub fn path(&self, warnings: &mut Vec<Warning>) -> Result<PathBuf, SceneError> {
        let directory = self.document.file.parent().unwrap_or(Path::new(""));
        Ok(match names::find(directory, self.string()?, UTF_8) {
            Ok(found) => {
                warnings.extend(found.note.map(|note| self.origin().note(note)));
                found.path
            }
            Err(path) => path,
        })
    }

    pub fn boolean(&self) -> Result<bool, SceneError> {
        match self.value {
            DeValue::Boolean(boolean) => Ok(*boolean),
            _ => Err(self.fault("must be true or false")),
        }
    }

    pub fn is_array(&self) -> bool {
        matches!(self.value, DeValue::Array(_))
    }

    /// A finite number, whole or not.
    pub fn number(&self) -> Result<f64, SceneError> {
        number(self.value).ok_or_else(|| self.fault("must be a finite number"))
    }

    /// A number greater than 0.
    pub fn length(&self) -> Result<f64, SceneError> {
        match self.number()? {
            length if length > 0.0 => Ok(length),
            _ => Err(self.fault("must be greater than 0")),
        }
    }

    /// So many finite numbers.
    pub fn numbers<const N: usize>(&self) -> Result<[f64; N], SceneError> {
        numbers(self.value).ok_or_else(|| self.fault(&format!("must be {N} finite numbers")))
    }

    pub fn vector(&self) -> Result<DVec3, SceneError> {
        self.numbers().map(DVec3::from_array)
    }

    /// So many vectors.
    pub fn vectors<const N: usize>(&self) -> Result<[DVec3; N], SceneError> {
        let vectors = || {
            let DeValue::Array(items) = self.value else { return None };
            let vectors = items.iter().map(|item| numbers(item.get_ref()).map(DVec3::from_array));
            vectors.collect::<Option<Vec<_>>>()?.try_into().ok()
        };
        vectors().ok_or_else(|| self.fault(&format!("must be {N} points of 3 finite numbers")))
    }

    /// A radiance or an intensity: finite, and not negative.
    pub fn power(&self) -> Result<DVec3, SceneError> {
        let power = self.vector()?;
        match crate::scene::normalise::is_power(power) {
            true => Ok(power),
            false => Err(self.fault("must not be negative, nor beyond f32")),
        }
    }

    /// A whole number within bounds.
    pub fn count(&self, least: u32, most: u32) -> Result<u32, SceneError> {
        let number = number(self.value).filter(|number| number.fract() == 0.0);
        let within = number.filter(|number| (f64::from(least)..=f64::from(most)).contains(number));
        within
            .map(|number| number as u32)
            .ok_or_else(|| self.fault(&format!("must be a whole number from {least} to {most}")))
    }

    /// A string or number as it would stand on a command line, or a list of them.
    pub fn words(&self) -> Result<Vec<String>, SceneError> {
        let words = match self.value {
            DeValue::Array(items) => items.iter().map(|item| word(item.get_ref())).collect(),
            value => word(value).map(|word| vec![word]),
        };
        let words = words.filter(|words: &Vec<_>| !words.is_empty());
        words.ok_or_else(|| self.fault("must be a string or a number, or a list of these"))
    }

    /// One of the names in a list.
    pub fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Result<T, SceneError> {
        let name = self.string()?;
        let names: Vec<&str> = choices.iter().map(|&(name, _)| name).collect();
        let found = choices.iter().find(|&&(choice, _)| choice == name);
        found
            .map(|&(_, value)| value)
            .ok_or_else(|| self.fault(&format!("is {name:?}, must be one of {}", names.join(", "))))
    }
}

fn word(value: &DeValue) -> Option<String> {
    match value {
        DeValue::String(string) => Some(string.to_string()),
        DeValue::Integer(integer) => Some(integer.as_str().to_owned()),
        DeValue::Float(float) => Some(float.as_str().to_owned()),
        _ => None,
    }
}

fn number(value: &DeValue) -> Option<f64> {
    let number = match value {
        DeValue::Integer(integer) => {
            i64::from_str_radix(integer.as_str(), integer.radix()).ok()? as f64
        }
        DeValue::Float(float) => float.as_str().parse().ok()?,
        _ => return None,
    };
    number.is_finite().then_some(number)
}

fn numbers<const N: usize>(value: &DeValue) -> Option<[f64; N]> {
    let DeValue::Array(items) = value else { return None };
    items.iter().map(|item| number(item.get_ref())).collect::<Option<Vec<_>>>()?.try_into().ok()
}
