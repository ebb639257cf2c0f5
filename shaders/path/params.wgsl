// Paths from the camera, a vertex a stage. A path stays in its slot: the samples of a pixel, then
// those of the next. The queue lists the slots of the paths that go on.

struct PathParams {
    // Paths in the queue; pixels when they are summed.
    paths: u32,
    // How many bounces the paths have behind them.
    bounce: u32,
    // The first sample of each pixel, and how many it has.
    first_sample: u32,
    samples: u32,
    lights: u32,
    nodes: u32,
    offset: f32,
    // Density of the places drawn on an area light over its mean radiance and its sides; 0 if
    // emission that the next segment finds does not count.
    light_density: f32,
    // 1 if the environment that the next segment escapes to counts, else 0.
    background: f32,
    // The probability of a light that is drawn by solid angle, over its mean radiance, its sides
    // and its squared radius; 0 if emission that the next segment finds does not count.
    solid_density: f32,
    // On the geometry term, of bias compensation.
    bound: f32,
    // By which the paths of bias compensation leave the visible point: 0 diffuse, 1 glossy.
    lobe: u32,
    // Rows of the visibility that clusters share, in fours.
    quads: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
}

@group(0) @binding(0) var<storage, read> params: PathParams;
