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
/// So many lights have a stratum each...
const SINGLE: u32 = 128;
/// ... and more are in runs of so many: the guide asks each of them, as `ASKED` of
/// `shaders/direct/guide_unshadowed.wgsl`. In longer runs every block of pixels asks others.
const ASKED: u32 = 4;

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

/// Strata of so many lights at some place, and so many that are infinitely far away: runs of them,
/// `most` at most. Those far away, few and strong, are never with others.
pub fn strata([near, far]: [u32; 2], most: u32) -> Vec<LightStratumRecord> {
    let of_far = far.min(most / 4);
    let of_near = near.div_ceil(ASKED).max(SINGLE).min(most - of_far);
    [runs(0, near, of_near), runs(near, far, of_far)].concat()
}

/// Runs of so many lights from the first on.
fn runs(first: u32, lights: u32, most: u32) -> Vec<LightStratumRecord> {
    let count = lights.min(most);
    let end = move |run: u32| (u64::from(run) * u64::from(lights) / u64::from(count)) as u32;
    let run = |run: u32| LightStratumRecord {
        low: [(first + end(run)) as f32, 0.0],
        extent: [(end(run + 1) - end(run)) as f32, 1.0],
        kind: DELTA,
        pad: [0; 3],
    };
    (0..count).map(run).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_light_is_in_one_stratum() {
        for [near, far, most] in
            [[1, 0, 64], [0, 9, 64], [65, 2, 64], [100_000, 100, 256], [7, 3, 8], [700, 1, 447]]
        {
            let mut end = 0;
            let strata = strata([near, far], most);
            assert!(strata.len() as u32 <= most);
            for stratum in strata {
                assert_eq!(stratum.low[0] as u32, end);
                assert!(stratum.extent[0] >= 1.0);
                let next = end + stratum.extent[0] as u32;
                assert!(end >= near || next <= near, "one near and one far");
                end = next;
            }
            assert_eq!(end, near + far);
        }
    }
}
