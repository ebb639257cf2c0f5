//! The programs of light straight from its source.

use super::{gather::lobes, surfaces};
use crate::gpu::module::{
    AREA_LIGHT, BACKGROUND, CHOOSE_LIGHT, DIRECT, DIRECT_EXACT, DIRECT_SAMPLED, DIRECTIONAL_LIGHT,
    DRAW_ONE, DRAW_RESAMPLED, EMIT, ENVIRONMENT_CELLS, ENVIRONMENT_CONSTANT, ENVIRONMENT_IMAGE,
    ENVIRONMENT_LIGHT_CONSTANT, ENVIRONMENT_LIGHT_IMAGE, HEMISPHERE, LIGHT_SAMPLE, LOCAL_LIGHT,
    PLACE_BY_ANGLE, PLACE_BY_AREA, POINT_LIGHT, SAMPLING, SPHERE_CONE, SPHERE_LIGHT, SPOT_LIGHT,
    THROUGHPUT_NONE, TYPES, VIEW_KEPT,
};
use crate::gpu::{Module, Program};
use crate::render::{LightKind, Plan, Sky, Target};

/// What a kernel needs to draw from the lights of a kind with a density that is known by area.
pub(super) fn lights_of(target: Target, kind: LightKind) -> Vec<&'static Module> {
    lights_by(target, kind, &PLACE_BY_AREA)
}

/// What a kernel needs to draw from the lights of a kind; `place` says where on a triangle.
fn lights_by(target: Target, kind: LightKind, place: &'static Module) -> Vec<&'static Module> {
    match kind {
        LightKind::Point => vec![&LIGHT_SAMPLE, &POINT_LIGHT, &LOCAL_LIGHT],
        LightKind::Spot => vec![&LIGHT_SAMPLE, &SPOT_LIGHT, &LOCAL_LIGHT],
        LightKind::Directional => vec![&LIGHT_SAMPLE, &DIRECTIONAL_LIGHT],
        LightKind::Area => {
            let mut modules = surfaces::light_glow(target.features);
            modules.extend([&LIGHT_SAMPLE, &CHOOSE_LIGHT, &AREA_LIGHT, place]);
            modules
        }
        LightKind::Sphere => {
            vec![&LIGHT_SAMPLE, &CHOOSE_LIGHT, &HEMISPHERE, &SPHERE_CONE, &SPHERE_LIGHT]
        }
        LightKind::Environment => match target.features.sky {
            Sky::Image => vec![
                &LIGHT_SAMPLE,
                &ENVIRONMENT_IMAGE,
                &ENVIRONMENT_CELLS,
                &ENVIRONMENT_LIGHT_IMAGE,
            ],
            _ => {
                vec![&LIGHT_SAMPLE, &HEMISPHERE, &ENVIRONMENT_CONSTANT, &ENVIRONMENT_LIGHT_CONSTANT]
            }
        },
    }
}

/// Direct light from the lights of a kind. From many lights of some extent, those that give much
/// are sought out; from those that are near to surfaces, places are drawn by solid angle.
pub fn direct(target: Target, kind: LightKind, many: bool, near: bool) -> Program {
    let mut modules = vec![&TYPES, &SAMPLING, &VIEW_KEPT];
    modules.extend(lobes(target));
    modules.extend(surfaces::rays(target));
    modules.push(&DIRECT);
    let place = if near { &PLACE_BY_ANGLE } else { &PLACE_BY_AREA };
    modules.extend(lights_by(target, kind, place));
    match kind.is_exact() {
        true => modules.push(&DIRECT_EXACT),
        false => modules.extend([if many { &DRAW_RESAMPLED } else { &DRAW_ONE }, &DIRECT_SAMPLED]),
    }
    let label = match kind {
        LightKind::Point => "direct light, points",
        LightKind::Spot => "direct light, spots",
        LightKind::Directional => "direct light, directional",
        LightKind::Area => "direct light, areas",
        LightKind::Sphere => "direct light, spheres",
        LightKind::Environment => "direct light, environment",
    };
    Program::new(label, modules)
}

/// The program for direct light from the lights of a kind in a scene.
pub fn direct_for(plan: &Plan, kind: LightKind) -> Program {
    /// A lamp or two, of which all points see much the same.
    const FEW_LIGHTS: u32 = 16;
    direct(plan.target(), kind, plan.lights.count(kind) > FEW_LIGHTS, plan.near_lights)
}

/// Emission towards the camera.
pub fn emit(target: Target) -> Program {
    let modules = vec![&TYPES, &THROUGHPUT_NONE, surfaces::glow(target.features), &EMIT];
    Program::new("emission", modules)
}

/// Radiance of the environment towards the camera.
pub fn background(target: Target) -> Option<Program> {
    let sky = sky(target)?;
    let modules = [&[&TYPES][..], &sky, &[&THROUGHPUT_NONE, &BACKGROUND]].concat();
    Some(Program::new("background", modules))
}

/// What the camera sees emitted in a scene.
pub fn emitted(plan: &Plan) -> Vec<Program> {
    let areas = plan.lights.have_surfaces();
    areas.then(|| emit(plan.target())).into_iter().chain(background(plan.target())).collect()
}

/// The radiance of the environment, if there is one.
pub(super) fn sky(target: Target) -> Option<Vec<&'static Module>> {
    match target.features.sky {
        Sky::None => None,
        Sky::Constant => Some(vec![&ENVIRONMENT_CONSTANT]),
        Sky::Image => Some(vec![&ENVIRONMENT_IMAGE]),
    }
}

/// Whether there are programs for a kind of lights: not for an environment, or spheres, that are not
/// there.
pub(super) fn has_kind(target: Target, kind: LightKind) -> bool {
    match kind {
        LightKind::Environment => target.features.sky.shines(),
        LightKind::Sphere => target.features.sphere_lights,
        _ => true,
    }
}
