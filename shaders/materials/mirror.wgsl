// An ideal mirror.

fn at_mirror(point: Point, bsdf: Bsdf, direction: vec3f) -> SpecularSample {
    let cosine = -dot(direction, point.normal);
    return SpecularSample(normalize(direction + 2.0 * cosine * point.normal), bsdf.specular, 1.0);
}
