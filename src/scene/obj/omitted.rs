//! What OBJ has and we do not show.

use std::path::Path;

use crate::scene::omission::{Omission, Tally};
use crate::scene::{Origin, Warning};

/// The rows of [`OMITTED`] that no keyword alone tells.
pub const NO_SURFACE: usize = 0;
pub const NORMALS: usize = 1;
pub const SMOOTHING: usize = 2;
pub const ALPHA: usize = 3;
pub const THIRD: usize = 4;
pub const POLYPAINT: usize = 5;
const UNKNOWN: usize = 6;

/// All of it.
pub const OMITTED: [Omission; 12] = [
    row(
        "p, l, f of 1 or 2",
        "points, lines or faces of fewer than three corners are left out",
        false,
    ),
    row("vn", "faces have normals that differ at their corners; they are shown flat", true),
    row("s", "faces of smoothing groups have no normals; they are shown flat", true),
    row("v x y z r g b a", "colours of vertices have an alpha, which is left out", true),
    row("vt u v w", "texture coordinates have a third number, which is left out", false),
    row("#MRGB", "comments hold colours of vertices by ZBrush; they are left out", true),
    row("any other statement", "statements are none of OBJ's; they are left out", false),
    row("curv, curv2, surf", "free-form curves or surfaces are left out", true),
    row("bsp, bzp, cdc, cdp, res", "free-form patches of before 3.0 are left out", true),
    row("call, csh", "calls of other files or programs are left out", true),
    row("usemap", "texture maps of usemap are left out; name them by map_Kd", true),
    row("shadow_obj, trace_obj", "objects for shadows or reflections alone are left out", false),
];

/// Statements that change nothing that is shown: groups, the parts of free-form geometry, and how
/// edges and levels of detail are displayed.
const HARMLESS: [&str; 24] = [
    "bevel", "bmat", "c_interp", "con", "cstype", "ctech", "d_interp", "deg", "end", "g", "hole",
    "lod", "maplib", "mg", "o", "parm", "scrv", "sp", "step", "stech", "trim", "vp", "vn", "s",
];

const fn row(what: &'static str, instead: &'static str, changes_image: bool) -> Omission {
    Omission { format: "OBJ", what, instead, changes_image }
}

/// Whether a word begins a statement of the format.
pub fn is_keyword(word: &str) -> bool {
    let read = ["v", "vt", "f", "fo", "usemtl", "mtllib"];
    let omitted = || OMITTED.iter().flat_map(|row| row.what.split(", "));
    read.contains(&word) || HARMLESS.contains(&word) || omitted().any(|known| known == word)
}

/// How often each row of [`OMITTED`] occurs in a file.
#[derive(Debug, Default)]
pub struct Omitted([Tally; OMITTED.len()]);

impl Omitted {
    /// Counts something that is left out.
    pub fn add(&mut self, row: usize, line: usize) {
        self.0[row].add(line);
    }

    /// Counts a statement that is not read.
    pub fn add_statement(&mut self, keyword: &str, words: &str, line: usize) {
        let of_row = |row: &Omission| row.what.split(", ").any(|known| known == keyword);
        match OMITTED.iter().position(of_row) {
            Some(NORMALS | SMOOTHING) => {}
            _ if keyword == "usemap" && words == "off" => {}
            Some(row) => self.add(row, line),
            None if HARMLESS.contains(&keyword) => {}
            None => self.add(UNKNOWN, line),
        }
    }

    /// The first line of what has no surface.
    pub fn without_surface(&self) -> Option<usize> {
        let Tally { count, first } = self.0[NO_SURFACE];
        (count > 0).then_some(first)
    }

    /// A warning of each row that occurs.
    pub fn warnings(&self, file: &Path) -> impl Iterator<Item = Warning> {
        let occurs = OMITTED.iter().zip(&self.0).filter(|(_, tally)| tally.count > 0);
        occurs.map(move |(omission, Tally { count, first })| {
            let (origin, what) = (Origin::line(file, *first), omission.instead);
            let what = format!("{count} {what}");
            if omission.changes_image { origin.changed(what) } else { origin.note(what) }
        })
    }
}
