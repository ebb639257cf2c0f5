//! The order of modules that a front page tells, and what breaks it.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use crate::sources::Names;
use crate::tree::Tree;

/// The heading of the list on the front page.
const HEADING: &str = "# The order of modules";

/// Modules, the lowest first.
#[derive(Debug)]
pub struct Order(Vec<String>);

/// Files of a module each of which imports, by way of the others, from itself.
#[derive(Debug)]
pub struct Circle {
    /// The listed module.
    pub module: String,
    /// The files, by name.
    pub files: BTreeSet<String>,
    /// The imports among them, a line each.
    imports: Vec<String>,
}

impl Order {
    /// From the first block of text below the heading: one module a line, with what it holds.
    pub fn of_front_page(text: &str) -> Self {
        let lines = text.lines().filter_map(|line| line.strip_prefix("//!")).map(str::trim);
        let block = lines.skip_while(|line| *line != HEADING).skip_while(|line| *line != "```text");
        let block = block.skip(1).take_while(|line| *line != "```");
        let modules: Vec<_> = block
            .map(|line| {
                let (module, about) = line.split_once(' ').unwrap_or((line, ""));
                assert!(!about.trim().is_empty(), "the front page does not say what {line} holds");
                module.to_owned()
            })
            .collect();
        assert!(!modules.is_empty(), "no list below \"{HEADING}\"");
        Self(modules)
    }

    /// The place in the list of a module: that of the longest path that it begins with.
    fn place(&self, path: &Names) -> Option<usize> {
        let path = path.join("::");
        let holds = |listed: &str| {
            path.strip_prefix(listed).is_some_and(|rest| rest.is_empty() || rest.starts_with("::"))
        };
        let all = self.0.iter().enumerate().filter(|(_, listed)| holds(listed));
        all.max_by_key(|(_, listed)| listed.len()).map(|(place, _)| place)
    }

    /// What the list lacks or has too much, and files that are of no module.
    pub fn faults(&self, tree: &Tree) -> Vec<String> {
        let mut faults: Vec<String> =
            tree.strays.iter().map(|file| format!("src/{file} is of no module")).collect();
        for (file, path) in &tree.files {
            match self.place(path) {
                // The crate's root says what modules there are, and that is all.
                None if path.is_empty() => faults.extend(
                    tree.imports.contains_key(file).then(|| format!("src/{file} has imports")),
                ),
                None => faults.push(format!("src/{file} is of no listed module")),
                Some(_) => {}
            }
        }
        for (index, listed) in self.0.iter().enumerate() {
            if tree.files.values().all(|path| path.join("::") != *listed) {
                faults.push(format!("{listed} is listed, and there is no such file"));
            }
            if self.0[..index].contains(listed) {
                faults.push(format!("{listed} is listed twice"));
            }
        }
        faults
    }

    /// Imports from modules that stand further up, a line each.
    pub fn upward(&self, tree: &Tree) -> Vec<String> {
        let mut upward = Vec::new();
        for (from, imports) in &tree.imports {
            let Some(own) = self.place(&tree.files[from]) else { continue };
            for (to, line) in imports {
                match self.place(&tree.files[to]) {
                    Some(other) if other > own => upward.push(format!(
                        "src/{from}:{line}: `{}` imports from `{}` (src/{to}), which stands above it",
                        self.0[own], self.0[other]
                    )),
                    _ => {}
                }
            }
        }
        upward
    }

    /// All circles among the files of one module.
    pub fn circles(&self, tree: &Tree) -> Vec<Circle> {
        let place = |file: &str| self.place(&tree.files[file]);
        // The imports within listed modules.
        let mut within: BTreeMap<&str, BTreeMap<&str, usize>> = BTreeMap::new();
        for (from, imports) in &tree.imports {
            let own = place(from);
            let inside = imports.iter().filter(|(to, _)| own.is_some() && place(to) == own);
            within.insert(from, inside.map(|(to, line)| (to.as_str(), *line)).collect());
        }
        let reach: BTreeMap<&str, BTreeSet<&str>> =
            within.keys().map(|file| (*file, reached(&within, file))).collect();
        let from_to = |from: &str, to: &str| reach.get(from).is_some_and(|all| all.contains(to));
        let mut circles: Vec<Circle> = Vec::new();
        for (file, all) in &reach {
            let known = circles.iter().any(|circle| circle.files.contains(*file));
            if known || !all.contains(file) {
                continue;
            }
            let files: Vec<&str> =
                all.iter().filter(|other| from_to(other, file)).copied().collect();
            let mut imports = Vec::new();
            for from in &files {
                for (to, line) in within[from].iter().filter(|(to, _)| files.contains(*to)) {
                    imports.push(format!("  src/{from}:{line}: imports from src/{to}"));
                }
            }
            let module = place(file).map_or(String::new(), |place| self.0[place].clone());
            let files = files.into_iter().map(str::to_owned).collect();
            circles.push(Circle { module, files, imports });
        }
        circles
    }
}

/// The files that a file imports from, by way of others.
fn reached<'a>(
    imports: &BTreeMap<&'a str, BTreeMap<&'a str, usize>>,
    start: &'a str,
) -> BTreeSet<&'a str> {
    let mut reached = BTreeSet::new();
    let mut next = vec![start];
    while let Some(file) = next.pop() {
        for to in imports.get(file).into_iter().flat_map(BTreeMap::keys) {
            if reached.insert(*to) {
                next.push(to);
            }
        }
    }
    reached
}

impl fmt::Display for Circle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { module, files, imports } = self;
        write!(f, "a circle of {} files in `{module}`:\n{}", files.len(), imports.join("\n"))
    }
}
