//! The programs of camera rays, and of what comes back along them.

use super::catalogue::{
    ANTIALIAS, BACKGROUND, CAMERA, CORNERS, EMIT, FINISH, FOLLOW_NONE, FOLLOW_SPECULAR, GLASS,
    HIT_POINT, KEEP_THROUGHPUT, KEEP_THROUGHPUT_NONE, MIRROR, ONE_SURFACE, PIXELS, REFLECTANCE_ANY,
    REFLECTANCE_PLAIN, RESOLVE, SAMPLING, SHAPE_TRIANGLE, SHOW_ALBEDO, SHOW_DEPTH, SHOW_NORMAL,
    THROUGHPUT_KEPT, THROUGHPUT_NONE, TURN, TURN_EITHER, TURN_GLASS, TURN_MIRROR, TYPES,
    UNSEEN_BACKGROUND, UNSEEN_NONE, VIEW_KEPT, VIEW_NONE, VISIBLE, WAY_BACK,
};
use super::lights::sky;
use super::materials::{albedo, glow, keep, kept};
use super::trace::rays;
use crate::gpu::{Module, Program};
use crate::render::features::{Features, Target};
use crate::render::settings::Method;

/// Camera rays. Points keep their depth, or, if there is light, where they are seen from.
pub fn visible_points(target: Target, lit: bool) -> Program {
    let keep = if target.features.specular() { &KEEP_THROUGHPUT } else { &KEEP_THROUGHPUT_NONE };
    let mut modules = camera_rays(target, &kept_points(target.features));
    let view = if lit { &VIEW_KEPT } else { &VIEW_NONE };
    modules.extend([&WAY_BACK, view, keep, &VISIBLE]);
    Program::new("visible points", modules)
}

/// What is kept of points by the pass that finds them.
pub fn kept_points(features: Features) -> Vec<&'static Module> {
    [kept(features), keep(features)].concat()
}

/// More camera rays where pixels see edges.
pub fn antialias(target: Target) -> Program {
    let unseen = match sky(target) {
        Some(sky) => [&sky[..], &[&UNSEEN_BACKGROUND]].concat(),
        None => vec![&UNSEEN_NONE],
    };
    let last = [&unseen[..], &[throughput(target), &ONE_SURFACE, &ANTIALIAS]].concat();
    let modules = camera_rays(target, &last);
    Program::new("antialiasing", modules)
}

pub fn camera_rays(target: Target, last: &[&'static Module]) -> Vec<&'static Module> {
    let (first, rays) = ([&TYPES, &SAMPLING, &PIXELS], rays(target));
    [&first[..], &rays, &[&CAMERA], &follow(target), last].concat()
}

/// How rays go on at mirrors and glass, and what they see.
pub fn follow(target: Target) -> Vec<&'static Module> {
    // The other ways to trace rays load all triangles.
    let corners: &[&Module] = if target.literals { &[&CORNERS, &SHAPE_TRIANGLE] } else { &[] };
    let turns: &[&Module] = match (target.features.mirror, target.features.glass) {
        (false, false) => return [corners, &[&HIT_POINT, &FOLLOW_NONE]].concat(),
        (true, false) => &[&MIRROR, &TURN_MIRROR],
        (false, true) => &[&GLASS, &TURN_GLASS],
        (true, true) => &[&MIRROR, &GLASS, &TURN_EITHER],
    };
    [corners, &[&HIT_POINT, &WAY_BACK, &FINISH, &TURN], turns, &[&FOLLOW_SPECULAR]].concat()
}

/// What comes back of the radiance of visible points.
pub fn throughput(target: Target) -> &'static Module {
    if target.features.specular() { &THROUGHPUT_KEPT } else { &THROUGHPUT_NONE }
}

/// Radiance of visible points to the film, through mirrors and glass.
pub fn resolve(target: Target) -> Program {
    Program::new("throughput", vec![&TYPES, throughput(target), &RESOLVE])
}

/// Emission towards the camera.
pub fn emit(target: Target) -> Program {
    let modules = vec![&TYPES, &THROUGHPUT_NONE, glow(target.features), &EMIT];
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
        match target.features.has_finishes() {
            true => modules.extend([&FINISH, &REFLECTANCE_ANY]),
            false => modules.push(&REFLECTANCE_PLAIN),
        }
    }
    modules.push(module);
    Some(Program::new(label, modules))
}
