// Textures: the twin of `Texture::sample` of src/scene/texture/mapping.rs.

struct Texture {
    // Its first texel.
    first: u32,
    width: u32,
    height: u32,
    // Beyond its border across, and from bit 2 on down.
    wrap: u32,
    scale: vec2f,
    shift: vec2f,
}

// Texture.wrap: the image again; the image mirrored. Else its border.
const WRAP_REPEAT = 0u;
const WRAP_MIRRORED = 1u;

// Of all textures: red, green, blue in sRGB and alpha, a byte each.
@group(0) @binding(40) var<storage, read> texels: array<u32>;
@group(0) @binding(41) var<storage, read> textures: array<Texture>;

// The two texels nearest to a place along an axis, and how far it is from one to the other.
struct Neighbours {
    first: u32,
    second: u32,
    way: f32,
}

fn inside_image(at: f32, size: u32, wrap: u32) -> u32 {
    let last = f32(size) - 1.0;
    if wrap == WRAP_REPEAT && at < 0.0 { return size - 1u; }
    if wrap == WRAP_REPEAT && at > last { return 0u; }
    return u32(clamp(at, 0.0, last));
}

fn neighbours(at: f32, size: u32, wrap: u32) -> Neighbours {
    // Folded before it is scaled: large coordinates stay inside.
    var folded = at;
    if wrap == WRAP_REPEAT { folded = at - floor(at); }
    if wrap == WRAP_MIRRORED { folded = 1.0 - abs(at - 2.0 * floor(0.5 * at) - 1.0); }
    let place = clamp(folded, 0.0, 1.0) * f32(size) - 0.5;
    let first = floor(place);
    return Neighbours(
        inside_image(first, size, wrap),
        inside_image(first + 1.0, size, wrap),
        place - first,
    );
}

// A texel, its colour in linear light (IEC 61966-2-1).
fn texel(at: u32) -> vec4f {
    let value = unpack4x8unorm(texels[at]);
    let curve = pow((value.rgb + 0.055) / 1.055, vec3f(2.4));
    return vec4f(select(curve, value.rgb / 12.92, value.rgb <= vec3f(0.04045)), value.a);
}

// Colour in linear light and alpha, interpolated between the four nearest texels.
fn sample_texture(index: u32, uv: vec2f) -> vec4f {
    let image = textures[index];
    let at = uv * image.scale + image.shift;
    let x = neighbours(at.x, image.width, image.wrap & 3u);
    let y = neighbours(at.y, image.height, image.wrap >> 2u);
    let upper = image.first + y.first * image.width;
    let lower = image.first + y.second * image.width;
    let above = mix(texel(upper + x.first), texel(upper + x.second), x.way);
    let below = mix(texel(lower + x.first), texel(lower + x.second), x.way);
    return mix(above, below, y.way);
}
