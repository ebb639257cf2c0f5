//! What environment maps have and is not shown, or converted.

use crate::scene::omission::Omission;

/// All of it.
pub const OMITTED: [Omission; 6] = [
    row("layers beside one", "of which", false),
    row("data windows other than the display window", "in which it is placed", false),
    row("chromaticities or PRIMARIES that span no colours", "span no colours; left out", false),
    row("angular maps, mirrored balls, faces of cubes", "read as equirectangular", true),
    row("crosses and strips of cubes", "read as equirectangular", true),
    row("negative and not finite texels", "they are 0 here", true),
];

const fn row(what: &'static str, instead: &'static str, changes_image: bool) -> Omission {
    Omission { format: "EXR and HDR", what, instead, changes_image }
}
