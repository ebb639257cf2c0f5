// A ray that finds the visible point of a pixel.

struct PointRay {
    // Its number in a sequence of places in the pixel, and that sequence.
    number: u32,
    stream: u32,
    // Whether it goes through the middle instead.
    in_middle: bool,
    // Whether its point takes the place of another.
    replaces: bool,
    // Whether it is to be traced.
    is: bool,
}

// That of a sample.
fn own_ray(pixel: vec2u) -> PointRay {
    return PointRay(params.sample, camera_stream(pixel), params.samples == 1u, false, true);
}
