//! What is at the places that rays hit: the modules that textures and BSDFs choose.

use super::catalogue::{
    ALBEDO_PLAIN, ALBEDO_TEXTURED, FINISH, GATHERED_DIFFUSE, GATHERED_PHONG, GLOW_NONE,
    GLOW_TEXTURED, KEEP_ALBEDO, KEEP_ALBEDO_NONE, KEEP_GLOW, KEEP_GLOW_NONE, LIGHT_PLAIN,
    LIGHT_TEXTURED, LOBE_ENERGY, LOBES_DIFFUSE, LOBES_PHONG, MATERIAL_TEXTURES, PHONG,
    SCATTER_DIFFUSE, SCATTER_PHONG, VIEW_KEPT,
};
use super::trace::textures;
use crate::gpu::Module;
use crate::render::features::{Features, Target};

/// The albedo of points.
pub fn albedo(features: Features) -> &'static Module {
    if features.textures { &ALBEDO_TEXTURED } else { &ALBEDO_PLAIN }
}

/// What the emission of points is multiplied by.
pub fn glow(features: Features) -> &'static Module {
    if features.glows { &GLOW_TEXTURED } else { &GLOW_NONE }
}

/// What the radiance of area lights is multiplied by.
pub fn light_glow(features: Features) -> Vec<&'static Module> {
    match features.glows {
        true => [&textures(features)[..], &[&LIGHT_TEXTURED]].concat(),
        false => vec![&LIGHT_PLAIN],
    }
}

/// What keeps albedo and emission of points where rays have hit.
pub fn keep(features: Features) -> Vec<&'static Module> {
    let mut modules = Vec::new();
    if features.textures || features.glows {
        modules.extend(textures(features).into_iter().chain([&MATERIAL_TEXTURES]));
    }
    modules.push(if features.textures { &KEEP_ALBEDO } else { &KEEP_ALBEDO_NONE });
    modules.push(if features.glows { &KEEP_GLOW } else { &KEEP_GLOW_NONE });
    modules
}

/// The buffers that [`keep`] writes.
pub fn kept(features: Features) -> Vec<&'static Module> {
    let buffers = [(features.textures, albedo(features)), (features.glows, glow(features))];
    buffers.into_iter().filter_map(|(is, module)| is.then_some(module)).collect()
}

/// What points gather.
pub fn gathered(target: Target) -> &'static Module {
    if target.features.phong { &GATHERED_PHONG } else { &GATHERED_DIFFUSE }
}

/// How points gather, and what they reflect of it.
pub fn lobes(target: Target) -> Vec<&'static Module> {
    match target.features.phong {
        true => vec![&GATHERED_PHONG, &VIEW_KEPT, &FINISH, &PHONG, &LOBE_ENERGY, &LOBES_PHONG],
        false => vec![&GATHERED_DIFFUSE, &LOBE_ENERGY, &LOBES_DIFFUSE],
    }
}

/// How surfaces scatter light.
pub fn scatter(target: Target) -> Vec<&'static Module> {
    match target.features.phong {
        true => vec![&GATHERED_PHONG, &FINISH, &PHONG, &LOBE_ENERGY, &LOBES_PHONG, &SCATTER_PHONG],
        false => vec![&SCATTER_DIFFUSE],
    }
}
