// What the first rays of a pixel meet, as first_rays.wgsl left it, or those of a beam; and which of
// the visible points around are on the same surfaces.

@group(0) @binding(101) var pixel_surfaces: texture_2d<u32>;

struct RaySurfaces {
    s0: SeenSurface,
    s1: SeenSurface,
    s2: SeenSurface,
    s3: SeenSurface,
}

// The surface of the visible point of the i-th of the pixels around one.
fn surface_around(tile: TilePixels, pixel: vec2u, i: u32) -> SeenSurface {
    let at = table_place(place_of(tile, around(tile, pixel, i)));
    return unpack_surface(textureLoad(pixel_surfaces, at, 0));
}

// More than any squared distance in normalised units, and little more: what is added is not lost.
const FARTHEST = 16.0;

// By which points are preferred to give a ray their light: the nearest on the same surface, the
// nearest of the same material, the nearest; none if nothing is seen.
fn unlikeness(seen: SeenSurface, other: SeenSurface) -> f32 {
    let way = other.position - seen.position;
    let material = select(2.0 * FARTHEST, FARTHEST, seen.code == other.code);
    let apart = dot(way, way) + select(material, 0.0, alike(seen, other));
    return select(apart, HUGE, seen.code == 0u || other.code == 0u);
}

// Which of the points around a pixel gives its light to each of four rays: its own, if that is on
// the same surface; NO_LIGHT for none.
fn linked(tile: TilePixels, pixel: vec2u, rays: RaySurfaces) -> vec4u {
    var best = vec4u(NO_LIGHT);
    var least = vec4f(HUGE);
    for (var i = 0u; i < pixels_around(); i++) {
        let other = surface_around(tile, pixel, i);
        let apart = vec4f(
            unlikeness(rays.s0, other),
            unlikeness(rays.s1, other),
            unlikeness(rays.s2, other),
            unlikeness(rays.s3, other),
        );
        let own = vec4<bool>(i == OWN) & (apart < vec4f(FARTHEST));
        let nearer = own | (apart < least);
        best = select(best, vec4u(i), nearer);
        least = select(least, select(apart, vec4f(-1.0), own), nearer);
    }
    return best;
}
