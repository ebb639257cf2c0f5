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

fn lobe_over_diffuse(point: Point, toward: vec3f) -> f32 {
    let receiver = receiver_of(point);
    return receiver.peak * lobe(receiver.mirrored, toward, receiver.shininess);
}

// The throughput of light that the vertex reflects by a lobe of this value.
fn clamped_by(slot: u32, here: f32) -> vec3f {
    let arrival = arrivals[slot];
    return arrival.diffuse * clamped_share(arrival.diffuse_g * here)
        + arrival.glossy * clamped_share(arrival.glossy_g * here);
}

// What goes on from the vertex of a path in a direction that was drawn; from a visible point, of
// which the irradiance that one lobe weighs is sought, by that lobe.
fn carried_on(slot: u32, point: Point, albedo: vec3f, drawn: BsdfSample) -> Carried {
    let here = lobe_over_diffuse(point, drawn.direction);
    let above = dot(point.normal, drawn.direction) > 0.0;
    let weight = select(0.0, 1.0 / (PI * drawn.density), above);
    if params.bounce == 0u {
        let sought = PI * weight * vec2f(vec2u(params.lobe) == vec2u(0u, 1u));
        return Arrival(vec3f(sought.x), 1.0, vec3f(here * sought.y), here);
    }
    return Arrival(
        clamped_by(slot, 1.0) * albedo * weight,
        1.0,
        clamped_by(slot, here) * specular_of(point) * (here * weight),
        here,
    );
}

fn all_carried(carried: Carried) -> vec3f {
    return carried.diffuse + carried.glossy;
}

fn arrive(slot: u32, carried: Carried, next: Point, throughput: vec3f, g: f32) -> bool {
    let arrival = Arrival(
        carried.diffuse * throughput,
        carried.diffuse_g * g,
        carried.glossy * throughput,
        carried.glossy_g * g,
    );
    arrivals[slot] = arrival;
    let peak = max(receiver_of(next).peak, 1.0);
    let most = arrival.diffuse * clamped_share(arrival.diffuse_g * peak)
        + arrival.glossy * clamped_share(arrival.glossy_g * peak);
    return max(most.x, max(most.y, most.z)) > 0.0;
}

// Lobes see far.
fn farthest(point: Point, direction: vec3f) -> f32 {
    return HUGE;
}

fn gathered_back(slot: u32, point: Point, toward: vec3f, gathered: Gathered) -> vec3f {
    let diffuse = clamped_by(slot, 1.0) * gathered[0].rgb * albedo_of(slot, point);
    let here = lobe_over_diffuse(point, toward);
    return (diffuse + clamped_by(slot, here) * gathered[1].rgb * specular_of(point)) / PI;
}
