// What a point gathers where all surfaces are diffuse: irradiance; in w, the mean of the channels
// that the clamp took.

alias Gathered = vec4f;

const LOBES = 1u;

// Light gathered by a lobe, of which there is one.
fn gathered_by(lobe: u32, light: vec4f) -> Gathered {
    return light;
}

// What a lobe gathered.
fn light_of_lobe(gathered: Gathered, lobe: u32) -> vec4f {
    return gathered;
}

// The light of one, and what was clamped from the other.
fn with_clamped(gathered: Gathered, other: Gathered) -> Gathered {
    return vec4f(gathered.rgb, other.w);
}

// The light with this share of its mean in w.
fn with_half_difference(gathered: Gathered, share: f32) -> Gathered {
    return vec4f(gathered.rgb, share * (gathered.r + gathered.g + gathered.b) / 3.0);
}

// Its mean, and the half difference that it holds.
fn mean_and_difference(gathered: Gathered) -> vec2f {
    return vec2f((gathered.r + gathered.g + gathered.b) / 3.0, gathered.w);
}
