//! The programs of the path tracer.

use super::{Prepared, emit, traverse};
use crate::gpu::module::{
    AREA_LIGHT, CAMERA, CHOOSE_LIGHT, HIT_POINT, MIS, NO_ROULETTE, PATH, PATH_AREA, PATH_BOUNCE,
    PATH_CAMERA, PATH_COMPACT, PATH_COUNT, PATH_EMISSION, PATH_LIGHT, PATH_NO_EMISSION, PATH_POINT,
    PATH_RANDOM, PATH_STATE, PATH_SUM, PIXELS, POINT_LIGHT, RAY, ROULETTE, SAMPLING, TYPES,
};
use crate::gpu::{Module, Program};
use crate::render::{Bounces, Direct, Settings};

/// Camera rays.
pub fn camera(subgroups: bool) -> Program {
    let mut modules = vec![&TYPES, &SAMPLING, &PIXELS, &RAY, traverse(subgroups)];
    modules.extend([&CAMERA, &HIT_POINT, &PATH_STATE, &PATH_CAMERA]);
    Program { label: "paths, camera", modules }
}

fn vertex(subgroups: bool, last: &[&'static Module]) -> Vec<&'static Module> {
    let first = [&TYPES, &SAMPLING, &RAY, traverse(subgroups), &PATH, &PATH_STATE, &PATH_RANDOM];
    [&first[..], last].concat()
}

/// Shadow rays to point lights.
pub fn point(subgroups: bool) -> Program {
    let last = [&POINT_LIGHT, &CHOOSE_LIGHT, &PATH_LIGHT, &PATH_POINT];
    Program { label: "paths, point lights", modules: vertex(subgroups, &last) }
}

/// Shadow rays to area lights.
pub fn area(subgroups: bool) -> Program {
    let last = [&AREA_LIGHT, &CHOOSE_LIGHT, &PATH_LIGHT, &MIS, &PATH_AREA];
    Program { label: "paths, area lights", modules: vertex(subgroups, &last) }
}

/// The way on from a vertex to the next, where area lights may be met.
pub fn bounce(subgroups: bool, bounces: Bounces, areas: bool) -> Program {
    let survival = if bounces == Bounces::Unlimited { &ROULETTE } else { &NO_ROULETTE };
    let mut last = vec![&HIT_POINT, survival];
    match areas {
        true => last.extend([&MIS, &PATH_EMISSION]),
        false => last.push(&PATH_NO_EMISSION),
    }
    last.push(&PATH_BOUNCE);
    Program { label: "paths, bounce", modules: vertex(subgroups, &last) }
}

/// How many paths go on.
pub fn count() -> Program {
    Program { label: "paths, count", modules: vec![&TYPES, &PATH, &PATH_COUNT] }
}

/// The queue of those that do.
pub fn compact() -> Program {
    Program { label: "paths, queue", modules: vec![&TYPES, &PATH, &PATH_COMPACT] }
}

/// Mean and spread of the samples of pixels.
pub fn sum() -> Program {
    Program { label: "paths, sum", modules: vec![&PATH, &PATH_SUM] }
}

/// Whether paths have a vertex where they seek light straight from its source.
pub fn seeks_light(settings: &Settings) -> bool {
    settings.direct != Direct::Off || settings.bounces != Bounces::Finite(0)
}

/// What a scene and settings need.
pub(super) fn needed(prepared: &Prepared, settings: &Settings) -> Vec<Program> {
    let subgroups = prepared.gpu.has_subgroups();
    let (areas, points) = (prepared.area_lights.is_some(), prepared.point_lights.is_some());
    let lit = seeks_light(settings);
    let mut programs = vec![camera(subgroups), count(), compact(), sum()];
    programs.extend(areas.then(emit));
    programs.extend((lit && areas).then(|| area(subgroups)));
    programs.extend((lit && points).then(|| point(subgroups)));
    let bounces = settings.bounces != Bounces::Finite(0);
    programs.extend(bounces.then(|| bounce(subgroups, settings.bounces, areas)));
    programs
}

/// Every program of paths.
pub(super) fn all() -> Vec<Program> {
    let mut programs = vec![count(), compact(), sum()];
    for subgroups in [false, true] {
        programs.extend([camera(subgroups), point(subgroups), area(subgroups)]);
        for areas in [false, true] {
            let kinds = [Bounces::Finite(1), Bounces::Unlimited];
            programs.extend(kinds.map(|bounces| bounce(subgroups, bounces, areas)));
        }
    }
    programs
}
