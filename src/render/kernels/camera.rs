//! The programs of camera rays, and of what comes back along them.

use super::catalogue::{
    ALBEDO_PLAIN, ANTIALIAS, BACKGROUND, BEAM_EACH, BEAM_PACKET, BSDF, CAMERA, CHOOSE_POINTS,
    CHOSEN_POINTS, EDGE_LIST, EMIT, FIRST_RAYS, GLASS, HIT_POINT, HIT_TRIANGLES, LINK_RAYS,
    MATERIAL_TEXTURES, MIRROR, ONE_SURFACE, PIXEL_RAYS, PIXELS, POINTS_AROUND, RAY, RAY_EMISSION,
    RAY_EMISSION_NONE, RAY_EMISSION_SCALE, RAY_EMISSION_SCALE_NONE, RAY_OFFSET, RAY_THROUGHPUT,
    RAY_THROUGHPUT_NONE, REFLECTANCE_ANY, REFLECTANCE_PLAIN, RESOLVE, SAMPLE_SPECULAR_EITHER,
    SAMPLE_SPECULAR_GLASS, SAMPLE_SPECULAR_MIRROR, SAMPLING, SHAPE_TRIANGLE, SHOW_ALBEDO,
    SHOW_DEPTH, SHOW_NORMAL, SPECULAR_CHAIN, SPECULAR_CHAIN_NONE, SPECULAR_SAMPLE,
    STORE_THROUGHPUT, STORE_THROUGHPUT_NONE, STORED_RAYS, THROUGHPUT_NONE, THROUGHPUT_STORED,
    TYPES, UNSEEN_BACKGROUND, UNSEEN_NONE, VIEW_DIRECTION, VIEW_DIRECTION_NONE, VISIBLE_POINTS,
};
use super::lights::sky;
use super::materials::{albedo, attributes, emission_scale, store_attributes, stored_albedo};
use super::trace::{rays, textures};
use crate::gpu::{Module, Program};
use crate::render::features::{Features, Target};
use crate::render::settings::Method;

/// Camera rays. Points keep their depth, or, if there is light, where they are seen from.
pub fn visible_points(target: Target, lit: bool) -> Program {
    let keep = if target.features.specular() { &STORE_THROUGHPUT } else { &STORE_THROUGHPUT_NONE };
    let mut modules = camera_rays(target, &point_attributes(target.features));
    let view = if lit { &VIEW_DIRECTION } else { &VIEW_DIRECTION_NONE };
    modules.extend([&RAY_OFFSET, view, keep, &VISIBLE_POINTS]);
    Program::new("visible points", modules)
}

/// What is kept of points by the stage that finds them.
pub fn point_attributes(features: Features) -> Vec<&'static Module> {
    [attributes(features), store_attributes(features)].concat()
}

/// The first camera rays of pixels whose edges are antialiased; `emits` is whether surfaces do.
pub fn first_rays(target: Target, emits: bool) -> Program {
    let keep = if target.features.specular() { &STORE_THROUGHPUT } else { &STORE_THROUGHPUT_NONE };
    let mut modules = camera_rays(target, &stored_albedo(target.features));
    modules.extend((emits && !target.features.textures).then_some(&ALBEDO_PLAIN));
    modules.extend(beams(target, emits));
    modules.extend([&RAY_OFFSET, &VIEW_DIRECTION, keep, &PIXEL_RAYS, ray_throughput(target)]);
    modules.push(&FIRST_RAYS);
    Program::new("first rays", modules)
}

/// Which visible points are to be on another surface.
pub fn choose_points() -> Program {
    let modules = [&around()[..], &[&STORED_RAYS, &CHOOSE_POINTS]].concat();
    Program::new("choice of points", modules)
}

/// Visible points on other surfaces.
pub fn chosen_points(target: Target) -> Program {
    let keep = if target.features.specular() { &STORE_THROUGHPUT } else { &STORE_THROUGHPUT_NONE };
    let mut modules = camera_rays(target, &stored_albedo(target.features));
    modules.extend([&RAY_OFFSET, &VIEW_DIRECTION, keep, &PIXEL_RAYS, &EDGE_LIST, &CHOSEN_POINTS]);
    Program::new("chosen points", modules)
}

/// Which visible points give their light to the first rays.
pub fn link_rays() -> Program {
    let modules = [&around()[..], &[&STORED_RAYS, &LINK_RAYS]].concat();
    Program::new("links of rays", modules)
}

/// Radiance of pixels by their first rays, and more where pixels see edges; `emits` is whether
/// surfaces do.
pub fn antialias(target: Target, emits: bool) -> Program {
    let last = [&PIXEL_RAYS, &ONE_SURFACE, &POINTS_AROUND, throughput(target)];
    let mut modules = camera_rays(target, &[]);
    modules.extend(emits.then_some(&ALBEDO_PLAIN));
    modules.extend(beams(target, emits));
    modules.extend(last);
    modules.extend([ray_throughput(target), &EDGE_LIST, &ANTIALIAS]);
    Program::new("antialiasing", modules)
}

