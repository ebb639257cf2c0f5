//! What is not a number is counted and refused, not written silently; so is impossible input.

use std::path::Path;

use glam::{DVec3, dvec3};

use super::builder::SceneBuilder;
use super::measure::{absolute, frame, of};
use crate::error::{Error, OutputError};
use crate::extremes::{Figure, Scale};
use crate::gpu::Gpu;
use crate::render::{Bounces, Method, Settings};
use crate::report::warnings::strictly;
use crate::scene::Scene;

fn is(what: impl Into<String>, so: bool) -> Figure {
    absolute(what, 1.0, f64::from(so), 0.0)
}

/// A lamp at the edge of f32 covers the left half of the image: two samples of it are beyond.
/// Those pixels are counted, the first is found, and `--strict` makes an error of it.
pub fn counted(gpu: &Gpu, _: Scale) -> Result<Vec<Figure>, Error> {
    let mut figures = Vec::new();
    for method in [Method::Vpl, Method::Vplc, Method::Vpc, Method::Both, Method::Direct] {
        let settings = |samples| Settings {
            samples,
            edge_samples: 1,
            // The lamp's flux is beyond f32, too.
            bounces: Bounces::Finite(0),
            ..Settings::of(method)
        };
        let over = frame(gpu, screen(3e38)?, &settings(2))?;
        let counted = over.counts.nonfinite_pixels as f64;
        figures.push(of(method, absolute("pixels that are not finite", 32.0, counted, 0.0)));
        let first = over.image.first_nonfinite() == Some([0, 0]);
        figures.push(of(method, is("the first of them is found", first)));
        let strict = strictly(&over, &settings(2));
        let told = matches!(&strict, Err(Error::Strict(why)) if why.contains("column 0, row 0"));
        figures.push(of(method, is("--strict makes an error that says where", told)));
        let within = frame(gpu, screen(1e38)?, &settings(2))?;
        let counted = within.counts.nonfinite_pixels as f64;
        figures.push(of(method, absolute("of a radiance that f32 holds", 0.0, counted, 0.0)));
        figures.push(of(
            method,
            is("--strict lets it through", strictly(&within, &settings(2)).is_ok()),
        ));
    }
    Ok(figures)
}

/// A lamp of this radiance to the left of a dark wall, both far away, in 8 × 8 pixels.
fn screen(radiance: f64) -> Result<Scene, Error> {
    let mut builder = SceneBuilder::at(1.0, DVec3::ZERO);
    let wall = builder.material([0.5; 3], [0.0; 3])?;
    let lamp = builder.material([0.0; 3], [radiance; 3])?;
    let corner = |x, z| dvec3(x, 1.0, z);
    let half = |from: f64, to: f64| {
        [corner(from, -2.0), corner(to, -2.0), corner(to, 2.0), corner(from, 2.0)]
    };
    builder.quad(lamp, half(-2.0, 0.0));
    builder.quad(wall, half(0.0, 2.0));
    builder.camera(DVec3::ZERO, DVec3::Y, 60.0, [8, 8]);
    Ok(builder.scene()?)
}

const CAMERA: &str = "[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\nfov = 45\n";
const LIGHT: &str = "[[light]]\ntype = \"point\"\nposition = [0, 0, 3]\nintensity = [1, 1, 1]\n";
const MESH: &str = "[[mesh]]\nfile = \"mesh.obj\"\n";
const OBJ: &str = "mtllib mesh.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl one\nf 1 2 3\n";
const MTL: &str = "newmtl one\nKd 0.5 0.5 0.5\n";

/// Texts of a scene file, its mesh and its materials, and where the refusal must point: to a file,
/// and a line of it where it has one.
struct Wrong {
    what: &'static str,
    scene: String,
    mesh: String,
    materials: String,
    place: &'static str,
}

