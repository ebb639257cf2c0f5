//! No input panics, hangs or takes much memory, and every refusal is one line.

use gpu_vpl::error::SceneError;
use gpu_vpl::scene::Scene;
use image::ImageFormat::{Bmp, Jpeg, Png, Tga};
use proptest::prelude::*;

use super::gltf::documents;
use super::mutate::{fuzz, mutated};
use super::pictures::{self, QUARTERS, rgba};
use super::{load, load_bytes};

const CUBE: &str = include_str!("../../scenes/cube.obj");
const BLOCKS: &str = include_str!("../../scenes/blocks.toml");

/// All tables, types and keys.
const SCENE: &str = r#"exposure = 1.5
[camera]
position = [0, 0, 5]
direction = [0, 0, -1]
up = [0, 1, 0]
fov = 45
fov_axis = "smaller"
size = [64, 48]
[[mesh]]
file = "mesh.obj"
scale = [1, -2, 1]
rotate = [10, 20, 30]
translate = [1, 2, 3]
[[mesh]]
file = "mesh.obj"
material = "a"
matrix = [0, 0, 1, 10, 1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 1]
[[sphere]]
center = [0, 1, 0]
radius = 0.5
material = "d"
[materials.a]
texture = "a.png"
emission = [1, 2, 3]
two_sided = true
[materials.b]
type = "phong"
albedo = [0.5, 0.5, 0.5]
specular = [0.5, 0.5, 0.5]
shininess = 50
[materials.c]
type = "mirror"
specular = [0.5, 0.5, 0.5]
[materials.d]
type = "glass"
ior = 1.33
[[light]]
type = "spot"
position = [0, 0, 3]
target = [0, 0, 0]
intensity = [1, 1, 1]
angle = 60
softness = 0.5
[[light]]
type = "directional"
direction = [0, -1, 0]
irradiance = [1, 1, 1]
[[light]]
type = "sphere"
center = [0, 3, 0]
radius = 0.5
radiance = [1, 1, 1]
[[light]]
type = "quad"
corners = [[0, 0, 2], [2, 0, 2], [2, 1, 2], [0, 1, 2]]
radiance = [3, 2, 1]
[[light]]
type = "disk"
center = [0, 0, 3]
normal = [0, -2, 0]
radius = 0.5
radiance = [1, 1, 1]
[[light]]
type = "environment"
radiance = [1, 1, 1]
texture = "a.png"
"#;

const MESH: &str = "mtllib mesh.mtl\no it\nv 0 0 0\nv 1 0 0\nv 0 1 0 1\nv 1 1 0 0.5 0.5 0.5\n\
    v 0.5 2 1 2\nvt 0 0\nvt 1 0 0\nvt 0.5\nvn 0 0 1\ng a b\nusemtl one\ns off\nf 1/1/1 2/2/1 3/-1/1\n\
    usemtl two three\nf -4//-1 4//1 \\\n3//1 # it\nf 1 2 4 5 3\nl 1 2\np 1\nusemtl one\nf 1/1 2/2 5/3\n";

const MTL: &str = "# all statements\nnewmtl one\nKa 1 1 1\nKd 0.5 0.4 0.3\nKs 0.1 0.1 0.1\nKe 0 0 0\n\
    Ns 50\nNi 1.5\nTf 1 1 1\nd -halo 1\nillum 2\nmap_Kd -o 0.5 0.25 -s 2 3 1 -clamp on -mm 0 1 -bm 1 \
    -blendu on -cc off -boost 0 -texres 5 -imfchan r -type sphere -t 0 0 a.png\nmap_d -imfchan m a.png\n\
    bump -bm 2 b.png\nnewmtl two three\nKd 0 0 0\nKe 1 2 3\nTr 0.5\nillum 7\nmap_Ke a .png\n\
    newmtl four\nKd 0\nKs 1\nillum 3\nNs 1000\n";

/// Looks only at the shape of what is said.
fn survived(result: Result<Scene, SceneError>) {
    let messages = match result {
        Err(error) => vec![error.to_string()],
        Ok(scene) => scene.warnings.into_iter().map(|warning| warning.message).collect(),
    };
    for message in messages {
        assert!(!message.contains('\n'), "{message}");
    }
}

fn survives(files: &[(&str, &[u8])]) {
    survived(load_bytes(files));
}

fn seeds(texts: &[&str]) -> Vec<Vec<u8>> {
    texts.iter().map(|text| text.as_bytes().to_vec()).collect()
}

