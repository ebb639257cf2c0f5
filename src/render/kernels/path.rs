//! The programs of the path tracer.

use super::camera::{camera_rays, point_attributes, specular_chain};
use super::catalogue::{
    BACKGROUND, CHOOSE_LIGHT, EMIT, ENVIRONMENT_CELLS, ENVIRONMENT_CONSTANT, ENVIRONMENT_IMAGE,
    HEMISPHERE, MIS, PATH_BACKGROUND, PATH_BACKGROUND_NONE, PATH_BACKGROUND_WEIGHTED, PATH_CAMERA,
    PATH_COMPACT, PATH_CONTRIBUTION, PATH_COUNT, PATH_EMISSION, PATH_EMISSION_ANY,
    PATH_EMISSION_NONE, PATH_EXACT, PATH_FOLLOW, PATH_FOUND, PATH_LIGHT, PATH_PARAMS, PATH_RANDOM,
    PATH_SAMPLED, PATH_SEGMENT, PATH_STATE, PATH_SUM, RAY_OFFSET, ROULETTE, ROULETTE_NONE,
    SAMPLING, SPHERE_CONE, TABLE, THROUGHPUT_NONE, THROUGHPUT_PATH, TYPES, VIEW_DIRECTION,
};
use super::lights::{has_kind, lights_of, sky};
use super::materials::{albedo, emission_scale, scatter, store_attributes};
use super::trace::rays;
use crate::gpu::{Module, Program};
use crate::render::features::{Sky, Target};
use crate::render::lights::LightKind;
use crate::render::settings::{Bounces, Direct, Settings};

/// Camera rays.
pub fn camera(target: Target) -> Program {
    let mut modules = camera_rays(target, &point_attributes(target.features));
    modules.extend([&RAY_OFFSET, &VIEW_DIRECTION, &PATH_STATE, &PATH_CAMERA]);
    Program::new("paths, camera", modules)
}

/// What stages at the vertices of paths share, and how surfaces scatter light there.
pub fn vertex(target: Target, last: &[&'static Module]) -> Vec<&'static Module> {
    let first = [&TYPES, &SAMPLING, &HEMISPHERE, &VIEW_DIRECTION];
    let rays = rays(target);
    let path = [&PATH_PARAMS, &PATH_STATE, &PATH_RANDOM, albedo(target.features)];
    [&first[..], &rays, &path, &scatter(target), last].concat()
}

/// What paths see that is emitted towards the camera.
pub fn emit(target: Target) -> Program {
    let throughput: &[&Module] = match target.features.specular() {
        true => &[&PATH_STATE, &THROUGHPUT_PATH],
        false => &[&THROUGHPUT_NONE],
    };
    let last = [emission_scale(target.features), &EMIT];
    Program::new("emission", [&[&TYPES], throughput, &last].concat())
}

/// Shadow rays to the lights of a kind; none to a constant environment, which the next segment
/// finds as well.
pub fn next_event(target: Target, kind: LightKind) -> Option<Program> {
    next_event_by(target, kind, &[&PATH_CONTRIBUTION])
}

/// The same with what tells how much of the light paths bring back.
pub fn next_event_by(target: Target, kind: LightKind, back: &[&'static Module]) -> Option<Program> {
    // What shines evenly from everywhere is found by the next segment alone.
    let even = kind == LightKind::Environment && target.features.sky != Sky::Image;
    if even || !has_kind(target, kind) {
        return None;
    }
    let mut last = [&lights_of(target, kind)[..], back].concat();
    match kind.is_exact() {
        true => last.extend([&CHOOSE_LIGHT, &PATH_LIGHT, &PATH_EXACT]),
        false => last.extend([&PATH_LIGHT, &MIS, &PATH_SAMPLED]),
    }
    let label = match kind {
        LightKind::Point => "paths, point lights",
        LightKind::Spot => "paths, spot lights",
        LightKind::Directional => "paths, directional lights",
        LightKind::Area => "paths, area lights",
        LightKind::Sphere => "paths, sphere lights",
        LightKind::Environment => "paths, environment",
    };
    Some(Program::new(label, vertex(target, &last)))
}

/// The next segment of paths, in a scene with or without surfaces that emit.
pub fn segment(target: Target, bounces: Bounces, areas: bool) -> Program {
    let mut last = segments(target, bounces, areas);
    last.push(&PATH_SEGMENT);
    Program::new("paths, segment", vertex(target, &last))
}

/// How segments of paths go on and end, and what light they happen upon.
pub fn segments(target: Target, bounces: Bounces, areas: bool) -> Vec<&'static Module> {
    let survival = if bounces == Bounces::Unlimited { &ROULETTE } else { &ROULETTE_NONE };
    let mut last = specular_chain(target);
    last.extend([&RAY_OFFSET, &PATH_FOLLOW, survival, emission_scale(target.features)]);
    last.extend(store_attributes(target.features, false));
    let sky = target.features.sky;
    if areas || sky.shines() {
        last.push(&PATH_FOUND);
    }
    if areas || sky == Sky::Image {
        last.push(&MIS);
    }
    match target.features.sphere_lights {
        _ if !areas => last.push(&PATH_EMISSION_NONE),
        true => last.extend([&SPHERE_CONE, &PATH_EMISSION_ANY]),
        false => last.push(&PATH_EMISSION),
    }
    match sky {
        Sky::None => last.push(&PATH_BACKGROUND_NONE),
        Sky::Constant => last.extend([&ENVIRONMENT_CONSTANT, &PATH_BACKGROUND]),
        Sky::Image => {
            last.extend([
                &TABLE,
                &ENVIRONMENT_IMAGE,
                &ENVIRONMENT_CELLS,
                &PATH_BACKGROUND_WEIGHTED,
            ]);
        }
    }
    last
}

/// How many paths go on.
pub fn count() -> Program {
    Program::new("paths, count", vec![&TYPES, &PATH_PARAMS, &PATH_COUNT])
}

/// The queue of those that do.
pub fn compact() -> Program {
    Program::new("paths, queue", vec![&TYPES, &PATH_PARAMS, &PATH_COMPACT])
}

/// Mean and spread of the samples of pixels.
pub fn sum() -> Program {
    Program::new("paths, sum", vec![&PATH_PARAMS, &PATH_SUM])
}

/// Whether paths have a vertex where they seek light straight from its source.
pub fn seeks_light(settings: &Settings) -> bool {
    settings.direct != Direct::Off || settings.bounces != Bounces::Finite(0)
}

/// What paths see of the environment.
pub fn background(target: Target) -> Option<Program> {
    let mut modules = vec![&TYPES];
    modules.extend(sky(target)?);
    match target.features.specular() {
        true => modules.extend([&PATH_STATE, &THROUGHPUT_PATH, &BACKGROUND]),
        false => modules.extend([&THROUGHPUT_NONE, &BACKGROUND]),
    }
    Some(Program::new("background", modules))
}

/// Every program of paths that traces rays.
pub fn all(target: Target) -> Vec<Program> {
    let mut programs = vec![camera(target), emit(target)];
    programs.extend(background(target));
    programs.extend(LightKind::ALL.into_iter().filter_map(|kind| next_event(target, kind)));
    for areas in [false, true] {
        let kinds = [Bounces::Finite(1), Bounces::Unlimited];
        programs.extend(kinds.map(|bounces| segment(target, bounces, areas)));
    }
    programs
}

/// The programs of paths that are the same for every scene.
pub fn common() -> Vec<Program> {
    vec![count(), compact(), sum()]
}
