// The bound on the geometry term with a place that reflects: by cells of an octree, as intervals of
// places along a Morton curve, one curve for each way that surfaces face. Cells of
// src/render/vpls/density.rs are its twin.

// The cube that is the root: its lowest corner, the length of its edges. Then for every interval the
// key where it begins, in two words of 30 bits; its bound; and how many there are.
@group(0) @binding(112) var bound_cells: texture_2d<u32>;

const LEVELS = 19u;

fn cell(i: u32) -> vec4u {
    return textureLoad(bound_cells, table_place(i), 0);
}

// The lowest 10 bits, every third bit of 30.
fn spread(x: u32) -> u32 {
    var bits = x & 1023u;
    bits = (bits | bits << 16u) & 0x030000ffu;
    bits = (bits | bits << 8u) & 0x0300f00fu;
    bits = (bits | bits << 4u) & 0x030c30c3u;
    return (bits | bits << 2u) & 0x09249249u;
}

fn interleaved(x: vec3u) -> u32 {
    return spread(x.x) | spread(x.y) << 1u | spread(x.z) << 2u;
}

fn side_of(normal: vec3f) -> u32 {
    let size = abs(normal);
    let y = size.y > size.x;
    let z = size.z > max(size.x, size.y);
    let axis = select(select(0u, 1u, y), 2u, z);
    return 2u * axis + select(0u, 1u, normal[axis] < 0.0);
}

fn geometry_bound(point: Point) -> f32 {
    let root = bitcast<vec4f>(cell(0u));
    let local = clamp((point.position - root.xyz) / root.w, vec3f(0.0), vec3f(1.0));
    let place = vec3u(min(local * f32(1u << LEVELS), vec3f(f32((1u << LEVELS) - 1u))));
    let key = vec2u(side_of(point.normal) << 27u | interleaved(place >> vec3u(10u)), interleaved(place));
    // The last that begins no later.
    var low = 1u;
    var high = cell(1u).w + 1u;
    while low + 1u < high {
        let middle = (low + high) / 2u;
        let first = cell(middle).xy;
        let later = first.x > key.x || (first.x == key.x && first.y > key.y);
        low = select(middle, low, later);
        high = select(high, middle, later);
    }
    return bitcast<f32>(cell(low).z);
}
