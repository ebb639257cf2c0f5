// The ray that finds the visible point of a pixel: the sample's own; or, once the first rays are known,
// one of them in its place, as replace_points.wgsl says.

// Of each pixel, such a ray, plus one; 0 if there is none.
@group(0) @binding(108) var<storage, read> point_rays: array<u32>;

@group(0) @binding(109) var packed_pixel_surfaces: texture_storage_2d<rgba32uint, write>;

fn point_ray(point: u32, pixel: vec2u) -> PointRay {
    let own = own_ray(pixel);
    let chosen = point_rays[point];
    let number = ray_number(max(chosen, 1u) - 1u);
    let replaces = params.rays != 0u;
    return PointRay(
        select(own.number, number, replaces),
        select(own.stream, ray_stream(pixel), replaces),
        own.in_middle && !replaces,
        replaces,
        !replaces || chosen != 0u,
    );
}

// Keeps the surface of a point that takes the place of another.
fn store_replaced(ray: PointRay, pixel: vec2u, point: Point) {
    let at = table_place(place_of(tile_pixels(), pixel));
    if ray.replaces { textureStore(packed_pixel_surfaces, at, pack_surface(point)); }
}
