// What a point gathers where some surfaces are glossy: irradiance, and irradiance weighted by the
// Phong lobe over that of a white diffuse surface; in w, the mean of the channels that the clamp
// removed.

alias Gathered = mat2x4f;

// Light gathered by the diffuse lobe, 0, or by the glossy one.
fn gathered_by(lobe: u32, light: vec4f) -> Gathered {
    return Gathered(select(vec4f(0.0), light, lobe == 0u), select(light, vec4f(0.0), lobe == 0u));
}

// The light of one, and what was clamped from the other.
fn with_clamped(gathered: Gathered, other: Gathered) -> Gathered {
    return Gathered(vec4f(gathered[0].rgb, other[0].w), vec4f(gathered[1].rgb, other[1].w));
}
