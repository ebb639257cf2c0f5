//! The programs that filter light over pixels that see the same surface.

use super::catalogue::{
    FILTER_FAR, FILTER_GUIDE, FILTER_LEVEL, FILTER_NEAR, FILTER_PARAMS, FILTER_SURFACES,
    LIGHT_TABLE, LIGHT_TO_POINTS, LIGHT_TO_TABLE, ONE_SURFACE, PACK_LIGHT, PACK_SURFACES, PIXELS,
    RAY_COUNTS, TABLE, TYPES,
};
use super::gather::{surface, surface_code};
use super::materials::gathered;
use crate::gpu::{Module, Program};
use crate::render::features::Target;

/// What is filtered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Filtered {
    /// Light samples.
    Direct,
    /// What bias compensation gives back.
    Compensation,
}

/// The programs of the filter.
#[derive(Debug)]
pub struct FilterPrograms {
    /// The surfaces of visible points in the order of pixels.
    pub surfaces: Program,
    /// How many pixels around see the same surface, and so how many samples points take.
    pub counts: Program,
    /// The light of visible points in the order of pixels.
    pub light: Program,
    /// What is compared: local means.
    pub means: Program,
    /// A level whose taps are among the 5 × 5 pixels around.
    pub near: Program,
    /// One whose taps are not.
    pub far: Program,
    /// The last of those.
    pub last: Program,
}

impl FilterPrograms {
    /// For what is filtered.
    pub fn new(target: Target, filtered: Filtered) -> Self {
        let common = [&TYPES, &PIXELS, &TABLE, &FILTER_PARAMS];
        let program = |labels: [&'static str; 2], modules: &[&'static Module]| {
            Program::new(labels[filtered as usize], [&common[..], modules].concat())
        };
        let around = [&ONE_SURFACE, surface(target), &FILTER_SURFACES];
        let far = [&around[..], &[&FILTER_FAR]].concat();
        let level = |taps: &[&'static Module], to| {
            let own = [gathered(target), &LIGHT_TABLE, to, &FILTER_LEVEL];
            program(["direct light, filter", "compensation, filter"], &[taps, &own].concat())
        };
        Self {
            surfaces: program(
                ["direct light, surfaces", "compensation, surfaces"],
                &[&surface_code(target)[..], &[&PACK_SURFACES]].concat(),
            ),
            counts: program(
                ["direct light, ray counts", "compensation, like pixels"],
                &[&around[..], &[&RAY_COUNTS]].concat(),
            ),
            light: program(
                ["direct light, packing", "compensation, packing"],
                &[gathered(target), &LIGHT_TO_TABLE, &PACK_LIGHT],
            ),
            means: program(
                ["direct light, local means", "compensation, local means"],
                &[&FILTER_GUIDE],
            ),
            near: level(&[&FILTER_NEAR], &LIGHT_TO_TABLE),
            far: level(&far, &LIGHT_TO_TABLE),
            last: level(&far, &LIGHT_TO_POINTS),
        }
    }

    /// All of them.
    pub fn all(self) -> [Program; 7] {
        let Self { surfaces, counts, light, means, near, far, last } = self;
        [surfaces, counts, light, means, near, far, last]
    }
}
