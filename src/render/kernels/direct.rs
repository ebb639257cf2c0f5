//! The programs of light straight from its source.

use super::catalogue::{
    DIRECT_EXACT, DIRECT_PARAMS, DIRECT_SAMPLED, DRAW_ONE, DRAW_RESAMPLED, SAMPLING, TRIANGLE_AREA,
    TRIANGLE_SOLID_ANGLE, TYPES, VIEW_DIRECTION,
};
use super::lights::lights_by;
use super::materials::lobes;
use super::trace::rays;
use crate::gpu::Program;
use crate::render::features::Target;
use crate::render::lights::LightKind;

/// Direct light from the lights of a kind. From many lights of some extent, those that give much
/// are sought out; from those that are near to surfaces, places are drawn by solid angle.
pub fn direct(target: Target, kind: LightKind, many: bool, near: bool) -> Program {
    let mut modules = vec![&TYPES, &SAMPLING, &VIEW_DIRECTION];
    modules.extend(lobes(target));
    modules.extend(rays(target));
    modules.push(&DIRECT_PARAMS);
    let place = if near { &TRIANGLE_SOLID_ANGLE } else { &TRIANGLE_AREA };
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
