// Directions drawn by a Phong lobe.

// By cos^n about the mirrored direction of the viewer.
fn sample_lobe(mirrored: vec3f, shininess: f32, u: vec2f) -> vec3f {
    let cosine = pow(1.0 - u.x, 1.0 / (shininess + 1.0));
    let sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    let turn = 2.0 * PI * u.y;
    let about = vec3f(sine * cos(turn), sine * sin(turn), cosine);
    return normalize(frame_about(mirrored) * about);
}

// The density with which `sample_lobe` draws a unit direction, by solid angle.
fn lobe_density(mirrored: vec3f, shininess: f32, toward: vec3f) -> f32 {
    return (shininess + 1.0) / (2.0 * PI) * lobe(mirrored, toward, shininess);
}
