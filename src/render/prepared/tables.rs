//! The scene on the device: its tables, and whether there is room for them.

use glam::{Vec2, Vec3};

use crate::bvh::{Bvh, WideBvh};
use crate::gpu::{
    Gpu, GpuError, MaterialRecord, NodeRecord, Texture as Texels, TextureRecord, TriangleRecord,
};
use crate::render::features::Features;
use crate::render::materials::bsdf;
use crate::render::plan::memory::{UsedImage, used_images};
use crate::scene::texture::{Interpolation, level_sizes};
use crate::scene::{Material, Scene, Texture, Wrap};

/// A table of the scene, and the name by which shaders know it.
pub type Table = (&'static str, wgpu::Buffer);

/// What the device holds of a scene, and how many bytes of it at least.
fn sizes(gpu: &Gpu, scene: &Scene, features: Features) -> Vec<(&'static str, usize)> {
    let shapes = scene.triangles.len() + scene.spheres.len();
    let mut sizes = vec![
        ("triangles", shapes * size_of::<TriangleRecord>()),
        // A leaf holds a few shapes, and there are twice as many nodes as leaves.
        ("BVH nodes", shapes / 2 * size_of::<NodeRecord>()),
    ];
    if features.has_textures() {
        let images = used_images(scene, most_texels(gpu));
        let texels: usize = images.iter().map(|image| image.texels(scene)).sum();
        sizes.push(("texels", texels * size_of::<u32>()));
        sizes.push(("colours of corners", scene.colors.len() * size_of::<[[u16; 4]; 3]>()));
        sizes.push(("texture coordinates", scene.uvs.len() * size_of::<[Vec2; 3]>()));
    }
    sizes
}

/// Whether there is room for a scene, before anything is taken: each table within what the device
/// binds, and all of it in the memory of the host where the device is a software one.
///
/// # Errors
/// There is not.
pub fn check(gpu: &Gpu, scene: &Scene, features: Features) -> Result<(), GpuError> {
    let sizes = sizes(gpu, scene, features);
    for (label, bytes) in &sizes {
        gpu.check_binding(label, *bytes as u64)?;
    }
    let tables: usize = sizes.iter().map(|(_, bytes)| bytes).sum();
    // Host and device hold the tables; and what the builder of the hierarchy works on, measured.
    const BUILDING: usize = 200;
    let building = BUILDING * (scene.triangles.len() + scene.spheres.len());
    gpu.check_memory("the scene", (2 * tables + building) as u64)
}

/// Uploads the tables of a scene.
///
/// # Errors
/// They do not fit.
pub fn upload(
    gpu: &Gpu,
    scene: &Scene,
    bvh: &Bvh,
    features: Features,
) -> Result<Vec<Table>, GpuError> {
    let materials: Vec<_> = scene
        .materials
        .iter()
        .map(|material| MaterialRecord {
            albedo: material.albedo.to_array(),
            two_sided: u32::from(material.two_sided),
            emission: material.emission.to_array(),
            pad: 0,
        })
        .collect();
    let mut tables = vec![
        ("nodes", gpu.storage_of("BVH nodes", &bvh.nodes)?),
        ("triangles", gpu.storage_of("triangles", &bvh.triangles)?),
        ("materials", gpu.storage_of("materials", &materials)?),
    ];
    if features.has_bsdfs() {
        tables.push(("bsdfs", gpu.storage_of("bsdfs", &bsdf::bsdfs(scene))?));
    }
    if features.has_textures() {
        let (texels, textures) = pack(scene, &used_images(scene, most_texels(gpu)));
        let of_material = |m: &Material| [m.texture, m.emission_texture].map(plus_one);
        let used: Vec<[u32; 2]> = scene.materials.iter().map(of_material).collect();
        let uvs = bytemuck::cast_slice::<_, [f32; 6]>(&scene.uvs);
        tables.extend([
            ("texels", gpu.storage_of("texels", &texels)?),
            ("textures", gpu.storage_of("textures", &textures)?),
            ("uvs", gpu.storage_of("texture coordinates", uvs)?),
            ("material_textures", gpu.storage_of("textures of materials", &used)?),
        ]);
    }
    if features.vertex_colors {
        let colors = vertex_colors(scene);
        tables.push(("vertex_colors", gpu.storage_of("colours of corners", &colors)?));
    }
    if features.emission_textures {
        let lights = light_textures(scene);
        tables.push(("light_textures", gpu.storage_of("textures of area lights", &lights)?));
    }
    Ok(tables)
}

/// What packets of rays are traced through: nodes, and the shapes of their leaves.
///
/// # Errors
/// They do not fit.
pub fn of_packets(gpu: &Gpu, bvh: &Bvh, wide: &WideBvh) -> Result<Vec<Texels>, GpuError> {
    Ok(vec![
        gpu.texture_of("node_table", &wide.nodes)?,
        gpu.texture_of("triangle_table", &bvh.triangles)?,
    ])
}

/// The triangle of each area light, and its textures: see
/// `shaders/lights/light_scale_textured.wgsl`.
fn light_textures(scene: &Scene) -> Vec<[u32; 4]> {
    let of_light = |triangle: u32| {
        let material = &scene.materials[scene.triangles[triangle as usize].material as usize];
        let [glow, cutout] = [material.emission_texture, material.cutout].map(plus_one);
        [triangle, glow, cutout, 0]
    };
    scene.emitters().map(of_light).collect()
}

/// The colours of the corners of all shapes: see `shaders/materials/vertex_color.wgsl`.
fn vertex_colors(scene: &Scene) -> Vec<[u16; 4]> {
    let code = |value: f32| (value.clamp(0.0, 1.0) * f32::from(u16::MAX)).round() as u16;
    let packed = |color: &Vec3| {
        let [r, g, b] = color.to_array().map(code);
        [r, g, b, 0]
    };
    let colors = scene.colors.as_flattened();
    let white = 3 * (scene.triangles.len() + scene.spheres.len()) - colors.len();
    let white = std::iter::repeat_n(&Vec3::ONE, white);
    colors.iter().chain(white).map(packed).collect()
}

fn plus_one(texture: Option<u32>) -> u32 {
    texture.map_or(0, |texture| texture + 1)
}

/// As many as the device binds.
fn most_texels(gpu: &Gpu) -> usize {
    let limits = gpu.limits();
    let bytes = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
    bytes as usize / size_of::<u32>()
}

/// The texels of these images, each with its mip levels, one after the other, and the textures that
/// are laid on them. What no material shows has no texels.
fn pack(scene: &Scene, images: &[UsedImage]) -> (Vec<[u8; 4]>, Vec<TextureRecord>) {
    let mut texels = Vec::new();
    let mut held: Vec<Option<(u32, UsedImage)>> = vec![None; scene.images.len()];
    for image in images {
        held[image.index] = Some((texels.len() as u32, *image));
        let of = &scene.images[image.index];
        texels.extend_from_slice(&of.rgba);
        if image.has_mips {
            texels.extend(of.mips(image.has_holes));
        }
    }
    let record = |texture: &Texture| {
        let size = scene.images[texture.image as usize].size;
        let (first, image) = held[texture.image as usize].unzip();
        let has_mips = image.is_some_and(|image| image.has_mips);
        TextureRecord {
            first: first.unwrap_or_default(),
            width: size[0],
            height: size[1],
            sampler: sampler_code(texture, if has_mips { level_sizes(size).count() } else { 1 }),
            scale: texture.scale.to_array(),
            shift: texture.offset.to_array(),
        }
    };
    (texels, scene.textures.iter().map(record).collect())
}

/// [`TextureRecord::sampler`] of a texture whose image has so many levels.
fn sampler_code(texture: &Texture, levels: usize) -> u32 {
    let filter = texture.filter;
    let levels = if filter.mipmaps { levels } else { 1 };
    let [across, down] = texture.wrap.map(wrap_code);
    let bits = [
        (TextureRecord::NEAREST_MAGNIFIED, filter.magnified == Interpolation::Nearest),
        (TextureRecord::NEAREST_MINIFIED, filter.minified == Interpolation::Nearest),
    ];
    let flags: u32 = bits.into_iter().filter_map(|(bit, is)| is.then_some(bit)).sum();
    across | down << 2 | flags | (levels as u32) << TextureRecord::LEVELS
}

fn wrap_code(wrap: Wrap) -> u32 {
    match wrap {
        Wrap::Repeat => 0,
        Wrap::Mirror => 1,
        Wrap::Clamp => 2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::AdapterChoice;
    use crate::scene::Texels;

    #[test]
    fn scenes_that_do_not_fit_are_refused() {
        let gpu = Gpu::open(&AdapterChoice::Auto).unwrap();
        let mut scene = Scene::load("builtin:cornell").unwrap();
        assert!(check(&gpu, &scene, Features::of(&scene)).is_ok());
        let limits = gpu.limits();
        let most = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size) as usize;
        if most <= 1 << 30 {
            // One row of texels more than the device binds.
            let rgba = vec![[0; 4]; most / 4 + 4096];
            let size = [4096, rgba.len() as u32 / 4096];
            scene.images = vec![Texels { name: String::new(), size, rgba }];
            scene.textures = vec![Texture::of(0)];
            assert!(check(&gpu, &scene, Features::of(&scene)).is_ok(), "no material shows it");
            scene.materials[0].texture = Some(0);
            let error = check(&gpu, &scene, Features::of(&scene)).unwrap_err().to_string();
            let (needed, most) = ((most + 4 * 4096).to_string(), most.to_string());
            assert!(error.contains("texels") && error.contains(&needed), "{error}");
            assert!(error.contains(&most) && !error.contains('\n'), "{error}");
        }
        if gpu.info.device_type == "cpu" && cfg!(target_os = "linux") {
            let error = gpu.check_memory("the scene", u64::MAX).unwrap_err().to_string();
            assert!(error.contains("the scene needs 18446744073709551615 bytes"), "{error}");
        }
    }
}
