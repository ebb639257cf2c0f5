//! Loading scenes: what is read, what is refused with which line, and what normalising does.

#![expect(clippy::unwrap_used, reason = "a test that cannot set itself up must fail")]

mod builtin;
mod cases;
mod fuzz;
mod gltf;
mod light;
mod mtl;
mod mutate;
mod obj;
mod pictures;
mod texture;
mod toml;
mod units;

use gpu_vpl::error::SceneError;
use gpu_vpl::scene::Scene;

/// A triangle and a square, two materials and a light.
pub const MESH: &str = "mtllib mesh.mtl\n\
    v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n\
    usemtl one\nf 1 2 3\nusemtl two\nf 2 4 3\n";
/// The materials of [`MESH`].
pub const MTL: &str = "newmtl one\nKd 0.5 0.4 0.3\nnewmtl two\nKd 0 0 0\nKe 1 2 3\n";
/// A camera in front of [`MESH`], in four lines.
pub const CAMERA: &str = "[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\nfov = 45\n";

/// Loads the first of some files that lie in one directory; paths in messages lose it.
pub fn load(files: &[(&str, &str)]) -> Result<Scene, SceneError> {
    let files: Vec<_> = files.iter().map(|&(name, text)| (name, text.as_bytes())).collect();
    load_bytes(&files)
}

/// [`load`], of files that need not be text.
pub fn load_bytes(files: &[(&str, &[u8])]) -> Result<Scene, SceneError> {
    let directory = tempfile::tempdir().unwrap();
    for (name, bytes) in files {
        std::fs::write(directory.path().join(name), bytes).unwrap();
    }
    let mut result = Scene::load(directory.path().join(files[0].0).to_str().unwrap());
    let prefix = format!("{}/", directory.path().display());
    match &mut result {
        Ok(scene) => {
            for warning in &mut scene.warnings {
                warning.message = warning.message.replace(&prefix, "");
            }
        }
        Err(error) => {
            error.file = error.file.strip_prefix(&prefix).unwrap().to_owned();
            error.what = error.what.replace(&prefix, "");
        }
    }
    result
}

/// Loads a scene file beside [`MESH`] and [`MTL`].
pub fn load_toml(text: &str) -> Result<Scene, SceneError> {
    load(&[("scene.toml", text), ("mesh.obj", MESH), ("mesh.mtl", MTL)])
}

/// Loads a scene file of [`CAMERA`] in its first four lines, a mesh in the next two, and more.
pub fn load_more(text: &str) -> Result<Scene, SceneError> {
    load_toml(&format!("{CAMERA}[[mesh]]\nfile = \"mesh.obj\"\n{text}"))
}

/// Loads a bare mesh beside [`MTL`].
pub fn load_obj(text: &str) -> Result<Scene, SceneError> {
    load(&[("mesh.obj", text), ("mesh.mtl", MTL)])
}

/// Asserts an error of one line that begins with a place and holds a text.
#[track_caller]
pub fn refused(result: Result<Scene, SceneError>, place: &str, text: &str) {
    let message = result.unwrap_err().to_string();
    assert!(message.starts_with(&format!("{place}: ")), "{message}\nis not at {place}");
    assert!(message.contains(text), "{message}\ndoes not say {text}");
    assert!(!message.contains('\n'), "{message}\nis more than one line");
}

/// Asserts a warning that holds a text, and what it says of the image.
#[track_caller]
pub fn warned(scene: &Scene, text: &str, changes_image: bool) {
    let found = scene.warnings.iter().find(|warning| warning.message.contains(text));
    let of_it = found.map(|warning| warning.changes_image);
    assert_eq!(of_it, Some(changes_image), "{text} among {:#?}", scene.warnings);
}
