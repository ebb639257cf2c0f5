//! Strata of all lights that have some extent: what one choice among lamps, emitting meshes and parts
//! of the sky is made from.

use super::Lights;
use super::kind::LightKind;
use crate::gpu::LightStratumRecord;

/// Strata of the environment, across and down: powers of two.
const SKY_STRATA: [u32; 2] = [16, 16];
/// Strata of the emitting triangles, or of the spheres, at least and at most: powers of two.
const LEAST_STRATA: u32 = 8;
const MOST_STRATA: u32 = 64;

/// Those of lights of the kinds asked for. Of a kind, all have the same probability.
pub fn strata(lights: &Lights, kinds: &[LightKind]) -> Vec<LightStratumRecord> {
    kinds.iter().flat_map(|&kind| of_kind(lights, kind)).collect()
}

fn of_kind(lights: &Lights, kind: LightKind) -> Vec<LightStratumRecord> {
    let (code, [across, down]) = match kind {
        LightKind::Area => (0, [of_lamps(lights.count(kind)), 1]),
        LightKind::Sphere => (1, [of_lamps(lights.count(kind)), 1]),
        LightKind::Environment => (2, SKY_STRATA),
        LightKind::Point | LightKind::Spot | LightKind::Directional => return Vec::new(),
    };
    let extent = [1.0 / across as f32, 1.0 / down as f32];
    // Along a Morton curve, so that those side by side are near each other in the list.
    let places = (0..across * down).map(|index| match down {
        1 => [index, 0],
        _ => morton_place(index),
    });
    let stratum = |[x, y]: [u32; 2]| LightStratumRecord {
        low: [x as f32 * extent[0], y as f32 * extent[1]],
        extent,
        kind: code,
        pad: [0; 3],
    };
    places.map(stratum).collect()
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
