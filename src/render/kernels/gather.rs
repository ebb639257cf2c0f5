//! The programs that gather the light of many lights, and combine it over pixels.

use super::catalogue::{
    BSDF, CLAMPED_ENERGY, COMPENSATION_ADDED, COMPENSATION_NONE, DISCONTINUITY_BUFFER,
    GATHER_PARAMS, JOIN_SUBSETS, LIGHT_TABLE, LIGHT_TO_POINTS, LIGHT_TO_TABLE, ONE_SURFACE,
    PAIR_BOUNDED, PAIR_DIFFUSE, PAIR_GLOSSY, PAIR_UNBOUNDED, PIXELS, REFLECT, ROW_CLUSTER,
    ROW_POINT, SEEN_FUZZY, SEEN_HARD, SHADE, SHADE_COOPERATIVE, SHADE_GLOSSY, SIGNATURE_NONE,
    SIGNATURE_PROBED, SPLIT_SUBSETS, SUBSETS, SURFACE_LOBE_CODE, SURFACE_LOBED, SURFACE_PLAIN,
    TABLE, TYPES,
};
use super::materials::{albedo, gathered, lobes};
use super::visibility::{Emitter, vpl};
use crate::gpu::{Module, Program};
use crate::render::features::Target;
use crate::render::settings::Sharing;

/// Interleaved sampling: points into the order of subsets.
pub fn split_subsets() -> Program {
    let modules = vec![&TYPES, &PIXELS, &SUBSETS, &SPLIT_SUBSETS];
    Program::new("separation", modules)
}

/// Interleaved sampling: what points have gathered into rows of pixels, with signatures where
/// their visibility is probed, and with what bias compensation gives back.
pub fn join_subsets(target: Target, probed: bool, compensated: bool) -> Program {
    let signature = if probed { &SIGNATURE_PROBED } else { &SIGNATURE_NONE };
    let given = if compensated { &COMPENSATION_ADDED } else { &COMPENSATION_NONE };
    let mut modules = vec![&TYPES, gathered(target), &PIXELS, &SUBSETS, signature, given];
    modules.extend(surface_code(target));
    modules.extend([&TABLE, &LIGHT_TO_TABLE, &JOIN_SUBSETS]);
    Program::new("collection", modules)
}

/// Interleaved sampling: what the pixels around have gathered, along rows for pixels, or at last
/// along columns for points.
pub fn discontinuity_buffer(target: Target, last: bool) -> Program {
    let modules = vec![
        &TYPES,
        gathered(target),
        &PIXELS,
        &SUBSETS,
        &ONE_SURFACE,
        surface(target),
        &TABLE,
        &LIGHT_TABLE,
        if last { &LIGHT_TO_POINTS } else { &LIGHT_TO_TABLE },
        &DISCONTINUITY_BUFFER,
    ];
    Program::new("combination", modules)
}

/// The code that tells the surfaces of visible points apart.
pub fn surface_code(target: Target) -> Vec<&'static Module> {
    match target.features.phong {
        true => vec![surface(target), &BSDF, &SURFACE_LOBE_CODE],
        false => vec![surface(target)],
    }
}

/// What tells the surfaces of pixels apart.
pub fn surface(target: Target) -> &'static Module {
    if target.features.phong { &SURFACE_LOBED } else { &SURFACE_PLAIN }
}

/// Shading of points by lights.
pub fn shade(target: Target, bounded: bool, sharing: Sharing, emitter: Emitter) -> Program {
    let bound = if bounded { &PAIR_BOUNDED } else { &PAIR_UNBOUNDED };
    let mut modules = [&[&TYPES, vpl(target)][..], &lobes(target)].concat();
    modules.extend([bound, emitter.module(), &GATHER_PARAMS]);
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
    let albedo = albedo(target.features);
    let modules = [&[&TYPES][..], &lobes(target), &[albedo, &REFLECT]].concat();
    Program::new("reflection", modules)
}

/// What the clamp clamped_energy, where points have gathered what bias compensation gives back or not.
pub fn clamped_energy(target: Target, compensated: bool) -> Program {
    let given = if compensated { &COMPENSATION_ADDED } else { &COMPENSATION_NONE };
    let albedo = albedo(target.features);
    let modules = [&[&TYPES][..], &lobes(target), &[albedo, given, &CLAMPED_ENERGY]].concat();
    Program::new("clamped energy", modules)
}
