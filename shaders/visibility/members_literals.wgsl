// Shadow rays between rows and members that they draw, in a small scene: from a row to four at once.

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.rows { return; }
    let word = params.first_word + id.y;
    let point = points[params.first_point + id.x];
    let origin = offset_position(point, params.offset);
    var seen = 0u;
    var rays = vec4u(0u);
    let stop = select(min(32u, params.first + params.count), 0u, point.surface == NOTHING);
    // All four of a texel, of which some may be left for another dispatch.
    var i = params.first & ~3u;
    for (; i < stop; i += 4u) {
        let drawn = drawn_of(id.x, word, i / 4u);
        let m0 = member(drawn.x);
        let m1 = member(drawn.y);
        let m2 = member(drawn.z);
        let m3 = member(drawn.w);
        let lights = vec4u(i) + vec4u(0u, 1u, 2u, 3u);
        let asked = (lights >= vec4u(params.first)) & (lights < vec4u(stop));
        let open = vec4<bool>(m0.is, m1.is, m2.is, m3.is) & asked;
        rays += vec4u(open);
        let ends = transpose(mat4x3f(
            m0.position + params.offset * m0.normal, m1.position + params.offset * m1.normal,
            m2.position + params.offset * m2.normal, m3.position + params.offset * m3.normal,
        ));
        let ways = ends - origins(origin);
        let slack = line_slack(origin) * (abs(ways[0]) + abs(ways[1]) + abs(ways[2]));
        let free = vec4u(open & !meet_scene(Ray(origin, ways, slack), 1.0));
        seen |= (free.x | free.y << 1u | free.z << 2u | free.w << 3u) << i;
    }
    let at = (word - params.matrix_word) * params.rows + id.x;
    bits[at] = earlier(at) | seen;
    count_rays(rays.x + rays.y + rays.z + rays.w, i >= stop);
}
