// What a VPL gives to a point, where either may be glossy. The bound is on the geometry term
// times the lobe of each end over a diffuse one.

fn pair_of(x: Receiver, vpl: Vpl, seen: Seen, bit: u32) -> Gathered {
    let d = vpl.position - x.point.position;
    let square = dot(d, d);
    let cosines = max(dot(d, x.point.normal), 0.0) * max(facing(-d, vpl.normal), 0.0);
    // Never 0 / 0: a VPL at the point itself has cosines 0 and gives nothing.
    let g = cosines / max(square * square, 1e-37);
    let toward = d * inverseSqrt(max(square, 1e-37));
    let here = x.peak * lobe(x.mirrored, toward, x.shininess);
    let there = vpl.peak * lobe(vpl.mirrored, -toward, vpl.shininess);
    let diffuse = vec4f(vpl.intensity, vpl.mean);
    let specular = vec4f(vpl.specular, vpl.specular_mean);
    let visible = shown(vec2f(1.0), seen, bit).x;
    return Gathered(
        (bounded(vpl.bound, diffuse, g) + bounded(vpl.bound, specular, g * there)) * visible,
        (bounded(vpl.bound, diffuse, g * here) + bounded(vpl.bound, specular, g * here * there)) * visible,
    );
}

fn bounded(bound: f32, light: vec4f, g: f32) -> vec4f {
    return light * vec2f(bounded_geometry(g, bound), clamped_geometry(g, bound)).xxxy;
}
