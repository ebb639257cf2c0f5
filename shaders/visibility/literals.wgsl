// Shadow rays in a small scene: 4 neighbouring points an invocation, all seen from one VPL.

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let row = 4u * id.x;
    if row >= params.rows { return; }
    let word = params.first_word + id.y;
    let last = params.rows - 1u;
    let p0 = points[params.first_point + row];
    let p1 = points[params.first_point + min(row + 1u, last)];
    let p2 = points[params.first_point + min(row + 2u, last)];
    let p3 = points[params.first_point + min(row + 3u, last)];
    let surfaces = vec4u(p0.surface, p1.surface, p2.surface, p3.surface);
    let are = (surfaces != vec4u(NOTHING)) & (vec4u(row) + vec4u(0u, 1u, 2u, 3u) <= vec4u(last));
    let positions = transpose(mat4x3f(p0.position, p1.position, p2.position, p3.position));
    let ends = transpose(mat4x3f(
        offset_position(p0, params.offset), offset_position(p1, params.offset),
        offset_position(p2, params.offset), offset_position(p3, params.offset),
    ));
    let normals = transpose(mat4x3f(p0.normal, p1.normal, p2.normal, p3.normal));

    var seen = vec4u(0u);
    var rays = vec4u(0u);
    let count = min(32u, params.vpls - 32u * word);
    let stop = min(count, params.first + params.count);
    var i = params.first;
    for (; i < stop; i++) {
        let vpl = vpls[32u * word + i];
        // Pairs with a cosine <= 0 trace no ray.
        let between = positions - origins(vpl.position);
        let towards = between[0] * normals[0] + between[1] * normals[1] + between[2] * normals[2];
        let faced = vec4f(
            facing(p0.position - vpl.position, vpl.normal),
            facing(p1.position - vpl.position, vpl.normal),
            facing(p2.position - vpl.position, vpl.normal),
            facing(p3.position - vpl.position, vpl.normal),
        );
        let open = are & (towards < vec4f(0.0)) & (faced > vec4f(0.0));
        rays += vec4u(open);
        let origin = vpl.position + params.offset * vpl.normal;
        let ways = ends - origins(origin);
        let slack = line_slack(origin) * (abs(ways[0]) + abs(ways[1]) + abs(ways[2]));
        let free = open & !meet_scene(Ray(origin, ways, slack), 1.0);
        seen |= vec4u(free) << vec4u(i);
    }

    let at = (word - params.matrix_word) * params.rows + row;
    bits[at] = earlier(at) | seen.x;
    if row + 1u < params.rows { bits[at + 1u] = earlier(at + 1u) | seen.y; }
    if row + 2u < params.rows { bits[at + 2u] = earlier(at + 2u) | seen.z; }
    if row + 3u < params.rows { bits[at + 3u] = earlier(at + 3u) | seen.w; }
    count_rays(rays.x + rays.y + rays.z + rays.w, i >= stop);
}
