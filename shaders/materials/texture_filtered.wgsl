// Textures over the part of a surface that a pixel sees: a parallelogram. Lookups on a grid in it
// take the mean, each in the mip level whose texels are about as large as its share: along the
// longer side as many as make shares square, along the shorter one two.
//
// One lookup in a level that covers it all would blur: texels that are interpolated are three times
// as wide, by variance, as the box that a pixel averages. On images with the spectra of photographs
// (amplitudes that fall as 1/f) two blended levels leave 9 % of the squared error of no filter, the
// grid 3 %, with levels half a level finer than shares.

// Texture.sampler: the nearest texel counts alone where the texture is minified; from this bit on,
// how many levels there are.
const NEAREST_MINIFIED = 32u;
const LEVELS = 8u;

// Lookups along the longer side, at most: at grazing angles it has no end.
const MOST_COLUMNS = 8.0;
// Widths of the image along a side, at most: finite, and all of it many times.
const MOST_WIDTHS = 1e6;
// By how much finer levels are than a lookup's share.
const FINER = 0.5;

// The level after another.
fn next_level(image: Texture) -> Texture {
    var level = image;
    level.first += image.width * image.height;
    level.width = max(image.width / 2u, 1u);
    level.height = max(image.height / 2u, 1u);
    return level;
}

// Colour in linear light, averaged around a place over a parallelogram, whose sides are given in
// the coordinates of the surface.
fn sample_texture_over(index: u32, uv: vec2f, one: vec2f, other: vec2f) -> vec3f {
    let image = textures[index];
    let at = uv * image.scale + image.shift;
    let size = vec2f(f32(image.width), f32(image.height));
    let first = clamp(one * image.scale, vec2f(-MOST_WIDTHS), vec2f(MOST_WIDTHS));
    let second = clamp(other * image.scale, vec2f(-MOST_WIDTHS), vec2f(MOST_WIDTHS));
    let sides = vec2f(length(first * size), length(second * size));
    let turned = sides.y > sides.x;
    let long = max(sides.x, sides.y);
    let short = min(sides.x, sides.y);
    let along = select(first, second, turned);
    let across = select(second, first, turned);

    let levels = image.sampler >> LEVELS;
    let share = max(0.5 * short, 1.0);
    let rows = select(1.0, clamp(round(short / share), 1.0, 2.0), levels > 1u);
    let columns = select(1.0, clamp(round(long / share), 1.0, MOST_COLUMNS), levels > 1u);
    let width = max(share, long / columns);
    let number = min(u32(max(round(log2(width) - FINER), 0.0)), levels - 1u);
    let nearest_bit = select(NEAREST_MINIFIED, NEAREST_MAGNIFIED, long <= 1.0);
    let nearest = (image.sampler & nearest_bit) != 0u;

    var level = image;
    for (var i = 0u; i < number; i++) { level = next_level(level); }
    var sum = vec3f(0.0);
    for (var row = 0.5; row < rows; row += 1.0) {
        for (var column = 0.5; column < columns; column += 1.0) {
            let place = at + (column / columns - 0.5) * along + (row / rows - 0.5) * across;
            sum += sample_image(level, place, nearest).rgb;
        }
    }
    return sum / (rows * columns);
}
