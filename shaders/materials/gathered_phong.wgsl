// What a point gathers where some surfaces are glossy: irradiance, and irradiance weighted by the
// Phong lobe over that of a white diffuse surface; in w, the mean of the channels that the clamp
// removed.

alias Gathered = mat2x4f;

const LOBES = 2u;

// Light gathered by the diffuse lobe, 0, or by the glossy one.
fn gathered_by(lobe: u32, light: vec4f) -> Gathered {
    return Gathered(select(vec4f(0.0), light, lobe == 0u), select(light, vec4f(0.0), lobe == 0u));
}

// What a lobe gathered.
fn light_of_lobe(gathered: Gathered, lobe: u32) -> vec4f {
    return gathered[lobe];
}

// The light of one, and what was clamped from the other.
fn with_clamped(gathered: Gathered, other: Gathered) -> Gathered {
    return Gathered(vec4f(gathered[0].rgb, other[0].w), vec4f(gathered[1].rgb, other[1].w));
}

// The light with this share of its means in w.
fn with_half_difference(gathered: Gathered, share: f32) -> Gathered {
    let diffuse = share * (gathered[0].r + gathered[0].g + gathered[0].b) / 3.0;
    let glossy = share * (gathered[1].r + gathered[1].g + gathered[1].b) / 3.0;
    return Gathered(vec4f(gathered[0].rgb, diffuse), vec4f(gathered[1].rgb, glossy));
}

// Their mean, and the half difference that they hold.
fn mean_and_difference(gathered: Gathered) -> vec2f {
    let sum = gathered[0] + gathered[1];
    return vec2f((sum.r + sum.g + sum.b) / 3.0, sum.w);
}
