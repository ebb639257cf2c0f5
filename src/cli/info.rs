//! `info`: the adapters and built-in scenes there are, and what a scene holds.

use std::fmt::Write;

use clap::Args;
use glam::DVec3;
use serde::Serialize;

use super::console;
use crate::error::{Error, OutputError};
use crate::gpu::{self, AdapterDescription, Gpu};
use crate::render::{Prepared, Settings};
use crate::scene::{BUILTIN_SCENES, Scene, Sphere, Units};

/// The options of `info`.
#[derive(Debug, Args)]
pub struct InfoArgs {
    /// A .toml scene file, a bare .obj, .gltf or .glb, or builtin:NAME
    scene: Option<String>,

    /// Print JSON
    #[arg(long)]
    json: bool,

    /// Part of an adapter's name or driver, its index, or cpu; as `render` takes it
    #[arg(long, value_name = "NAME|INDEX")]
    adapter: Option<String>,
}

#[derive(Debug, Serialize)]
struct Info {
    version: &'static str,
    adapters: Vec<AdapterDescription>,
    /// The adapter that `render` would take, or why it would fail.
    chosen: Option<gpu::AdapterInfo>,
    chosen_error: Option<String>,
    builtin_scenes: Vec<Builtin>,
    scene: Option<SceneInfo>,
}

#[derive(Debug, Serialize)]
struct Builtin {
    name: String,
    what: &'static str,
}

#[derive(Debug, Serialize)]
struct SceneInfo {
    name: String,
    triangles: usize,
    materials: usize,
    point_lights: usize,
    emitting_triangles: usize,
    spheres: usize,
    textures: usize,
    dropped_triangles: u64,
    /// Corners of the box around all triangles and spheres, in the file's units.
    bounds: Option<[[f64; 3]; 2]>,
    camera: CameraInfo,
    /// Features of the renderer that this scene does without; null without an adapter.
    left_out: Option<Vec<&'static str>>,
    warnings: Vec<String>,
}

#[derive(Debug, Serialize)]
struct CameraInfo {
    position: [f64; 3],
    direction: [f64; 3],
    up: [f64; 3],
    fov: f64,
    fov_axis: String,
    size: [u32; 2],
}

/// Prints what there is. That there is no adapter is part of the answer and no error, unless
/// one was asked for by name.
///
/// # Errors
/// The scene cannot be read, or the adapter asked for is not there.
pub fn run(args: &InfoArgs) -> Result<(), Error> {
    let scene = args.scene.as_deref().map(Scene::load).transpose()?;
    let choice = super::adapter_choice(args.adapter.as_deref());
    let opened = Gpu::open(&choice);
    let (gpu, error) = match opened {
        Ok(gpu) => (Some(gpu), None),
        Err(error) if args.adapter.is_some() => return Err(error.into()),
        Err(error) => (None, Some(error.to_string())),
    };
    let info = Info {
        version: env!("CARGO_PKG_VERSION"),
        adapters: gpu::adapters(),
        chosen: gpu.as_ref().map(|gpu| gpu.info.clone()),
        chosen_error: error,
        builtin_scenes: BUILTIN_SCENES
            .iter()
            .map(|&(name, what)| Builtin { name: format!("builtin:{name}"), what })
            .collect(),
        scene: scene.map(|scene| describe(scene, gpu)),
    };
    let text = if args.json {
        serde_json::to_string_pretty(&info).unwrap_or_default() + "\n"
    } else {
        in_words(&info)
    };
    console::print(&text).map_err(|error| {
        OutputError::Write { file: "standard output".into(), why: error.to_string() }.into()
    })
}

fn describe(scene: Scene, gpu: Option<Gpu>) -> SceneInfo {
    let units = scene.units;
    let camera = &scene.camera;
    SceneInfo {
        name: scene.name.clone(),
        triangles: scene.triangles.len(),
        materials: scene.materials.len(),
        point_lights: scene.point_lights.len(),
        emitting_triangles: scene.emitters().count(),
        spheres: scene.spheres.len(),
        textures: scene.textures.len(),
        dropped_triangles: scene.dropped_triangles,
        bounds: bounds(&scene).map(|bounds| bounds.map(|corner| corner.to_array())),
        camera: CameraInfo {
            position: to_file_units(units, camera.position).to_array(),
            direction: camera.forward.as_dvec3().to_array(),
            up: camera.up.as_dvec3().to_array(),
            fov: camera.fov,
            fov_axis: format!("{:?}", camera.fov_axis).to_lowercase(),
            size: camera.size,
        },
        warnings: scene.warnings.iter().map(|warning| warning.message.clone()).collect(),
        left_out: gpu
            .and_then(|gpu| Prepared::new(gpu, scene, &Settings::default()).ok())
            .map(|prepared| prepared.left_out()),
    }
}

