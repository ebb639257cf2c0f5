// The queue of the paths that go on, in their order: neighbours stay neighbours, and the order
// does not depend on the device.

@group(0) @binding(23) var<storage, read_write> queue: array<u32>;
@group(0) @binding(24) var<storage, read> survivors: array<u32>;
// Where the survivors of each run of 64 go.
@group(0) @binding(26) var<storage, read> places: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let end = min(64u * id.x + 64u, params.paths);
    if 64u * id.x >= end { return; }
    var at = places[id.x];
    for (var i = 64u * id.x; i < end; i++) {
        let slot = survivors[i];
        if slot != NOTHING {
            queue[at] = slot;
            at += 1u;
        }
    }
}
