//! The programs of the path tracer.

use super::{Plan, camera_rays, follow, kept, surfaces, view};
use crate::gpu::module::{
    AREA_LIGHT, CHOOSE_LIGHT, EMIT, FINISH, GATHERED_PHONG, HEMISPHERE, LOBES_PHONG, MIS,
    NO_ROULETTE, PATH, PATH_AREA, PATH_CAMERA, PATH_COMPACT, PATH_COUNT, PATH_EMISSION, PATH_LIGHT,
    PATH_NO_EMISSION, PATH_POINT, PATH_RANDOM, PATH_SEGMENT, PATH_STATE, PATH_SUM, PHONG,
    POINT_LIGHT, ROULETTE, SAMPLING, SCATTER_DIFFUSE, SCATTER_PHONG, THROUGHPUT_NONE,
    THROUGHPUT_PATH, TYPES, VIEW_KEPT, VIEW_NONE,
};
use crate::gpu::{Module, Program};
use crate::render::{Bounces, Direct, LightKind, Settings, Target};

/// Camera rays.
pub fn camera(target: Target) -> Program {
    let mut modules = camera_rays(target, &kept(target.features));
    modules.extend([view(target), &PATH_STATE, &PATH_CAMERA]);
    Program::new("paths, camera", modules)
}

fn vertex(target: Target, last: &[&'static Module]) -> Vec<&'static Module> {
    let (first, rays) = ([&TYPES, &SAMPLING, &HEMISPHERE], surfaces::rays(target));
    let path = [&PATH, &PATH_STATE, &PATH_RANDOM, surfaces::albedo(target.features)];
    [&first[..], &rays, &path, &scatter(target), last].concat()
}

/// How surfaces scatter light.
fn scatter(target: Target) -> Vec<&'static Module> {
    match target.features.phong {
        true => vec![&GATHERED_PHONG, &VIEW_KEPT, &FINISH, &PHONG, &LOBES_PHONG, &SCATTER_PHONG],
        false => vec![&VIEW_NONE, &SCATTER_DIFFUSE],
    }
}

/// What paths see that is emitted towards the camera.
pub fn emit(target: Target) -> Program {
    let throughput: &[&Module] = match target.features.specular() {
        true => &[&PATH_STATE, &THROUGHPUT_PATH],
        false => &[&THROUGHPUT_NONE],
    };
    let last = [surfaces::glow(target.features), &EMIT];
    Program::new("emission", [&[&TYPES], throughput, &last].concat())
}

/// Shadow rays to the lights of a kind.
pub fn next_event(target: Target, kind: LightKind) -> Program {
    let (label, last) = match kind {
        LightKind::Point => {
            ("paths, point lights", vec![&POINT_LIGHT, &CHOOSE_LIGHT, &PATH_LIGHT, &PATH_POINT])
        }
        LightKind::Area => {
            let mut last = surfaces::light_glow(target.features);
            last.extend([&AREA_LIGHT, &CHOOSE_LIGHT, &PATH_LIGHT, &MIS, &PATH_AREA]);
            ("paths, area lights", last)
        }
    };
    Program::new(label, vertex(target, &last))
}

/// The next segment of paths, in a scene with or without area lights.
pub fn segment(target: Target, bounces: Bounces, areas: bool) -> Program {
    let survival = if bounces == Bounces::Unlimited { &ROULETTE } else { &NO_ROULETTE };
    let mut last = follow(target);
    last.extend([survival, surfaces::glow(target.features)]);
    last.extend(surfaces::keep(target.features));
    match areas {
        true => last.extend([&MIS, &PATH_EMISSION]),
        false => last.push(&PATH_NO_EMISSION),
    }
    last.push(&PATH_SEGMENT);
    Program::new("paths, segment", vertex(target, &last))
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
pub(super) fn needed(plan: &Plan, settings: &Settings) -> Vec<Program> {
    let target = plan.target();
    let areas = plan.lights.count(LightKind::Area) > 0;
    let mut programs = vec![camera(target), count(), compact(), sum()];
    programs.extend(areas.then(|| emit(target)));
    if seeks_light(settings) {
        programs.extend(plan.kinds().map(|kind| next_event(target, kind)));
    }
    let segments = has_segments(settings, areas);
    programs.extend(segments.then(|| segment(target, settings.bounces, areas)));
    programs
}

/// Every program of paths that traces rays.
pub(super) fn all(target: Target) -> Vec<Program> {
    let mut programs = vec![camera(target), emit(target)];
    programs.extend(LightKind::ALL.map(|kind| next_event(target, kind)));
    for areas in [false, true] {
        let kinds = [Bounces::Finite(1), Bounces::Unlimited];
        programs.extend(kinds.map(|bounces| segment(target, bounces, areas)));
    }
    programs
}

/// The programs of paths that are the same for every scene.
pub(super) fn common() -> Vec<Program> {
    vec![count(), compact(), sum()]
}
