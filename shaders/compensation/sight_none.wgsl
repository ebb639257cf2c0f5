// Nothing is known of what paths of bias compensation see of virtual point lights.

alias Sight = u32;

fn sight_of(slot: u32) -> Sight {
    return 0u;
}

fn thought_seen(sight: Sight, light: u32) -> f32 {
    return 1.0;
}
