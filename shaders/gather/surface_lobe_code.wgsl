// The 24 bits of surface_lobed.wgsl, of a visible point.

fn surface_code(point: Point) -> u32 {
    if point.surface == NOTHING { return NO_SURFACE; }
    let bsdf = bsdf_of(point);
    let octave = WIDEST_LOBE + u32(log2(1.0 + bsdf.parameter));
    let lobe = select(NO_LOBE, min(octave, NARROWEST_LOBE), bsdf.kind == PHONG);
    let n = point.normal;
    let flat = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    let place = select(flat, folded(flat), n.z < 0.0);
    let steps = vec2u(round(511.5 * (place + 1.0)));
    return lobe | (steps.x << 4u) | (steps.y << 14u);
}