/// What points around a pixel are to its first rays.
fn around() -> Vec<&'static Module> {
    vec![&TYPES, &SAMPLING, &PIXELS, &RAY, &CAMERA, &PIXEL_RAYS, &ONE_SURFACE, &POINTS_AROUND]
}

/// Rays that one traversal of the hierarchy serves.
pub fn rays_of_beam(target: Target) -> u32 {
    if target.subgroups && !target.literals { 4 } else { 1 }
}

/// Beams of camera rays, and what rays see that no light falls on.
fn beams(target: Target, emits: bool) -> Vec<&'static Module> {
    let packet = target.subgroups && !target.literals;
    let mut modules = vec![if packet { &BEAM_PACKET } else { &BEAM_EACH }];
    match emits {
        true if target.features.emission_textures => {
            modules.extend(textures(target.features));
            modules.extend([&MATERIAL_TEXTURES, &RAY_EMISSION_SCALE, &RAY_EMISSION]);
        }
        true => modules.extend([&RAY_EMISSION_SCALE_NONE, &RAY_EMISSION]),
        false => modules.push(&RAY_EMISSION_NONE),
    }
    match sky(target) {
        Some(sky) => modules.extend(sky.into_iter().chain([&UNSEEN_BACKGROUND])),
        None => modules.push(&UNSEEN_NONE),
    }
    modules
}

/// The throughputs of specular chains of first rays.
fn ray_throughput(target: Target) -> &'static Module {
    if target.features.specular() { &RAY_THROUGHPUT } else { &RAY_THROUGHPUT_NONE }
}

pub fn camera_rays(target: Target, last: &[&'static Module]) -> Vec<&'static Module> {
    let (first, rays) = ([&TYPES, &SAMPLING, &PIXELS], rays(target));
    [&first[..], &rays, &[&CAMERA], &specular_chain(target), last].concat()
}

/// How rays go on at mirrors and glass, and what they see.
pub fn specular_chain(target: Target) -> Vec<&'static Module> {
    // The other ways to trace rays load all triangles.
    let corners: &[&Module] =
        if target.literals { &[&HIT_TRIANGLES, &SHAPE_TRIANGLE] } else { &[] };
    let sampled: &[&Module] = match (target.features.mirror, target.features.glass) {
        (false, false) => return [corners, &[&HIT_POINT, &SPECULAR_CHAIN_NONE]].concat(),
        (true, false) => &[&MIRROR, &SAMPLE_SPECULAR_MIRROR],
        (false, true) => &[&GLASS, &SAMPLE_SPECULAR_GLASS],
        (true, true) => &[&MIRROR, &GLASS, &SAMPLE_SPECULAR_EITHER],
    };
    [corners, &[&HIT_POINT, &RAY_OFFSET, &BSDF, &SPECULAR_SAMPLE], sampled, &[&SPECULAR_CHAIN]]
        .concat()
}

/// What comes back of the radiance of visible points.
pub fn throughput(target: Target) -> &'static Module {
    if target.features.specular() { &THROUGHPUT_STORED } else { &THROUGHPUT_NONE }
}

/// Radiance of visible points to the film, through mirrors and glass.
pub fn resolve(target: Target) -> Program {
    Program::new("throughput", vec![&TYPES, throughput(target), &RESOLVE])
}

/// Emission towards the camera.
pub fn emit(target: Target) -> Program {
    let modules = vec![&TYPES, &THROUGHPUT_NONE, emission_scale(target.features), &EMIT];
    Program::new("emission", modules)
}

/// Radiance of the environment towards the camera.
pub fn background(target: Target) -> Option<Program> {
    let sky = sky(target)?;
    let modules = [&[&TYPES][..], &sky, &[&THROUGHPUT_NONE, &BACKGROUND]].concat();
    Some(Program::new("background", modules))
}

/// The picture of a method without light; none for the others.
pub fn show(target: Target, method: Method) -> Option<Program> {
    let (label, module) = match method {
        Method::Normal => ("normals", &SHOW_NORMAL),
        Method::Depth => ("depth", &SHOW_DEPTH),
        Method::Albedo => ("albedo", &SHOW_ALBEDO),
        _ => return None,
    };
    let mut modules = vec![&TYPES];
    if method == Method::Albedo {
        modules.push(albedo(target.features));
        match target.features.has_bsdfs() {
            true => modules.extend([&BSDF, &REFLECTANCE_ANY]),
            false => modules.push(&REFLECTANCE_PLAIN),
        }
    }
    modules.push(module);
    Some(Program::new(label, modules))
}
