// What a pixel has gathered goes to what its visible point has gathered otherwise.

@group(0) @binding(7) var<storage, read_write> irradiance: array<Gathered>;

fn store_light(point: u32, at: u32, light: Gathered) {
    irradiance[point] = with_clamped(irradiance[point] + light, irradiance[point]);
}
