// An environment by an image: directions by its cells.

// The interval, of `count` from the first on, that holds u.
fn environment_find(first: u32, count: u32, u: f32) -> u32 {
    var low = 0u;
    var high = count;
    while high - low > 1u {
        let middle = (low + high) / 2u;
        if environment_before(first + middle) <= u { low = middle; } else { high = middle; }
    }
    return low;
}

// How far into an interval u is, in [0, 1].
fn environment_rest(at: u32, u: f32) -> f32 {
    let before = environment_before(at);
    return saturate((u - before) / (environment_before(at + 1u) - before));
}

fn sample_environment_light(kind: u32, point: Point, at: vec2f, offset: f32) -> LightSample {
    let count = environment_cell_count();
    let row = environment_find(ENVIRONMENT_ROWS, count.y, at.y);
    let cells = environment_cells(row);
    let column = environment_find(cells, count.x, at.x);
    let inside =
        vec2f(environment_rest(cells + column, at.x), environment_rest(ENVIRONMENT_ROWS + row, at.y));
    let place = (vec2f(vec2u(column, row)) + inside) / vec2f(count);
    let turn = (place.x - 0.5) * 2.0 * PI;
    let polar = place.y * PI;
    let direction = vec3f(sin(polar) * sin(turn), cos(polar), -sin(polar) * cos(turn));
    let cosine = dot(direction, point.normal);
    let density = environment_density(vec2u(column, row), sin(polar));
    return LightSample(
        direction,
        HUGE,
        cosine > 0.0 && density > 0.0,
        environment_radiance(place),
        cosine,
        density,
    );
}
