//! What MTL has and we do not show.

use crate::scene::omission::Omission;

/// All of it; the maps first.
pub const OMITTED: [Omission; 10] = [
    row("map_Ks, map_Ns, map_Pr, map_Pm, bump, disp, decal, refl, norm", "not shown", true),
    row("Pr, Pm, Ps, Pc, aniso", "of physically based shading, not shown", true),
    row("d -halo", "whose halo is not shown", false),
    row("illum 10", "which shows shadows alone; read as paint", true),
    row("illum of other numbers", "which are no models of illumination; read as 2", false),
    row("sharpness, map_aat, xyz", "not shown", false),
    row("any other statement", "which MTL does not have; left out", false),
    row(
        "options -mm, -t, -cc, -imfchan, -boost, -colorspace, -type",
        "not supported; left out",
        true,
    ),
    row("alpha of map_Kd", "which is left out; map_d cuts out", false),
    row("a second newmtl of one name", "which is left out; the first counts", false),
];

const MAPS: usize = 0;
const PHYSICAL: usize = 1;
const HALO: usize = 2;
const SHADOWS: usize = 3;
const MODEL: usize = 4;
const DISPLAY: usize = 5;
const UNKNOWN: usize = 6;
/// Rows that no statement alone tells.
pub const ALPHA: usize = 8;
pub const SECOND: usize = 9;

/// Textures whose statement does not begin with `map_`.
const SURFACE_MAPS: [&str; 5] = ["bump", "disp", "decal", "refl", "norm"];

/// What says nothing to light that is computed: the ambient, and what goes with other statements.
const HARMLESS: [&str; 6] = ["map_ka", "pcr", "anisor", "map_pcr", "map_anisor", "ka"];

const fn row(what: &'static str, instead: &'static str, changes_image: bool) -> Omission {
    Omission { format: "MTL", what, instead, changes_image }
}

/// The row of a statement that is not read, if it says anything; `number` is its first.
pub fn of_statement(keyword: &str, number: Option<f64>) -> Option<usize> {
    match keyword {
        harmless if HARMLESS.contains(&harmless) => None,
        "map_aat" | "sharpness" | "xyz" => Some(DISPLAY),
        map if map.starts_with("map_") || SURFACE_MAPS.contains(&map) => Some(MAPS),
        // Writers give all of them, mostly 0.
        "pr" | "pm" | "ps" | "pc" | "aniso" => (number != Some(0.0)).then_some(PHYSICAL),
        _ => Some(UNKNOWN),
    }
}

/// The row of an `illum` that is not shown as it is.
pub fn of_illumination(model: f64) -> Option<usize> {
    match model {
        10.0 => Some(SHADOWS),
        model if model.fract() == 0.0 && (0.0..10.0).contains(&model) => None,
        _ => Some(MODEL),
    }
}

/// The row of a `d` with a halo, where that shows.
pub fn of_halo(opacity: f64) -> Option<usize> {
    (opacity < 1.0).then_some(HALO)
}
