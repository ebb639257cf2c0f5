// Russian roulette where a segment of bias compensation ends: most bring back little, as the bound
// took little of the light along them, and what they would find is left to those that live on.

// At the end of a segment.
const SURVIVAL_DIMENSIONS = 0x10000u;
// A path always lives on that brings back at least so much of the irradiance.
const CERTAIN_SHARE = 1.0;

// By what that which is left of a path is multiplied: 0 if it ends.
fn survival_of(left: vec3f, decides: f32) -> f32 {
    // Irradiance is sought, which is pi where a path from the camera has a throughput of 1.
    let probability = min(max(left.x, max(left.y, left.z)) / (PI * CERTAIN_SHARE), 1.0);
    return select(0.0, 1.0 / probability, decides < probability);
}
