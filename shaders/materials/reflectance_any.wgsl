// The reflectance of surfaces of every finish; of glass, what goes on of the light.

fn reflectance_of(index: u32, point: Point) -> vec3f {
    return albedo_of(index, point) + finish_of(point).specular;
}
