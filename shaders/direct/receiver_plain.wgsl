// How points receive light samples where all surfaces are diffuse.

alias LightReceiver = Point;

fn light_receiver(point: Point) -> LightReceiver {
    return point;
}

// What a sample of a stratum is thought to give, if nothing is between.
fn given_to(receiver: LightReceiver, light: LightSample, stratum: u32) -> f32 {
    return given(light);
}

// What arrives of a sample that gives this irradiance.
fn sample_arriving(
    point: Point,
    receiver: LightReceiver,
    light: LightSample,
    stratum: u32,
    irradiance: vec3f,
) -> Gathered {
    return arriving(point, normalize(light.toward), irradiance);
}
