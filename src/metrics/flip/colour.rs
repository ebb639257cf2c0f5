//! FLIP's colours: an opponent space to blur in, L*a*b* to compare in, and what a distance
//! there is worth.

use glam::{Mat3, Vec3};

/// Linear Rec. 709 RGB to CIE XYZ, white point D65 (IEC 61966-2-1), row by row.
const XYZ_FROM_RGB: [[f32; 3]; 3] = [
    [0.412_390_8, 0.357_584_3, 0.180_480_8],
    [0.212_639, 0.715_168_7, 0.072_192_3],
    [0.019_330_8, 0.119_194_8, 0.950_532_2],
];

/// Conversions between linear RGB and spaces relative to its white.
pub struct Space {
    /// To XYZ over that of white.
    from_rgb: Mat3,
    to_rgb: Mat3,
}

impl Space {
    /// Rec. 709's.
    pub fn new() -> Self {
        let xyz_from_rgb = Mat3::from_cols_array_2d(&XYZ_FROM_RGB).transpose();
        let white = xyz_from_rgb * Vec3::ONE;
        let from_rgb = Mat3::from_diagonal(white.recip()) * xyz_from_rgb;
        Self { from_rgb, to_rgb: from_rgb.inverse() }
    }

    /// Y Cx Cz, a linear version of L*a*b*.
    pub fn opponent_from_rgb(&self, rgb: Vec3) -> Vec3 {
        let Vec3 { x, y, z } = self.from_rgb * rgb;
        Vec3::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
    }

    /// The inverse of [`Self::opponent_from_rgb`].
    pub fn rgb_from_opponent(&self, opponent: Vec3) -> Vec3 {
        let y = (opponent.x + 16.0) / 116.0;
        self.to_rgb * Vec3::new(y + opponent.y / 500.0, y, y - opponent.z / 200.0)
    }

    /// CIE 1976 L*a*b*.
    pub fn lab_from_rgb(&self, rgb: Vec3) -> Vec3 {
        let Vec3 { x, y, z } = (self.from_rgb * rgb).map(lightness);
        Vec3::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
    }
}

/// The cube root of L*a*b*, continued as a line near 0.
fn lightness(t: f32) -> f32 {
    const DELTA: f32 = 6.0 / 29.0;
    if t > DELTA * DELTA * DELTA { libm::cbrtf(t) } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
}

/// The Hunt effect: colours look more colourful where it is bright.
pub fn hunt(lab: Vec3) -> Vec3 {
    let colourfulness = 0.01 * lab.x;
    Vec3::new(lab.x, colourfulness * lab.y, colourfulness * lab.z)
}

/// The HyAB distance: city block in lightness, Euclidean in chroma.
pub fn hyab(a: Vec3, b: Vec3) -> f32 {
    let Vec3 { x, y, z } = a - b;
    x.abs() + (y * y + z * z).sqrt()
}

/// Maps distances to [0, 1]: what is below a knee gets most of the range, as larger differences
/// are all just large.
pub struct Redistribution {
    /// The largest distance, from green to blue, after the exponent.
    largest: f32,
}

impl Redistribution {
    /// The exponent of distances, q_c.
    const EXPONENT: f32 = 0.7;
    /// Where the knee is, p_c, as a fraction of the largest.
    const KNEE: f32 = 0.4;
    /// What the knee maps to, p_t.
    const AT_KNEE: f32 = 0.95;

    /// That of Rec. 709.
    pub fn new() -> Self {
        let space = Space::new();
        let [green, blue] = [Vec3::Y, Vec3::Z].map(|rgb| hunt(space.lab_from_rgb(rgb)));
        Self { largest: libm::powf(hyab(green, blue), Self::EXPONENT) }
    }

    /// What a HyAB distance is worth.
    pub fn of(&self, distance: f32) -> f32 {
        let distance = libm::powf(distance, Self::EXPONENT);
        let knee = Self::KNEE * self.largest;
        if distance < knee {
            Self::AT_KNEE / knee * distance
        } else {
            let beyond = (distance - knee) / (self.largest - knee);
            (Self::AT_KNEE + beyond * (1.0 - Self::AT_KNEE)).min(1.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_and_black_have_no_hue() {
        let space = Space::new();
        for (grey, lightness) in [(0.0, 0.0), (0.18, 49.496), (1.0, 100.0)] {
            let lab = space.lab_from_rgb(Vec3::splat(grey));
            assert!(lab.abs_diff_eq(Vec3::new(lightness, 0.0, 0.0), 1e-3), "{lab}");
        }
    }

    #[test]
    fn the_opponent_space_is_left_as_it_was_entered() {
        let space = Space::new();
        let rgb = Vec3::new(0.2, 0.9, 0.4);
        let back = space.rgb_from_opponent(space.opponent_from_rgb(rgb));
        assert!(back.abs_diff_eq(rgb, 1e-5), "{back}");
    }

    #[test]
    fn distances_are_redistributed_about_the_knee() {
        let redistribution = Redistribution::new();
        let distance = |part: f32| libm::powf(part * redistribution.largest, 1.0 / 0.7);
        for (part, worth) in [(0.0, 0.0), (0.2, 0.475), (0.4, 0.95), (0.7, 0.975), (1.0, 1.0)] {
            assert!((redistribution.of(distance(part)) - worth).abs() < 1e-5, "{part}");
        }
    }
}
