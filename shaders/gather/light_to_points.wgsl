// What a pixel has gathered goes to its visible point.

@group(0) @binding(7) var<storage, read_write> irradiance: array<Gathered>;

fn store_light(point: u32, at: u32, light: Gathered) {
    irradiance[point] = light;
}
