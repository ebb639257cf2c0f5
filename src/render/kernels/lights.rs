//! How places on the lights of each kind are drawn: the modules that lights choose.

use super::catalogue::{
    AREA_LIGHT, AREA_LIGHT_NONE, DELTA_LIGHT, DIRECTIONAL_LIGHT, ENVIRONMENT_CELLS,
    ENVIRONMENT_CONSTANT, ENVIRONMENT_IMAGE, ENVIRONMENT_LIGHT_CONSTANT, ENVIRONMENT_LIGHT_IMAGE,
    ENVIRONMENT_LIGHT_NONE, HEMISPHERE, LIGHT_KINDS, LIGHT_SAMPLE, LIGHT_STRATA, LOCAL_LIGHT,
    ONLY_AREA, ONLY_ENVIRONMENT, ONLY_SPHERE, POINT_LIGHT, SEVERAL_KINDS, SPHERE_CONE,
    SPHERE_LIGHT, SPHERE_LIGHT_NONE, SPOT_LIGHT, STRATUM_ANY, STRATUM_DELTA, STRATUM_EXTENDED,
    TABLE, TRIANGLE_AREA,
};
use super::materials::light_emission_scale;
use crate::gpu::Module;
use crate::render::features::{Sky, Target};
use crate::render::lights::LightKind;

/// What a kernel needs to draw from the lights of a kind alone, with a density that is known by area.
pub fn lights_of(target: Target, kind: LightKind) -> Vec<&'static Module> {
    match kind {
        LightKind::Point => vec![&LIGHT_SAMPLE, &POINT_LIGHT, &LOCAL_LIGHT],
        LightKind::Spot => vec![&LIGHT_SAMPLE, &SPOT_LIGHT, &LOCAL_LIGHT],
        LightKind::Directional => vec![&LIGHT_SAMPLE, &DIRECTIONAL_LIGHT],
        LightKind::Area => {
            [&[&LIGHT_SAMPLE][..], &area_lights(target, &TRIANGLE_AREA), &[&ONLY_AREA]].concat()
        }
        LightKind::Sphere => [&[&LIGHT_SAMPLE][..], &SPHERE_LIGHTS, &[&ONLY_SPHERE]].concat(),
        LightKind::Environment => {
            [&[&LIGHT_SAMPLE][..], &environment(target), &[&ONLY_ENVIRONMENT]].concat()
        }
    }
}

/// What a kernel needs to draw from the strata of lights of these kinds; `place` says where on a
/// triangle. Lights without extent are of one table, whatever they are.
pub fn light_strata(
    target: Target,
    kinds: &[LightKind],
    place: &'static Module,
) -> Vec<&'static Module> {
    let (delta, extended): (Vec<_>, Vec<_>) =
        kinds.iter().copied().partition(|kind: &LightKind| kind.is_exact());
    let mut modules = match extended[..] {
        [] => vec![&LIGHT_SAMPLE],
        [LightKind::Area] => {
            [&[&LIGHT_SAMPLE][..], &area_lights(target, place), &[&ONLY_AREA]].concat()
        }
        [kind] => lights_of(target, kind),
        _ => several_kinds(target, &extended, place),
    };
    modules.extend([&TABLE, &LIGHT_STRATA]);
    match (delta.is_empty(), extended.is_empty()) {
        (true, _) => modules.push(&STRATUM_EXTENDED),
        (false, true) => modules.extend([&DELTA_LIGHT, &STRATUM_DELTA]),
        (false, false) => modules.extend([&LIGHT_KINDS, &DELTA_LIGHT, &STRATUM_ANY]),
    }
    modules
}

/// Lights of some extent, of several kinds.
fn several_kinds(
    target: Target,
    kinds: &[LightKind],
    place: &'static Module,
) -> Vec<&'static Module> {
    let has = |kind| kinds.contains(&kind);
    let mut modules: Vec<&Module> = vec![&LIGHT_SAMPLE];
    match has(LightKind::Area) {
        true => modules.extend(area_lights(target, place)),
        false => modules.push(&AREA_LIGHT_NONE),
    }
    match has(LightKind::Sphere) {
        true => modules.extend(SPHERE_LIGHTS),
        false => modules.push(&SPHERE_LIGHT_NONE),
    }
    match has(LightKind::Environment) && target.features.sky.shines() {
        true => modules.extend(environment(target)),
        false => modules.push(&ENVIRONMENT_LIGHT_NONE),
    }
    modules.extend([&LIGHT_KINDS, &SEVERAL_KINDS]);
    modules
}

static SPHERE_LIGHTS: [&Module; 4] = [&HEMISPHERE, &TABLE, &SPHERE_CONE, &SPHERE_LIGHT];

/// Emitting triangles.
fn area_lights(target: Target, place: &'static Module) -> Vec<&'static Module> {
    let mut modules = light_emission_scale(target.features);
    modules.extend([&TABLE, &AREA_LIGHT, place]);
    modules
}

/// The environment.
fn environment(target: Target) -> Vec<&'static Module> {
    match target.features.sky {
        Sky::Image => {
            vec![&TABLE, &ENVIRONMENT_IMAGE, &ENVIRONMENT_CELLS, &ENVIRONMENT_LIGHT_IMAGE]
        }
        _ => vec![&HEMISPHERE, &ENVIRONMENT_CONSTANT, &ENVIRONMENT_LIGHT_CONSTANT],
    }
}

/// The radiance of the environment, if there is one.
pub fn sky(target: Target) -> Option<Vec<&'static Module>> {
    match target.features.sky {
        Sky::None => None,
        Sky::Constant => Some(vec![&ENVIRONMENT_CONSTANT]),
        Sky::Image => Some(vec![&TABLE, &ENVIRONMENT_IMAGE]),
    }
}

/// Whether there are programs for a kind of lights: not for an environment, or spheres, that are not
/// there.
pub fn has_kind(target: Target, kind: LightKind) -> bool {
    match kind {
        LightKind::Environment => target.features.sky.shines(),
        LightKind::Sphere => target.features.sphere_lights,
        _ => true,
    }
}
