// Adds emission that a path hits by chance.

@group(0) @binding(20) var<storage, read_write> radiance: array<vec4f>;

fn found(slot: u32, light: vec3f) {
    radiance[slot] += vec4f(light, 0.0);
}
