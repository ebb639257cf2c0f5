// The mean of the channels.

fn mean_of(colour: vec3f) -> f32 {
    return (colour.x + colour.y + colour.z) / 3.0;
}
