// Which rows (points) see which VPLs: a bit each, 32 VPLs a word, word by word. The plain
// twin of visibility_packet.wgsl, for adapters without wide subgroups.

struct VisibilityParams {
    rows: u32,
    vpls: u32,
    first_word: u32,
    matrix_word: u32,
    offset: f32,
    nodes: u32,
    pad0: u32,
    pad1: u32,
}

@group(0) @binding(0) var<uniform> params: VisibilityParams;
@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(5) var<storage, read> vpls: array<Vpl>;
@group(0) @binding(6) var<storage, read_write> bits: array<u32>;
// Rays traced, in two words.
@group(0) @binding(10) var<storage, read_write> counter: array<atomic<u32>, 2>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.rows { return; }
    let point = points[id.x];
    let word = params.first_word + id.y;
    var seen = 0u;
    var rays = 0u;
    let count = select(min(32u, params.vpls - 32u * word), 0u, point.surface == NOTHING);
    for (var i = 0u; i < count; i++) {
        let vpl = vpls[32u * word + i];
        let between = point.position - vpl.position;
        if dot(between, point.normal) >= 0.0 || dot(between, vpl.normal) <= 0.0 { continue; }
        rays++;
        let origin = vpl.position + params.offset * vpl.normal;
        let end = point.position + params.offset * point.normal;
        let hit = traverse(origin, end - origin, 1.0, params.nodes, true, 0u);
        if hit.triangle == NOTHING { seen |= 1u << i; }
    }
    bits[(word - params.matrix_word) * params.rows + id.x] = seen;
    let before = atomicAdd(&counter[0], rays);
    if before + rays < before { atomicAdd(&counter[1], 1u); }
}
