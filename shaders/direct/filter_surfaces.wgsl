// Parameters of the filter of direct light, and the surfaces that the pixels of a tile see.

struct FilterParams {
    // Of the tile, in pixels.
    width: u32,
    height: u32,
    // Pixels between taps.
    step: u32,
    // 1 for the last level, which writes in the order of points.
    last: u32,
    // By which the variance of a difference is multiplied for one that counts 1/e.
    tolerance: f32,
    // Light samples of a point that has many like neighbours.
    rays: u32,
    pad0: u32,
    pad1: u32,
}

@group(0) @binding(0) var<storage, read> params: FilterParams;
// In the order of pixels: where they are, and the code of surface_plain.wgsl or surface_lobed.wgsl.
@group(0) @binding(17) var<storage, read> surfaces: array<vec4u>;

struct Surface {
    position: vec3f,
    // 0 where there is none.
    normal: vec3f,
    code: u32,
}

// That of a pixel; none beyond the tile.
fn surface_at(pixel: vec2i) -> Surface {
    let is = all(pixel >= vec2i(0)) && all(pixel < vec2i(i32(params.width), i32(params.height)));
    let inside = select(vec2i(0), pixel, is);
    let packed = surfaces[u32(inside.y) * params.width + u32(inside.x)];
    let normal = select(vec3f(0.0), normal_of_code(packed.w), is);
    return Surface(bitcast<vec3f>(packed.xyz), normal, packed.w);
}

fn is_like(a: Surface, b: Surface) -> bool {
    return of_one_lobe(a.code, b.code) && one_surface(a.normal, b.normal, b.position - a.position);
}
