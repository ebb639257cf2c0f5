//! What glTF has and we do not show.

use crate::scene::omission::Omission;

/// All of it.
pub const OMITTED: [Omission; 23] = [
    row("normalTexture", "a normalTexture", true),
    row("metallicRoughnessTexture", "a metallicRoughnessTexture, of which the mean is used", true),
    row("textures of metals", "a texture on what it mirrors, of which the mean is used", true),
    row("alphaMode BLEND", "transparency, cut out where it is less than half opaque", true),
    row("TEXCOORD_n beside one a material", "textures on different coordinates", true),
    row("several turns by KHR_texture_transform", "textures turned differently", true),
    row("NORMAL", "normals of smooth surfaces; they are shown flat", true),
    row("alpha of COLOR_0", "colours with an alpha, which is left out", true),
    row("skins", "a skin or morph targets, not supported yet; undeformed", true),
    row("weights of morph targets", "a skin or morph targets, not supported yet; undeformed", true),
    row("animations", "has animations, which are left out", true),
    row("points and lines", "sets of points or lines are left out", false),
    row("orthographic cameras", "is orthographic, not supported yet", true),
    row("cameras after the first", "is passed over, the first is used", false),
    row("scenes beside one", "scenes, of which one is shown", false),
    row("range of lights", "has a range, which is left out", false),
    row("KHR_materials_transmission of less than one half", "a little transmission", true),
    row("KHR_materials_unlit", "KHR_materials_unlit, lit as any surface", true),
    row("KHR_materials_pbrSpecularGlossiness", "shown by the nearest", true),
    row("other extensions of materials", "not shown as it is", true),
    row(
        "EXT_mesh_gpu_instancing and other extensions of nodes",
        "not supported; it is left out",
        true,
    ),
    row("other extensions", "not supported", true),
    row("images in KTX2, DDS or AVIF", "has no PNG or JPEG", true),
];

const fn row(what: &'static str, instead: &'static str, changes_image: bool) -> Omission {
    Omission { format: "glTF", what, instead, changes_image }
}
