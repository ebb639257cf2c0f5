//! The lights of a scene, the strongest first.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fmt::{Result, Write};

use glam::Vec3;
use serde::Serialize;

use super::table::{self, Column};
use crate::scene::{Cone, Environment, Scene, environment};

/// A light; all triangles and spheres of an emitting material are one.
#[derive(Debug, Serialize)]
pub struct LightInfo {
    /// `area`, `point`, `spot`, `directional` or `environment`.
    kind: &'static str,
    material: Option<String>,
    /// Triangles and spheres that emit.
    shapes: usize,
    /// Emitted flux, mean of the channels, in W, as if a surface's emission had no texture. Of
    /// directional light and an environment, what of it meets the sphere around the scene.
    power: f64,
    /// The part of the power of all lights, in [0, 1].
    share: f64,
}

/// The lights of a scene by power, the strongest first; around it is a sphere of this radius in
/// the file's units.
pub fn of(scene: &Scene, radius: f64) -> Vec<LightInfo> {
    let scale = scene.units.scale;
    let light = |kind, power| LightInfo { kind, material: None, shapes: 0, power, share: 0.0 };
    let mut lights = areas(scene);
    lights.extend(scene.point_lights.iter().map(|point| {
        let (kind, angle) = match &point.cone {
            Some(cone) => ("spot", solid_angle(cone)),
            None => ("point", 4.0 * PI),
        };
        light(kind, angle * scale * scale * mean(point.intensity))
    }));
    let disk = PI * radius * radius;
    let directional = |irradiance: Vec3| light("directional", disk * mean(irradiance));
    lights.extend(scene.directional_lights.iter().map(|light| directional(light.irradiance)));
    let sky = |sky: &Environment| light("environment", 4.0 * PI * disk * mean_radiance(sky));
    lights.extend(scene.environment.iter().map(sky));

    let total: f64 = lights.iter().map(|light| light.power).sum();
    for light in &mut lights {
        light.share = if total > 0.0 { light.power / total } else { 0.0 };
    }
    lights.sort_by(|a, b| b.power.total_cmp(&a.power));
    lights
}

/// Emitting materials with the shapes that they are on.
fn areas(scene: &Scene) -> Vec<LightInfo> {
    let triangles = scene.triangles.iter().map(|t| (t.material, f64::from(t.area())));
    let sphere = |radius: f32| 4.0 * PI * f64::from(radius).powi(2);
    let spheres = scene.spheres.iter().map(|s| (s.material, sphere(s.radius)));
    let mut of_materials: BTreeMap<u32, (usize, f64)> = BTreeMap::new();
    for (material, area) in triangles.chain(spheres) {
        if scene.materials[material as usize].emits() {
            let (shapes, sum) = of_materials.entry(material).or_default();
            (*shapes, *sum) = (*shapes + 1, *sum + area);
        }
    }
    let light = |(index, (shapes, area)): (u32, (usize, f64))| {
        let material = &scene.materials[index as usize];
        let sides = if material.two_sided { 2.0 } else { 1.0 };
        let area = sides * area * scene.units.scale.powi(2);
        let power = PI * area * mean(material.emission);
        LightInfo { kind: "area", material: Some(material.name.clone()), shapes, power, share: 0.0 }
    };
    of_materials.into_iter().map(light).collect()
}

/// The integral of a spot light's ramp, squared, over all directions.
fn solid_angle(cone: &Cone) -> f64 {
    let [inner, outer] = [cone.cos_inner, cone.cos_outer].map(f64::from);
    2.0 * PI * (1.0 - inner + (inner - outer) / 3.0)
}

/// The mean of an environment's radiance over all directions.
fn mean_radiance(sky: &Environment) -> f64 {
    let Some(image) = &sky.image else { return mean(sky.radiance) };
    let [width, height] = image.size.map(f64::from);
    let texels = |row: &[u32]| -> f64 {
        row.iter().map(|&texel| mean(sky.radiance * environment::unpack(texel))).sum()
    };
    let edge = |row: f64| (PI * row / height).cos();
    let rows = image.texels.chunks(image.size[0] as usize).enumerate();
    let of_row = |(at, row): (usize, &[u32])| {
        let at = at as f64;
        texels(row) / width * 0.5 * (edge(at) - edge(at + 1.0))
    };
    rows.map(of_row).sum()
}

fn mean(rgb: Vec3) -> f64 {
    f64::from(rgb.element_sum()) / 3.0
}

/// The lights as a table; those beyond its end together.
pub fn in_words(text: &mut String, lights: &[LightInfo]) -> Result {
    let total: f64 = lights.iter().map(|light| light.power).sum();
    let count = lights.len();
    writeln!(text, "\nlights: {count}, together {} W", table::number(total))?;
    if lights.is_empty() {
        return Ok(());
    }
    let columns = [
        Column::Text("kind"),
        Column::Text("material"),
        Column::Number("shapes"),
        Column::Number("power [W]"),
        Column::Number("share"),
    ];
    let row = |light: &LightInfo| {
        [
            light.kind.to_owned(),
            light.material.clone().unwrap_or_default(),
            if light.shapes == 0 { String::new() } else { light.shapes.to_string() },
            table::number(light.power),
            percent(light.share),
        ]
    };
    table::write(text, columns, lights.iter().map(row))?;
    let rest = lights.get(table::MOST_ROWS..).unwrap_or_default();
    if !rest.is_empty() {
        let power: f64 = rest.iter().map(|light| light.power).sum();
        let share: f64 = rest.iter().map(|light| light.share).sum();
        writeln!(text, "      of {} W together, {}", table::number(power), percent(share))?;
    }
    Ok(())
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}
