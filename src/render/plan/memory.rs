//! How many bytes a scene takes on the device.

use glam::Vec2;

use crate::bvh::{Bvh, WideBvh, WideNode};
use crate::gpu::{
    AreaLightRecord, BsdfRecord, DirectionalLightRecord, MaterialRecord, NodeRecord,
    PointLightRecord, SphereLightRecord, SpotLightRecord, Texture, TextureRecord, TriangleRecord,
};
use crate::render::features::Features;
use crate::render::lights::{LightKind, Lights};
use crate::scene::texture::mip_texels;
use crate::scene::{Material, Scene};

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
    // In a texture, their number in a texel before.
    fn counted<T>(count: usize) -> u64 {
        Texture::bytes_of::<u8>(16 + count * size_of::<T>())
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
        let texels = used_images(scene, usize::MAX).iter().map(|image| image.texels(scene)).sum();
        tables.extend([
            ("texels", of::<[u8; 4]>(texels)),
            ("textures", of::<TextureRecord>(scene.textures.len())),
            ("texture coordinates", of::<[Vec2; 3]>(scene.uvs.len())),
            ("textures of materials", of::<[u32; 2]>(materials)),
        ]);
    }
    if features.vertex_colors {
        let corners = 3 * (scene.triangles.len() + scene.spheres.len());
        tables.push(("colours of corners", of::<[u16; 4]>(corners)));
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
        LightKind::Area => ("area lights", counted::<AreaLightRecord>(lights.area.records.len())),
        LightKind::Sphere => {
            ("sphere lights", counted::<SphereLightRecord>(lights.sphere.records.len()))
        }
        LightKind::Environment => {
            let words = lights.environment.as_ref().map_or(0, |light| light.words().len());
            ("environment", Texture::bytes_of::<u32>(words))
        }
    }));
    let image = scene.environment.as_ref().and_then(|environment| environment.image.as_ref());
    tables.extend(
        image.map(|image| ("environment image", Texture::bytes_of::<u32>(image.texels.len()))),
    );
    tables
}

/// An image that some material shows, as the device holds it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UsedImage {
    /// Index into [`Scene::images`].
    pub index: usize,
    /// Whether there are mip levels of it.
    pub has_mips: bool,
    /// Whether a material with holes shows its colours, so that the levels weigh them by alpha.
    pub has_holes: bool,
}

impl UsedImage {
    /// The texels of all its levels.
    pub fn texels(&self, scene: &Scene) -> usize {
        let image = &scene.images[self.index];
        image.rgba.len() + if self.has_mips { mip_texels(image.size) } else { 0 }
    }
}

/// The images that some material shows, in order, with mip levels where their colours are
/// filtered. If the device binds fewer texels than that makes, as `most` says, the last images go
/// without: then they alias, but can be rendered.
pub fn used_images(scene: &Scene, most: usize) -> Vec<UsedImage> {
    let mut used: Vec<Option<UsedImage>> = vec![None; scene.images.len()];
    for material in &scene.materials {
        for (texture, is_cutout) in textures(material) {
            let texture = &scene.textures[texture as usize];
            let index = texture.image as usize;
            let known = UsedImage { index, has_mips: false, has_holes: false };
            let image = used[index].get_or_insert(known);
            image.has_mips |= !is_cutout && texture.filter.mipmaps;
            image.has_holes |= !is_cutout && material.cutout.is_some();
        }
    }
    let mut used: Vec<UsedImage> = used.into_iter().flatten().collect();
    let mut all: usize = used.iter().map(|image| scene.images[image.index].rgba.len()).sum();
    for image in &mut used {
        let more = mip_texels(scene.images[image.index].size);
        image.has_mips &= all.saturating_add(more) <= most;
        all += if image.has_mips { more } else { 0 };
    }
    used
}

/// The textures of a material, and whether they cut holes, which are not filtered.
fn textures(material: &Material) -> impl Iterator<Item = (u32, bool)> {
    let colors = [material.texture, material.emission_texture].map(|used| (used, false));
    let all = colors.into_iter().chain([(material.cutout, true)]);
    all.filter_map(|(used, is_cutout)| used.map(|texture| (texture, is_cutout)))
}
