// An environment that shadow rays seek, too.

// In a direction that was drawn with this density by solid angle.
fn find_background(slot: u32, carried: vec3f, direction: vec3f, density: f32) {
    let place = environment_place(direction);
    let drawn = environment_density(environment_cell(place), length(direction.xz));
    let weight = params.background * mis_weight(max(density, 1e-30), drawn);
    found(slot, carried * environment_radiance(place) * weight);
}
