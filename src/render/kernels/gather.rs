//! The programs that gather the light of many lights: VPLs, or places on light sources.

use super::surfaces::{self, shapes};
use super::tracing::Tracing;
use crate::gpu::module::{
    BITS, COLLECT, COMBINE, EMITTER_POINT, EMITTER_SURFACE, EXPAND, FINISH, GATHER,
    GATHERED_DIFFUSE, GATHERED_PHONG, GIVEN_BACK, GIVEN_NONE, INTERLEAVED, LOBE_ENERGY,
    LOBES_DIFFUSE, LOBES_PHONG, ONE_SURFACE, PAIR_BOUNDED, PAIR_DIFFUSE, PAIR_GLOSSY,
    PAIR_UNBOUNDED, PHONG, PIXELS, RAY, REFLECT, REMOVED, ROW_CLUSTER, ROW_POINT, SEEN_FUZZY,
    SEEN_HARD, SEPARATE, SHADE, SHADE_COOPERATIVE, SHADE_GLOSSY, SIGNATURE_NONE, SIGNATURE_PROBED,
    SURFACE_LOBE_CODE, SURFACE_LOBED, SURFACE_PLAIN, TYPES, VIEW_KEPT, VPL_DIFFUSE, VPL_GLOSSY,
};
use crate::gpu::{Module, Program};
use crate::render::{LightKind, Plan, Target};

/// What points gather.
pub(super) fn gathered(target: Target) -> &'static Module {
    if target.features.phong { &GATHERED_PHONG } else { &GATHERED_DIFFUSE }
}

/// How points gather, and what they reflect of it.
pub(super) fn lobes(target: Target) -> Vec<&'static Module> {
    match target.features.phong {
        true => vec![&GATHERED_PHONG, &VIEW_KEPT, &FINISH, &PHONG, &LOBE_ENERGY, &LOBES_PHONG],
        false => vec![&GATHERED_DIFFUSE, &LOBE_ENERGY, &LOBES_DIFFUSE],
    }
}

pub(super) fn vpl(target: Target) -> &'static Module {
    if target.features.phong { &VPL_GLOSSY } else { &VPL_DIFFUSE }
}

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

    fn module(self) -> &'static Module {
        match self {
            Self::Surface => &EMITTER_SURFACE,
            Self::Point => &EMITTER_POINT,
        }
    }
}

/// Shadow rays between points and lights.
pub fn visibility(target: Target, tracing: Tracing, emitter: Emitter) -> Program {
    let mut modules = vec![&TYPES, &VIEW_KEPT, vpl(target)];
    modules.extend(match tracing {
        Tracing::Single => shapes(target.features),
        Tracing::Shaft | Tracing::Rays => surfaces::blockers(target.features),
        Tracing::Literals => vec![&RAY],
    });
    modules.extend([emitter.module(), &BITS]);
    modules.extend(tracing.modules());
    Program::new("visibility", modules)
}

/// The visibility program that suits a scene and its device.
pub fn visibility_for(plan: &Plan, emitter: Emitter) -> Program {
    visibility(plan.target(), Tracing::of(plan), emitter)
}

/// Visibility of VPLs from that of their clusters.
pub fn expand() -> Program {
    Program::new("expansion", vec![&EXPAND])
}

/// Interleaved sampling: points into the order of subsets.
pub fn separate() -> Program {
    let modules = vec![&TYPES, &PIXELS, &INTERLEAVED, &SEPARATE];
    Program::new("separation", modules)
}

/// Interleaved sampling: what points have gathered into rows of pixels, with signatures where
/// their visibility is probed, and with what bias compensation gives back.
pub fn collect(target: Target, probed: bool, compensated: bool) -> Program {
    let signature = if probed { &SIGNATURE_PROBED } else { &SIGNATURE_NONE };
    let given = if compensated { &GIVEN_BACK } else { &GIVEN_NONE };
    let mut modules = vec![&TYPES, gathered(target), &PIXELS, &INTERLEAVED, signature, given];
    modules.push(surface(target));
    if target.features.phong {
        modules.extend([&FINISH, &SURFACE_LOBE_CODE]);
    }
    modules.push(&COLLECT);
    Program::new("collection", modules)
}

/// Interleaved sampling: what the pixels around have gathered.
pub fn combine(target: Target) -> Program {
    let modules = vec![
        &TYPES,
        gathered(target),
        &PIXELS,
        &INTERLEAVED,
        &ONE_SURFACE,
        surface(target),
        &COMBINE,
    ];
    Program::new("combination", modules)
}

/// What tells the surfaces of pixels apart.
fn surface(target: Target) -> &'static Module {
    if target.features.phong { &SURFACE_LOBED } else { &SURFACE_PLAIN }
}

/// Whose row of the bit matrix a point reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sharing {
    /// Its own.
    Own,
    /// That of its cluster.
    Cluster,
    /// Those of the nearest clusters, weighted.
    Fuzzy,
}

/// Shading of points by lights.
pub fn shade(target: Target, bounded: bool, sharing: Sharing, emitter: Emitter) -> Program {
    let bound = if bounded { &PAIR_BOUNDED } else { &PAIR_UNBOUNDED };
    let mut modules = [&[&TYPES, vpl(target)][..], &lobes(target)].concat();
    modules.extend([bound, emitter.module(), &GATHER]);
    match sharing {
        Sharing::Own => modules.extend([&SEEN_HARD, &ROW_POINT]),
        Sharing::Cluster => modules.extend([&SEEN_HARD, &ROW_CLUSTER]),
        Sharing::Fuzzy => modules.push(&SEEN_FUZZY),
    }
    let glossy = target.features.phong;
    modules.push(if glossy { &PAIR_GLOSSY } else { &PAIR_DIFFUSE });
    modules.push(match target.subgroups {
        true if glossy => &SHADE_GLOSSY,
        true => &SHADE_COOPERATIVE,
        false => &SHADE,
    });
    Program::new("shading", modules)
}

/// What visible points have gathered to reflected radiance.
pub fn reflect(target: Target) -> Program {
    let albedo = surfaces::albedo(target.features);
    let modules = [&[&TYPES][..], &lobes(target), &[albedo, &REFLECT]].concat();
    Program::new("reflection", modules)
}

/// What the clamp removed, where points have gathered what bias compensation gives back or not.
pub fn removed(target: Target, compensated: bool) -> Program {
    let given = if compensated { &GIVEN_BACK } else { &GIVEN_NONE };
    let albedo = surfaces::albedo(target.features);
    let modules = [&[&TYPES][..], &lobes(target), &[albedo, given, &REMOVED]].concat();
    Program::new("clamped energy", modules)
}
