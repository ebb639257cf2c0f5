//! A file taken apart: its modules, and every path that it names.

use std::collections::{BTreeMap, BTreeSet};

use syn::spanned::Spanned;
use syn::visit::Visit;
use syn::{Item, UseTree};

use crate::paths::Paths;

/// The texts of source files by name, such as `lib.rs` and `scene/draft.rs`.
pub type Sources = BTreeMap<String, String>;

/// The segments of a path.
pub type Names = Vec<String>;

/// A module: a file, or a part of one.
#[derive(Debug, Default)]
pub struct Module {
    /// The file that it is in.
    pub file: String,
    /// Its modules.
    pub children: BTreeSet<String>,
    /// What it defines beside them.
    pub items: BTreeSet<String>,
    /// What it imports by name, and from where.
    pub uses: BTreeMap<String, Names>,
    /// What it imports all of.
    pub globs: Vec<Names>,
}

/// A path that a file names.
#[derive(Debug)]
pub struct Reference {
    /// The file.
    pub file: String,
    /// The line in it.
    pub line: usize,
    /// The module that names it.
    pub scope: Names,
    /// The path as it is written.
    pub path: Names,
    /// Whether it is that of a `use`.
    pub import: bool,
}

/// A `use` of one name: its path, the name that it gets (none for `*`), and its line.
pub type Leaf = (Names, Option<String>, usize);

/// Modules by path, and all that they name.
#[derive(Debug, Default)]
pub struct Crate {
    /// The crate's root is the empty path.
    pub modules: BTreeMap<Names, Module>,
    /// In no order.
    pub references: Vec<Reference>,
}

impl Crate {
    /// Reads a file and those of its modules.
    pub fn read(&mut self, sources: &Sources, path: Names, file: &str) {
        let text = sources.get(file).unwrap_or_else(|| panic!("src/{file} is missing"));
        let parsed = syn::parse_file(text).unwrap_or_else(|why| panic!("src/{file}: {why}"));
        self.items(sources, path, file, &parsed.items);
    }

    fn items(&mut self, sources: &Sources, path: Names, file: &str, items: &[Item]) {
        let mut module = Module { file: file.to_owned(), ..Module::default() };
        let mut paths = Paths::new(path.clone(), file);
        for item in items {
            module.items.extend(defined(item));
            match item {
                Item::Mod(child) => {
                    module.children.insert(child.ident.to_string());
                }
                Item::Use(import) => {
                    for (target, name, line) in leaves(&import.tree) {
                        paths.add(target.clone(), line, true);
                        match name {
                            Some(name) => {
                                module.uses.insert(name, target);
                            }
                            None => module.globs.push(target),
                        }
                    }
                }
                _ => paths.visit_item(item),
            }
        }
        self.modules.insert(path.clone(), module);
        self.references.extend(paths.found);
        for item in items {
            let Item::Mod(child) = item else { continue };
            let name = child.ident.to_string();
            let below = [&path[..], std::slice::from_ref(&name)].concat();
            match &child.content {
                Some((_, items)) => self.items(sources, below, file, items),
                None => {
                    let folder = file.strip_suffix("lib.rs").or(file.strip_suffix(".rs"));
                    let folder = folder.unwrap_or_default();
                    let slash = if folder.is_empty() { "" } else { "/" };
                    self.read(sources, below, &format!("{folder}{slash}{name}.rs"));
                }
            }
        }
    }
}

/// The name that an item defines, if it is not a module.
fn defined(item: &Item) -> Option<String> {
    let name = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::Type(item) => &item.ident,
        Item::Union(item) => &item.ident,
        _ => return None,
    };
    Some(name.to_string())
}

/// The single names of a `use`.
pub fn leaves(tree: &UseTree) -> Vec<Leaf> {
    let mut found = Vec::new();
    collect(tree, &mut Vec::new(), &mut found);
    found
}

fn collect(tree: &UseTree, before: &mut Names, found: &mut Vec<Leaf>) {
    let line = tree.span().start().line;
    let path = |last: &str, before: &Names| match last {
        "self" => before.clone(),
        _ => [&before[..], &[last.to_owned()]].concat(),
    };
    match tree {
        UseTree::Path(part) => {
            before.push(part.ident.to_string());
            collect(&part.tree, before, found);
            before.pop();
        }
        UseTree::Name(name) => {
            let path = path(&name.ident.to_string(), before);
            let name = path.last().cloned();
            found.push((path, name, line));
        }
        UseTree::Rename(name) => {
            let path = path(&name.ident.to_string(), before);
            found.push((path, Some(name.rename.to_string()), line));
        }
        UseTree::Glob(_) => found.push((before.clone(), None, line)),
        UseTree::Group(group) => {
            for tree in &group.items {
                collect(tree, before, found);
            }
        }
    }
}
