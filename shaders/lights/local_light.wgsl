// Lights at a place.

fn light_of(index: u32, point: Point, offset: f32) -> LightSample {
    let light = lights[index];
    let to_light = light.position - point.position;
    let square = dot(to_light, to_light);
    let distance = sqrt(square);
    let cosine = dot(to_light, point.normal);
    let intensity = intensity_towards(light, to_light / -distance);
    return LightSample(
        light.position - offset_position(point, offset),
        1.0,
        cosine > 0.0 && any(intensity > vec3f(0.0)),
        intensity,
        cosine / (square * distance),
        light.probability,
    );
}
