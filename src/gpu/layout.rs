//! The records that host and shaders share. A test holds each against naga's layout of the
//! WGSL struct of the same name.

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

/// A texture: where its texels are, and how it is laid on surfaces; 32 bytes.
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
    /// image mirrored, 2 its border.
    pub wrap: u32,
    /// Texel coordinates are uv · scale + shift.
    pub scale: [f32; 2],
    /// See above.
    pub shift: [f32; 2],
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
pub struct FinishRecord {
    /// Of Phong k_s, of mirrors the reflectance, of glass what goes on of the light.
    pub specular: [f32; 3],
    /// 0 diffuse, 1 Phong, 2 mirror, 3 glass.
    pub kind: u32,
    /// Of Phong the shininess, of glass the index of refraction of the inside over that of the
    /// outside.
    pub parameter: f32,
    /// Of Phong, the probability that a direction is drawn from the lobe.
    pub gloss: f32,
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
    /// Distance from the camera; or, in frames with Phong surfaces, the direction towards the
    /// viewer, two coordinates of 16 bits.
    pub depth: f32,
}

impl PointRecord {
    /// [`PointRecord::surface`] of a camera ray that hit nothing.
    pub const NOTHING: u32 = u32::MAX;
}

/// A virtual point light, 48 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct VplRecord {
    /// Where it is.
    pub position: [f32; 3],
    /// Unused.
    pub pad0: f32,
    /// Unit normal of the side that it lights.
    pub normal: [f32; 3],
    /// Unused.
    pub pad1: f32,
    /// Intensity along the normal: exitant flux over π.
    pub intensity: [f32; 3],
    /// Mean of the channels of `intensity`.
    pub mean: f32,
}

/// A virtual point light with a Phong lobe, 80 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct GlossyVplRecord {
    /// Where it is.
    pub position: [f32; 3],
    /// Exponent n of the lobe.
    pub shininess: f32,
    /// Unit normal of the side that it lights.
    pub normal: [f32; 3],
    /// The lobe at its peak over 1/π, (n + 2)/2; 0 without a lobe.
    pub peak: f32,
    /// Intensity along the normal of the diffuse part.
    pub intensity: [f32; 3],
    /// Mean of the channels of `intensity`.
    pub mean: f32,
    /// What the intensity would be if the lobe were diffuse.
    pub specular: [f32; 3],
    /// Mean of the channels of `specular`.
    pub specular_mean: f32,
    /// Unit direction of the lobe.
    pub mirrored: [f32; 3],
    /// Unused.
    pub pad: f32,
}

/// A point light, 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct PointLightRecord {
    /// Where it is.
    pub position: [f32; 3],
    /// The probability of all point lights before this one.
    pub before: f32,
    /// Radiant intensity, the same in all directions.
    pub intensity: [f32; 3],
    /// The probability of this light among the point lights.
    pub probability: f32,
}

/// A point light that shines into a cone, 64 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct SpotLightRecord {
    /// Where it is.
    pub position: [f32; 3],
    /// The probability of all spot lights before this one.
    pub before: f32,
    /// Radiant intensity where it shines in full.
    pub intensity: [f32; 3],
    /// The probability of this light among the spot lights.
    pub probability: f32,
    /// Unit vector along the cone's axis.
    pub axis: [f32; 3],
    /// Cosine of the angle beyond which it does not shine.
    pub cos_outer: f32,
    /// How fast the ramp rises with the cosine from there.
    pub slope: f32,
    /// Unused.
    pub pad: [u32; 3],
}

/// A light infinitely far away, 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct DirectionalLightRecord {
    /// Unit vector to where the light comes from.
    pub toward: [f32; 3],
    /// The probability of all directional lights before this one.
    pub before: f32,
    /// Irradiance of a surface across it.
    pub irradiance: [f32; 3],
    /// The probability of this light among the directional lights.
    pub probability: f32,
}

/// An emitting triangle, 80 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct AreaLightRecord {
    /// First corner.
    pub corner: [f32; 3],
    /// The probability of all lights before this one.
    pub before: f32,
    /// Second corner minus the first.
    pub edge1: [f32; 3],
    /// The probability of this light.
    pub probability: f32,
    /// Third corner minus the first.
    pub edge2: [f32; 3],
    /// Whether both sides emit.
    pub two_sided: u32,
    /// Unit normal of the emitting side.
    pub normal: [f32; 3],
    /// The area.
    pub area: f32,
    /// Emitted radiance.
    pub radiance: [f32; 3],
    /// Unused.
    pub pad: f32,
}

/// An emitting sphere, 48 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct SphereLightRecord {
    /// The centre.
    pub center: [f32; 3],
    /// The radius.
    pub radius: f32,
    /// Emitted radiance.
    pub radiance: [f32; 3],
    /// Whether it emits inwards, too.
    pub two_sided: u32,
    /// The probability of all emitting spheres before this one.
    pub before: f32,
    /// The probability of this one.
    pub probability: f32,
    /// Unused.
    pub pad: [u32; 2],
}

