// A row takes the visibility of a VPL cluster from a member that it draws in proportion to what each
// would give it if nothing were between: over many rows, or seeds, the mean is what all members give with
// visibilities of their own. One member for all rows would lose the light of a cluster wherever it alone
// is hidden.

// Members weighed for a draw, at most; of more, evenly spaced ones. Few would be drawn with
// probabilities that are off by about one over their number.
const MOST_MEMBERS = 256u;

// The members of each cluster: the first, and how many.
@group(0) @binding(130) var member_ranges: texture_2d<u32>;
// Cluster after cluster, MEMBER_SIZE texels a member: position, weight; normal, bound.
@group(0) @binding(131) var member_table: texture_2d<u32>;
// For each quadruple of clusters and each row: the members.
@group(0) @binding(133) var drawn_table: texture_storage_2d<rgba32uint, write>;

// Four rows, coordinate by coordinate.
struct FourRows {
    positions: mat3x4f,
    normals: mat3x4f,
}

// The segments from four rows to a member, squares of their lengths, and geometry terms.
struct Segments {
    ways: mat3x4f,
    squares: vec4f,
    geometry: vec4f,
}

fn segments(rows: FourRows, position: vec3f, normal: vec3f) -> Segments {
    let ways = mat3x4f(vec4f(position.x), vec4f(position.y), vec4f(position.z)) - rows.positions;
    let squares = ways[0] * ways[0] + ways[1] * ways[1] + ways[2] * ways[2];
    let here = ways[0] * rows.normals[0] + ways[1] * rows.normals[1] + ways[2] * rows.normals[2];
    let cosines = max(here, vec4f(0.0)) * max(-(ways * normal), vec4f(0.0));
    // Never 0 / 0: a member at the point itself has cosines 0 and gives nothing.
    return Segments(ways, squares, cosines / max(squares * squares, vec4f(1e-37)));
}

// The members of a cluster that rows draw, from `row` on.
fn drawn(rows: FourRows, row: u32, cluster: u32) -> vec4u {
    let range = textureLoad(member_ranges, table_place(cluster), 0).xy;
    let count = min(range.y, MOST_MEMBERS);
    // A lattice over rows and clusters: what neighbours draw is spread evenly (Roberts, "The
    // Unreasonable Effectiveness of Quasirandom Sequences", 2018).
    let places = (vec4u(row) + vec4u(0u, 1u, 2u, 3u)) * 3242174889u + cluster * 2447445414u + params.seed;
    let jitter = hash(places.x) % max(range.y, 1u);
    var sums = vec4f(0.0);
    for (var i = 0u; i < count; i++) { sums += weights(rows, candidate(range, i, count, jitter)); }
    var left = sums * vec4f(places >> vec4u(8u)) * (1.0 / 16777216.0);
    var drawn = vec4u(NOTHING);
    for (var i = 0u; i < count; i++) {
        let member = candidate(range, i, count, jitter);
        let weights = weights(rows, member);
        drawn = select(drawn, vec4u(member), (weights > vec4f(0.0)) & (left >= vec4f(0.0)));
        left -= weights;
    }
    return drawn;
}

// The i-th of so many members that are weighed.
fn candidate(range: vec2u, i: u32, count: u32, jitter: u32) -> u32 {
    return range.x + select((i * range.y + jitter) / max(count, 1u), i, range.y == count);
}

// An invocation has four rows and a quadruple of clusters.
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let row = 4u * id.x;
    if row >= params.rows { return; }
    let last = params.rows - 1u;
    let p0 = points[params.first_point + row];
    let p1 = points[params.first_point + min(row + 1u, last)];
    let p2 = points[params.first_point + min(row + 2u, last)];
    let p3 = points[params.first_point + min(row + 3u, last)];
    let rows = FourRows(
        transpose(mat4x3f(p0.position, p1.position, p2.position, p3.position)),
        transpose(mat4x3f(p0.normal, p1.normal, p2.normal, p3.normal)),
    );
    let cluster = 32u * params.first_word + 4u * id.y;
    let one = drawn(rows, row, cluster);
    let two = drawn(rows, row, cluster + 1u);
    let three = drawn(rows, row, cluster + 2u);
    let four = drawn(rows, row, cluster + 3u);
    for (var i = 0u; i < 4u; i++) {
        let place = table_place(id.y * params.rows + row + i);
        let members = vec4u(one[i], two[i], three[i], four[i]);
        if row + i <= last { textureStore(drawn_table, place, members); }
    }
}
