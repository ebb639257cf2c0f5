// Textures: the twin of `Texture::sample` of src/scene/texture/mapping.rs.

struct Texture {
    // Its first texel.
    first: u32,
    width: u32,
    height: u32,
    // How it wraps across, and from bit 2 on down, and how it is filtered.
    sampler: u32,
    scale: vec2f,
    shift: vec2f,
}

// Texture.sampler: beyond the border the image again; the image mirrored. Else its border.
const WRAP_REPEAT = 0u;
const WRAP_MIRRORED = 1u;
// The nearest texel counts alone where the texture is magnified.
const NEAREST_MAGNIFIED = 16u;

// Of all images and their mip levels: red, green, blue in sRGB and alpha, a byte each.
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

// The curve of sRGB, ((x + 0.055) / 1.055)^2.4, at its 245 values above 0.04045: by a polynomial,
// as it is taken for each texel. Off by 1.1e-5 at most, and by 0.02 % of the value; at 1 it is 1.
fn srgb_curve(x: vec3f) -> vec3f {
    let high = 0.8385609 + x * (-0.76029919 + x * (0.68926061 + x * (-0.38550398 + x * 0.093722093)));
    return 0.00085839915 + x * (0.035129157 + x * (0.48827201 + x * high));
}

// A texel, its colour in linear light (IEC 61966-2-1).
fn texel(at: u32) -> vec4f {
    let value = unpack4x8unorm(texels[at]);
    let low = value.rgb / 12.92;
    return vec4f(select(srgb_curve(value.rgb), low, value.rgb <= vec3f(0.04045)), value.a);
}

// Colour in linear light and alpha at a place of an image, in its widths and heights: that of the
// nearest texel, or interpolated between the four nearest.
fn sample_image(image: Texture, at: vec2f, nearest: bool) -> vec4f {
    let x = neighbours(at.x, image.width, image.sampler & 3u);
    let y = neighbours(at.y, image.height, (image.sampler >> 2u) & 3u);
    let ways = vec2f(x.way, y.way);
    let way = select(ways, step(vec2f(0.5), ways), nearest);
    let upper = image.first + y.first * image.width;
    let lower = image.first + y.second * image.width;
    let above = mix(texel(upper + x.first), texel(upper + x.second), way.x);
    let below = mix(texel(lower + x.first), texel(lower + x.second), way.x);
    return mix(above, below, way.y);
}

// The same of a texture's image itself at a place of a surface.
fn sample_texture(index: u32, uv: vec2f) -> vec4f {
    let image = textures[index];
    let nearest = (image.sampler & NEAREST_MAGNIFIED) != 0u;
    return sample_image(image, uv * image.scale + image.shift, nearest);
}
