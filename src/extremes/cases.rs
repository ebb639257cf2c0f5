//! Rows and cases as data.

use std::collections::{BTreeMap, HashSet};

use serde::Deserialize;
use toml::{Table, Value};

use super::Bake;

/// The rows and cases of this program.
pub const CASES: &str = include_str!("../../tests/extremes/cases.toml");

/// Rows, the scenes that cases share, and the cases, families taken apart.
#[derive(Debug, Clone, Default)]
pub struct Cases {
    /// What may go wrong.
    pub rows: Vec<Row>,
    /// By name.
    pub scenes: BTreeMap<String, SceneText>,
    /// What shows that it does not.
    pub cases: Vec<Case>,
}

/// Something that goes wrong in renderers.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// What cases call it.
    pub name: String,
    /// What it is about.
    pub about: String,
    /// What goes wrong, or what is expected.
    pub wrong: String,
    /// What is done about it.
    pub treatment: String,
}

/// A scene file and the meshes that it names, with `$placeholders`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneText {
    /// The scene file.
    pub toml: String,
    /// Files beside it: OBJ and MTL text.
    #[serde(default)]
    pub files: BTreeMap<String, String>,
    /// OBJ files beside it that are made: the name of a shape and its numbers.
    #[serde(default)]
    pub shapes: BTreeMap<String, String>,
    /// What its placeholders are if a case does not say.
    #[serde(default)]
    pub set: Table,
}

/// A scene, how it is rendered, and what the image must be; or a check in Rust.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Its name, apart from all others.
    pub name: String,
    /// The row that it belongs to.
    pub row: String,
    /// One of [`super::checks::CHECKS`], which says all that remains.
    pub check: Option<String>,
    /// One of [`Cases::scenes`].
    #[serde(default)]
    pub scene: String,
    /// What the placeholders of scene and case are.
    #[serde(default)]
    pub set: Table,
    /// How the coordinates of the scene's text are changed.
    #[serde(default)]
    pub bake: Bake,
    /// The methods; names of `--method`, or of variants of them.
    #[serde(default)]
    pub methods: Vec<String>,
    /// Options of `render`.
    #[serde(default)]
    pub options: String,
    /// Options for publication, before those above.
    #[serde(default)]
    pub full: String,
    /// What is otherwise for a method.
    #[serde(default)]
    pub of: BTreeMap<String, Own>,
    /// What a warning must hold.
    pub warns: Option<String>,
    /// What the image must be.
    pub expect: Option<Expect>,
    /// The part that counts, of the whole's width and height: left, top, right, bottom.
    pub region: Option<[f64; 4]>,
    /// Where the expectation comes from.
    #[serde(default)]
    pub from: String,
    /// How far the image may be off, relative to what is expected.
    #[serde(default)]
    pub within: f64,
    /// Why so far.
    #[serde(default)]
    pub because: String,
}

/// What is otherwise for a method.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Own {
    /// Further options.
    #[serde(default)]
    pub options: String,
    /// Further options for publication.
    #[serde(default)]
    pub full: String,
    /// Another tolerance.
    pub within: Option<f64>,
}

/// What an image must be.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Expect {
    /// In the mean over its pixels.
    Mean(Radiance),
    /// At each of its pixels.
    EveryPixel(Radiance),
    /// The mean of each tile of 16 × 16 pixels.
    EveryTile(Radiance),
    /// 0 everywhere.
    Black,
    /// A number everywhere.
    Finite,
    /// Like another one.
    Like(Like),
    /// None: the scene or an option is refused, with an error that holds this.
    Refused(String),
}

/// A radiance.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Radiance {
    /// The same in all channels.
    Grey(f64),
    /// For each channel.
    Color([f64; 3]),
}

impl Radiance {
    /// For each channel.
    pub fn channels(self) -> [f64; 3] {
        match self {
            Self::Grey(value) => [value; 3],
            Self::Color(values) => values,
        }
    }
}

/// Another image, the same but for what is given, and how near to it the image must be.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Like {
    /// Another scene.
    pub scene: Option<String>,
    /// Other placeholders.
    #[serde(default)]
    pub set: Table,
    /// Otherwise baked; as it is, if there is nothing.
    #[serde(default)]
    pub bake: Bake,
    /// Another method.
    pub method: Option<String>,
    /// Further options.
    #[serde(default)]
    pub options: String,
    /// Further options for publication.
    #[serde(default)]
    pub full: String,
    /// Left and right are swapped.
    #[serde(default)]
    pub mirrored: bool,
    /// The most that the mean FLIP may be.
    pub flip: Option<f64>,
    /// The most that the means may differ by, relative to the other's.
    pub mean: Option<f64>,
    /// The most that any pixel may differ by, relative to the other's mean.
    pub pixel: Option<f64>,
}

/// The file, before families are taken apart.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    row: Vec<Row>,
    scenes: BTreeMap<String, SceneText>,
    case: Vec<Table>,
}

