//! Colours of other primaries as Rec. 709.

use glam::{DMat3, DVec2, DVec3};

/// What red, green and blue are, and white, by their chromaticities x and y (CIE 1931).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Primaries {
    /// Red, green and blue.
    pub colors: [DVec2; 3],
    /// White.
    pub white: DVec2,
}

/// Those of Rec. 709 (ITU-R BT.709-6) and sRGB, white D65.
pub const REC_709: Primaries = Primaries {
    colors: [DVec2::new(0.64, 0.33), DVec2::new(0.3, 0.6), DVec2::new(0.15, 0.06)],
    white: DVec2::new(0.3127, 0.329),
};

impl Primaries {
    /// Whether they are so near that the difference is rounding, or another's idea of D65.
    pub fn is_like(&self, other: &Self) -> bool {
        const NEAR: f64 = 0.003;
        let pairs = self.colors.iter().zip(&other.colors).chain([(&self.white, &other.white)]);
        pairs.into_iter().all(|(one, two)| one.distance(*two) < NEAR)
    }

    /// The matrix from their RGB to XYZ, in which white has a Y of 1; none if they span no colours.
    fn to_xyz(self) -> Option<DMat3> {
        let [red, green, blue] = self.colors.map(xyz);
        let unscaled = DMat3::from_cols(red, green, blue);
        let scale = unscaled.inverse() * xyz(self.white);
        let matrix = unscaled * DMat3::from_diagonal(scale);
        matrix.is_finite().then_some(matrix).filter(|m| m.determinant().abs() > 1e-6)
    }

    /// The matrix from their RGB to that of Rec. 709, white becoming white (Bradford's adaptation; Lam,
    /// "Metamerism and Colour Constancy", 1985); none if they span no colours.
    pub fn to_rec_709(self) -> Option<DMat3> {
        let cones = DMat3::from_cols(
            DVec3::new(0.8951, -0.7502, 0.0389),
            DVec3::new(0.2664, 1.7135, -0.0685),
            DVec3::new(-0.1614, 0.0367, 1.0296),
        );
        let [from, to] = [self.white, REC_709.white].map(|white| cones * xyz(white));
        let adapt = cones.inverse() * DMat3::from_diagonal(to / from) * cones;
        let matrix = from_xyz()? * adapt * self.to_xyz()?;
        matrix.is_finite().then_some(matrix)
    }
}

/// The matrix from XYZ to the RGB of Rec. 709.
pub fn from_xyz() -> Option<DMat3> {
    REC_709.to_xyz().map(|matrix| matrix.inverse())
}

/// The colour of a chromaticity whose Y is 1.
fn xyz(at: DVec2) -> DVec3 {
    DVec3::new(at.x / at.y, 1.0, (1.0 - at.x - at.y) / at.y)
}

/// Changes all colours by a matrix.
pub fn convert(pixels: &mut [[f32; 3]], matrix: DMat3) {
    for pixel in pixels {
        *pixel = (matrix * DVec3::from_array(pixel.map(f64::from))).as_vec3().to_array();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_stays_white_and_rec_709_is_itself() {
        let same = REC_709.to_rec_709().unwrap();
        assert!((same - DMat3::IDENTITY).abs_diff_eq(DMat3::ZERO, 1e-12));
        let acescg = Primaries {
            colors: [DVec2::new(0.713, 0.293), DVec2::new(0.165, 0.83), DVec2::new(0.128, 0.044)],
            white: DVec2::new(0.32168, 0.33767),
        };
        let matrix = acescg.to_rec_709().unwrap();
        assert!((matrix * DVec3::ONE).distance(DVec3::ONE) < 1e-9);
        // As OpenColorIO has it.
        assert!((matrix * DVec3::X).distance(DVec3::new(1.7051, -0.1302, -0.0240)) < 2e-3);
        assert!(!acescg.is_like(&REC_709));
        let none = Primaries { colors: [DVec2::ONE; 3], ..REC_709 };
        assert!(none.to_rec_709().is_none());
    }
}
