//! Scenes made by the program.

mod cornell;
mod room;
mod shapes;

use super::{Draft, Scene, SceneError};

/// Names of the built-in scenes, and what they are.
pub const BUILTIN_SCENES: &[(&str, &str)] = &[
    ("cornell", "the Cornell box, lit by the area light in its ceiling"),
    ("cornell-point", "the Cornell box, lit by a point light"),
    ("room", "a vaulted hall of more than 100,000 triangles, lit mostly indirectly"),
];

/// Makes the built-in scene of this name.
pub fn load(name: &str) -> Result<Scene, SceneError> {
    let mut draft = Draft::new(format!("builtin:{name}"));
    match name {
        "cornell" => cornell::area(&mut draft)?,
        "cornell-point" => cornell::point(&mut draft)?,
        "room" => room::build(&mut draft)?,
        _ => {
            let names: Vec<&str> = BUILTIN_SCENES.iter().map(|&(name, _)| name).collect();
            let what = format!("no such scene; there are {}", names.join(", "));
            return Err(SceneError::new(draft.name, what));
        }
    }
    draft.finish()
}
