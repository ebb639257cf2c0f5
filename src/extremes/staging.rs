//! From a case to what is rendered: its scene as files, its options as settings.

use std::collections::BTreeMap;
use std::fs;

use toml::Table;

use super::bake::Bake;
use super::cases::{Case, Cases, Like, SceneText, fill, filled};
use super::{Scale, shapes};
use crate::error::Error;
use crate::scene::{Scene, SceneError};

/// Methods with an option that makes them another, by the name they have in cases.
const VARIANTS: [(&str, &str); 4] = [
    ("both, hard", "--method=both --fuzzy 1"),
    ("both, fuzzy", "--method=both --fuzzy 4"),
    ("both, merged", "--method=both --merge light"),
    ("both, compensated", "--method=both --compensate"),
];

/// What is rendered: files, and options.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Staging {
    /// The files of the scene by name, the scene file under [`SCENE`].
    pub files: BTreeMap<String, String>,
    /// The options.
    pub words: Vec<String>,
}

/// The name of the scene file.
const SCENE: &str = "scene.toml";

impl Staging {
    /// What a case asks for with a method; or, with `like`, what that is compared with.
    ///
    /// # Errors
    /// The case names no scene, or its text is at fault.
    pub fn of(
        cases: &Cases,
        case: &Case,
        method: &str,
        scale: Scale,
        like: Option<&Like>,
    ) -> Result<Self, String> {
        let mut set = case.set.clone();
        let mut bake = case.bake;
        let (mut name, mut shown) = (&case.scene, method);
        let own = case.of.get(method).cloned().unwrap_or_default();
        let mut options = vec![[&case.options, &case.full], [&own.options, &own.full]];
        if let Some(like) = like {
            set.extend(like.set.clone());
            bake = like.bake;
            name = like.scene.as_ref().unwrap_or(name);
            shown = like.method.as_deref().unwrap_or(method);
            options.push([&like.options, &like.full]);
        }
        let levels = if scale == Scale::Full { 2 } else { 1 };
        let options = options.iter().flat_map(|of| of[..levels].iter().map(|text| text.as_str()));
        let variant = VARIANTS.iter().find(|(name, _)| *name == shown);
        let method = variant.map_or(format!("--method={shown}"), |(_, words)| (*words).to_owned());
        let options: Vec<_> = [method.as_str()].into_iter().chain(options).collect();
        let text = cases.scenes.get(name).ok_or_else(|| format!("there is no scene `{name}`"))?;
        Ok(Self { files: files(text, &set, &bake)?, words: merged(&options) })
    }

    /// Writes the files to a temporary directory and reads the scene from there.
    ///
    /// # Errors
    /// The scene is refused, in words without that directory; or the disk is full.
    pub fn scene(&self) -> Result<Scene, Error> {
        let failed = |error: std::io::Error| SceneError::new(SCENE, error.to_string());
        let directory = tempfile::tempdir().map_err(failed)?;
        for (name, text) in &self.files {
            fs::write(directory.path().join(name), text).map_err(failed)?;
        }
        let path = directory.path().join(SCENE);
        let place = format!("{}{}", directory.path().display(), std::path::MAIN_SEPARATOR);
        match Scene::load(&path.to_string_lossy()) {
            Ok(mut scene) => {
                for warning in &mut scene.warnings {
                    warning.message = warning.message.replace(&place, "");
                }
                Ok(scene)
            }
            Err(SceneError { file, line, what }) => Err(Error::Scene(SceneError {
                file: file.strip_prefix(directory.path()).unwrap_or(&file).to_owned(),
                line,
                what: what.replace(&place, ""),
            })),
        }
    }
}

fn files(text: &SceneText, own: &Table, bake: &Bake) -> Result<BTreeMap<String, String>, String> {
    let mut set = own.clone();
    for (name, value) in &text.set {
        if !set.contains_key(name) {
            set.insert(name.clone(), filled(value, own)?);
        }
    }
    let set = &set;
    let mut files = BTreeMap::new();
    files.insert(SCENE.to_owned(), bake.scene(&fill(&text.toml, set)?)?);
    for (name, text) in &text.files {
        let text = fill(text, set)?;
        let text = if name.ends_with(".obj") { bake.obj(&text)? } else { text };
        files.insert(name.clone(), text);
    }
    for (name, shape) in &text.shapes {
        files.insert(name.clone(), bake.obj(&shapes::obj(&fill(shape, set)?)?)?);
    }
    Ok(files)
}

/// The words of several lists of options, of which a later one replaces an earlier one of its
/// name. `default` is as if it was not given.
fn merged(lists: &[&str]) -> Vec<String> {
    let mut options: Vec<Vec<&str>> = Vec::new();
    for word in lists.iter().flat_map(|list| list.split_whitespace()) {
        match options.last_mut() {
            Some(option) if !word.starts_with("--") => option.push(word),
            _ => options.push(vec![word]),
        }
    }
    let name = |option: &[&str]| option[0].split('=').next().unwrap_or_default().to_owned();
    let mut kept: Vec<Vec<&str>> = Vec::new();
    for option in options {
        kept.retain(|earlier| name(earlier) != name(&option));
        if option.get(1) != Some(&"default") {
            kept.push(option);
        }
    }
    kept.concat().into_iter().map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_later_option_replaces_an_earlier_one() {
        let lists = ["--method=vpl", "--vpls 10 --seed 3", "--vpls 20 --strict", "--method path"];
        assert_eq!(merged(&lists).join(" "), "--seed 3 --vpls 20 --strict --method path");
        assert!(merged(&["", "--vpls 10", "--vpls default"]).is_empty());
    }
}
