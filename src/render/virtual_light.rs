//! What visible points gather: VPLs, clusters of them, or places on light sources.

use glam::Vec3;

use crate::cluster::morton;

/// A light of a point and a side: what is gathered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VirtualLight {
    /// Where it is.
    pub position: Vec3,
    /// Unit normal of the side that it lights.
    pub normal: Vec3,
    /// Intensity along the normal of its diffuse part, per channel: exitant flux over π.
    pub intensity: Vec3,
    /// What a glossy surface adds.
    pub gloss: Option<GlossyLobe>,
}

/// The Phong lobe of a light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GlossyLobe {
    /// Index of the material.
    pub material: u32,
    /// What the intensity would be if the lobe were diffuse: flux times k_s over π.
    pub specular: Vec3,
    /// Exponent n.
    pub shininess: f32,
    /// Unit direction of the lobe, in which the surface mirrors the light that it got.
    pub mirrored: Vec3,
}

impl VirtualLight {
    /// A diffuse light.
    pub fn diffuse(position: Vec3, normal: Vec3, intensity: Vec3) -> Self {
        Self { position, normal, intensity, gloss: None }
    }

    /// The mean of the channels of the intensity, with what a glossy surface adds.
    pub fn mean_intensity(&self) -> f64 {
        let specular = self.gloss.map_or(Vec3::ZERO, |gloss| gloss.specular);
        f64::from((self.intensity + specular).element_sum()) / 3.0
    }
}

/// The order along a Morton curve, so that neighbours in a word are neighbours in space; first
/// by the side that they face, as lights that face away from a point are skipped together.
pub fn curve(lights: &[VirtualLight]) -> Vec<u32> {
    let place = within(lights.iter().map(|light| light.position));
    let mut order: Vec<u32> = (0..lights.len() as u32).collect();
    order.sort_by_cached_key(|&index| {
        let VirtualLight { position, normal, .. } = lights[index as usize];
        let axis = normal.abs().max_position();
        (2 * axis + usize::from(normal[axis] < 0.0), morton(place(position)), index)
    });
    order
}

/// Positions within [-2, 2] by their places among all, so that the cells of the curve, which decide
/// what subsets lights are dealt to, fit the lights, and not the scene around them.
fn within(positions: impl Iterator<Item = Vec3> + Clone) -> impl Fn(Vec3) -> Vec3 {
    let low = positions.clone().fold(Vec3::INFINITY, Vec3::min);
    let high = positions.fold(Vec3::NEG_INFINITY, Vec3::max);
    let extent = (high - low).max_element().max(f32::MIN_POSITIVE);
    // Neither middles nor quarters are on borders of cells, where rounding decides.
    move |position| (position - low) / extent * 2.9 - 1.618_034
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_of_lights_does_not_depend_on_their_scale() {
        let at = |i: u32, scale: f32| {
            let [x, y, z] = [7, 11, 13].map(|prime| ((i * prime) % 31) as f32 / 15.0 - 1.0);
            VirtualLight::diffuse(scale * Vec3::new(x, y, z), Vec3::Z, Vec3::ONE)
        };
        let order = |scale| curve(&(0..200).map(|i| at(i, scale)).collect::<Vec<_>>());
        assert_eq!(order(1.0), order(0.53));
        assert_ne!(order(1.0), (0..200).collect::<Vec<_>>());
        // Lights in one place have no extent.
        assert_eq!(curve(&[at(3, 1.0), at(3, 1.0)]), [0, 1]);
    }
}
