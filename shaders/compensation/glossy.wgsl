// What bias compensation carries along its paths where some surfaces are glossy. The bound is on
// the geometry term times the lobe of each end over a diffuse one, so that what it took of a
// segment depends on which lobes reflect at both ends: light that comes by the diffuse part of a
// vertex and by its lobe goes on apart, and is weighed where the next vertex reflects.

alias Carried = Arrival;

// Throughput by the diffuse part and by the lobe of the vertex before, each with the geometry term
// of the segment times that lobe over the bound.
struct Arrival {
    diffuse: vec3f,
    diffuse_g: f32,
    glossy: vec3f,
    glossy_g: f32,
}

@group(0) @binding(28) var<storage, read_write> arrivals: array<Arrival>;

fn lobe_over_diffuse(receiver: Receiver, toward: vec3f) -> f32 {
    return receiver.peak * lobe(receiver.mirrored, toward, receiver.shininess);
}

// The throughput of light that the vertex reflects by a lobe of this value.
fn clamped_by(arrival: Arrival, here: f32) -> vec3f {
    return arrival.diffuse * clamped_share(arrival.diffuse_g * here)
        + arrival.glossy * clamped_share(arrival.glossy_g * here);
}

// What goes on from the vertex of a path in a direction that was drawn; from a visible point, of
// which the irradiance that one lobe weighs is sought, by that lobe.
fn carried_on(slot: u32, point: Point, albedo: vec3f, drawn: BsdfSample) -> Carried {
    let here = lobe_over_diffuse(receiver_of(point), drawn.direction);
    let above = dot(point.normal, drawn.direction) > 0.0;
    let weight = select(0.0, 1.0 / (PI * drawn.density), above);
    if params.bounce == 0u {
        let sought = PI * weight * vec2f(vec2u(params.lobe) == vec2u(0u, 1u));
        return Arrival(vec3f(sought.x), 1.0, vec3f(here * sought.y), here);
    }
    let arrival = arrivals[slot];
    return Arrival(
        clamped_by(arrival, 1.0) * albedo * weight,
        1.0,
        clamped_by(arrival, here) * specular_of(point) * (here * weight),
        here,
    );
}

fn all_carried(carried: Carried) -> vec3f {
    return carried.diffuse + carried.glossy;
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
    var arrival = Arrival(
        carried.diffuse * throughput,
        carried.diffuse_g * g,
        carried.glossy * throughput,
        carried.glossy_g * g,
    );
    // By the lobe at its peak the most is clamped.
    let survives = survival_of(clamped_by(arrival, max(receiver_of(next).peak, 1.0)), decides);
    arrival.diffuse *= survives;
    arrival.glossy *= survives;
    arrivals[slot] = arrival;
    return survives > 0.0;
}

// Lobes see far.
fn farthest(point: Point, direction: vec3f) -> f32 {
    return HUGE;
}

// By what a vertex sends back the light that it gathers.
struct Returning {
    arrival: Arrival,
    receiver: Receiver,
    // What it reflects of light of the diffuse part.
    diffuse: vec3f,
    // And of the lobe, over a diffuse one.
    specular: vec3f,
}

fn returning(slot: u32, point: Point) -> Returning {
    let arrival = arrivals[slot];
    let diffuse = clamped_by(arrival, 1.0) * albedo_of(slot, point) / PI;
    return Returning(arrival, receiver_of(point), diffuse, specular_of(point) / PI);
}

// What comes back of light that a vertex gathers from a unit direction.
fn gathered_back(by: Returning, toward: vec3f, gathered: Gathered) -> vec3f {
    let specular = clamped_by(by.arrival, lobe_over_diffuse(by.receiver, toward)) * by.specular;
    return by.diffuse * gathered[0].rgb + specular * gathered[1].rgb;
}
