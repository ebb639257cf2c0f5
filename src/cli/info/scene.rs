//! What a scene holds, what it needs of the renderer, and what it does without.

use std::fmt::{Result, Write};

use glam::{DVec3, Vec3};
use serde::Serialize;

use super::lights::{self, LightInfo};
use super::materials::{self, Kinds, MaterialInfo, TextureInfo};
use super::memory::{self, Memory};
use super::table::{number, numbers};
use crate::bvh::Quality;
use crate::render::kernels::{Tracing, features_of, features_without};
use crate::render::{Plan, Settings};
use crate::scene::{Scene, Units};

/// A scene in numbers. Lengths and positions are in the file's units.
#[derive(Debug, Serialize)]
pub struct SceneInfo {
    name: String,
    triangles: usize,
    spheres: usize,
    /// Left out as they have no area.
    dropped_triangles: u64,
    emitting_triangles: usize,
    emitting_spheres: usize,
    /// Point and spot lights.
    point_lights: usize,
    directional_lights: usize,
    environment: bool,
    materials_by_kind: Kinds,
    images: usize,
    /// Corners of the box around all shapes.
    bounds: Option<[[f64; 3]; 2]>,
    camera: CameraInfo,
    lights: Vec<LightInfo>,
    materials: Vec<MaterialInfo>,
    textures: Vec<TextureInfo>,
    memory: Memory,
    bvh: BvhInfo,
    /// Features of the renderer that the scene needs with default settings.
    used: Vec<&'static str>,
    /// Those that are not linked for it.
    left_out: Vec<&'static str>,
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

#[derive(Debug, Serialize)]
struct BvhInfo {
    #[serde(flatten)]
    quality: Quality,
    /// What rays are traced through: `hierarchy`, or `literals` of the shader.
    traversal: &'static str,
    /// How shadow rays to VPLs are: `single`, packets against `shaft` or `rays`, or `literals`.
    visibility: &'static str,
}

/// Describes a scene, as it is rendered with default settings on a device with or without
/// subgroups.
pub fn describe(scene: Scene, subgroups: bool) -> SceneInfo {
    let settings = Settings::default();
    let plan = Plan::new(scene, &settings, subgroups);
    let programs = plan.programs(&settings);
    let scene = &plan.scene;
    let bounds = bounds(scene);
    let radius = bounds.map_or(0.0, |[low, high]| 0.5 * low.distance(high));
    let emits = |material: u32| scene.materials[material as usize].emits();
    SceneInfo {
        name: scene.name.clone(),
        triangles: scene.triangles.len(),
        spheres: scene.spheres.len(),
        dropped_triangles: scene.dropped_triangles,
        emitting_triangles: scene.emitters().count(),
        emitting_spheres: scene.spheres.iter().filter(|sphere| emits(sphere.material)).count(),
        point_lights: scene.point_lights.len(),
        directional_lights: scene.directional_lights.len(),
        environment: scene.environment.is_some(),
        materials_by_kind: materials::kinds(scene),
        images: scene.images.len(),
        bounds: bounds.map(|corners| corners.map(|corner| corner.to_array())),
        camera: camera(scene),
        lights: lights::of(scene, radius),
        materials: materials::of(scene),
        textures: materials::textures(scene),
        memory: memory::of(&plan),
        bvh: bvh(&plan),
        used: features_of(programs.iter()),
        left_out: features_without(programs.iter()),
        warnings: scene.warnings.iter().map(|warning| warning.message.clone()).collect(),
    }
}

fn camera(scene: &Scene) -> CameraInfo {
    let camera = &scene.camera;
    CameraInfo {
        position: to_file_units(scene.units, camera.position).to_array(),
        direction: camera.forward.as_dvec3().to_array(),
        up: camera.up.as_dvec3().to_array(),
        fov: camera.fov,
        fov_axis: format!("{:?}", camera.fov_axis).to_lowercase(),
        size: camera.size,
    }
}

fn bvh(plan: &Plan) -> BvhInfo {
    BvhInfo {
        quality: plan.bvh.quality(),
        traversal: if plan.target().literals { "literals" } else { "hierarchy" },
        visibility: match plan.tracing() {
            Tracing::Single => "single",
            Tracing::Shaft => "shaft",
            Tracing::Rays => "rays",
            Tracing::Literals => "literals",
        },
    }
}

fn bounds(scene: &Scene) -> Option<[DVec3; 2]> {
    let corners = scene.triangles.iter().flat_map(|triangle| triangle.vertices);
    let spheres = scene.spheres.iter();
    let ends = spheres.flat_map(|sphere| [-1.0, 1.0].map(|r| sphere.center + r * sphere.radius));
    corners
        .chain(ends)
        .map(|corner| [to_file_units(scene.units, corner); 2])
        .reduce(|[low, high], [corner, _]| [low.min(corner), high.max(corner)])
}

/// What rounding to f32 leaves of a coordinate that is 0 in the file is 0 again.
fn to_file_units(units: Units, point: Vec3) -> DVec3 {
    const ROUNDING: f64 = 1e-6;
    let place = units.center + units.scale * point.as_dvec3();
    let rounded = |x: f64| if x.abs() < ROUNDING * units.scale { 0.0 } else { x };
    DVec3::from_array(place.to_array().map(rounded))
}

/// The scene in words.
pub fn in_words(text: &mut String, scene: &SceneInfo) -> Result {
    writeln!(text, "\nscene {}:", scene.name)?;
    let dropped = match scene.dropped_triangles {
        0 => String::new(),
        dropped => format!(", and {dropped} dropped, as they have no area"),
    };
    row(text, "triangles", &format!("{}{dropped}", scene.triangles))?;
    row(text, "spheres", &scene.spheres.to_string())?;
    if let Some([low, high]) = scene.bounds.map(|corners| corners.map(numbers)) {
        row(text, "bounds", &format!("{low} to {high}"))?;
    }
    let CameraInfo { position, direction, fov, fov_axis, size: [width, height], .. } =
        &scene.camera;
    let (position, direction) = (numbers(*position), numbers(*direction));
    row(text, "camera", &format!("at {position} towards {direction}"))?;
    let fov = number(*fov);
    row(text, "", &format!("{fov} degrees ({fov_axis}), {width} x {height} pixels"))?;
    bvh_in_words(text, &scene.bvh)?;
    list(text, "uses", &scene.used)?;
    list(text, "left out", &scene.left_out)?;
    lights::in_words(text, &scene.lights)?;
    materials::in_words(text, &scene.materials_by_kind, &scene.materials)?;
    materials::textures_in_words(text, &scene.textures, scene.images)?;
    memory::in_words(text, &scene.memory)?;
    warnings_in_words(text, &scene.warnings)
}

fn bvh_in_words(text: &mut String, bvh: &BvhInfo) -> Result {
    let Quality { nodes, leaves, depth, mean_leaf_size, sah_cost } = bvh.quality;
    let (size, cost) = (number(mean_leaf_size), number(sah_cost));
    let shape = format!("{nodes} nodes, {leaves} leaves of {size} shapes, depth {depth}");
    row(text, "hierarchy", &format!("{shape}, SAH cost {cost}"))?;
    let traced = match bvh.traversal {
        "literals" => "triangles that are written into the shaders",
        _ => "the hierarchy",
    };
    let shadows = match bvh.visibility {
        "literals" => "four at once",
        "shaft" => "in packets, against boxes as a whole",
        "rays" => "in packets, against boxes ray by ray",
        _ => "one by one",
    };
    row(text, "rays", &format!("through {traced}; those to VPLs {shadows}"))
}

fn row(text: &mut String, name: &str, what: &str) -> Result {
    writeln!(text, "  {name:9}  {what}")
}

/// Names in lines of bounded width.
fn list(text: &mut String, name: &str, names: &[&str]) -> Result {
    const WIDTH: usize = 84;
    let mut lines = vec![String::new()];
    for (at, name) in names.iter().enumerate() {
        let end = if at + 1 == names.len() { "" } else { "," };
        let full = lines.last().is_some_and(|line| line.len() + name.len() > WIDTH);
        if full {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            let blank = if line.is_empty() { "" } else { " " };
            line.push_str(&format!("{blank}{name}{end}"));
        }
    }
    if names.is_empty() {
        lines = vec!["nothing".to_owned()];
    }
    let names = std::iter::once(name).chain(std::iter::repeat(""));
    names.zip(&lines).try_for_each(|(name, line)| row(text, name, line))
}

fn warnings_in_words(text: &mut String, warnings: &[String]) -> Result {
    /// All of them are in the JSON.
    const MOST: usize = 20;
    if warnings.is_empty() {
        return Ok(());
    }
    writeln!(text, "\nwarnings: {}", warnings.len())?;
    for warning in warnings.iter().take(MOST) {
        writeln!(text, "  {warning}")?;
    }
    match warnings.len().saturating_sub(MOST) {
        0 => Ok(()),
        more => writeln!(text, "  ... and {more} more"),
    }
}