fn wrongs() -> Vec<Wrong> {
    let right = || format!("{CAMERA}{LIGHT}{MESH}");
    let of = |what, scene, mesh: &str, materials: &str, place| Wrong {
        what,
        scene,
        mesh: mesh.to_owned(),
        materials: materials.to_owned(),
        place,
    };
    let scene = |what, scene, place| of(what, scene, OBJ, MTL, place);
    let material =
        |line: &str| format!("{CAMERA}{LIGHT}{MESH}material = \"m\"\n[materials.m]\n{line}\n");
    let mesh =
        |what, from: &str, to: &str, place| of(what, right(), &OBJ.replace(from, to), MTL, place);
    vec![
        scene("an albedo above 1", material("albedo = [0.5, 1.5, 0.5]"), "scene.toml:13: "),
        scene("an albedo below 0", material("albedo = [0.5, -0.1, 0.5]"), "scene.toml:13: "),
        scene(
            "an albedo that is no number",
            material("albedo = [0.5, nan, 0.5]"),
            "scene.toml:13: ",
        ),
        scene(
            "a negative radiance",
            material("albedo = [0, 0, 0]\nemission = [1, -1, 1]"),
            "scene.toml:14: ",
        ),
        scene(
            "an infinite radiance",
            material("albedo = [0, 0, 0]\nemission = [1, inf, 1]"),
            "scene.toml:14: ",
        ),
        scene(
            "a negative intensity",
            right().replace("intensity = [1, 1, 1]", "intensity = [1, 1, -1]"),
            "scene.toml:8: ",
        ),
        mesh("a vertex that is no number", "v 1 0 0", "v nan 0 0", "mesh.obj:3: "),
        mesh("an infinite vertex", "v 0 1 0", "v 0 inf 0", "mesh.obj:4: "),
        mesh("a vertex that overflows", "v 0 1 0", "v 0 1e999 0", "mesh.obj:4: "),
        of("a reflectance below 0", right(), OBJ, "newmtl one\nKd 0.5 -0.5 0.5\n", "mesh.mtl:1: "),
        scene("no light", format!("{CAMERA}{MESH}"), "scene.toml: "),
        scene("a black light", right().replace("[1, 1, 1]", "[0, 0, 0]"), "scene.toml: "),
        scene("no camera", format!("{LIGHT}{MESH}"), "scene.toml: "),
    ]
}

/// Each refused with the exit code of bad input, in one line that says where.
pub fn refused(_: &Gpu, _: Scale) -> Result<Vec<Figure>, Error> {
    let mut figures = Vec::new();
    let fine = Wrong {
        what: "",
        scene: format!("{CAMERA}{LIGHT}{MESH}"),
        mesh: OBJ.to_owned(),
        materials: MTL.to_owned(),
        place: "",
    };
    figures.push(is("what is right is read", load(&fine)?.is_ok()));
    for wrong in wrongs() {
        let what = wrong.what;
        let Err(error) = load(&wrong)? else {
            figures.push(is(format!("{what} is refused"), false));
            continue;
        };
        let line = error.to_string();
        let code = f64::from(error.exit_code());
        figures.push(absolute(format!("{what}: exit code"), 2.0, code, 0.0));
        // The directory comes before the file's name.
        let place = line.contains(&format!("/{}", wrong.place)) && !line.contains('\n');
        figures.push(is(
            format!("{what}: one line that names {}", wrong.place.trim_end_matches(": ")),
            place,
        ));
    }
    Ok(figures)
}

/// Reads a scene from files of their own.
fn load(wrong: &Wrong) -> Result<Result<Scene, Error>, Error> {
    let failed = |file: &Path, error: &std::io::Error| OutputError::Write {
        file: file.to_owned(),
        why: error.to_string(),
    };
    let directory = tempfile::tempdir().map_err(|error| failed(&std::env::temp_dir(), &error))?;
    let files =
        [("scene.toml", &wrong.scene), ("mesh.obj", &wrong.mesh), ("mesh.mtl", &wrong.materials)];
    for (name, text) in files {
        let file = directory.path().join(name);
        std::fs::write(&file, text).map_err(|error| failed(&file, &error))?;
    }
    let source = directory.path().join("scene.toml");
    Ok(Scene::load(&source.to_string_lossy()).map_err(Error::from))
}
