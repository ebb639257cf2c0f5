// A constant environment, which segments alone find: they draw directions as well as shadow rays
// would.

fn find_background(slot: u32, carried: vec3f, direction: vec3f, density: f32) {
    found(slot, carried * background(direction) * params.background);
}
