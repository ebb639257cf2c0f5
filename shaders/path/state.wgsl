// What a path carries from vertex to vertex.

struct Path {
    // What its vertex reflects of the light that is sought next, the vertex itself left out.
    throughput: vec3f,
    // The seed of its pixel's random numbers.
    stream: u32,
}
