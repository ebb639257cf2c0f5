// Where the first rays of a pixel end, as first_rays.wgsl left it.

@group(0) @binding(103) var<storage, read> ray_places: array<vec4u>;
@group(0) @binding(104) var<storage, read> ray_surfaces: array<vec4u>;

fn stored_ray(index: u32, ray: u32) -> Point {
    let place = ray_places[4u * index + ray];
    let normal = normalize(unpack4x8snorm(place.w).xyz);
    return Point(bitcast<vec3f>(place.xyz), ray_surfaces[index][ray], normal, 0.0);
}
