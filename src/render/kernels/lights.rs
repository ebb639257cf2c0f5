//! How places on the lights of each kind are drawn: the modules that lights choose.

use super::catalogue::{
    AREA_LIGHT, CHOOSE_LIGHT, DIRECTIONAL_LIGHT, ENVIRONMENT_CELLS, ENVIRONMENT_CONSTANT,
    ENVIRONMENT_IMAGE, ENVIRONMENT_LIGHT_CONSTANT, ENVIRONMENT_LIGHT_IMAGE, HEMISPHERE,
    LIGHT_SAMPLE, LOCAL_LIGHT, POINT_LIGHT, SPHERE_CONE, SPHERE_LIGHT, SPOT_LIGHT, TRIANGLE_AREA,
};
use super::materials::light_emission_scale;
use crate::gpu::Module;
use crate::render::features::{Sky, Target};
use crate::render::lights::LightKind;

/// What a kernel needs to draw from the lights of a kind with a density that is known by area.
pub fn lights_of(target: Target, kind: LightKind) -> Vec<&'static Module> {
    lights_by(target, kind, &TRIANGLE_AREA)
}

/// What a kernel needs to draw from the lights of a kind; `place` says where on a triangle.
pub fn lights_by(target: Target, kind: LightKind, place: &'static Module) -> Vec<&'static Module> {
    match kind {
        LightKind::Point => vec![&LIGHT_SAMPLE, &POINT_LIGHT, &LOCAL_LIGHT],
        LightKind::Spot => vec![&LIGHT_SAMPLE, &SPOT_LIGHT, &LOCAL_LIGHT],
        LightKind::Directional => vec![&LIGHT_SAMPLE, &DIRECTIONAL_LIGHT],
        LightKind::Area => {
            let mut modules = light_emission_scale(target.features);
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

/// The radiance of the environment, if there is one.
pub fn sky(target: Target) -> Option<Vec<&'static Module>> {
    match target.features.sky {
        Sky::None => None,
        Sky::Constant => Some(vec![&ENVIRONMENT_CONSTANT]),
        Sky::Image => Some(vec![&ENVIRONMENT_IMAGE]),
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
