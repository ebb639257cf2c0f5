// What bias compensation carries along its paths where all surfaces are diffuse: the throughput,
// with the share that the bound took on each segment so far.

alias Carried = vec3f;

// What goes on from the vertex of a path in a direction that was drawn; from a visible point, of
// which irradiance is sought, as from one that weighs it by 1.
fn carried_on(slot: u32, point: Point, albedo: vec3f, drawn: BsdfSample) -> Carried {
    if params.bounce == 0u { return vec3f(1.0 / drawn.density); }
    return paths[slot].throughput * drawn.weight;
}

fn all_carried(carried: Carried) -> vec3f {
    return carried;
}

// What arrives at the next vertex by a segment of this geometry term over the bound; whether it goes
// on from there, which a random number decides.
fn arrive(
    slot: u32,
    carried: Carried,
    next: Point,
    throughput: vec3f,
    g: f32,
    decides: f32,
) -> bool {
    let left = carried * throughput * clamped_share(g);
    let survives = survival_of(left, decides);
    paths[slot].throughput = left * survives;
    return survives > 0.0;
}

// No light from farther away is clamped, whatever reflects it: G <= cos / d^2 <= b.
fn farthest(point: Point, direction: vec3f) -> f32 {
    return sqrt(max(dot(point.normal, direction), 0.0) / params.bound);
}

// By what a vertex sends back the light that it gathers.
alias Returning = vec3f;

fn returning(slot: u32, point: Point) -> Returning {
    return paths[slot].throughput * albedo_of(slot, point) / PI;
}

// What comes back of light that a vertex gathers from a unit direction.
fn gathered_back(by: Returning, toward: vec3f, gathered: Gathered) -> vec3f {
    return by * gathered.rgb;
}
