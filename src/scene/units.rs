//! The units of a scene file, and the normalised ones of the renderer.

use glam::DVec3;

/// How far a half-extent may be from a power of two that is used instead. Scenes are often a power
/// of two wide; far from the origin they are so but for rounding.
const SCALE_SLACK: f64 = 1e-6;

/// The map between the file's units and the normalised ones: file = center + scale · normalised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// The centre of the scene's bounds, in the file's units.
    pub center: DVec3,
    /// Half of the longest extent, so that normalised units are the same whatever those of the
    /// file: what decides by a bit, as ties of K-means, decides alike.
    pub scale: f64,
}

impl Units {
    /// The units in which these corners span [-1, 1] along their longest axis.
    pub(super) fn around(corners: impl Iterator<Item = DVec3>) -> Self {
        let (low, high) = corners
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), corner| {
                (low.min(corner), high.max(corner))
            });
        let half_extent = 0.5 * (high - low).max_element();
        Self { center: 0.5 * (low + high), scale: power_of_two_near(half_extent) }
    }

    /// A point of the file in normalised units.
    pub fn normalise(&self, point: DVec3) -> DVec3 {
        (point - self.center) / self.scale
    }
}

/// `length`, or the power of two next to it if that is within [`SCALE_SLACK`].
fn power_of_two_near(length: f64) -> f64 {
    let power = length.log2().round().exp2();
    if (length / power - 1.0).abs() <= SCALE_SLACK { power } else { length }
}
