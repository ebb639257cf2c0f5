// A ray goes on at mirrors and glass to the first surface that is neither.

struct Sight {
    hit: Hit,
    // Of the last segment.
    direction: vec3f,
    // What comes back of the radiance that is seen.
    throughput: vec3f,
    turned: bool,
    // Whether chance has chosen between reflection and refraction.
    chosen: bool,
}

// Mirrors and glass that a ray meets at most: between facing mirrors it would never end.
const MOST_SPECULAR = 32u;

// Point `number` of the sequence of `stream` chooses between reflection and refraction.
// All invocations of a subgroup must call it together.
fn follow(
    origin: vec3f,
    direction: vec3f,
    limit: f32,
    node_count: u32,
    offset: f32,
    number: u32,
    stream: u32,
    invocation: u32,
) -> Sight {
    var seen = Sight(Hit(limit, NOTHING, vec3f(0.0)), direction, vec3f(1.0), false, false);
    var at = origin;
    var reach = limit;
    for (var i = 0u; i <= MOST_SPECULAR; i++) {
        let hit = traverse(at, seen.direction, reach, node_count, false, invocation);
        let point = hit_point(hit, seen.direction);
        let finish = finish_of(point);
        let goes_on = reach > 0.0 && hit.triangle != NOTHING && finish.kind >= MIRROR;
        if reach > 0.0 { seen.hit = hit; }
        if goes_on {
            let u = scrambled(number, hash(stream ^ hash(i + 1u))).x;
            let turned = turn(point, finish, seen.direction, u);
            let back = way_back(point, seen.direction, offset);
            let through = way_through(point, seen.direction, offset);
            at = point.position + select(through, back, turned.side > 0.0);
            seen.direction = turned.direction;
            seen.throughput *= turned.weight;
            seen.turned = true;
            seen.chosen = seen.chosen || finish.kind == GLASS;
            // What is met is not what is seen.
            seen.hit.triangle = NOTHING;
            if i == MOST_SPECULAR { seen.throughput = vec3f(0.0); }
        }
        reach = select(0.0, HUGE, goes_on);
        if !some_ray(goes_on) { break; }
    }
    return seen;
}

// What comes back of the radiance that is seen.
fn throughput_of(sight: Sight) -> vec3f {
    return sight.throughput;
}

// Whether mirrors or glass have turned the ray.
fn is_turned(sight: Sight) -> bool {
    return sight.turned;
}
