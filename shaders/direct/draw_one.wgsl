// Light sampling: a place on the lights, drawn by power, where lights are few.

struct Drawn {
    light: LightSample,
    // Of its unshadowed contribution in the sum over all shadow rays.
    weight: f32,
}

fn draw_light(point: Point, ray: u32, stream: u32) -> Drawn {
    // The stratum of the ray among the point's, and in it that of the sample of the pixel.
    let u = stratified(ray * params.samples + params.sample, params.weight, stream);
    let light = sample_light(point, u, params.lights, params.offset);
    return Drawn(light, 1.0 / light.density);
}
