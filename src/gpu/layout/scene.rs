//! Shapes, materials, and points on them.

use bytemuck::{Pod, Zeroable};

/// A BVH node in depth-first order, 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct NodeRecord {
    /// Lower corner of the bounds.
    pub low: [f32; 3],
    /// The node that follows this subtree; the number of nodes after the last.
    pub skip: u32,
    /// Upper corner of the bounds.
    pub high: [f32; 3],
    /// 8 · first triangle + number of triangles; 0 for an inner node.
    pub leaf: u32,
}

/// A triangle or a sphere in leaf order, 48 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct TriangleRecord {
    /// First corner; the centre of a sphere.
    pub a: [f32; 3],
    /// Index of the material.
    pub material: u32,
    /// Second corner; the radius of a sphere, and zeros.
    pub b: [f32; 3],
    /// Index of the triangle in the scene; spheres go on where triangles end.
    pub index: u32,
    /// Third corner.
    pub c: [f32; 3],
    /// What it is: [`Self::SPHERE`] and [`Self::FAR`], and in [`Self::CUTOUT`] its alpha.
    pub kind: u32,
}

impl TriangleRecord {
    /// The bit of a sphere.
    pub const SPHERE: u32 = 1 << 31;
    /// The bit of a sphere that is met only where rays leave it: a second record of a sphere
    /// with holes, through which the far side is seen.
    pub const FAR: u32 = 1 << 30;
    /// The bits of the texture, plus one, that cuts holes into the shape; 0 for none.
    pub const CUTOUT: u32 = Self::FAR - 1;
}

/// A texture: where its texels are, those of its mip levels after them, and how it is laid on
/// surfaces; 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct TextureRecord {
    /// Its first texel.
    pub first: u32,
    /// Texels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// What lies beyond its border across, and from bit 2 on down: 0 the image again, 1 the
    /// image mirrored, 2 its border. Then [`Self::NEAREST_MAGNIFIED`] and the like, and from
    /// [`Self::LEVELS`] on the number of its levels, the image itself counted.
    pub sampler: u32,
    /// Texel coordinates are uv · scale + shift.
    pub scale: [f32; 2],
    /// See above.
    pub shift: [f32; 2],
}

impl TextureRecord {
    /// The bit of a texture whose nearest texel counts where it is magnified.
    pub const NEAREST_MAGNIFIED: u32 = 1 << 4;
    /// The same where it is minified.
    pub const NEAREST_MINIFIED: u32 = 1 << 5;
    /// The first bit of the number of levels.
    pub const LEVELS: u32 = 8;
}

/// A diffuse material, 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct MaterialRecord {
    /// Reflectance per channel.
    pub albedo: [f32; 3],
    /// Whether both sides emit.
    pub two_sided: u32,
    /// Emitted radiance.
    pub emission: [f32; 3],
    /// Unused.
    pub pad: u32,
}

/// What a material reflects beside its diffuse part, 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct BsdfRecord {
    /// Of Phong k_s, of mirrors the reflectance, of glass what goes on of the light.
    pub specular: [f32; 3],
    /// 0 diffuse, 1 Phong, 2 mirror, 3 glass.
    pub kind: u32,
    /// Of Phong the shininess, of glass the index of refraction of the inside over that of the
    /// outside.
    pub parameter: f32,
    /// Of Phong, the probability that a direction is drawn from the lobe.
    pub lobe_probability: f32,
    /// Unused.
    pub pad: [u32; 2],
}

/// A visible point (or the representative of a cluster of them), 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct PointRecord {
    /// Where it is.
    pub position: [f32; 3],
    /// Material, with the top bit set if the front of the surface is seen; all ones if the
    /// camera ray hit nothing.
    pub surface: u32,
    /// Geometric normal, facing the camera.
    pub normal: [f32; 3],
    /// Distance from the camera; or, in frames with light, the direction towards the viewer, two
    /// coordinates of 16 bits.
    pub depth: f32,
}

impl PointRecord {
    /// [`PointRecord::surface`] of a camera ray that hit nothing.
    pub const NOTHING: u32 = u32::MAX;

    /// The same, seen from this direction: the twin of `with_view_direction` in `shaders/camera/view_direction.wgsl`.
    pub fn seen_from(self, view: [f32; 3]) -> Self {
        let sum = view.map(f32::abs).iter().sum::<f32>();
        let [x, y, z] = view.map(|value| value / sum);
        let sign = |value: f32| if value >= 0.0 { 1.0 } else { -1.0 };
        let folded = match z >= 0.0 {
            true => [x, y],
            false => [(1.0 - y.abs()) * sign(x), (1.0 - x.abs()) * sign(y)],
        };
        let [low, high] = folded.map(|value| (value * 32767.0).round() as i16 as u16);
        Self { depth: f32::from_bits(u32::from(low) | u32::from(high) << 16), ..self }
    }
}
