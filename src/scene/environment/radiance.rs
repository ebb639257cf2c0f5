//! Radiance by direction.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use super::unpack;

/// Radiance by direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Environment {
    /// Radiance [W sr⁻¹ m⁻²]; what the image is multiplied by, if there is one.
    pub radiance: Vec3,
    /// How it varies.
    pub image: Option<EnvironmentImage>,
}

/// An equirectangular image: a row is a circle of latitude, the first around +Y. The middle
/// column is towards -Z, to its right is +X.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EnvironmentImage {
    /// Where it came from.
    pub name: String,
    /// Width and height, both at least 1.
    pub size: [u32; 2],
    /// Rows from the top, as [`super::pack`] packs them.
    pub texels: Vec<u32>,
}

impl Environment {
    /// Whether it is not black.
    pub fn shines(&self) -> bool {
        let image =
            |image: &EnvironmentImage| image.texels.iter().any(|&texel| texel & 0x07ff_ffff != 0);
        self.radiance.max_element() > 0.0 && self.image.as_ref().is_none_or(image)
    }

    /// The radiance that comes from a direction, of unit length: that of the texel. The twin of
    /// `background` in `shaders/lights/environment_image.wgsl`.
    pub fn from_direction(&self, direction: Vec3) -> Vec3 {
        self.radiance * self.image.as_ref().map_or(Vec3::ONE, |image| image.at(place(direction)))
    }
}

impl EnvironmentImage {
    /// The texel at a place, from the top left, in [0, 1]².
    pub fn at(&self, uv: Vec2) -> Vec3 {
        let [width, height] = self.size;
        let texel = |at: f32, size: u32| ((at * size as f32) as u32).min(size - 1);
        let (x, y) = (texel(uv.x, width), texel(uv.y, height));
        unpack(self.texels[y as usize * width as usize + x as usize])
    }
}

/// Where in an equirectangular image a unit direction is, from its top left, in [0, 1]².
pub fn place(direction: Vec3) -> Vec2 {
    let turn = libm::atan2f(direction.x, -direction.z);
    let polar = libm::atan2f(libm::hypotf(direction.x, direction.z), direction.y);
    Vec2::new(0.5 + turn / TAU, polar / PI)
}

/// The unit direction of a place in an equirectangular image: the inverse of [`place`].
pub fn direction(place: Vec2) -> Vec3 {
    let (turn, polar) = ((place.x - 0.5) * TAU, place.y * PI);
    let sin = libm::sinf(polar);
    Vec3::new(sin * libm::sinf(turn), libm::cosf(polar), -sin * libm::cosf(turn))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_and_places_are_inverse() {
        for i in 1..40 {
            for j in 1..20 {
                let at = Vec2::new(i as f32 / 40.0, j as f32 / 20.0);
                assert!(place(direction(at)).distance(at) < 1e-5, "{at}");
            }
        }
        assert!(direction(Vec2::new(0.5, 0.5)).distance(-Vec3::Z) < 1e-6);
        assert!(direction(Vec2::new(0.75, 0.5)).distance(Vec3::X) < 1e-6);
        assert!(direction(Vec2::new(0.2, 0.0)).distance(Vec3::Y) < 1e-6);
    }
}
