//! The materials of a scene, and the images that they show.

use std::fmt::{Result, Write};

use glam::Vec3;
use serde::Serialize;

use super::table::{self, Column};
use crate::scene::{Bsdf, Material, Scene, Texture, Wrap};

/// How many materials there are of each kind.
#[derive(Debug, Default, Serialize)]
pub struct Kinds {
    diffuse: usize,
    phong: usize,
    mirror: usize,
    glass: usize,
}

/// A material. What its kind has none of is null.
#[derive(Debug, Serialize)]
pub struct MaterialInfo {
    name: String,
    kind: &'static str,
    /// Triangles and spheres of it.
    shapes: usize,
    albedo: [f64; 3],
    specular: Option<[f64; 3]>,
    shininess: Option<f64>,
    ior: Option<f64>,
    /// The image that the albedo is multiplied by.
    texture: Option<String>,
    /// The image whose alpha cuts holes.
    cutout: Option<String>,
    emission: [f64; 3],
    /// The image that the emission is multiplied by.
    emission_texture: Option<String>,
    two_sided: bool,
}

/// An image, laid on surfaces in one way.
#[derive(Debug, Serialize)]
pub struct TextureInfo {
    image: String,
    width: u32,
    height: u32,
    /// Across and down: `repeat`, `mirror` or `clamp`.
    wrap: [&'static str; 2],
    /// Of the image, which other textures may share.
    bytes: u64,
    /// Materials that show it.
    materials: usize,
}

/// How many materials there are of each kind.
pub fn kinds(scene: &Scene) -> Kinds {
    let mut kinds = Kinds::default();
    for material in &scene.materials {
        *match material.bsdf {
            Bsdf::Diffuse => &mut kinds.diffuse,
            Bsdf::Phong { .. } => &mut kinds.phong,
            Bsdf::Mirror { .. } => &mut kinds.mirror,
            Bsdf::Glass { .. } => &mut kinds.glass,
        } += 1;
    }
    kinds
}

/// The materials of a scene, in its order.
pub fn of(scene: &Scene) -> Vec<MaterialInfo> {
    let mut shapes = vec![0; scene.materials.len()];
    let triangles = scene.triangles.iter().map(|triangle| triangle.material);
    for material in triangles.chain(scene.spheres.iter().map(|sphere| sphere.material)) {
        shapes[material as usize] += 1;
    }
    scene.materials.iter().zip(shapes).map(|(material, n)| describe(scene, material, n)).collect()
}

fn describe(scene: &Scene, material: &Material, shapes: usize) -> MaterialInfo {
    let image = |texture: Option<u32>| {
        texture.map(|index| {
            let texture = &scene.textures[index as usize];
            scene.images[texture.image as usize].name.clone()
        })
    };
    let (kind, specular, shininess, ior) = match material.bsdf {
        Bsdf::Diffuse => ("diffuse", None, None, None),
        Bsdf::Phong { specular, shininess } => ("phong", Some(specular), Some(shininess), None),
        Bsdf::Mirror { specular } => ("mirror", Some(specular), None, None),
        Bsdf::Glass { specular, ior } => ("glass", Some(specular), None, Some(ior)),
    };
    MaterialInfo {
        name: material.name.clone(),
        kind,
        shapes,
        albedo: rgb(material.albedo),
        specular: specular.map(rgb),
        shininess: shininess.map(shortest),
        ior: ior.map(shortest),
        texture: image(material.texture),
        cutout: image(material.cutout),
        emission: rgb(material.emission),
        emission_texture: image(material.emission_texture),
        two_sided: material.two_sided,
    }
}

/// The textures of a scene, in its order.
pub fn textures(scene: &Scene) -> Vec<TextureInfo> {
    let describe = |(index, texture): (u32, &Texture)| {
        let image = &scene.images[texture.image as usize];
        let shows = |material: &&Material| material.textures().any(|used| used == index);
        TextureInfo {
            image: image.name.clone(),
            width: image.size[0],
            height: image.size[1],
            wrap: texture.wrap.map(|wrap| match wrap {
                Wrap::Repeat => "repeat",
                Wrap::Mirror => "mirror",
                Wrap::Clamp => "clamp",
            }),
            bytes: size_of_val(image.rgba.as_slice()) as u64,
            materials: scene.materials.iter().filter(shows).count(),
        }
    };
    (0..).zip(&scene.textures).map(describe).collect()
}

fn rgb(color: Vec3) -> [f64; 3] {
    color.to_array().map(shortest)
}

/// The shortest number that rounds to the same f32: 0.63 and not 0.6299999952316284.
fn shortest(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(f64::from(value))
}

/// The materials as a table.
pub fn in_words(text: &mut String, kinds: &Kinds, materials: &[MaterialInfo]) -> Result {
    let Kinds { diffuse, phong, mirror, glass } = kinds;
    let counts = [(diffuse, "diffuse"), (phong, "phong"), (mirror, "mirror"), (glass, "glass")];
    let there = counts.iter().filter(|(count, _)| **count > 0);
    let there: Vec<_> = there.map(|(count, kind)| format!("{count} {kind}")).collect();
    writeln!(text, "\nmaterials: {} ({})", materials.len(), there.join(", "))?;
    let columns = [
        Column::Text("name"),
        Column::Text("kind"),
        Column::Number("shapes"),
        Column::Text("albedo"),
        Column::Text("specular"),
        Column::Number("shininess"),
        Column::Number("ior"),
        Column::Text("emission"),
        Column::Text("textures"),
    ];
    let option = |value: Option<f64>| value.map(table::number).unwrap_or_default();
    let color = |value: [f64; 3]| match value {
        [0.0, 0.0, 0.0] => "0".to_owned(),
        _ => table::numbers(value),
    };
    let row = |material: &MaterialInfo| {
        let emits = material.emission != [0.0; 3];
        [
            material.name.clone(),
            material.kind.to_owned(),
            material.shapes.to_string(),
            color(material.albedo),
            material.specular.map(color).unwrap_or_default(),
            option(material.shininess),
            option(material.ior),
            if emits { color(material.emission) } else { String::new() },
            used_images(material),
        ]
    };
    table::write(text, columns, materials.iter().map(row))
}

/// What a material shows, each image once.
fn used_images(material: &MaterialInfo) -> String {
    let MaterialInfo { texture, cutout, emission_texture, .. } = material;
    let mut names: Vec<&str> = Vec::new();
    for name in [texture, cutout, emission_texture].into_iter().flatten() {
        let file = name.rsplit('/').next().unwrap_or(name);
        if !names.contains(&file) {
            names.push(file);
        }
    }
    names.join(", ")
}

/// The textures as a table, if there are any.
pub fn textures_in_words(text: &mut String, textures: &[TextureInfo], images: usize) -> Result {
    if textures.is_empty() {
        return Ok(());
    }
    writeln!(text, "\ntextures: {} of {images} images", textures.len())?;
    let columns = [
        Column::Text("image"),
        Column::Number("width"),
        Column::Number("height"),
        Column::Text("wrap"),
        Column::Number("memory"),
        Column::Number("materials"),
    ];
    let row = |texture: &TextureInfo| {
        [
            texture.image.clone(),
            texture.width.to_string(),
            texture.height.to_string(),
            texture.wrap.join(" "),
            table::bytes(texture.bytes),
            texture.materials.to_string(),
        ]
    };
    table::write(text, columns, textures.iter().map(row))
}
