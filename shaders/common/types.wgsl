// Records shared with the host (src/gpu/layout.rs).

struct Material {
    albedo: vec3f,
    two_sided: u32,
    emission: vec3f,
    pad: u32,
}

struct Point {
    position: vec3f,
    surface: u32,
    normal: vec3f,
    depth: f32,
}

const PI = 3.14159265358979;

// Point.surface: the camera ray hit nothing; the front of the surface is seen.
const NOTHING = 0xffffffffu;
const FRONT = 0x80000000u;