#[test]
fn scene_files() {
    let png = rgba(Png, &QUARTERS);
    fuzz("scene files", &mutated(seeds(&[SCENE, SCENE, BLOCKS])), |bytes| {
        survives(&[
            ("scene.toml", &bytes),
            ("mesh.obj", MESH.as_bytes()),
            ("mesh.mtl", MTL.as_bytes()),
            ("cube.obj", CUBE.as_bytes()),
            ("a.png", &png),
        ]);
    });
}

#[test]
fn objs() {
    fuzz("OBJ", &mutated(seeds(&[MESH, MESH, CUBE])), |bytes| {
        survives(&[("mesh.obj", &bytes), ("mesh.mtl", MTL.as_bytes())]);
    });
}

#[test]
fn mtls() {
    let png = rgba(Png, &QUARTERS);
    fuzz("MTL", &mutated(seeds(&[MTL])), |bytes| {
        let mesh = MESH.as_bytes();
        survives(&[("mesh.obj", mesh), ("mesh.mtl", &bytes), ("a.png", &png), ("a .png", &png)]);
    });
}

#[test]
fn gltf_texts() {
    let texts = documents().iter().map(|document| document.0.clone()).collect();
    fuzz("glTF", &mutated(texts), |bytes| survives(&[("a.gltf", &bytes)]));
}

#[test]
fn glbs() {
    let files = documents().iter().map(|document| document.1.clone()).collect();
    fuzz("GLB", &mutated(files), |bytes| survives(&[("a.glb", &bytes)]));
}

#[test]
fn images() {
    let colors: Vec<[u8; 3]> = (0..=255).map(|i: u8| [i, i.wrapping_mul(7), 255 - i]).collect();
    let rgb = |format| pictures::rgb(format, 16, &colors);
    let seeds = vec![
        rgba(Png, &QUARTERS),
        rgb(Png),
        rgb(Jpeg),
        rgba(Jpeg, &QUARTERS),
        rgb(Bmp),
        rgba(Bmp, &QUARTERS),
        rgb(Tga),
        rgba(Tga, &QUARTERS),
    ];
    let scene = format!(
        "{}[[light]]\ntype = \"environment\"\ntexture = \"a.tga\"\n\
        [[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"a\"\n\
        [materials.a]\ntexture = \"a.tga\"\n",
        super::CAMERA
    );
    fuzz("images", &mutated(seeds), |bytes| {
        survives(&[("scene.toml", scene.as_bytes()), ("a.tga", &bytes)]);
    });
}

#[test]
fn environment_maps() {
    let colors: Vec<[f32; 3]> = (0..64).map(|i| [i as f32, 0.5, 1e-3 * i as f32]).collect();
    let seeds = vec![
        pictures::hdr(16, &colors),
        pictures::hdr(2, &colors),
        pictures::exr(16, &colors),
        pictures::exr(2, &colors[..8]),
    ];
    let scene = format!(
        "{}[[light]]\ntype = \"environment\"\ntexture = \"a.hdr\"\n\
        [[light]]\ntype = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nradiance = [1, 1, 1]\n",
        super::CAMERA
    );
    fuzz("environment maps", &mutated(seeds), |bytes| {
        survives(&[("scene.toml", scene.as_bytes()), ("a.hdr", &bytes)]);
    });
}

#[test]
fn random_bytes() {
    fuzz("random bytes", &prop::collection::vec(any::<u8>(), 0..300), |bytes| {
        survives(&[("a.obj", &bytes)]);
        survives(&[("a.toml", &bytes)]);
        survives(&[("a.glb", &bytes)]);
        survives(&[("a.gltf", &bytes)]);
        survives(&[("mesh.obj", MESH.as_bytes()), ("mesh.mtl", &bytes)]);
    });
}

#[test]
fn random_statements() {
    let statements =
        "((v|f|l|vt|usemtl|mtllib|o)( -?[0-9]{1,3}(/-?[0-9]?){0,2}){0,7}\\\\?\n){0,30}";
    fuzz("statements", &statements, |text| survived(load(&[("mesh.obj", &text)])));
}

#[test]
fn random_polygons() {
    let corners = prop::collection::vec((-3i8..3, -3i8..3, -1i8..1), 3..12);
    fuzz("polygons", &corners, |corners| {
        let vertices = corners.iter().map(|(x, y, z)| format!("v {x} {y} {z}\n"));
        let mut text: String = vertices.collect();
        text += "f";
        (1..=corners.len()).for_each(|i| text += &format!(" {i}"));
        survived(load(&[("mesh.obj", &text)]));
    });
}
