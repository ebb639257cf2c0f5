// What the colours of a triangle's corners multiply its albedo by.

// Of the corners of all shapes: red and green, and blue, of 16 bits each. Those of a sphere are white.
@group(0) @binding(121) var<storage, read> vertex_colors: array<vec2u>;

fn corner_color(at: u32) -> vec3f {
    let color = vertex_colors[at];
    return vec3f(unpack2x16unorm(color.x), unpack2x16unorm(color.y).x);
}

// Where a ray has hit. By differences, so that white stays white whatever the weights are: those of a
// sphere are its normal.
fn vertex_color(hit: Hit) -> vec3f {
    let at = 3u * load_triangle(hit.triangle).index;
    let a = corner_color(at);
    let b = corner_color(at + 1u) - a;
    let c = corner_color(at + 2u) - a;
    return saturate(a + b * hit.weights.y + c * hit.weights.z);
}
