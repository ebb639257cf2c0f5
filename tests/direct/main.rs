//! Direct light against closed forms: every kind of light, on every shape.

#[path = "../common/mod.rs"]
mod common;

mod closed_forms;
mod environment;
mod glossy;
mod lights;
mod many_lights;
mod sampling;
mod sphere_lights;
mod spheres;
