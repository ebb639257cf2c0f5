//! The sweep file: experiments as tables of `render`'s options.

use std::collections::BTreeMap;
use std::path::Path;

use super::axes::Axes;
use crate::cli::parse;
use crate::error::{Error, SceneError};
use crate::scene::document::{Document, Section, Value};
use crate::scene::text::read_text;
use crate::study::{Experiment, Plan, ReferencePlan, presets};

/// The keys beside `[[experiment]]`.
const KEYS: [&str; 9] = [
    "name",
    "scenes",
    "size",
    "seeds",
    "reference_samples",
    "clustering_seeds",
    "mask_above",
    "common",
    "experiment",
];

/// Reads a sweep file. Scenes of the command line take the place of its own, which are relative
/// to it.
///
/// # Errors
/// The file is missing or malformed, or holds something that is no option or value of `render`.
pub fn read(file: &Path, scenes: Vec<String>) -> Result<Plan, Error> {
    let text = read_text(file, None)?.content;
    let document = Document::new(file, &text);
    let table = document.parse()?;
    let root = document.section("the sweep", 1, &table);
    root.only(&KEYS)?;
    let mut plan = presets::of_scenes(scenes);
    plan.name = match root.get("name") {
        Some(name) => name.string()?.to_owned(),
        None => file.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
    };
    if let Some(own) = root.get("scenes").filter(|_| plan.scenes.is_empty()) {
        plan.scenes = own.words()?.iter().map(|name| beside(file, name)).collect();
    }
    if plan.scenes.is_empty() {
        return Err(root.fault("no scene; give `scenes`, or SCENE on the command line").into());
    }
    if let Some(size) = root.get("size") {
        let parsed = parse::size(size.string()?).map_err(|why| size.fault(&why))?;
        plan.size = Some(parsed);
    }
    let count = |value: &Value<'_>, least: u32| value.count(least, 1 << 24);
    if let Some(seeds) = root.get("seeds") {
        plan.seeds = (0..count(&seeds, 1)?.min(1000)).collect();
    }
    if let Some(samples) = root.get("reference_samples") {
        plan.reference = ReferencePlan::Path { samples: count(&samples, 32)? };
    }
    if let Some(seeds) = root.get("clustering_seeds") {
        plan.clustering_seeds = count(&seeds, 0)? as usize;
    }
    if let Some(level) = root.get("mask_above") {
        plan.mask_above = Some(level.number()?);
    }
    let common = match root.get("common") {
        Some(common) => options(&common.section("[common]")?, &[])?,
        None => BTreeMap::new(),
    };
    plan.experiments = root
        .sections("experiment")?
        .iter()
        .map(|section| experiment(section, &common))
        .collect::<Result<_, _>>()?;
    match plan.experiments.is_empty() {
        true => Err(root.fault("no [[experiment]]").into()),
        false => Ok(plan),
    }
}

fn experiment(
    section: &Section<'_>,
    common: &BTreeMap<&str, Vec<String>>,
) -> Result<Experiment, Error> {
    let mut values = common.clone();
    values.extend(options(section, &["name", "title"])?);
    let name = section.required("name")?.string()?.to_owned();
    let title = match section.get("title") {
        Some(title) => title.string()?.to_owned(),
        None => format!("`{name}`"),
    };
    let axes = Axes::new(values)
        .map_err(|unknown| section.fault(format!("`{unknown}` is no option of a setting")))?;
    let located = |error: Error| Error::from(section.fault(error.to_string()));
    Ok(Experiment { name, title, runs: axes.runs().map_err(located)? })
}

/// The keys of a table but these, as options: underscores stand for hyphens.
fn options<'a>(
    section: &Section<'a>,
    but: &[&str],
) -> Result<BTreeMap<&'a str, Vec<String>>, SceneError> {
    let options = section.values().filter(|(key, _)| !but.contains(key));
    options
        .map(|(key, value)| {
            let name = Axes::name(key).ok_or_else(|| value.fault("is no option of a setting"))?;
            Ok((name, value.words()?))
        })
        .collect()
}

/// A scene's file, relative to the sweep's.
fn beside(file: &Path, scene: &str) -> String {
    if scene.starts_with("builtin:") {
        return scene.to_owned();
    }
    let directory = file.parent().unwrap_or(Path::new(""));
    directory.join(scene).to_string_lossy().into_owned()
}
