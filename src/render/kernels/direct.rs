//! The programs of light straight from its source.

use super::camera::corners;
use super::catalogue::{
    CHOOSE_STRATUM, CHOOSE_STRATUM_EVEN, DIRECT_EXACT, DIRECT_PARAMS, DIRECT_SAMPLED, EMITTED,
    EMITTED_ANY, EMITTED_NONE, ESCAPING, ESCAPING_NONE, GUIDE, GUIDE_PARAMS, GUIDE_PILOT,
    GUIDE_UNSHADOWED, HEMISPHERE, HIT_POINT, LIGHT_KINDS, LOBE_RAYS, LOBE_SAMPLE, MEAN, MIS, RAY,
    RAYS_ALIKE, RAYS_COUNTED, RECEIVER_LOBED, RECEIVER_PLAIN, SAMPLING, SPHERE_CONE, TABLE,
    TRIANGLE_AREA, TRIANGLE_SOLID_ANGLE, TYPES, VIEW_DIRECTION,
};
use super::lights::{light_strata, lights_of, sky};
use super::materials::{emission_scale_at, lobes};
use super::trace::{rays, shape};
use crate::gpu::{Module, Program};
use crate::render::features::Target;
use crate::render::lights::LightKind;

/// Direct light from the lights of a kind without extent, each by a ray.
pub fn direct_exact(target: Target, kind: LightKind) -> Program {
    let mut modules = vec![&TYPES, &SAMPLING, &VIEW_DIRECTION];
    modules.extend(lobes(target));
    modules.extend(rays(target));
    modules.push(&DIRECT_PARAMS);
    modules.extend(lights_of(target, kind));
    modules.push(&DIRECT_EXACT);
    let label = match kind {
        LightKind::Point => "direct light, points",
        LightKind::Spot => "direct light, spots",
        _ => "direct light, directional",
    };
    Program::new(label, modules)
}

/// By what the places of light samples are drawn, and how many a point takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LightRays {
    /// All strata of the lights alike.
    Even,
    /// The guide.
    Guided,
    /// The guide, and points take numbers of samples of their own.
    Counted,
}

impl LightRays {
    /// How many a point takes.
    fn counts(self) -> &'static Module {
        if self == Self::Counted { &RAYS_COUNTED } else { &RAYS_ALIKE }
    }
}

/// Direct light from all lights of some extent. From triangles that are near to surfaces, places are
/// drawn by solid angle.
pub fn direct_sampled(target: Target, kinds: &[LightKind], near: bool, by: LightRays) -> Program {
    let mut modules = vec![&TYPES, &SAMPLING, &VIEW_DIRECTION];
    modules.extend(lobes(target));
    modules.extend(rays(target));
    modules.push(&DIRECT_PARAMS);
    modules.extend(light_strata(target, kinds, place(near)));
    match target.features.phong {
        true => {
            modules.extend([&LIGHT_KINDS, &MEAN, &MIS, &HEMISPHERE, &LOBE_SAMPLE, &RECEIVER_LOBED])
        }
        false => modules.push(&RECEIVER_PLAIN),
    }
    modules.push(by.counts());
    match by {
        LightRays::Even => modules.push(&CHOOSE_STRATUM_EVEN),
        LightRays::Guided | LightRays::Counted => modules.extend([&TABLE, &CHOOSE_STRATUM]),
    }
    modules.push(&DIRECT_SAMPLED);
    Program::new("direct light, samples", modules)
}

/// What rays by the lobes of glossy surfaces find of the lights of these kinds; nothing in scenes
/// without lobes.
pub fn direct_lobe_rays(target: Target, kinds: &[LightKind], by: LightRays) -> Option<Program> {
    if !target.features.phong {
        return None;
    }
    let has = |kind| kinds.contains(&kind);
    let mut modules = vec![&TYPES, &SAMPLING, &HEMISPHERE, &MEAN, &MIS];
    modules.extend(lobes(target));
    modules.push(&LOBE_SAMPLE);
    modules.extend(rays(target));
    modules.push(&DIRECT_PARAMS);
    if has(LightKind::Area) || has(LightKind::Sphere) {
        modules.extend(corners(target));
        modules.push(&HIT_POINT);
        modules.extend(emission_scale_at(target.features));
        match has(LightKind::Sphere) {
            true => modules.extend([&SPHERE_CONE, &EMITTED_ANY]),
            false => modules.push(&EMITTED),
        }
    } else {
        modules.push(&EMITTED_NONE);
    }
    match sky(target).filter(|_| has(LightKind::Environment)) {
        Some(sky) => modules.extend([&sky[..], &[&ESCAPING]].concat()),
        None => modules.push(&ESCAPING_NONE),
    }
    modules.extend([by.counts(), &LOBE_RAYS]);
    Some(Program::new("direct light, lobes", modules))
}

/// What the strata of the lights give unshadowed to blocks of pixels.
pub fn guide_unshadowed(target: Target, kinds: &[LightKind], near: bool) -> Program {
    let mut modules = vec![&TYPES, &SAMPLING, &VIEW_DIRECTION];
    modules.push(&RAY);
    if target.features.emission_textures {
        // Textures of lights lie on shapes.
        modules.push(shape(target.features));
    }
    modules.extend(light_strata(target, kinds, place(near)));
    modules.extend([&GUIDE_PARAMS, &GUIDE_UNSHADOWED]);
    Program::new("direct light, unshadowed", modules)
}

/// Pilot rays from blocks of pixels to strata of the lights.
pub fn guide_pilot(target: Target, kinds: &[LightKind], near: bool) -> Program {
    let mut modules = vec![&TYPES, &SAMPLING, &VIEW_DIRECTION];
    modules.extend(rays(target));
    modules.extend(light_strata(target, kinds, place(near)));
    modules.extend([&GUIDE_PARAMS, &TABLE, &CHOOSE_STRATUM, &GUIDE_PILOT]);
    Program::new("direct light, pilot rays", modules)
}

/// The probabilities of strata by what pilot rays found.
pub fn guide() -> Program {
    Program::new("direct light, guide", vec![&GUIDE_PARAMS, &TABLE, &GUIDE])
}

fn place(near: bool) -> &'static Module {
    if near { &TRIANGLE_SOLID_ANGLE } else { &TRIANGLE_AREA }
}
