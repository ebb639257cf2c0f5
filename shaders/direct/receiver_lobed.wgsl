// How points receive light samples where some surfaces are glossy: what the lobe reflects of light is
// found by light samples and by directions of the lobe (lobe_rays.wgsl), which share it.

@group(0) @binding(3) var<storage, read> materials: array<Material>;

// The albedo, by the mean of its channels, over which a lobe counts: textures may darken it.
const LEAST_ALBEDO = 0.1;

struct LightReceiver {
    lobe: Receiver,
    normal: vec3f,
    // Reflectance of the lobe over the albedo, means of the channels.
    gloss: f32,
}

fn light_receiver(point: Point) -> LightReceiver {
    if point.surface == NOTHING { return LightReceiver(); }
    let specular = mean_of(specular_of(point));
    let albedo = mean_of(materials[point.surface & ~FRONT].albedo);
    return LightReceiver(receiver_of(point), point.normal, specular / max(albedo, LEAST_ALBEDO));
}

// Of what the lobe reflects of a sample, over its irradiance, the share that light samples bring.
fn lobe_share(
    receiver: LightReceiver,
    light: LightSample,
    stratum: u32,
    toward: vec3f,
) -> f32 {
    let own = receiver.lobe;
    let gloss = own.peak * lobe(own.mirrored, toward, own.shininess);
    // Densities in the measure of the geometry term.
    let by_angle = light.geometry / max(dot(receiver.normal, toward), 1e-6);
    let by_lobe = lobe_density(own.mirrored, own.shininess, toward) * by_angle;
    return gloss * mis_weight(max(light_density(light, stratum), 1e-30), by_lobe);
}

// The density with which a sample is taken to be drawn. Any would do that rays of the lobe know as
// well: that of the guide, they do not.
fn light_density(light: LightSample, stratum: u32) -> f32 {
    let drawn = light_stratum(stratum);
    // Rays of the lobe never find lights without extent.
    if drawn.kind == DELTA_LIGHT { return HUGE; }
    if drawn.kind == SPHERE_LIGHT { return light.density * drawn.extent.x * drawn.extent.y; }
    let is_area = drawn.kind == AREA_LIGHT;
    return mean_of(light.radiance) * select(params.sky_density, params.area_density, is_area);
}

// What a sample of a stratum is thought to give, if nothing is between, of what the point reflects.
fn given_to(receiver: LightReceiver, light: LightSample, stratum: u32) -> f32 {
    let share = lobe_share(receiver, light, stratum, normalize(light.toward));
    return given(light) * (1.0 + receiver.gloss * share);
}

// What arrives of a sample that gives this irradiance.
fn sample_arriving(
    point: Point,
    receiver: LightReceiver,
    light: LightSample,
    stratum: u32,
    irradiance: vec3f,
) -> Gathered {
    let share = lobe_share(receiver, light, stratum, normalize(light.toward));
    return Gathered(vec4f(irradiance, 0.0), vec4f(irradiance * share, 0.0));
}
