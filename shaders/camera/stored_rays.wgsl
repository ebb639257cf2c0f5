// What the first rays of a pixel meet, as first_rays.wgsl left it.

@group(0) @binding(102) var<storage, read> ray_surfaces: array<vec4u>;

fn stored_ray(own: u32, ray: u32) -> SeenSurface {
    // Those that there are not see nothing.
    let is = ray < first_rays();
    let packed = ray_surfaces[MOST_FIRST * own + select(0u, ray, is)];
    return unpack_surface(select(vec4u(0u), packed, is));
}

fn stored_rays(own: u32) -> RaySurfaces {
    return RaySurfaces(
        stored_ray(own, 0u), stored_ray(own, 1u), stored_ray(own, 2u), stored_ray(own, 3u),
    );
}
