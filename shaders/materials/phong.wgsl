// The modified Phong lobe: Lafortune and Willems, "Using the Modified Phong Reflectance Model for
// Physically Based Rendering", 1994.

// The viewer's direction mirrored at the surface.
fn mirrored_view(point: Point) -> vec3f {
    let view = view_direction(point);
    return 2.0 * dot(view, point.normal) * point.normal - view;
}

// cos^n of the angle between unit directions, 0 beyond a right angle.
fn lobe(one: vec3f, other: vec3f, shininess: f32) -> f32 {
    let cosine = dot(one, other);
    // Never 0^0.
    return select(0.0, pow(max(cosine, 1e-20), shininess), cosine > 0.0);
}