/// Parameters of the camera pass.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct CameraParams {
    /// The pinhole.
    pub position: [f32; 3],
    /// Width of the image in pixels.
    pub width: u32,
    /// Unit viewing direction.
    pub forward: [f32; 3],
    /// Height of the image in pixels.
    pub height: u32,
    /// Half the image's width at distance 1.
    pub right: [f32; 3],
    /// First 8 × 8 block of the tile.
    pub first_block: u32,
    /// Half the image's height at distance 1.
    pub up: [f32; 3],
    /// Which sample of each pixel.
    pub sample: u32,
    /// Samples a pixel.
    pub samples: u32,
    /// Seed of the frame.
    pub seed: u32,
    /// Blocks of the tile.
    pub blocks: u32,
    /// Number of BVH nodes.
    pub nodes: u32,
    /// The first ray of an edge in this dispatch.
    pub first_ray: u32,
    /// Rays of an edge in this dispatch; of paths, samples of a pixel.
    pub rays: u32,
    /// Rays of an edge for this sample.
    pub edge_rays: u32,
    /// Distance by which rays that go on are kept off surfaces.
    pub offset: f32,
}

/// Parameters of the direct-light passes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct DirectParams {
    /// Points of the tile.
    pub points: u32,
    /// Lights in the buffer.
    pub lights: u32,
    /// The first point light, or light sample, of this dispatch.
    pub first: u32,
    /// Point lights, or light samples, of this dispatch.
    pub count: u32,
    /// Seed of the frame.
    pub seed: u32,
    /// First 8 × 8 block of the tile.
    pub first_block: u32,
    /// Distance by which shadow rays are kept off surfaces.
    pub offset: f32,
    /// Number of BVH nodes.
    pub nodes: u32,
    /// Which sample of each pixel.
    pub sample: u32,
    /// Samples a pixel.
    pub samples: u32,
    /// One over the light samples of all samples of a pixel.
    pub weight: f32,
    /// One over the light samples of a point.
    pub share: f32,
}

/// Parameters of the visibility pass.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct VisibilityParams {
    /// Rows of the bit matrix: points that trace rays.
    pub rows: u32,
    /// VPLs in the buffer.
    pub vpls: u32,
    /// The first word (of 32 VPLs) of this dispatch, in the VPL buffer.
    pub first_word: u32,
    /// The word of the VPL buffer that is the matrix's first.
    pub matrix_word: u32,
    /// Distance by which shadow rays are kept off surfaces.
    pub offset: f32,
    /// Number of BVH nodes.
    pub nodes: u32,
    /// The first VPL of each word in this dispatch.
    pub first: u32,
    /// VPLs of each word in this dispatch.
    pub count: u32,
    /// The point of the first row.
    pub first_point: u32,
    /// Unused.
    pub pad: [u32; 3],
}

/// Parameters of the pass that gives VPLs the visibility of their clusters.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct ExpandParams {
    /// Rows of the bit matrix.
    pub rows: u32,
    /// The word of the VPL buffer that is the matrix's first.
    pub matrix_word: u32,
    /// Words in the matrix.
    pub words: u32,
    /// Unused.
    pub pad: u32,
}

/// Parameters of the passes of interleaved sampling.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct InterleaveParams {
    /// Width of the tile in pixels.
    pub width: u32,
    /// Height of the tile in pixels.
    pub height: u32,
    /// Subsets along each axis.
    pub s: u32,
    /// By how many subsets this sample is ahead of the first.
    pub rotation: u32,
    /// Pixels across a subset.
    pub subset_width: u32,
    /// Points of a subset.
    pub subset_points: u32,
    /// Points of all subsets.
    pub points: u32,
    /// Of the two that combine.
    pub pass_number: u32,
}

/// Parameters of the shading pass.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct ShadeParams {
    /// Points to shade.
    pub points: u32,
    /// Rows of the bit matrix.
    pub rows: u32,
    /// The word of the VPL buffer that is the matrix's first.
    pub matrix_word: u32,
    /// Words in the matrix.
    pub words: u32,
    /// The bound on G.
    pub bound: f32,
    /// The first point to shade.
    pub first_point: u32,
    /// Unused.
    pub pad: [u32; 2],
}

/// What a path from the camera carries, 16 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct PathRecord {
    /// What its vertex reflects of the light that is sought next, the vertex itself left out.
    pub throughput: [f32; 3],
    /// Seed of its pixel's random numbers.
    pub stream: u32,
}

/// The samples of a pixel, 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct PathSum {
    /// Mean radiance.
    pub mean: [f32; 3],
    /// Shadow rays of all samples.
    pub shadow_rays: f32,
    /// Sum of the squared deviations from the mean.
    pub squares: [f32; 3],
    /// Unused.
    pub pad: f32,
}

/// Parameters of the passes of paths.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct PathParams {
    /// Paths in the queue; pixels when they are summed.
    pub paths: u32,
    /// How many bounces the paths have behind them.
    pub bounce: u32,
    /// The first sample of each pixel.
    pub first_sample: u32,
    /// Samples of each pixel.
    pub samples: u32,
    /// Lights in the buffer.
    pub lights: u32,
    /// Number of BVH nodes.
    pub nodes: u32,
    /// Distance by which rays are kept off surfaces.
    pub offset: f32,
    /// Density of the places drawn on an area light over its mean radiance and its sides; 0 if
    /// emission that the next segment finds does not count.
    pub light_density: f32,
    /// 1 if the environment that the next segment escapes to counts, else 0.
    pub background: f32,
    /// The probability of an emitting sphere over its mean radiance, its sides and its squared
    /// radius; 0 if emission that the next segment finds does not count.
    pub solid_density: f32,
    /// Unused.
    pub pad: [u32; 2],
}
