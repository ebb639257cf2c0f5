//! The programs that antialias: the first rays of all pixels, their visible points, and more rays where
//! surfaces of unlike radiance meet.

use super::camera::{camera_rays, throughput};
use super::catalogue::{
    ANTIALIAS, BEAM, BEAM_EACH, BEAM_PACKET, CAMERA, FIRST_RADIANCE, FIRST_RAYS, LINK_RAYS,
    ONE_SURFACE, PIXEL_LIST, PIXEL_RAYS, PIXELS, PIXELS_AROUND, RADIANCE_CODE, RAY, RAY_BACKGROUND,
    RAY_BACKGROUND_NONE, RAY_CODES, RAY_EMISSION, RAY_EMISSION_NONE, RAY_EMISSION_SCALE,
    RAY_EMISSION_SCALE_NONE, RAY_LIGHT, RAY_LIGHT_NONE, RAY_SURFACES, RAY_THROUGHPUT,
    RAY_THROUGHPUT_NONE, REPLACE_POINTS, RESOLVE_RAYS, SAMPLING, SEEN_SURFACE, STORED_RAYS, TABLE,
    TYPES, UNSEEN_SURFACES,
};
use super::lights::sky;
use super::materials::filtered_textures;
use super::trace::textures;
use crate::gpu::{Module, Program};
use crate::render::features::Target;

/// The rays of a pixel, and the surfaces that pixels and rays see.
const OF_PIXELS: [&Module; 6] =
    [&TABLE, &PIXEL_RAYS, &PIXELS_AROUND, &ONE_SURFACE, &SEEN_SURFACE, &RAY_CODES];

/// Rays that one traversal of the hierarchy serves.
pub fn rays_of_beam(target: Target) -> u32 {
    if has_packets(target) { 4 } else { 1 }
}

/// The first rays of every pixel. Some surface `emits`, or none.
pub fn first_rays(target: Target, emits: bool) -> Program {
    let mut modules = camera_rays(target, &OF_PIXELS);
    modules.extend(beams(target, emits));
    modules.extend([ray_light(target, emits), ray_throughput(target), &FIRST_RAYS]);
    Program::new("first camera rays", modules)
}

/// Which pixels have a ray that meets what no visible point shows.
pub fn unseen_surfaces() -> Program {
    Program::new("unseen surfaces", around(&[&STORED_RAYS, &UNSEEN_SURFACES]))
}

/// Which pixels have visible points on such surfaces in place of others.
pub fn replace_points() -> Program {
    let first: [&Module; 5] = [&TYPES, &SAMPLING, &PIXELS, &RAY, &CAMERA];
    let modules = [&first[..], &OF_PIXELS, &[&REPLACE_POINTS]].concat();
    Program::new("replaced visible points", modules)
}

/// Which visible points give their light to the first rays.
pub fn link_rays(target: Target, emits: bool) -> Program {
    let last = [ray_light(target, emits), &STORED_RAYS, &LINK_RAYS];
    Program::new("links of rays", around(&last))
}

/// What the first rays see, to the film.
pub fn resolve_rays(target: Target, emits: bool) -> Program {
    let mut modules = vec![&TYPES, &SAMPLING, &PIXELS, &RAY, &CAMERA];
    modules.extend(OF_PIXELS);
    modules.push(ray_light(target, emits));
    modules.push(ray_throughput(target));
    modules.extend([&RADIANCE_CODE, &FIRST_RADIANCE, &RESOLVE_RAYS]);
    Program::new("radiance of rays", modules)
}

/// More camera rays where surfaces of unlike radiance meet.
pub fn antialias(target: Target, emits: bool) -> Program {
    let mut modules = camera_rays(target, &OF_PIXELS);
    modules.extend(beams(target, emits));
    modules.extend([throughput(target), &RAY_SURFACES]);
    modules.extend([&RADIANCE_CODE, &PIXEL_LIST, &ANTIALIAS]);
    Program::new("antialiasing", modules)
}

/// What points around a pixel are to its rays.
fn around(last: &[&'static Module]) -> Vec<&'static Module> {
    let first: [&Module; 5] = [&TYPES, &SAMPLING, &PIXELS, &RAY, &CAMERA];
    [&first[..], &OF_PIXELS, &[&RAY_SURFACES], last].concat()
}

/// Whether packets of beams go through the hierarchy.
fn has_packets(target: Target) -> bool {
    target.subgroups && !target.literals
}

/// Beams of camera rays, and what rays see that no light falls on.
fn beams(target: Target, emits: bool) -> Vec<&'static Module> {
    let mut modules: Vec<&Module> = vec![&BEAM];
    modules.push(if has_packets(target) { &BEAM_PACKET } else { &BEAM_EACH });
    match emits {
        true if target.features.emission_textures => {
            modules.extend(textures(target.features));
            modules.extend(filtered_textures(target.features));
            modules.extend([&RAY_EMISSION_SCALE, &RAY_EMISSION]);
        }
        true => modules.extend([&RAY_EMISSION_SCALE_NONE, &RAY_EMISSION]),
        false => modules.push(&RAY_EMISSION_NONE),
    }
    match sky(target) {
        Some(sky) => modules.extend(sky.into_iter().chain([&RAY_BACKGROUND])),
        None => modules.push(&RAY_BACKGROUND_NONE),
    }
    modules
}

/// What rays see of lights, where there is something to see.
fn ray_light(target: Target, emits: bool) -> &'static Module {
    if emits || sky(target).is_some() { &RAY_LIGHT } else { &RAY_LIGHT_NONE }
}

/// The throughputs of specular chains of first rays.
fn ray_throughput(target: Target) -> &'static Module {
    if target.features.specular() { &RAY_THROUGHPUT } else { &RAY_THROUGHPUT_NONE }
}
