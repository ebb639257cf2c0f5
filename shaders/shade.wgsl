// Irradiance at every point from the VPLs that its row sees. The plain twin of
// shade_cooperative.wgsl, for adapters without wide subgroups.

struct ShadeParams {
    points: u32,
    rows: u32,
    matrix_word: u32,
    words: u32,
    bound: f32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
}

@group(0) @binding(0) var<uniform> params: ShadeParams;
@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(5) var<storage, read> vpls: array<Vpl>;
@group(0) @binding(6) var<storage, read> bits: array<u32>;
// In w, the mean of the channels that the bound removed.
@group(0) @binding(7) var<storage, read_write> irradiance: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.points { return; }
    let point = points[id.x];
    var total = vec4f(0.0);
    for (var word = 0u; word < params.words; word++) {
        var seen = bits[word * params.rows + id.x];
        // A sum a word, then the sum of those, keeps rounding small over many VPLs.
        var sum = vec4f(0.0);
        while seen != 0u {
            let vpl = vpls[32u * (params.matrix_word + word) + firstTrailingBit(seen)];
            seen &= seen - 1u;
            let d = vpl.position - point.position;
            let square = dot(d, d);
            let cosines = max(dot(d, point.normal), 0.0) * max(-dot(d, vpl.normal), 0.0);
            // Never 0 / 0: a VPL at the point itself has cosines 0 and gives nothing.
            let g = cosines / max(square * square, 1e-37);
            sum += vec4f(vpl.intensity * kept(g, params.bound), vpl.mean * removed(g, params.bound));
        }
        total += sum;
    }
    irradiance[id.x] += total;
}
