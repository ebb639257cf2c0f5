// What a point gathers where all surfaces are diffuse: irradiance; in w, the mean of the channels
// that the clamp removed.

alias Gathered = vec4f;

// The light of one, and what was removed from the other.
fn with_removed(gathered: Gathered, other: Gathered) -> Gathered {
    return vec4f(gathered.rgb, other.w);
}
