//! How many bytes a scene takes on the device.

use glam::Vec2;

use crate::bvh::{Bvh, WideBvh, WideNode};
use crate::gpu::{
    AreaLightRecord, BsdfRecord, DirectionalLightRecord, MaterialRecord, NodeRecord,
    PointLightRecord, SphereLightRecord, SpotLightRecord, Texture, TextureRecord, TriangleRecord,
};
use crate::render::features::Features;
use crate::render::lights::{LightKind, Lights};
use crate::scene::Scene;

/// The tables that the device holds of a scene, and what they take in bytes. A table of nothing has one element.
pub fn tables(
    scene: &Scene,
    bvh: &Bvh,
    wide: Option<&WideBvh>,
    lights: &Lights,
    features: Features,
) -> Vec<(&'static str, u64)> {
    fn of<T>(count: usize) -> u64 {
        (count.max(1) * size_of::<T>()) as u64
    }
    let materials = scene.materials.len();
    let mut tables = vec![
        ("BVH nodes", of::<NodeRecord>(bvh.nodes.len())),
        ("triangles and spheres", of::<TriangleRecord>(bvh.triangles.len())),
        ("materials", of::<MaterialRecord>(materials)),
    ];
    if let Some(wide) = wide {
        let shapes = Texture::bytes_of::<TriangleRecord>(bvh.triangles.len());
        tables.extend([
            ("nodes for packets", Texture::bytes_of::<WideNode>(wide.nodes.len())),
            ("shapes for packets", shapes),
        ]);
    }
    if features.has_bsdfs() {
        tables.push(("bsdfs", of::<BsdfRecord>(materials)));
    }
    if features.has_textures() {
        let texels = used_images(scene).map(|image| scene.images[image].rgba.len()).sum();
        tables.extend([
            ("texels", of::<[u8; 4]>(texels)),
            ("textures", of::<TextureRecord>(scene.textures.len())),
            ("texture coordinates", of::<[Vec2; 3]>(scene.uvs.len())),
            ("textures of materials", of::<[u32; 2]>(materials)),
        ]);
    }
    if features.emission_textures {
        tables.push(("textures of area lights", of::<[u32; 4]>(scene.emitters().count())));
    }
    tables.extend(lights.kinds().map(|kind| match kind {
        LightKind::Point => ("point lights", of::<PointLightRecord>(lights.point.records.len())),
        LightKind::Spot => ("spot lights", of::<SpotLightRecord>(lights.spot.records.len())),
        LightKind::Directional => {
            let count = lights.directional.records.len();
            ("directional lights", of::<DirectionalLightRecord>(count))
        }
        LightKind::Area => ("area lights", of::<AreaLightRecord>(lights.area.records.len())),
        LightKind::Sphere => {
            ("sphere lights", of::<SphereLightRecord>(lights.sphere.records.len()))
        }
        LightKind::Environment => {
            let words = lights.environment.as_ref().map_or(0, |light| light.words().len());
            ("environment", of::<u32>(words))
        }
    }));
    let image = scene.environment.as_ref().and_then(|environment| environment.image.as_ref());
    tables.extend(image.map(|image| ("environment image", of::<u32>(image.texels.len()))));
    tables
}

/// The images that some material shows, in order.
pub fn used_images(scene: &Scene) -> impl Iterator<Item = usize> + '_ {
    let textures = || scene.materials.iter().flat_map(|material| material.textures());
    let uses = move |image: usize| {
        textures().any(|texture| scene.textures[texture as usize].image as usize == image)
    };
    (0..scene.images.len()).filter(move |&image| uses(image))
}
