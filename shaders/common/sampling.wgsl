// Owen-scrambled Sobol points in two dimensions, a sequence a pixel.
// Burley, "Practical Hash-based Owen Scrambling", JCGT 2020; the hash is Vegdahl's.

// The 2D sequence is a (0, 2)-sequence: every aligned run of 2^k points is stratified. The matrix
// of its second dimension is Pascal's triangle modulo 2, a product of five sparse ones.
fn sobol(index: u32) -> vec2u {
    var y = index;
    y ^= (y & 0xaaaaaaaau) >> 1u;
    y ^= (y & 0xccccccccu) >> 2u;
    y ^= (y & 0xf0f0f0f0u) >> 4u;
    y ^= (y & 0xff00ff00u) >> 8u;
    y ^= (y & 0xffff0000u) >> 16u;
    return reverseBits(vec2u(index, y));
}

fn hash(x: u32) -> u32 {
    var h = x ^ (x >> 16u);
    h *= 0x7feb352du;
    h ^= h >> 15u;
    h *= 0x846ca68bu;
    return h ^ (h >> 16u);
}

fn owen(x: u32, seed: u32) -> u32 {
    var v = reverseBits(x);
    v ^= v * 0x3d20adeau;
    v += seed;
    v *= (seed >> 16u) | 1u;
    v ^= v * 0x05526c56u;
    v ^= v * 0x53a22864u;
    return reverseBits(v);
}

// Point `index` of the sequence that `seed` scrambles, in [0, 1)^2.
fn scrambled(index: u32, seed: u32) -> vec2f {
    // Shuffling the index, within the runs that are stratified, decorrelates sequences used side
    // by side.
    let p = sobol(owen(index, hash(seed)));
    let q = vec2u(owen(p.x, hash(seed ^ 0x9e3779b9u)), owen(p.y, hash(seed ^ 0x3c6ef372u)));
    return vec2f(q >> vec2u(8u)) * (1.0 / 16777216.0);
}

// Point `index` of 1 / weight points in [0, 1)^2: a Hammersley set, jittered in x and
// scrambled in y. Neighbours with other seeds have the same stratum in x at the same index,
// so that their rays go the same way.
fn stratified(index: u32, weight: f32, seed: u32) -> vec2f {
    let jitter = f32(hash(index ^ hash(seed ^ 0x9e3779b9u)) >> 8u) * (1.0 / 16777216.0);
    let y = owen(reverseBits(index), hash(seed ^ 0x3c6ef372u));
    return vec2f((f32(index) + jitter) * weight, f32(y >> 8u) * (1.0 / 16777216.0));
}
