// What a diffuse VPL gives to a diffuse point.

// A VPL of this light (intensity, and its mean).
fn pair(x: Point, position: vec3f, facet: vec4f, light: vec4f, seen: Seen, bit: u32) -> Gathered {
    let d = position - x.position;
    let square = dot(d, d);
    let cosines = max(dot(d, x.normal), 0.0) * max(facing(-d, facet.xyz), 0.0);
    // Never 0 / 0: a VPL at the point itself has cosines 0 and gives nothing.
    let g = cosines / max(square * square, 1e-37);
    return light * shown(vec2f(bounded_geometry(g, facet.w), clamped_geometry(g, facet.w)), seen, bit).xxxy;
}

fn pair_of(x: Receiver, vpl: Vpl, seen: Seen, bit: u32) -> Gathered {
    return pair(x, vpl.position, vec4f(vpl.normal, vpl.bound), vec4f(vpl.intensity, vpl.mean), seen, bit);
}
