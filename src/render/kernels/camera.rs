//! The programs of camera rays, and of what comes back along them.

use super::{light::sky, surfaces};
use crate::gpu::module::{
    ANTIALIAS, CAMERA, CORNERS, FINISH, FOLLOW_NONE, FOLLOW_SPECULAR, GLASS, HIT_POINT,
    KEEP_THROUGHPUT, KEEP_THROUGHPUT_NONE, MIRROR, ONE_SURFACE, PIXELS, RESOLVE, SAMPLING,
    SHAPE_TRIANGLE, THROUGHPUT_KEPT, THROUGHPUT_NONE, TURN, TURN_EITHER, TURN_GLASS, TURN_MIRROR,
    TYPES, UNSEEN_BACKGROUND, UNSEEN_NONE, VIEW_KEPT, VIEW_NONE, VISIBLE, WAY_BACK,
};
use crate::gpu::{Module, Program};
use crate::render::{Features, Target};

/// Camera rays. Points keep their depth, or, if there is light, where they are seen from.
pub fn visible_points(target: Target, lit: bool) -> Program {
    let keep = if target.features.specular() { &KEEP_THROUGHPUT } else { &KEEP_THROUGHPUT_NONE };
    let mut modules = camera_rays(target, &kept(target.features));
    let view = if lit { &VIEW_KEPT } else { &VIEW_NONE };
    modules.extend([&WAY_BACK, view, keep, &VISIBLE]);
    Program::new("visible points", modules)
}

/// What is kept of points by the pass that finds them.
pub(super) fn kept(features: Features) -> Vec<&'static Module> {
    [surfaces::kept(features), surfaces::keep(features)].concat()
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

pub(super) fn camera_rays(target: Target, last: &[&'static Module]) -> Vec<&'static Module> {
    let (first, rays) = ([&TYPES, &SAMPLING, &PIXELS], surfaces::rays(target));
    [&first[..], &rays, &[&CAMERA], &follow(target), last].concat()
}

/// How rays go on at mirrors and glass, and what they see.
pub(super) fn follow(target: Target) -> Vec<&'static Module> {
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
pub(super) fn throughput(target: Target) -> &'static Module {
    if target.features.specular() { &THROUGHPUT_KEPT } else { &THROUGHPUT_NONE }
}

/// Radiance of visible points to the film, through mirrors and glass.
pub fn resolve(target: Target) -> Program {
    Program::new("throughput", vec![&TYPES, throughput(target), &RESOLVE])
}
