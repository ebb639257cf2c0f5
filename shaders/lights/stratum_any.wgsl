// Strata of lights of some extent, and of lights without.

// A place in a stratum, uniform there by the measure of its kind.
fn sample_stratum(index: u32, point: Point, u: vec2f, offset: f32) -> LightSample {
    let stratum = light_stratum(index);
    if stratum.kind == DELTA_LIGHT { return sample_delta_light(stratum, point, u.x, offset); }
    let at = stratum.low + stratum.extent * u;
    var light = sample_light(stratum.kind, point, at, offset);
    light.density /= stratum.extent.x * stratum.extent.y;
    return light;
}
