//! What is at the places that rays hit: the modules that textures and BSDFs choose.

use super::catalogue::{
    ALBEDO_PLAIN, ALBEDO_TEXTURED, BSDF, EMISSION_SCALE_AT, EMISSION_SCALE_AT_NONE,
    EMISSION_SCALE_NONE, EMISSION_SCALE_TEXTURED, FOOTPRINT, GATHERED_DIFFUSE, GATHERED_PHONG,
    LIGHT_SCALE_NONE, LIGHT_SCALE_TEXTURED, LOBE_ENERGY, LOBE_SAMPLE, LOBES_DIFFUSE, LOBES_PHONG,
    MATERIAL_TEXTURES, MATERIAL_TEXTURES_FILTERED, PHONG, SCATTER_DIFFUSE, SCATTER_PHONG,
    STORE_ALBEDO, STORE_ALBEDO_NONE, STORE_EMISSION_SCALE, STORE_EMISSION_SCALE_NONE,
    TEXTURE_FILTERED, UV_DIFFERENCE, UV_DIFFERENCE_ANY, UV_DIFFERENCE_TRIANGLE, VERTEX_COLOR,
    VERTEX_COLOR_NONE, VIEW_DIRECTION,
};
use super::trace::textures;
use crate::gpu::Module;
use crate::render::features::{Features, Target};

/// The albedo of points.
pub fn albedo(features: Features) -> &'static Module {
    if features.textures { &ALBEDO_TEXTURED } else { &ALBEDO_PLAIN }
}

/// What the emission of points is multiplied by.
pub fn emission_scale(features: Features) -> &'static Module {
    if features.emission_textures { &EMISSION_SCALE_TEXTURED } else { &EMISSION_SCALE_NONE }
}

/// What the emission where a ray has hit is multiplied by.
pub fn emission_scale_at(features: Features) -> Vec<&'static Module> {
    match features.emission_textures {
        true => [&textures(features)[..], &[&MATERIAL_TEXTURES, &EMISSION_SCALE_AT]].concat(),
        false => vec![&EMISSION_SCALE_AT_NONE],
    }
}

/// What the radiance of area lights is multiplied by.
pub fn light_emission_scale(features: Features) -> Vec<&'static Module> {
    match features.emission_textures {
        true => [&textures(features)[..], &[&LIGHT_SCALE_TEXTURED]].concat(),
        false => vec![&LIGHT_SCALE_NONE],
    }
}

/// What the colours of corners multiply the albedo by.
fn vertex_color(features: Features) -> &'static Module {
    if features.vertex_colors { &VERTEX_COLOR } else { &VERTEX_COLOR_NONE }
}

/// What keeps albedo and emission of points where rays have hit, at a place or, where camera rays
/// are `filtered`, over what a pixel sees.
pub fn store_attributes(features: Features, filtered: bool) -> Vec<&'static Module> {
    let mut modules = Vec::new();
    if features.textures || features.emission_textures {
        modules.extend(textures(features));
        match filtered {
            true => modules.extend(filtered_textures(features)),
            false => modules.push(&MATERIAL_TEXTURES),
        }
    }
    match features.textures {
        true => modules.extend([vertex_color(features), &STORE_ALBEDO]),
        false => modules.push(&STORE_ALBEDO_NONE),
    }
    modules.push(if features.emission_textures {
        &STORE_EMISSION_SCALE
    } else {
        &STORE_EMISSION_SCALE_NONE
    });
    modules
}

/// Textures over what a pixel sees, after [`textures`].
pub fn filtered_textures(features: Features) -> [&'static Module; 5] {
    let shapes = if features.spheres { &UV_DIFFERENCE_ANY } else { &UV_DIFFERENCE_TRIANGLE };
    [&UV_DIFFERENCE, shapes, &TEXTURE_FILTERED, &FOOTPRINT, &MATERIAL_TEXTURES_FILTERED]
}

/// The buffers that [`store_attributes`] writes.
pub fn attributes(features: Features) -> Vec<&'static Module> {
    let buffers = [
        (features.textures, albedo(features)),
        (features.emission_textures, emission_scale(features)),
    ];
    buffers.into_iter().filter_map(|(is, module)| is.then_some(module)).collect()
}

/// What points gather.
pub fn gathered(target: Target) -> &'static Module {
    if target.features.phong { &GATHERED_PHONG } else { &GATHERED_DIFFUSE }
}

/// How points gather, and what they reflect of it.
pub fn lobes(target: Target) -> Vec<&'static Module> {
    match target.features.phong {
        true => vec![&GATHERED_PHONG, &VIEW_DIRECTION, &BSDF, &PHONG, &LOBE_ENERGY, &LOBES_PHONG],
        false => vec![&GATHERED_DIFFUSE, &LOBE_ENERGY, &LOBES_DIFFUSE],
    }
}

/// How surfaces scatter light.
pub fn scatter(target: Target) -> Vec<&'static Module> {
    match target.features.phong {
        true => vec![
            &GATHERED_PHONG,
            &BSDF,
            &PHONG,
            &LOBE_ENERGY,
            &LOBES_PHONG,
            &LOBE_SAMPLE,
            &SCATTER_PHONG,
        ],
        false => vec![&SCATTER_DIFFUSE],
    }
}
