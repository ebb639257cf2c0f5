// Paths of a finite number of bounces end only where nothing is reflected.

fn survival(throughput: vec3f) -> f32 {
    return select(0.0, 1.0, max(throughput.x, max(throughput.y, throughput.z)) > 0.0);
}
