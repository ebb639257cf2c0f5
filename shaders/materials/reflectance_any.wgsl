// The reflectance of surfaces with any BSDF; of glass, the share of light that goes on.

fn reflectance_of(index: u32, point: Point) -> vec3f {
    return albedo_of(index, point) + bsdf_of(point).specular;
}
