//! Colours packed to 32 bits.

use glam::Vec3;

/// The largest channel that [`pack`] can hold; images are scaled to it.
pub const MOST: f32 = 65_408.0;

/// Colours of 9 bits a channel under an exponent of 5 bits, which all share: more than Radiance
/// files have. Values are rounded, and cut off at [`MOST`].
pub fn pack(color: Vec3) -> u32 {
    let color = color.clamp(Vec3::ZERO, Vec3::splat(MOST));
    let most = color.max_element().max(1e-10);
    // The least exponent whose 511 steps of 2^(exponent - 24) reach the largest channel.
    let mut exponent = (libm::floorf(libm::log2f(most)) as i32 + 16).clamp(0, 31);
    let step = |exponent: i32| libm::ldexpf(1.0, exponent - 24);
    if libm::roundf(most / step(exponent)) > 511.0 && exponent < 31 {
        exponent += 1;
    }
    let [r, g, b] =
        color.to_array().map(|channel| libm::roundf(channel / step(exponent)).min(511.0) as u32);
    r | g << 9 | b << 18 | (exponent as u32) << 27
}

/// The inverse of [`pack`].
pub fn unpack(texel: u32) -> Vec3 {
    let step = libm::ldexpf(1.0, (texel >> 27) as i32 - 24);
    let channel = |shift: u32| (texel >> shift & 511) as f32 * step;
    Vec3::new(channel(0), channel(9), channel(18))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packing_keeps_nine_bits_of_the_largest_channel() {
        for exponent in -12..16 {
            for step in 0..100 {
                let x = libm::ldexpf(1.0 + step as f32 / 100.0, exponent).min(MOST);
                let got = unpack(pack(Vec3::new(x, 0.3 * x, 0.0)));
                assert!((got.x - x).abs() <= x / 511.0 && (got.y - 0.3 * x).abs() <= x / 511.0);
            }
        }
        assert_eq!(unpack(pack(Vec3::ZERO)), Vec3::ZERO);
        assert_eq!(unpack(pack(Vec3::splat(1e9))), Vec3::splat(MOST));
    }
}
