//! The programs of bias compensation.

use super::catalogue::{
    COMPENSATION_ADD, COMPENSATION_BOUND, COMPENSATION_CONTRIBUTION, COMPENSATION_DIFFUSE,
    COMPENSATION_GLOSSY, COMPENSATION_SEGMENT, COMPENSATION_SHARE, COMPENSATION_START,
    COMPENSATION_SURVIVAL, COMPENSATION_VPLS, EMITTER_SURFACE, PAIR_BOUNDED, PAIR_DIFFUSE,
    PAIR_GLOSSY, PATH_STATE, SAMPLING, SEEN_ALL, SIGHT_COLUMNS, SIGHT_NONE, TABLE, TYPES,
    VPL_TABLE, VPL_TABLE_GLOSSY,
};
use super::materials::{gathered, lobes};
use super::path::{next_event_by, segments, vertex};
use super::visibility::vpl;
use crate::gpu::{Module, Program};
use crate::render::features::Target;
use crate::render::lights::LightKind;
use crate::render::settings::Bounces;

/// A path at each visible point.
pub fn start() -> Program {
    let modules = vec![&TYPES, &SAMPLING, &PATH_STATE, &COMPENSATION_START];
    Program::new("compensation, start", modules)
}

/// Light straight from its source at vertices.
pub fn next_event(target: Target, kind: LightKind) -> Option<Program> {
    let back = [&carried(target)[..], &[&COMPENSATION_CONTRIBUTION]].concat();
    next_event_by(target, kind, &back)
}

/// Light of VPLs at vertices; with `columns` of which clusters have told what they see.
pub fn vpls(target: Target, columns: bool) -> Program {
    let [table, pair] = match target.features.phong {
        true => [&VPL_TABLE_GLOSSY, &PAIR_GLOSSY],
        false => [&VPL_TABLE, &PAIR_DIFFUSE],
    };
    let mut last = carried(target);
    last.extend([vpl(target), &TABLE, table, &PAIR_BOUNDED, &EMITTER_SURFACE, &SEEN_ALL, pair]);
    last.push(if columns { &SIGHT_COLUMNS } else { &SIGHT_NONE });
    last.push(&COMPENSATION_VPLS);
    Program::new("compensation, VPLs", vertex(target, &last))
}

/// The next segment, in a scene with or without surfaces that emit.
pub fn segment(target: Target, bounces: Bounces, areas: bool) -> Program {
    let mut last = segments(target, bounces, areas);
    last.extend(carried(target));
    last.extend([&TABLE, &COMPENSATION_BOUND, &COMPENSATION_SEGMENT]);
    Program::new("compensation, segment", vertex(target, &last))
}

/// What was given back, to what visible points gather.
pub fn compensated(target: Target) -> Program {
    Program::new("compensation", vec![gathered(target), &COMPENSATION_ADD])
}

/// What is carried from vertex to vertex.
fn carried(target: Target) -> Vec<&'static Module> {
    let of = if target.features.phong { &COMPENSATION_GLOSSY } else { &COMPENSATION_DIFFUSE };
    [&lobes(target)[..], &[&COMPENSATION_SHARE, &COMPENSATION_SURVIVAL, of]].concat()
}

/// Every program of bias compensation for a target.
pub fn all(target: Target) -> Vec<Program> {
    let mut programs = vec![start(), compensated(target)];
    programs.extend(LightKind::ALL.into_iter().filter_map(|kind| next_event(target, kind)));
    programs.extend([false, true].map(|columns| vpls(target, columns)));
    for areas in [false, true] {
        let kinds = [Bounces::Finite(1), Bounces::Unlimited];
        programs.extend(kinds.map(|bounces| segment(target, bounces, areas)));
    }
    programs
}
