// Which pixels give up their visible point for one on a surface that no point around shows, so that
// what is thinner than a pixel has light of its own. The surface that is given up has to be shown by
// others around.

@group(0) @binding(4) var<storage, read> points: array<Point>;
// The first ray that is to find the visible point anew; NOTHING if it stays.
@group(0) @binding(105) var<storage, read_write> choices: array<u32>;

const OTHERS = 2u;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.blocks * 64u { return; }
    let pixel = pixel_of(id.x, params.first_block, params.width);
    let is = pixel.x < params.width && pixel.y < params.height;
    let rays = first_rays();
    let point = points[id.x];
    // The first ray whose surface is not shown.
    var chosen = NOTHING;
    for (var ray = 0u; ray < rays; ray++) {
        let seen = stored_ray(id.x, ray);
        var shown = !is || chosen != NOTHING || seen.surface == NOTHING || alike(seen, point);
        for (var i = 0u; i < 9u && !shown; i++) {
            shown = alike(seen, points[around(pixel, id.x, i)]);
        }
        chosen = select(ray, chosen, shown);
    }
    var others = 0u;
    for (var i = 0u; i < 9u && chosen != NOTHING; i++) {
        let index = around(pixel, id.x, i);
        others += u32(index != id.x && alike(point, points[index]));
    }
    choices[id.x] = select(NOTHING, chosen, others >= OTHERS);
}