fn bounds(scene: &Scene) -> Option<[DVec3; 2]> {
    let corners = scene.triangles.iter().flat_map(|triangle| triangle.vertices);
    let extremes = |sphere: &Sphere| [sphere.center - sphere.radius, sphere.center + sphere.radius];
    corners
        .chain(scene.spheres.iter().flat_map(extremes))
        .map(|corner| [to_file_units(scene.units, corner); 2])
        .reduce(|[low, high], [corner, _]| [low.min(corner), high.max(corner)])
}

fn to_file_units(units: Units, point: glam::Vec3) -> DVec3 {
    units.center + units.scale * point.as_dvec3()
}

/// Coordinates to the seven digits that an f32 holds.
fn point(coordinates: [f64; 3]) -> String {
    coordinates.map(|value| (value as f32).to_string()).join(" ")
}

fn in_words(info: &Info) -> String {
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = adapters_in_words(&mut text, info);
    if let Some(scene) = &info.scene {
        let _ = scene_in_words(&mut text, scene);
    }
    text
}

fn adapters_in_words(text: &mut String, info: &Info) -> std::fmt::Result {
    writeln!(text, "gpu-vpl {}\n\nadapters:", info.version)?;
    for (index, AdapterDescription { info, limits, features }) in info.adapters.iter().enumerate() {
        let gpu::AdapterInfo { name, backend, driver, device_type } = info;
        writeln!(text, "  {index}: {name} ({backend}, {driver}, {device_type})")?;
        for (limit, value) in limits {
            writeln!(text, "       {limit}: {value}")?;
        }
        if !features.is_empty() {
            writeln!(text, "       features: {}", features.join(", "))?;
        }
    }
    match (&info.chosen, &info.chosen_error) {
        (Some(chosen), _) => writeln!(text, "chosen: {} ({})", chosen.name, chosen.backend)?,
        (None, reason) => writeln!(text, "chosen: none; {}", reason.as_deref().unwrap_or(""))?,
    }
    writeln!(text, "\nbuilt-in scenes:")?;
    for Builtin { name, what } in &info.builtin_scenes {
        writeln!(text, "  {name:24} {what}")?;
    }
    Ok(())
}

fn scene_in_words(text: &mut String, scene: &SceneInfo) -> std::fmt::Result {
    writeln!(text, "\nscene {}:", scene.name)?;
    writeln!(
        text,
        "  triangles          {} (dropped {})",
        scene.triangles, scene.dropped_triangles
    )?;
    writeln!(text, "  materials          {}", scene.materials)?;
    writeln!(text, "  point lights       {}", scene.point_lights)?;
    writeln!(text, "  emitting triangles {}", scene.emitting_triangles)?;
    writeln!(text, "  spheres            {}", scene.spheres)?;
    writeln!(text, "  textures           {}", scene.textures)?;
    if let Some([low, high]) = scene.bounds.map(|corners| corners.map(point)) {
        writeln!(text, "  bounds             {low} to {high}")?;
    }
    let CameraInfo { position, direction, fov, fov_axis, size: [width, height], .. } =
        &scene.camera;
    let (position, direction) = (point(*position), point(*direction));
    writeln!(text, "  camera             at {position} towards {direction}")?;
    writeln!(text, "                     {fov}° ({fov_axis}), {width} x {height} pixels")?;
    if let Some(left_out) = &scene.left_out {
        let left_out = if left_out.is_empty() { "nothing" } else { &left_out.join(", ") };
        writeln!(text, "  left out           {left_out}")?;
    }
    for warning in &scene.warnings {
        writeln!(text, "  warning: {warning}")?;
    }
    Ok(())
}
