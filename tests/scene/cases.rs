//! Files as people's programs write them, of `tests/cases`, beside small ones of the same kind.

mod formats;
mod mtl_glass;
mod names;
mod silence;
mod strict;
mod views;

use gpu_vpl::scene::{Material, Scene};

/// Loads a file of `tests/cases`.
fn case(name: &str) -> Scene {
    Scene::load(&path(name)).unwrap()
}

fn path(name: &str) -> String {
    format!("{}/tests/cases/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// The material of this name, which must be there.
fn material<'a>(scene: &'a Scene, name: &str) -> &'a Material {
    let found = scene.materials.iter().find(|material| material.name == name);
    found.unwrap_or_else(|| unreachable!("no {name} among {:#?}", scene.materials))
}
