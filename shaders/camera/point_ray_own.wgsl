// The ray that finds the visible point of a pixel: the sample's own.

fn point_ray(point: u32, pixel: vec2u) -> PointRay {
    return own_ray(pixel);
}

fn store_replaced(ray: PointRay, pixel: vec2u, point: Point) {}
