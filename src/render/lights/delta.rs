//! Lights without extent as samples are drawn of them where they are many: all in one table, in runs
//! of lights that are about as strong and near each other.

use glam::Vec3;

use super::table::mean;
use crate::cluster::morton;
use crate::gpu::{
    DeltaLightRecord, DirectionalLightRecord, LightStratumRecord, PointLightRecord, SpotLightRecord,
};

/// The code of their strata, as in `shaders/lights/kinds.wgsl`.
const DELTA: u32 = 4;

/// A point light: the ramp of a spot that is 1 in all directions.
pub fn of_point(light: &PointLightRecord) -> DeltaLightRecord {
    DeltaLightRecord {
        place: light.position,
        is_far: 0,
        intensity: light.intensity,
        slope: 1.0,
        axis: [0.0; 3],
        cos_outer: -1.0,
    }
}

/// A spot.
pub fn of_spot(light: &SpotLightRecord) -> DeltaLightRecord {
    DeltaLightRecord {
        place: light.position,
        is_far: 0,
        intensity: light.intensity,
        slope: light.slope,
        axis: light.axis,
        cos_outer: light.cos_outer,
    }
}

/// A light infinitely far away.
pub fn of_directional(light: &DirectionalLightRecord) -> DeltaLightRecord {
    DeltaLightRecord {
        place: light.toward,
        is_far: 1,
        intensity: light.irradiance,
        slope: 0.0,
        axis: [0.0; 3],
        cos_outer: 0.0,
    }
}

/// Orders lights so that each run of them is of one kind and about as strong, and then along a Morton
/// curve: in a run, all are drawn alike.
pub fn order(lights: &mut [DeltaLightRecord]) {
    lights.sort_by_key(|light| {
        let strength = mean(Vec3::from_array(light.intensity)).log2().div_euclid(2.0) as i32;
        (light.is_far, -strength, morton(Vec3::from_array(light.place)))
    });
}

/// Strata of so many lights: a run each, `most` at most.
pub fn strata(lights: u32, most: u32) -> impl Iterator<Item = LightStratumRecord> {
    let count = lights.min(most);
    let first = move |run: u32| (u64::from(run) * u64::from(lights) / u64::from(count)) as u32;
    (0..count).map(move |run| LightStratumRecord {
        low: [first(run) as f32, 0.0],
        extent: [(first(run + 1) - first(run)) as f32, 1.0],
        kind: DELTA,
        pad: [0; 3],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_light_is_in_one_stratum() {
        for (lights, most) in [(1, 64), (5, 64), (64, 64), (65, 64), (100_000, 256), (7, 3)] {
            let mut end = 0;
            let strata: Vec<_> = strata(lights, most).collect();
            assert_eq!(strata.len() as u32, lights.min(most));
            for stratum in strata {
                assert_eq!(stratum.low[0] as u32, end);
                assert!(stratum.extent[0] >= 1.0);
                end += stratum.extent[0] as u32;
            }
            assert_eq!(end, lights);
        }
    }
}
