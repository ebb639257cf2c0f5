//! What rays hit, and what is there: the modules that a scene's shapes and textures choose.

use crate::gpu::Module;
use crate::gpu::module::{
    ALBEDO_PLAIN, ALBEDO_TEXTURED, BLOCKER_ANY, BLOCKER_TRIANGLE, KEEP_ALBEDO, KEEP_ALBEDO_NONE,
    OPAQUE_ALL, OPAQUE_CUTOUT, RAY, SHAPE_ANY, SHAPE_TRIANGLE, TEXTURE, UV_ANY, UV_TRIANGLE,
};
use crate::render::{Features, Target};

/// Rays, and the shapes that they meet.
pub fn shapes(features: Features) -> Vec<&'static Module> {
    let mut modules: Vec<&Module> = vec![&RAY];
    modules.push(if features.spheres { &SHAPE_ANY } else { &SHAPE_TRIANGLE });
    match features.cutouts {
        true => modules.extend(textures(features).into_iter().chain([&OPAQUE_CUTOUT])),
        false => modules.push(&OPAQUE_ALL),
    }
    modules
}

/// Rays, the shapes that they meet, and how those are traced that neighbours trace alike.
pub fn rays(target: Target) -> Vec<&'static Module> {
    if target.literals {
        return vec![&RAY, super::traverse(target)];
    }
    let mut modules = shapes(target.features);
    modules.push(super::traverse(target));
    modules
}

/// Rays, and the shapes that block those of a packet.
pub fn blockers(features: Features) -> Vec<&'static Module> {
    match features.spheres || features.cutouts {
        true => [&shapes(features)[..], &[&BLOCKER_ANY]].concat(),
        false => vec![&RAY, &BLOCKER_TRIANGLE],
    }
}

/// The albedo of points.
pub fn albedo(features: Features) -> &'static Module {
    if features.textures { &ALBEDO_TEXTURED } else { &ALBEDO_PLAIN }
}

/// What keeps the albedo of points where rays have hit.
pub fn keep_albedo(features: Features) -> Vec<&'static Module> {
    if !features.textures {
        return vec![&KEEP_ALBEDO_NONE];
    }
    let textures = if features.cutouts { Vec::new() } else { textures(features) };
    [&textures[..], &[&KEEP_ALBEDO]].concat()
}

fn textures(features: Features) -> Vec<&'static Module> {
    vec![&TEXTURE, if features.spheres { &UV_ANY } else { &UV_TRIANGLE }]
}
