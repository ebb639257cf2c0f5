// How many paths of each run of 64 go on.

@group(0) @binding(24) var<storage, read> survivors: array<u32>;
@group(0) @binding(25) var<storage, read_write> counts: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let end = min(64u * id.x + 64u, params.paths);
    if 64u * id.x >= end { return; }
    var count = 0u;
    for (var i = 64u * id.x; i < end; i++) { count += u32(survivors[i] != NOTHING); }
    counts[id.x] = count;
}
