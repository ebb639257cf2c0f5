// The order of the points of an image: blocks of 8 x 8 pixels in rows, Morton order inside, so
// that neighbouring points are neighbouring pixels. The twin of src/render/camera/tiling.rs.

fn pixel_of(point: u32, first_block: u32, width: u32) -> vec2u {
    let across = (width + 7u) / 8u;
    let block = first_block + point / 64u;
    let i = point % 64u;
    let x = (i & 1u) | ((i >> 1u) & 2u) | ((i >> 2u) & 4u);
    let y = ((i >> 1u) & 1u) | ((i >> 2u) & 2u) | ((i >> 3u) & 4u);
    return vec2u((block % across) * 8u + x, (block / across) * 8u + y);
}

fn point_of(pixel: vec2u, width: u32) -> u32 {
    let across = (width + 7u) / 8u;
    let block = (pixel.y / 8u) * across + pixel.x / 8u;
    let i = (pixel & vec2u(1u)) | ((pixel & vec2u(2u)) << vec2u(1u)) | ((pixel & vec2u(4u)) << vec2u(2u));
    return 64u * block + (i.x | (i.y << 1u));
}
