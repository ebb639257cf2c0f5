//! The order of modules on the crate's front page is the order of imports: a file imports from its
//! own module and those listed before it, and the files of a module import in no circle.

#![expect(clippy::panic, clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use order::Order;
use sources::Sources;
use tree::Tree;

mod checker;
mod order;
mod paths;
mod sources;
mod tree;

/// The files of `src`, but for the program's own.
fn library() -> Sources {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut sources = BTreeMap::new();
    let mut folders = vec![root.clone()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let name = path.strip_prefix(&root).unwrap().to_str().unwrap().replace('\\', "/");
                sources.insert(name, fs::read_to_string(&path).unwrap());
            }
        }
    }
    // The program, which stands above the library.
    sources.remove("main.rs").unwrap();
    sources
}

fn ordered() -> (Tree, Order) {
    let sources = library();
    assert!(sources.len() > 100, "only {} files found", sources.len());
    (Tree::read(&sources), Order::of_front_page(&sources["lib.rs"]))
}

#[test]
fn every_file_belongs_to_a_listed_module() {
    let (tree, order) = ordered();
    let faults = order.faults(&tree);
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn no_file_imports_from_a_module_listed_after_its_own() {
    let (tree, order) = ordered();
    let upward = order.upward(&tree);
    assert!(upward.is_empty(), "\n{}", upward.join("\n"));
}

#[test]
fn no_files_of_a_module_import_in_a_circle() {
    let (tree, order) = ordered();
    let circles = order.circles(&tree);
    let told: Vec<_> = circles.iter().map(ToString::to_string).collect();
    assert!(told.is_empty(), "\n{}", told.join("\n"));
}
