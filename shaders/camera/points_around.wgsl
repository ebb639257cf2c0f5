// The visible points of the 3 x 3 pixels around one, and which of them are on the surface of a ray.

fn alike(p: Point, q: Point) -> bool {
    let same = one_surface(p.normal, q.normal, q.position - p.position);
    return p.surface == q.surface && (same || p.surface == NOTHING);
}

// Whether the tile has a pixel.
fn in_tile(pixel: vec2i) -> bool {
    let across = (params.width + 7u) / 8u;
    let first = i32(params.first_block / across) * 8;
    let end = min(i32((params.first_block + params.blocks) / across) * 8, i32(params.height));
    return pixel.x >= 0 && pixel.x < i32(params.width) && pixel.y >= first && pixel.y < end;
}

// The point of a pixel of the tile.
fn point_at(pixel: vec2i) -> u32 {
    let first = i32(params.first_block / ((params.width + 7u) / 8u)) * 8;
    return point_of(vec2u(pixel - vec2i(0, first)), params.width);
}

// The point of the i-th of the pixels around one; its own, the fifth, where there is none.
fn around(pixel: vec2u, own: u32, i: u32) -> u32 {
    let other = vec2i(pixel) + vec2i(i32(i % 3u), i32(i / 3u)) - 1;
    let is = in_tile(other);
    return select(own, point_at(select(vec2i(pixel), other, is)), is);
}

// More than any squared distance in normalised units, and little more: what is added is not lost.
const FARTHEST = 16.0;

// The pixel itself, of the 3 x 3 around it.
const OWN = 4u;

// The code of what gives its light to a ray: the pixel's own point, if that is on the same surface;
// else the nearest of those around that are; if there is none, the nearest of all.
fn nearest_around(pixel: vec2u, own: u32, point: Point, seen: Point) -> u32 {
    if seen.surface == NOTHING { return NO_LIGHT; }
    if alike(seen, point) { return OWN; }
    var best = OWN;
    var least = HUGE;
    for (var i = 0u; i < 9u; i++) {
        let other = points[around(pixel, own, i)];
        let way = other.position - seen.position;
        let distance = select(FARTHEST, 0.0, alike(seen, other)) + dot(way, way);
        best = select(best, i, distance < least);
        least = min(least, distance);
    }
    return best | select(0u, UNLIKE, least >= FARTHEST);
}
