//! Nothing that a file has is dropped in silence: what OBJ and glTF hold of colours, names and
//! comments.

use glam::Vec3;
use gpu_vpl::scene::Scene;
use gpu_vpl::scene::texture::Interpolation;

use super::super::{load, load_obj, warned};
use super::{case, material};

#[test]
fn comments_end_with_their_line() {
    let scene = case("comment_backslash/comment_backslash/s.toml");
    assert_eq!(material(&scene, "paint").albedo, Vec3::new(0.1, 0.6, 0.1));
    assert_eq!(scene.triangles.iter().filter(|t| t.material == 1).count(), 12, "{scene:?}");
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for text in [
        format!("# made in C:\\work\\\n{corners}f 1 2 3\n"),
        format!("{corners}o props\\chair\\\nf 1 2 3\n"),
        format!("{corners}g C:\\\nf 1 2 3\n"),
        "v 0 0 0 # the first \\\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_owned(),
        format!("{corners}f 1 2 \\\n3\n"),
        format!("{corners}g a \\\nb\nf 1 2 3\n"),
    ] {
        assert_eq!(load_obj(&text).unwrap().triangles.len(), 1, "{text}");
    }
}

/// The colours of a triangle of three vertices of a mesh.
fn colors(text: &str) -> Vec<[Vec3; 3]> {
    load_obj(text).unwrap().colors
}

#[test]
fn colours_of_vertices_are_shown() {
    let [rgb, rgba] =
        ["colours", "rgba"].map(|name| case(&format!("vertex_colours_obj/vertex_{name}/s.toml")));
    assert_eq!((rgb.colors.len(), &rgb.colors), (16, &rgba.colors));
    assert_eq!(rgb.colors[0], [Vec3::new(1.0, 1.0, 0.0), Vec3::Z, Vec3::Y]);
    assert!(rgb.materials.iter().any(|m| m.name == "default" && m.albedo == Vec3::ONE));
    let linear = 0.214_041_14;
    let close = |got: Vec3, expected: Vec3| assert!(got.distance(expected) < 1e-5, "{got}");
    for half in ["0.5 0.5 0.5", "127.5 127.5 127.5"] {
        let one = if half.starts_with("0.") { "1 1 1" } else { "255 255 255" };
        let text = format!("v 0 0 0 {half}\nv 1 0 0 {one}\nv 0 1 0 0 0 0\nf 1 2 3\n");
        let [[a, b, c]] = colors(&text)[..] else { unreachable!("one triangle") };
        close(a, Vec3::splat(linear));
        close(b, Vec3::ONE);
        close(c, Vec3::ZERO);
    }
    // They multiply a colour, and give way to a map.
    let obj = "mtllib m.mtl\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 0 0 1\n\
        usemtl plain\nf 1 2 3\nusemtl mapped\nf 1 2 4\n";
    let mtl = "newmtl plain\nKd 0.5 0.5 0.5\nnewmtl mapped\nmap_Kd gone.png\n";
    let scene = load(&[("m.obj", obj), ("m.mtl", mtl)]).unwrap();
    assert_eq!(scene.colors, [[Vec3::X; 3], [Vec3::ONE; 3]]);
    assert_eq!(material(&scene, "plain").albedo, Vec3::splat(0.5));
    warned(&scene, "1 triangles have colours at their corners and a map_Kd", false);
    // Vertices without are as any that have no material.
    let scene = load_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1 1 0 0\nf 1 2 3\nf 1 2 4\n").unwrap();
    assert_eq!(scene.colors[0], [Vec3::splat(0.8); 3]);
    assert_eq!(scene.colors[1], [Vec3::ONE, Vec3::ONE, Vec3::X]);
    assert!(colors("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").is_empty());
    let clear = load_obj("v 0 0 0 1 0 0 0.5\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    warned(&clear, "mesh.obj:1: 1 colours of vertices have an alpha", true);
}

#[test]
fn a_scene_file_s_material_hides_the_colours_and_says_so() {
    let obj = "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n";
    let toml = format!(
        "{}[[mesh]]\nfile = \"m.obj\"\nmaterial = \"m\"\n[materials.m]\nalbedo = [0.5, 0.5, 0.5]\n\
         emission = [1, 1, 1]\n",
        super::super::CAMERA
    );
    let scene = load(&[("s.toml", &toml), ("m.obj", obj)]).unwrap();
    assert!(scene.colors.is_empty());
    warned(&scene, "the colours at the corners of 1 triangles are left out", false);
}

#[test]
fn nearest_is_nearest() {
    let scene: Scene = case("nearest/nearest/m.gltf");
    let filter = scene.textures[0].filter;
    assert_eq!(
        (filter.magnified, filter.minified),
        (Interpolation::Nearest, Interpolation::Nearest)
    );
    assert!(!filter.mipmaps);
}

#[test]
fn decals_are_in_front_of_their_walls() {
    for name in ["coplanar", "coplanar_rot"] {
        let scene = case(&format!("coplanar/{name}/s.toml"));
        warned(&scene, "2 pairs of triangles of different materials overlap in one plane", false);
        let of = |name: &str| {
            let index = scene.materials.iter().position(|material| material.name == name).unwrap();
            scene.triangles.iter().filter(move |t| t.material as usize == index)
        };
        // On both sides of the wall.
        assert_eq!((of("floor").count(), of("mark").count()), (2, 4), "{name}");
    }
    // A rug of another material on a tiled floor, and tiles that only touch.
    let tiles = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 0 1\nv 1 0 1\nv 2 0 1\n";
    let scene =
        load_obj(&format!("{tiles}usemtl one\nf 1 2 5 4\nusemtl two\nf 2 3 6 5\n")).unwrap();
    assert!(scene.warnings.iter().all(|w| !w.message.contains("overlap")), "{:?}", scene.warnings);
    let rug = "v 0.25 0 0.25\nv 1.75 0 0.25\nv 1.75 0 0.75\nv 0.25 0 0.75\n";
    let text = format!("{tiles}{rug}usemtl one\nf 1 2 5 4\nf 2 3 6 5\nusemtl two\nf 7 8 9 10\n");
    warned(&load_obj(&text).unwrap(), "pairs of triangles of different materials overlap", false);
}
