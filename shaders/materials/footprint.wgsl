// The part of a surface that a pixel sees, as a ray cone meets it (Akenine-Moeller et al.,
// "Improved Shader and Texture Level of Detail Using Ray Cones", JCGT 2021). A pixel is a square,
// whose second moments are the same in all directions, as a cone's are: its sides may lie as suits
// the surface.

// The sides of a parallelogram on the surface.
struct Footprint {
    along: vec3f,
    across: vec3f,
}

// The least cosine between a ray and a normal.
const LEAST_COSINE = 1e-4;

// Of a cone of this width across its unit direction, where it has met a point.
fn footprint_of(point: Point, direction: vec3f, width: f32) -> Footprint {
    let facing = dot(point.normal, direction);
    // Straight from above any direction along the surface is right.
    let way = direction - facing * point.normal;
    let axis = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(point.normal.x) > 0.5);
    let along = normalize(select(cross(point.normal, axis), way, dot(way, way) > 1e-6));
    let cosine = max(abs(facing), LEAST_COSINE);
    return Footprint(along * (width / cosine), cross(point.normal, along) * width);
}
