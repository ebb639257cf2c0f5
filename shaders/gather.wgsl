// The pass that adds up, at every point, the irradiance from the VPLs that its row sees.

struct ShadeParams {
    points: u32,
    rows: u32,
    matrix_word: u32,
    words: u32,
    bound: f32,
    first_point: u32,
    pad0: u32,
    pad1: u32,
}

@group(0) @binding(0) var<storage, read> params: ShadeParams;
@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(5) var<storage, read> vpls: array<Vpl>;
@group(0) @binding(6) var<storage, read> bits: array<u32>;
// In w, the mean of the channels that the bound removed.
@group(0) @binding(7) var<storage, read_write> irradiance: array<Gathered>;

// What a VPL of this light (intensity, and its mean) gives to a point.
fn pair(x: Point, position: vec3f, normal: vec3f, light: vec4f, seen: Seen, bit: u32) -> Gathered {
    let d = position - x.position;
    let square = dot(d, d);
    let cosines = max(dot(d, x.normal), 0.0) * max(facing(-d, normal), 0.0);
    // Never 0 / 0: a VPL at the point itself has cosines 0 and gives nothing.
    let g = cosines / max(square * square, 1e-37);
    return light * shown(vec2f(kept(g, params.bound), removed(g, params.bound)), seen, bit).xxxy;
}
