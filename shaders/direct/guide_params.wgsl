// Parameters and buffers of the guide: for each block of 8 x 8 pixels, which strata of the lights its
// points see. Importance caching: Georgiev et al., "Importance Caching for Complex Illumination",
// Eurographics 2012; here the caches are the pixels of a block.

struct GuideParams {
    // Of the tile, and across the image.
    blocks: u32,
    across: u32,
    first_block: u32,
    strata: u32,
    seed: u32,
    offset: f32,
    nodes: u32,
    // Of the pilot rays.
    round: u32,
}

@group(0) @binding(0) var<storage, read> params: GuideParams;
@group(0) @binding(4) var<storage, read> points: array<Point>;
// Of each block and stratum of the lights: what it gives unshadowed; the share of it that is thought
// to arrive; its probability and all before it.
@group(0) @binding(84) var<storage, read_write> guide: array<f32>;
@group(0) @binding(85) var<storage, read_write> pilots: array<u32>;
@group(0) @binding(86) var<storage, read_write> unshadowed: array<f32>;
@group(0) @binding(87) var<storage, read_write> arriving_share: array<f32>;

const MOST_STRATA = 384u;
// Of pilots: none; and a bit of those that arrived.
const NO_PILOT = 0xffffffffu;
const ARRIVED = 0x80000000u;
