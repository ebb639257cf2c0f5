// What tells the surfaces of pixels apart beside where they are, in 24 bits: their normals on an
// octahedron, 10 bits a coordinate (Cigolle et al., "A Survey of Efficient Representations for
// Independent Unit Vectors", JCGT 2014), and the width of the lobe that weighs what they gather.

// Where nothing is hit, and where there is no lobe; from there on, octaves of the exponent.
const NO_SURFACE = 0u;
const NO_LOBE = 1u;
const WIDEST_LOBE = 2u;
const NARROWEST_LOBE = 15u;

// The lower half of the octahedron lies in the corners of the square of the upper one.
fn folded(place: vec2f) -> vec2f {
    return (1.0 - abs(place.yx)) * select(vec2f(-1.0), vec2f(1.0), place >= vec2f(0.0));
}

// 0 where there is none.
fn normal_of_code(code: u32) -> vec3f {
    if (code & 15u) == NO_SURFACE { return vec3f(0.0); }
    let steps = vec2u(code >> 4u, code >> 14u) & vec2u(1023u);
    let place = vec2f(steps) / 511.5 - 1.0;
    let height = 1.0 - abs(place.x) - abs(place.y);
    return normalize(vec3f(select(place, folded(place), height < 0.0), height));
}

// Whether light that one lobe weighs is of use to the other.
fn of_one_lobe(a: u32, b: u32) -> bool {
    return (a & 15u) == (b & 15u);
}
