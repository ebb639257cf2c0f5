//! The programs of shadow rays between points and many lights: VPLs, or places on light sources.

use super::catalogue::{
    BITS, DRAW_MEMBERS, EMITTER_POINT, EMITTER_SURFACE, EXPAND, EXPAND_PARAMS, MEMBER_DIFFUSE,
    MEMBER_GLOSSY, MEMBERS, PACK_COLUMNS, RAY, SAMPLING, TABLE, TYPES, VIEW_DIRECTION,
    VISIBILITY_LIGHTS, VISIBILITY_PARAMS, VPL_DIFFUSE, VPL_GLOSSY, WEIGHT_DIFFUSE, WEIGHT_GLOSSY,
};
use super::trace::{Tracing, blockers, shapes};
use crate::gpu::{Module, Program};
use crate::render::features::Target;
use crate::render::lights::LightKind;

/// How many rays one invocation may trace in a dispatch, a power of two up to the 32 of a
/// word. Mesa's llvmpipe silently leaves all loops of an invocation after 65,535 rounds
/// together; so many are enough for that many rays even if each meets all boxes of a small
/// hierarchy, or many of a large one.
pub fn rays_at_once(nodes: usize) -> u32 {
    const ROUNDS: usize = 65_000;
    // A round for a node, and at a leaf, which half of the nodes are, one for each triangle, one
    // to leave them, and one for the way on.
    let rays = (ROUNDS / (4 * nodes.max(1))).clamp(4, 32);
    1 << rays.ilog2()
}

/// What the lights are that points gather.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Emitter {
    /// Places on surfaces: VPLs, or places on light sources.
    Surface,
    /// Point lights.
    Point,
}

impl Emitter {
    /// What the lights of a kind are gathered as, if they can be.
    pub fn of(kind: LightKind) -> Option<Self> {
        match kind {
            LightKind::Point => Some(Self::Point),
            LightKind::Area => Some(Self::Surface),
            LightKind::Spot
            | LightKind::Directional
            | LightKind::Sphere
            | LightKind::Environment => None,
        }
    }

    /// The module of it.
    pub fn module(self) -> &'static Module {
        match self {
            Self::Surface => &EMITTER_SURFACE,
            Self::Point => &EMITTER_POINT,
        }
    }
}

/// The record of a light that points gather.
pub fn vpl(target: Target) -> &'static Module {
    if target.features.phong { &VPL_GLOSSY } else { &VPL_DIFFUSE }
}

/// Shadow rays between points and lights.
pub fn visibility(target: Target, tracing: Tracing, emitter: Emitter) -> Program {
    let mut modules = vec![&TYPES, &VIEW_DIRECTION, vpl(target)];
    modules.extend(met(target, tracing));
    modules.extend([emitter.module(), &VISIBILITY_LIGHTS, &VISIBILITY_PARAMS, &BITS]);
    if matches!(tracing, Tracing::Shaft | Tracing::Rays) {
        modules.push(&TABLE);
    }
    modules.extend(tracing.modules());
    modules.push(tracing.of_lights());
    Program::new("visibility", modules)
}

/// Shadow rays between points and members of VPL clusters that they draw.
pub fn visibility_of_members(target: Target, tracing: Tracing) -> Program {
    let mut modules = vec![&TYPES, &VIEW_DIRECTION];
    modules.extend(met(target, tracing));
    modules.extend([&VISIBILITY_PARAMS, &BITS, &TABLE]);
    modules.extend([member(target), &MEMBERS]);
    modules.extend(tracing.modules());
    modules.push(tracing.of_members());
    Program::new("visibility of clusters", modules)
}

/// Which members of VPL clusters points draw.
pub fn draw_members(target: Target) -> Program {
    let weight = if target.features.phong { &WEIGHT_GLOSSY } else { &WEIGHT_DIFFUSE };
    let modules = [&TYPES, &SAMPLING, &TABLE, &VISIBILITY_PARAMS, member(target), weight];
    Program::new("draws of members", [&modules[..], &[&DRAW_MEMBERS]].concat())
}

/// The record of a member of a VPL cluster.
fn member(target: Target) -> &'static Module {
    if target.features.phong { &MEMBER_GLOSSY } else { &MEMBER_DIFFUSE }
}

/// What shadow rays may meet.
fn met(target: Target, tracing: Tracing) -> Vec<&'static Module> {
    match tracing {
        Tracing::Single => shapes(target.features),
        Tracing::Shaft | Tracing::Rays => blockers(target.features),
        Tracing::Literals => vec![&RAY],
    }
}

/// Visibility of VPLs from that of their clusters.
pub fn expand() -> Program {
    Program::new("expansion", vec![&TABLE, &EXPAND_PARAMS, &EXPAND])
}

/// Visibility of VPL clusters, packed for that.
pub fn pack_columns() -> Program {
    Program::new("expansion, packing", vec![&TABLE, &EXPAND_PARAMS, &PACK_COLUMNS])
}
