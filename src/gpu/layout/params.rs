//! Parameters of stages, and what paths carry.

use bytemuck::{Pod, Zeroable};

/// Parameters of the camera stage.
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

/// Parameters of the direct-light stages.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct DirectParams {
    /// Points of the tile.
    pub points: u32,
    /// Lights in the buffer, or strata of them.
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
    /// Light samples of a point.
    pub rays: u32,
    /// Places on the lights that each ray chooses from.
    pub candidates: u32,
    /// Parts of the light samples that are stratified by themselves, 1 or 2.
    pub halves: u32,
    /// The density, by area, with which places on area lights are taken to be drawn, over their mean
    /// radiance; 0 if none are.
    pub area_density: f32,
    /// The probability with which an emitting sphere is, over its mean radiance, its sides and its
    /// squared radius.
    pub solid_density: f32,
    /// The density, by solid angle, with which directions to the environment are, over the mean
    /// radiance there.
    pub sky_density: f32,
    /// Rays of the points that take most of them.
    pub most_rays: u32,
    /// Lobes take rays whose exponent is at least this...
    pub least_shininess: f32,
    /// ... and below this.
    pub most_shininess: f32,
    /// Unused.
    pub pad: u32,
}

/// Parameters of the filter of direct light.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct FilterParams {
    /// Width of the tile in pixels.
    pub width: u32,
    /// Height of the tile in pixels.
    pub height: u32,
    /// Pixels between taps.
    pub step: u32,
    /// By which the variance of a difference is multiplied for one that counts 1/e.
    pub tolerance: f32,
    /// Light samples of a point that has many like neighbours.
    pub rays: u32,
    /// Unused.
    pub pad: [u32; 3],
}

/// Parameters of the stages that guide light samples.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct GuideParams {
    /// Blocks of the tile.
    pub blocks: u32,
    /// Blocks across the image.
    pub across: u32,
    /// First 8 × 8 block of the tile.
    pub first_block: u32,
    /// Strata of the lights.
    pub strata: u32,
    /// Seed of the frame.
    pub seed: u32,
    /// Distance by which shadow rays are kept off surfaces.
    pub offset: f32,
    /// Number of BVH nodes.
    pub nodes: u32,
    /// 1 where there are pilot rays, else 0.
    pub is_piloted: u32,
    /// Strata of an even sky, which are the first; the last is then the same sky by the cosine.
    pub even_sky: u32,
    /// Unused.
    pub pad: [u32; 3],
}

/// Parameters of the visibility stage.
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
    /// Words of this dispatch; used where rows draw members of clusters.
    pub words: u32,
    /// Tells draws of members apart; used there, too.
    pub seed: u32,
    /// Unused.
    pub pad: u32,
}

/// Parameters of the stage that gives VPLs the visibility of their clusters.
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

/// Parameters of the stages of interleaved sampling.
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
    pub axis: u32,
}

/// Parameters of the shading stage.
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
    /// The first point to shade.
    pub first_point: u32,
    /// Unused.
    pub pad: [u32; 3],
}

/// Parameters of the stage that corrects shared visibility.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct CorrectParams {
    /// Points whose visibility is corrected.
    pub points: u32,
    /// Rows of the bit matrix.
    pub rows: u32,
    /// The word of the VPL buffer that is the matrix's first.
    pub matrix_word: u32,
    /// Words in the matrix.
    pub words: u32,
    /// The first of the points.
    pub first_point: u32,
    /// Rays of each point, for all chunks of the bit matrix.
    pub rays: u32,
    /// The first of them in the sequence of its point.
    pub first_ray: u32,
    /// Seed of the tile.
    pub seed: u32,
    /// Distance by which shadow rays are kept off surfaces.
    pub offset: f32,
    /// Number of BVH nodes.
    pub nodes: u32,
    /// Which chunk of the bit matrix this is.
    pub chunk: u32,
    /// Of how many.
    pub chunks: u32,
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

/// Parameters of the stages of paths.
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
    /// The least on the geometry term, of bias compensation.
    pub bound: f32,
    /// By which the paths of bias compensation leave the visible point: 0 diffuse, 1 glossy.
    pub lobe: u32,
    /// Rows of the visibility that clusters share, in fours.
    pub quads: u32,
    /// Unused.
    pub pad: [u32; 3],
}

/// Parameters of the stage that starts bias compensation.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct StartParams {
    /// Visible points.
    pub points: u32,
    /// The first 8 × 8 block of the tile.
    pub first_block: u32,
    /// Of the random numbers.
    pub seed: u32,
    /// Paths of each point.
    pub paths: u32,
}

/// Parameters of the stage that adds what bias compensation gives back.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct CompensatedParams {
    /// Visible points.
    pub points: u32,
    /// Of a path in the mean.
    pub share: f32,
    /// See [`PathParams::lobe`].
    pub lobe: u32,
    /// Paths of each point.
    pub paths: u32,
    /// The number of the first.
    pub first: u32,
    /// 1 if the difference of the halves of the paths is wanted, else 0.
    pub halves: f32,
    /// Unused.
    pub pad: [u32; 2],
}

/// What arrives at a vertex of bias compensation in scenes with Phong surfaces, 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct ArrivalRecord {
    /// Throughput by the diffuse part of the vertex before.
    pub diffuse: [f32; 3],
    /// Geometry term of the segment.
    pub diffuse_g: f32,
    /// Throughput by its lobe.
    pub glossy: [f32; 3],
    /// The geometry term times the lobe over a diffuse one.
    pub glossy_g: f32,
}
