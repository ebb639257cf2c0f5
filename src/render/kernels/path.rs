//! The programs of the path tracer.

use super::{Prepared, Purpose, Traversal, emit};
use crate::gpu::module::{
    AREA_LIGHT, CAMERA, CHOOSE_LIGHT, HIT_POINT, MIS, NO_ROULETTE, PATH, PATH_AREA, PATH_CAMERA,
    PATH_COMPACT, PATH_COUNT, PATH_EMISSION, PATH_LIGHT, PATH_NO_EMISSION, PATH_POINT, PATH_RANDOM,
    PATH_SEGMENT, PATH_STATE, PATH_SUM, PIXELS, POINT_LIGHT, ROULETTE, SAMPLING, TYPES,
};
use crate::gpu::{Module, Program};
use crate::render::{Bounces, Direct, Settings};

/// Camera rays.
pub fn camera(nearest: &Traversal) -> Program {
    let modules = [&TYPES, &SAMPLING, &PIXELS, &CAMERA, &HIT_POINT, &PATH_STATE, &PATH_CAMERA];
    nearest.link("paths, camera", &modules)
}

fn vertex(last: &[&'static Module]) -> Vec<&'static Module> {
    [&[&TYPES, &SAMPLING, &PATH, &PATH_STATE, &PATH_RANDOM][..], last].concat()
}

/// Shadow rays to point lights.
pub fn point(shadow: &Traversal) -> Program {
    let last = [&POINT_LIGHT, &CHOOSE_LIGHT, &PATH_LIGHT, &PATH_POINT];
    shadow.link("paths, point lights", &vertex(&last))
}

/// Shadow rays to area lights.
pub fn area(shadow: &Traversal) -> Program {
    let last = [&AREA_LIGHT, &CHOOSE_LIGHT, &PATH_LIGHT, &MIS, &PATH_AREA];
    shadow.link("paths, area lights", &vertex(&last))
}

/// The next segment of paths, in a scene with or without area lights.
pub fn segment(nearest: &Traversal, bounces: Bounces, areas: bool) -> Program {
    let survival = if bounces == Bounces::Unlimited { &ROULETTE } else { &NO_ROULETTE };
    let mut last = vec![&HIT_POINT, survival];
    match areas {
        true => last.extend([&MIS, &PATH_EMISSION]),
        false => last.push(&PATH_NO_EMISSION),
    }
    last.push(&PATH_SEGMENT);
    nearest.link("paths, segment", &vertex(&last))
}

/// How many paths go on.
pub fn count() -> Program {
    Program::new("paths, count", vec![&TYPES, &PATH, &PATH_COUNT])
}

/// The queue of those that do.
pub fn compact() -> Program {
    Program::new("paths, queue", vec![&TYPES, &PATH, &PATH_COMPACT])
}

/// Mean and spread of the samples of pixels.
pub fn sum() -> Program {
    Program::new("paths, sum", vec![&PATH, &PATH_SUM])
}

/// Whether paths have a vertex where they seek light straight from its source.
pub fn seeks_light(settings: &Settings) -> bool {
    settings.direct != Direct::Off || settings.bounces != Bounces::Finite(0)
}

/// Whether paths go beyond the visible point: to bounce, or to happen upon area lights.
pub fn has_segments(settings: &Settings, areas: bool) -> bool {
    settings.bounces != Bounces::Finite(0) || (areas && settings.direct != Direct::Off)
}

/// What a scene and settings need.
pub(super) fn needed(prepared: &Prepared, settings: &Settings) -> Vec<Program> {
    let [nearest, shadow] =
        [Purpose::Nearest, Purpose::Shadow].map(|purpose| Traversal::of(prepared, purpose));
    let (areas, points) = (prepared.area_lights.is_some(), prepared.point_lights.is_some());
    let lit = seeks_light(settings);
    let mut programs = vec![camera(&nearest), count(), compact(), sum()];
    programs.extend(areas.then(emit));
    programs.extend((lit && areas).then(|| area(&shadow)));
    programs.extend((lit && points).then(|| point(&shadow)));
    let segments = has_segments(settings, areas);
    programs.extend(segments.then(|| segment(&nearest, settings.bounces, areas)));
    programs
}

/// Every program of paths.
pub(super) fn all(traversals: &[Traversal]) -> Vec<Program> {
    let mut programs = vec![count(), compact(), sum()];
    for traversal in traversals {
        programs.extend([camera(traversal), point(traversal), area(traversal)]);
        for areas in [false, true] {
            let kinds = [Bounces::Finite(1), Bounces::Unlimited];
            programs.extend(kinds.map(|bounces| segment(traversal, bounces, areas)));
        }
    }
    programs
}
