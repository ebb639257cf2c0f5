//! Strata of all lights that samples are drawn of: what one choice among lamps, emitting meshes, parts
//! of the sky and, where they are many, lights without extent is made from.

use super::delta;
use super::kind::LightKind;
use crate::gpu::LightStratumRecord;

/// The kinds of strata, as in `shaders/lights/strata.wgsl`; the last is an even sky by the cosine.
const AREA: u32 = 0;
const SPHERE: u32 = 1;
const SKY: u32 = 2;
const HEMISPHERE: u32 = 3;
/// Strata of the environment, across and down: powers of two.
const SKY_STRATA: [u32; 2] = [16, 16];
/// Strata of the emitting triangles, or of the spheres, at least and at most: powers of two.
const LEAST_STRATA: u32 = 8;
const MOST_STRATA: u32 = 64;
/// All strata, at most: as `MOST_STRATA` of `shaders/direct/guide_params.wgsl`.
const MOST_OF_ALL: u32 = 448;

/// The strata, in the order of their table.
#[derive(Debug, Clone, Default)]
pub struct LightStrata {
    /// A record each. Of the strata of a kind that has some extent, all have the same probability in
    /// the square.
    pub records: Vec<LightStratumRecord>,
    /// How many of an even sky are the first of all; the last is then the same sky by the cosine at
    /// the point. 0 where there is no such sky.
    pub even_sky: u32,
}

impl LightStrata {
    /// Those of kinds with their numbers of lights; `even` is whether the environment has one
    /// radiance.
    pub fn of(kinds: &[(LightKind, u32)], even: bool) -> Self {
        let mut strata = Self::default();
        // The sky is first: what is told of its strata by their place is then of them alone.
        if kinds.iter().any(|(kind, _)| *kind == LightKind::Environment) {
            strata.add(SKY, SKY_STRATA);
            if even {
                strata.even_sky = strata.records.len() as u32;
            }
        }
        for (kind, lights) in kinds {
            match kind {
                LightKind::Area => strata.add(AREA, [of_lamps(*lights), 1]),
                LightKind::Sphere => strata.add(SPHERE, [of_lamps(*lights), 1]),
                _ => {}
            }
        }
        let is_far = |kind| kind == LightKind::Directional;
        let deltas = || kinds.iter().filter(|(kind, _)| kind.is_exact());
        let delta = [false, true].map(|far| {
            deltas().filter(|(kind, _)| is_far(*kind) == far).map(|(_, lights)| lights).sum::<u32>()
        });
        let room = MOST_OF_ALL - strata.records.len() as u32 - 1;
        strata.records.extend(delta::strata(delta, room));
        if strata.even_sky > 0 {
            strata.add(HEMISPHERE, [1, 1]);
        }
        strata
    }

    /// A stratum for each kind, of which all have the same probability: lights of a kind are drawn by
    /// their power, an even sky by the cosine.
    pub fn plain(kinds: &[LightKind], even: bool) -> Self {
        let mut strata = Self::default();
        for kind in kinds {
            let code = match kind {
                LightKind::Area => AREA,
                LightKind::Sphere => SPHERE,
                _ if even => HEMISPHERE,
                _ => SKY,
            };
            strata.add(code, [1, 1]);
        }
        strata
    }

    /// A grid of strata of a kind.
    fn add(&mut self, kind: u32, [across, down]: [u32; 2]) {
        let extent = [1.0 / across as f32, 1.0 / down as f32];
        self.records.extend((0..across * down).map(|index| {
            // Along a Morton curve, so that those side by side are near each other in the list.
            let [x, y] = if down == 1 { [index, 0] } else { morton_place(index) };
            let low = [x as f32 * extent[0], y as f32 * extent[1]];
            LightStratumRecord { low, extent, kind, pad: [0; 3] }
        }));
    }
}

/// A few of each lamp: those that see part of a lamp draw from that part.
fn of_lamps(lights: u32) -> u32 {
    (4 * lights).next_power_of_two().clamp(LEAST_STRATA, MOST_STRATA)
}

/// The place along a Morton curve, as far across as down.
fn morton_place(index: u32) -> [u32; 2] {
    let every_other = |bits: u32| (0..8).fold(0, |sum, bit| sum | (bits >> (2 * bit) & 1) << bit);
    [every_other(index), every_other(index >> 1)]
}
