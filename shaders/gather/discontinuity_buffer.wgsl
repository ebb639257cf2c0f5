// What the pixels around have gathered from the other subsets of VPLs: the discontinuity buffer
// of Wald et al., "Interactive Global Illumination using Fast Ray Tracing", 2002, one axis after
// the other: first along rows, from pixels into pixels; then along columns, into points. A
// subset's irradiance is the mean, with the weights of a tent of 2s - 1 pixels, over its pixels
// that see the same surface, less of those that see other lights; the subsets count alike.

@group(0) @binding(92) var surface_table: texture_2d<u32>;

// How much the light of a point counts that sees one light more, or less, of eight.
const UNLIKE = 0.25;

struct Surface {
    position: vec3f,
    // 0 where there is none.
    normal: vec3f,
    code: u32,
    signature: u32,
}

fn load_surface(at: i32) -> Surface {
    let packed = textureLoad(surface_table, table_place(u32(at)), 0);
    let code = packed.w & 0xffffffu;
    return Surface(bitcast<vec3f>(packed.xyz), normal_of_code(code), code, packed.w >> 24u);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.width * params.height { return; }
    let s = i32(params.s);
    let pixel = pixel_of(id.x, 0u, params.width);
    let at = i32(pixel.y * params.width + pixel.x);
    // Along rows, then along columns.
    let along_rows = params.axis == 0u;
    let stride = select(i32(params.width), 1, along_rows);
    let place = i32(select(pixel.y, pixel.x, along_rows));
    let extent = i32(select(params.height, params.width, along_rows));
    let own = load_surface(at);
    var sum = Gathered();
    var subsets = 0.0;
    for (var first = 0; first < s; first++) {
        // The pixels of a subset: one on either side, or the pixel itself.
        var tap = Gathered();
        var weights = 0.0;
        for (var step = first; step > -s; step -= s) {
            let is = place + step >= 0 && place + step < extent;
            let other = select(at, at + step * stride, is);
            let seen = load_surface(other);
            let same = is && of_one_lobe(own.code, seen.code)
                && one_surface(own.normal, seen.normal, seen.position - own.position);
            let unlike = f32(countOneBits(own.signature ^ seen.signature));
            let weight = select(0.0, f32(s - abs(step)) * pow(UNLIKE, unlike), same);
            tap += light_at(u32(other)) * weight;
            weights += weight;
        }
        // A subset that only unlike pixels gather counts less.
        sum += tap * (1.0 / max(weights, 1.0));
        subsets += min(weights, 1.0);
    }
    // What the clamp took is summed over the image only, and stays with its pixel.
    store_light(id.x, u32(at), with_clamped(sum * (1.0 / max(subsets, 1e-30)), light_at(u32(at))));
}
