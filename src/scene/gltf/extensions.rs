//! What becomes of a file's extensions.

use std::collections::BTreeSet;

use super::json::Document;

/// What an extension is to us.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Meaning {
    /// It is shown, or what reads it warns of what is not.
    Read,
    /// It says nothing of what is seen.
    Unseen,
    /// Without it, the file shows something else: this.
    Otherwise(&'static str),
    /// Without it there is nothing to show: what unpacks it.
    Needed(&'static str),
}

const UNPACK: &str = "`gltf-transform copy IN OUT` unpacks it";

const KNOWN: [(&str, Meaning); 27] = [
    ("KHR_lights_punctual", Meaning::Read),
    ("KHR_materials_emissive_strength", Meaning::Read),
    ("KHR_materials_ior", Meaning::Read),
    ("KHR_materials_pbrSpecularGlossiness", Meaning::Read),
    ("KHR_materials_transmission", Meaning::Read),
    ("KHR_materials_unlit", Meaning::Read),
    ("KHR_mesh_quantization", Meaning::Read),
    ("KHR_texture_transform", Meaning::Read),
    ("EXT_texture_webp", Meaning::Read),
    ("EXT_structural_metadata", Meaning::Unseen),
    ("EXT_mesh_features", Meaning::Unseen),
    ("EXT_instance_features", Meaning::Unseen),
    ("KHR_node_selectability", Meaning::Unseen),
    ("KHR_node_hoverability", Meaning::Unseen),
    ("KHR_xmp", Meaning::Unseen),
    ("KHR_xmp_json_ld", Meaning::Unseen),
    ("KHR_animation_pointer", Meaning::Otherwise("it is shown at rest")),
    ("KHR_materials_variants", Meaning::Otherwise("the first materials are shown")),
    ("KHR_texture_basisu", Meaning::Otherwise("its images need another form")),
    ("EXT_texture_avif", Meaning::Otherwise("its images need another form")),
    ("MSFT_texture_dds", Meaning::Otherwise("its images need another form")),
    ("MSFT_lod", Meaning::Otherwise("the finest level is shown")),
    ("EXT_lights_image_based", Meaning::Otherwise("the environment is left out")),
    ("EXT_lights_ies", Meaning::Otherwise("the lamps' profiles are left out")),
    ("KHR_draco_mesh_compression", Meaning::Needed(UNPACK)),
    ("EXT_meshopt_compression", Meaning::Needed(UNPACK)),
    ("EXT_mesh_gpu_instancing", Meaning::Needed("`gltf-transform uninstance IN OUT` unpacks it")),
];

/// What is wrong with a file that cannot be shown without an extension.
pub fn refused(document: &Document) -> Option<String> {
    let refused = document.extensions_required.iter().find_map(|name| match of(name) {
        Some(Meaning::Needed(tool)) => Some((name, tool)),
        None if !is_of_materials(name) => Some((name, "export it without")),
        _ => None,
    });
    refused.map(|(name, advice)| {
        format!("requires the extension {name}, which is not supported; {advice}")
    })
}

/// What is said of the extensions that a file uses, and that nothing else warns of: materials and
/// nodes do of theirs.
pub fn left_out(document: &Document) -> Vec<String> {
    let used: BTreeSet<&String> =
        document.extensions_used.iter().chain(&document.extensions_required).collect();
    let on_nodes =
        |name: &str| document.nodes.iter().any(|node| node.extensions.others.contains_key(name));
    let told = |name: &&&String| !is_of_materials(name) && !on_nodes(name);
    let what = |name: &String| match of(name) {
        // Of what is needed, the file holds what is shown without it as well.
        Some(Meaning::Read | Meaning::Unseen | Meaning::Needed(_)) => None,
        Some(Meaning::Otherwise(what)) => Some(what),
        None => Some("it is left out"),
    };
    used.iter()
        .filter(told)
        .filter_map(|name| Some(format!("uses {name}, not supported; {}", what(name)?)))
        .collect()
}

fn of(name: &str) -> Option<Meaning> {
    KNOWN.iter().find(|(known, _)| *known == name).map(|(_, meaning)| *meaning)
}

/// Whether it is about how surfaces look: the nearest that there is can be shown.
fn is_of_materials(name: &str) -> bool {
    name.contains("_materials_") && name != "KHR_materials_variants"
}
