//! The order of places along a Morton curve: neighbours in it are neighbours in space.

use glam::Vec3;

/// Interleaved bits of a position, 21 an axis; normalised coordinates lie within [-2, 2].
pub fn morton(position: Vec3) -> u64 {
    let spread = |x: f32| {
        let cell = ((f64::from(x) + 2.0) / 4.0 * f64::from(1 << 21)).clamp(0.0, 2_097_151.0);
        (0..21).fold(0u64, |sum, bit| sum | ((cell as u64 >> bit & 1) << (3 * bit)))
    };
    spread(position.x) | spread(position.y) << 1 | spread(position.z) << 2
}
