//! How images are laid on surfaces, and what they are at a place of them.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3, Vec4};

use super::{Filter, Interpolation, Texels};

/// What lies beyond an image's border.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Wrap {
    /// The image again.
    #[default]
    Repeat,
    /// The image mirrored.
    Mirror,
    /// Its border.
    Clamp,
}

/// How an image is laid on surfaces: texel coordinates are uv · scale + offset, from the image's
/// top left corner, 1 its width and height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Texture {
    /// Index into [`crate::scene::Scene::images`].
    pub image: u32,
    /// Beyond the left and right border, and beyond top and bottom.
    pub wrap: [Wrap; 2],
    /// How texels become colours.
    pub filter: Filter,
    /// See above.
    pub scale: Vec2,
    /// See above.
    pub offset: Vec2,
}

impl Texture {
    /// The whole image, repeated.
    pub fn of(image: u32) -> Self {
        let (wrap, filter) = ([Wrap::Repeat; 2], Filter::default());
        Self { image, wrap, filter, scale: Vec2::ONE, offset: Vec2::ZERO }
    }

    /// Colour in linear light and alpha at a place of the image itself, which is no part of a
    /// pixel: light paths take no mip level, as a VPL has no size, and holes are cut where they
    /// are. Linearly interpolated unless the texture is magnified otherwise. The twin of
    /// `sample_texture` in `shaders/materials/texture.wgsl`.
    pub fn sample(&self, images: &[Texels], uv: Vec2) -> Vec4 {
        let image = &images[self.image as usize];
        let [width, height] = image.size;
        let at = uv * self.scale + self.offset;
        let (x0, x1, x) = neighbours(at.x, width, self.wrap[0]);
        let (y0, y1, y) = neighbours(at.y, height, self.wrap[1]);
        let [x, y] = match self.filter.magnified {
            Interpolation::Nearest => [x, y].map(|way| if way >= 0.5 { 1.0 } else { 0.0 }),
            Interpolation::Linear => [x, y],
        };
        let top = image.texel(x0, y0).lerp(image.texel(x1, y0), x);
        let bottom = image.texel(x0, y1).lerp(image.texel(x1, y1), x);
        top.lerp(bottom, y)
    }
}

/// Texture coordinates of a place on a triangle, from those of its corners.
pub fn on_triangle([a, b, c]: [Vec2; 3], weights: [f32; 3]) -> Vec2 {
    a * weights[0] + b * weights[1] + c * weights[2]
}

/// Texture coordinates of the place on a sphere that has this unit normal: u goes around +y,
/// eastwards from -z, and is one half at +z; v goes from the pole at +y to that at -y.
pub fn on_sphere(normal: Vec3) -> Vec2 {
    let across = normal.x.hypot(normal.z);
    let turn = libm::atan2f(normal.x, normal.z);
    Vec2::new(0.5 + turn / TAU, libm::atan2f(across, normal.y) / PI)
}

/// The two texels nearest to a place along an axis, and how far it is from the first to the
/// second.
fn neighbours(at: f32, size: u32, wrap: Wrap) -> (u32, u32, f32) {
    let extent = size as f32;
    // Folded before it is scaled: large coordinates, and those that are no numbers, stay inside.
    let folded = match wrap {
        Wrap::Repeat => at - at.floor(),
        Wrap::Mirror => 1.0 - (at - 2.0 * (0.5 * at).floor() - 1.0).abs(),
        Wrap::Clamp => at,
    };
    let folded = folded.clamp(0.0, 1.0);
    let place = if folded.is_nan() { 0.0 } else { folded * extent - 0.5 };
    let first = place.floor();
    let inside = |x: f32| match wrap {
        Wrap::Repeat if x < 0.0 => size - 1,
        Wrap::Repeat if x >= extent => 0,
        _ => x.clamp(0.0, extent - 1.0) as u32,
    };
    (inside(first), inside(first + 1.0), place - first)
}
