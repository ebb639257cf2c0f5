// The reflectance of diffuse surfaces.

fn reflectance_of(index: u32, point: Point) -> vec3f {
    return albedo_of(index, point);
}
