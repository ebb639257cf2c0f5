// The offset of rays: where they start and end at a point, which is off its surface, on the ray
// that found it. Nothing is between, however close a wall comes to its foot.

// The way back is no steeper along the surface than so many times the way off it...
const MOST_ALONG = 1000.0;
// ... and no longer than this share of the ray.
const MOST_OF_RAY = 0.5;

// What goes through a surface starts as far behind it, back along it by some 8 times the rounding
// of a place: at a wall's foot a ray meets the wall and, by rounding no later, what stands behind
// it.
const BEHIND = 0.25;

// From the point of a hit to where rays start and end, which is this far off its surface.
fn ray_offset(point: Point, direction: vec3f, offset: f32) -> vec3f {
    let facing = dot(point.normal, direction);
    let along = direction - facing * point.normal;
    let back = min(offset / max(-facing, 1.0 / MOST_ALONG), MOST_OF_RAY * point.depth);
    return offset * point.normal - back * along;
}

// From the point of a hit to where a ray starts that went through.
fn ray_offset_through(point: Point, direction: vec3f, offset: f32) -> vec3f {
    let facing = dot(point.normal, direction);
    return -offset * (point.normal + BEHIND * (direction - facing * point.normal));
}
