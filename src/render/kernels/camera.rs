//! The programs of camera rays, and of what comes back along them.

use super::catalogue::{
    BACKGROUND, BSDF, CAMERA, EMIT, GLASS, HIT_POINT, HIT_TRIANGLES, MIRROR, ONE_SURFACE,
    PIXEL_RAYS, PIXELS, PIXELS_AROUND, POINT_RAY, POINT_RAY_ANY, POINT_RAY_OWN, RAY_OFFSET,
    REFLECTANCE_ANY, REFLECTANCE_PLAIN, RESOLVE, SAMPLE_SPECULAR_EITHER, SAMPLE_SPECULAR_GLASS,
    SAMPLE_SPECULAR_MIRROR, SAMPLING, SEEN_SURFACE, SHAPE_TRIANGLE, SHOW_ALBEDO, SHOW_DEPTH,
    SHOW_NORMAL, SPECULAR_CHAIN, SPECULAR_CHAIN_NONE, SPECULAR_SAMPLE, STORE_THROUGHPUT,
    STORE_THROUGHPUT_NONE, TABLE, THROUGHPUT_NONE, THROUGHPUT_STORED, TYPES, VIEW_DIRECTION,
    VIEW_DIRECTION_NONE, VISIBLE_POINTS,
};
use super::lights::sky;
use super::materials::{albedo, attributes, emission_scale, store_attributes};
use super::trace::rays;
use crate::gpu::{Module, Program};
use crate::render::features::{Features, Target};
use crate::render::settings::Method;

/// Camera rays. Points keep their depth, or, if there is light, where they are seen from; where pixels
/// are antialiased, some give way to others.
pub fn visible_points(target: Target, lit: bool, antialiased: bool) -> Program {
    let mut modules = camera_rays(target, &point_attributes(target.features));
    modules.push(&POINT_RAY);
    match antialiased {
        true => {
            let surfaces: [&Module; 5] =
                [&TABLE, &PIXEL_RAYS, &PIXELS_AROUND, &ONE_SURFACE, &SEEN_SURFACE];
            modules.extend(surfaces);
            modules.push(&POINT_RAY_ANY);
        }
        false => modules.push(&POINT_RAY_OWN),
    }
    let view = if lit { &VIEW_DIRECTION } else { &VIEW_DIRECTION_NONE };
    modules.extend([&RAY_OFFSET, view, store_throughput(target), &VISIBLE_POINTS]);
    Program::new("visible points", modules)
}

/// What is kept of points by the stage that finds them.
pub fn point_attributes(features: Features) -> Vec<&'static Module> {
    [attributes(features), store_attributes(features, true)].concat()
}

/// Camera rays, before what becomes of them.
pub fn camera_rays(target: Target, last: &[&'static Module]) -> Vec<&'static Module> {
    let (first, rays) = ([&TYPES, &SAMPLING, &PIXELS], rays(target));
    [&first[..], &rays, &[&CAMERA], &specular_chain(target), last].concat()
}

/// The triangles that rays hit, where tracing them does not load them anyway.
pub fn corners(target: Target) -> &'static [&'static Module] {
    static CORNERS: [&Module; 2] = [&HIT_TRIANGLES, &SHAPE_TRIANGLE];
    if target.literals { &CORNERS } else { &[] }
}

/// How rays go on at mirrors and glass, and what they see.
pub fn specular_chain(target: Target) -> Vec<&'static Module> {
    let corners = corners(target);
    let sampled: &[&Module] = match (target.features.mirror, target.features.glass) {
        (false, false) => return [corners, &[&HIT_POINT, &SPECULAR_CHAIN_NONE]].concat(),
        (true, false) => &[&MIRROR, &SAMPLE_SPECULAR_MIRROR],
        (false, true) => &[&GLASS, &SAMPLE_SPECULAR_GLASS],
        (true, true) => &[&MIRROR, &GLASS, &SAMPLE_SPECULAR_EITHER],
    };
    [corners, &[&HIT_POINT, &RAY_OFFSET, &BSDF, &SPECULAR_SAMPLE], sampled, &[&SPECULAR_CHAIN]]
        .concat()
}

/// What keeps that of visible points.
pub fn store_throughput(target: Target) -> &'static Module {
    if target.features.specular() { &STORE_THROUGHPUT } else { &STORE_THROUGHPUT_NONE }
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