impl Cases {
    /// Reads rows and cases. Of a case with `vary`, a list of what to set, there is one for each
    /// entry.
    ///
    /// # Errors
    /// What is wrong with which case.
    pub fn parse(text: &str) -> Result<Self, String> {
        let file: File = toml::from_str(text).map_err(|error| error.to_string())?;
        let mut cases = Vec::new();
        for mut table in file.case {
            let name = table.get("name").and_then(Value::as_str).unwrap_or("a case").to_owned();
            let fault = |what: String| format!("{name}: {what}");
            let mut members = vec![Table::new()];
            if let Some(vary) = table.remove("vary") {
                members = vary.try_into().map_err(|error| fault(format!("vary: {error}")))?;
            }
            for member in members {
                cases.push(case(&table, member).map_err(fault)?);
            }
        }
        let mut names = HashSet::new();
        match cases.iter().find(|case| !names.insert(&case.name)) {
            Some(Case { name, .. }) => Err(format!("{name}: two cases have this name")),
            None => Ok(Self { rows: file.row, scenes: file.scenes, cases }),
        }
    }
}

/// A case of a family.
fn case(family: &Table, member: Table) -> Result<Case, String> {
    let mut set = match family.get("set") {
        Some(set) => set.clone().try_into().map_err(|error| format!("set: {error}"))?,
        None => Table::new(),
    };
    set.extend(member);
    // What is set may hold placeholders of the others.
    let others = set.clone();
    for value in set.iter_mut().map(|(_, value)| value) {
        *value = filled(value, &others)?;
    }
    let mut table = family.clone();
    table.insert("set".to_owned(), Value::Table(Table::new()));
    let mut value = filled(&Value::Table(table), &set)?;
    if let Some(table) = value.as_table_mut() {
        table.insert("set".to_owned(), Value::Table(set));
    }
    value.try_into().map_err(|error: toml::de::Error| error.message().to_owned())
}

/// A value whose placeholders are filled in. A string that is nothing but one becomes what it
/// stands for.
///
/// # Errors
/// One of them is not set.
pub fn filled(value: &Value, set: &Table) -> Result<Value, String> {
    Ok(match value {
        Value::String(text) => match text.strip_prefix('$').and_then(|name| set.get(name)) {
            Some(whole) => whole.clone(),
            None => Value::String(fill(text, set)?),
        },
        Value::Array(items) => {
            Value::Array(items.iter().map(|item| filled(item, set)).collect::<Result<_, _>>()?)
        }
        Value::Table(table) => {
            let entry = |(key, value): (&String, &Value)| Ok((key.clone(), filled(value, set)?));
            Value::Table(table.iter().map(entry).collect::<Result<_, String>>()?)
        }
        other => other.clone(),
    })
}

/// A text whose placeholders are filled in.
///
/// # Errors
/// One of them is not set.
pub fn fill(text: &str, set: &Table) -> Result<String, String> {
    let mut parts = text.split('$');
    let mut filled = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        let (name, rest) = part.split_at(end.unwrap_or(part.len()));
        match set.get(name) {
            Some(Value::String(text)) => filled += text,
            Some(value) => filled += &value.to_string(),
            None => return Err(format!("${name} is not set")),
        }
        filled += rest;
    }
    Ok(filled)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_family_is_taken_apart_and_its_placeholders_filled_in() {
        let text = r#"
            row = []
            [scenes]
            [[case]]
            name = "albedo $a"
            row = "r"
            set = { b = 2 }
            vary = [{ a = 0.5, l = 3 }, { a = 1.0, l = [1, 2, 3] }]
            bake = { scale = "$a" }
            options = "--bounces $b"
            expect = { mean = "$l" }
        "#;
        let cases = Cases::parse(text).unwrap().cases;
        assert_eq!((cases[0].name.as_str(), cases[1].name.as_str()), ("albedo 0.5", "albedo 1.0"));
        assert_eq!((cases[0].bake.scale, cases[0].options.as_str()), (0.5, "--bounces 2"));
        assert_eq!(cases[0].expect, Some(Expect::Mean(Radiance::Grey(3.0))));
        assert_eq!(cases[1].expect, Some(Expect::Mean(Radiance::Color([1.0, 2.0, 3.0]))));
        assert_eq!(fill("a $b, $c.", &cases[0].set).unwrap_err(), "$c is not set");
        let unknown = text.replace("$l", "$x");
        assert_eq!(Cases::parse(&unknown).unwrap_err(), "albedo $a: $x is not set");
        let key = text.replace("options", "option");
        assert!(Cases::parse(&key).unwrap_err().contains("unknown field `option`"));
        let twice = text.replace("albedo $a", "albedo");
        assert_eq!(Cases::parse(&twice).unwrap_err(), "albedo: two cases have this name");
    }
}
