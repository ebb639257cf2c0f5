//! The checker itself, on crates of a few lines.

use crate::order::Order;
use crate::sources::Sources;
use crate::tree::Tree;

const FRONT: &str = "//! # The order of modules\n//!\n//! ```text\n//! low   what is below\n\
                     //! high  what is above\n//! ```\nmod high;\nmod low;\n";

fn made(files: &[(&str, &str)]) -> (Tree, Order) {
    let mut sources: Sources =
        files.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect();
    let front = sources.entry("lib.rs".to_owned()).or_insert(FRONT.to_owned()).clone();
    (Tree::read(&sources), Order::of_front_page(&front))
}

#[test]
fn an_import_from_above_is_found_with_its_line() {
    let (tree, order) = made(&[
        ("high.rs", "pub struct Thing;\nuse crate::low::Part;"),
        ("low.rs", "pub struct Part;\n\nuse crate::high::Thing;"),
    ]);
    let told = "src/low.rs:3: `low` imports from `high` (src/high.rs), which stands above it";
    assert_eq!(order.upward(&tree), [told]);
    assert!(order.faults(&tree).is_empty() && order.circles(&tree).is_empty());
}

#[test]
fn every_way_to_name_something_counts() {
    for low in [
        "fn f() { crate::high::thing() }",
        "fn f() -> super::high::Thing { todo!() }",
        "fn f() { print!(\"{}\", crate::high::COUNT); }",
        "#[derive(Debug)]\n#[arg(value_parser = crate::high::thing)]\nstruct A;",
        "fn f() { use crate::high; }",
        "#[cfg(test)]\nmod tests { use super::super::high::*; }",
        "use crate::high as other;",
    ] {
        let high = "pub struct Thing; pub fn thing() {} pub const COUNT: u32 = 1;";
        let (tree, order) = made(&[("high.rs", high), ("low.rs", low)]);
        assert_eq!(order.upward(&tree).len(), 1, "{low}");
    }
    let local = "fn f(high: u32) -> u32 { image::thing(high) }\npub(in crate::low) struct B;";
    let (tree, order) = made(&[("high.rs", ""), ("low.rs", local)]);
    assert!(order.upward(&tree).is_empty());
}

#[test]
fn an_import_through_a_re_export_is_one_of_the_definer() {
    let (tree, order) = made(&[
        ("low.rs", "mod a;\nmod b;\npub use a::A;\npub use b::{B, b};"),
        ("low/a.rs", "use super::B;\npub struct A;"),
        ("low/b.rs", "pub struct B;\npub fn b() {}"),
        ("high.rs", "use crate::low::{self, b};\nfn f() -> low::A { b() }"),
    ]);
    assert!(order.circles(&tree).is_empty(), "a facade is in no circle");
    let imports = |file: &str| tree.imports[file].keys().map(String::as_str).collect::<Vec<_>>();
    assert_eq!(imports("low/a.rs"), ["low/b.rs"]);
    assert_eq!(imports("high.rs"), ["low.rs", "low/a.rs", "low/b.rs"]);
}

#[test]
fn a_circle_is_found_whatever_it_goes_through() {
    let (tree, order) = made(&[
        ("low.rs", "mod a;\nmod b;\nmod c;\npub use a::A;\npub use b::b;"),
        ("low/a.rs", "use super::b;\npub struct A;"),
        ("low/b.rs", "pub fn b() -> super::A { todo!() }"),
        ("low/c.rs", "use super::A;"),
        ("high.rs", "mod part;\nfn f() { part::run() }\nstruct Whole;"),
        ("high/part.rs", "pub fn run() {}\nuse super::Whole;"),
    ]);
    let circles = order.circles(&tree);
    let files: Vec<Vec<_>> = circles.iter().map(|c| c.files.iter().collect()).collect();
    assert_eq!(files, [["high.rs", "high/part.rs"], ["low/a.rs", "low/b.rs"]]);
    let told = "a circle of 2 files in `low`:\n  src/low/a.rs:1: imports from src/low/b.rs\n  \
                src/low/b.rs:1: imports from src/low/a.rs";
    assert_eq!(circles[1].to_string(), told);
}

#[test]
fn a_function_named_as_its_module_is_followed_too() {
    let (tree, order) = made(&[
        ("low.rs", "mod read;\npub use read::read;\npub struct Whole;"),
        ("low/read.rs", "pub fn read() {}\nuse super::Whole;"),
        ("high.rs", "fn f() { crate::low::read() }"),
    ]);
    assert!(tree.imports["high.rs"].contains_key("low/read.rs"));
    assert_eq!(order.circles(&tree).len(), 1);
}

#[test]
fn the_longest_listed_path_decides() {
    let front = "//! # The order of modules\n//!\n//! ```text\n//! low::deep  lowest\n//! low  rest\n\
                 //! ```\npub mod low;\n";
    let (tree, order) = made(&[
        ("lib.rs", front),
        ("low.rs", "pub mod deep;\npub struct Rest;\nuse deep::part::P;"),
        ("low/deep.rs", "pub mod part;"),
        ("low/deep/part.rs", "pub struct P;\nuse crate::low::Rest;"),
    ]);
    let told = "src/low/deep/part.rs:2: `low::deep` imports from `low` (src/low.rs), which stands above it";
    assert_eq!(order.upward(&tree), [told]);
}

#[test]
fn lists_and_files_must_agree() {
    let (tree, order) = made(&[
        ("lib.rs", &(FRONT.replace("mod low;", "mod other;") + "use high::H;")),
        ("high.rs", "pub struct H;"),
        ("other.rs", ""),
        ("stray.rs", ""),
    ]);
    let faults = [
        "src/stray.rs is of no module",
        "src/lib.rs has imports",
        "src/other.rs is of no listed module",
        "low is listed, and there is no such file",
    ];
    assert_eq!(order.faults(&tree), faults);
}
