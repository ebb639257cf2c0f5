//! Which file imports from which: every path is followed to the file that defines what it names.

use std::collections::{BTreeMap, BTreeSet};

use crate::sources::{Crate, Names, Sources};

/// Re-exports of re-exports are followed so far.
const DEEPEST: usize = 32;

/// The files of a crate and what they import.
#[derive(Debug)]
pub struct Tree {
    /// Files and the paths of their modules.
    pub files: BTreeMap<String, Names>,
    /// Of each file, the files that it imports from, and the first line that does.
    pub imports: BTreeMap<String, BTreeMap<String, usize>>,
    /// Files that no module names.
    pub strays: BTreeSet<String>,
}

impl Tree {
    /// Reads all files from `lib.rs` on.
    pub fn read(sources: &Sources) -> Self {
        let mut all = Crate::default();
        all.read(sources, Vec::new(), "lib.rs");
        let mut files: BTreeMap<String, Names> = BTreeMap::new();
        for (path, module) in &all.modules {
            // A file's own module comes before those within it.
            files.entry(module.file.clone()).or_insert_with(|| path.clone());
        }
        let mut imports: BTreeMap<String, BTreeMap<String, usize>> = BTreeMap::new();
        for reference in &all.references {
            // A local name may be like that of a module.
            let local = !reference.import && reference.path.len() == 1;
            let last = if local { Last::Item } else { Last::Anything };
            let Some(to) = all.resolve(&reference.scope, &reference.path, last, 0) else {
                continue;
            };
            if to != reference.file {
                let lines = imports.entry(reference.file.clone()).or_default();
                let line = lines.entry(to).or_insert(reference.line);
                *line = reference.line.min(*line);
            }
        }
        let strays = sources.keys().filter(|file| !files.contains_key(*file)).cloned().collect();
        Self { files, imports, strays }
    }
}

/// What the last segment of a path may be.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Last {
    /// A module among others.
    Anything,
    /// No module.
    Item,
}

impl Crate {
    /// The file that defines what a module names by a path; none if it is of another crate, or a
    /// local name.
    fn resolve(&self, scope: &Names, path: &[String], last: Last, depth: usize) -> Option<String> {
        if depth > DEEPEST {
            return None;
        }
        if let Some(absolute) = absolute(scope, path) {
            return self.walk(&absolute, last, depth);
        }
        // A single segment that is no import of its own: `use rayon;`, or a prelude's name.
        let found = self.step(scope, path, last, depth);
        found.or_else(|| {
            let globs = &self.modules.get(scope)?.globs;
            globs.iter().find_map(|glob| {
                let from = absolute(scope, glob)?;
                self.step(&from, path, last, depth + 1)
            })
        })
    }

    /// Follows a path from the crate's root.
    fn walk(&self, path: &[String], last: Last, depth: usize) -> Option<String> {
        let mut at: Names = Vec::new();
        let mut rest = path;
        while rest.len() > 1 && self.modules.get(&at)?.children.contains(&rest[0]) {
            at.push(rest[0].clone());
            rest = &rest[1..];
        }
        let module = self.modules.get(&at)?;
        if rest.is_empty() {
            return Some(module.file.clone());
        }
        let found = self.step(&at, rest, last, depth).or_else(|| {
            module
                .globs
                .iter()
                .find_map(|glob| self.step(&absolute(&at, glob)?, rest, last, depth + 1))
        });
        // Else a macro makes it.
        found.or_else(|| Some(module.file.clone()))
    }

    /// Follows a path from a module that has its first segment. Where there are segments behind
    /// it, that is a module or a type; else it is rather an item or a re-export than a module, as
    /// in `pub use flip::flip`.
    fn step(&self, at: &Names, path: &[String], last: Last, depth: usize) -> Option<String> {
        let module = self.modules.get(at)?;
        let (first, rest) = path.split_first()?;
        let child = || {
            let child = [&at[..], std::slice::from_ref(first)].concat();
            let named = module.children.contains(first);
            named.then(|| self.walk(&[&child[..], rest].concat(), last, depth + 1)).flatten()
        };
        if !rest.is_empty()
            && let Some(file) = child()
        {
            return Some(file);
        }
        if rest.is_empty() && module.items.contains(first) {
            return Some(module.file.clone());
        }
        if let Some(target) = module.uses.get(first) {
            let itself = target.len() == 1 && target[0] == *first;
            let target = [&target[..], rest].concat();
            let last = if rest.is_empty() { Last::Anything } else { last };
            return if itself { None } else { self.resolve(at, &target, last, depth + 1) };
        }
        if module.items.contains(first) {
            return Some(module.file.clone());
        }
        if rest.is_empty() && last == Last::Anything && module.children.contains(first) {
            let child = [&at[..], std::slice::from_ref(first)].concat();
            return self.modules.get(&child).map(|module| module.file.clone());
        }
        None
    }
}

/// A path from the crate's root; none if it does not say where it begins.
fn absolute(scope: &Names, path: &[String]) -> Option<Names> {
    let mut at = scope.clone();
    let mut rest = path;
    match rest.first()?.as_str() {
        "crate" => {
            at.clear();
            rest = &rest[1..];
        }
        "self" => rest = &rest[1..],
        "super" => {
            while rest.first().is_some_and(|segment| segment == "super") {
                at.pop()?;
                rest = &rest[1..];
            }
        }
        _ => return None,
    }
    at.extend(rest.iter().cloned());
    Some(at)
}
