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
    // Whether there are pilot rays; the guide is first made without.
    is_piloted: u32,
    // Strata of an even sky, which are the first; then the last stratum is the same sky by the cosine
    // at the point, of which one direction is as good as another where nothing is in the way. Either
    // these or that are drawn from.
    even_sky: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
}

@group(0) @binding(0) var<storage, read> params: GuideParams;
const MOST_STRATA = 448u;
// Of the counts of pilot rays; it divides the most.
const STRATA_PER_ENTRY = 8u;
