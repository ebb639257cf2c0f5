//! The names of files and materials, and the encodings that they are written in.

use glam::Vec3;
use gpu_vpl::scene::Scene;

use super::super::pictures::{QUARTERS, png};
use super::super::{CAMERA, load, load_bytes, refused, warned};
use super::{case, material};

/// Whether an image was read, and is not what stands for one that could not be.
fn shows_an_image(scene: &Scene) -> bool {
    !scene.images.is_empty() && scene.images.iter().all(|i| i.rgba != [[255, 0, 255, 255]])
}

#[test]
fn backslashes_drives_and_case_are_seen_through() {
    let library = case("mtllib_backslash/mtllib_backslash/s.toml");
    assert_eq!(material(&library, "paint").albedo, Vec3::new(0.1, 0.6, 0.1));
    assert!(shows_an_image(&library));
    assert!(library.warnings.iter().all(|w| !w.message.contains("is not there")));
    for (name, says) in [
        ("abs_win", "`C:\\Users\\someone\\Desktop\\tex\\wood.png` is not there; "),
        ("case", "`Wood.JPG` is not there; "),
    ] {
        let scene = case(&format!("mtllib_backslash/{name}/s.toml"));
        assert!(shows_an_image(&scene), "{name}");
        warned(&scene, says, false);
    }
    for name in ["s", "s2"] {
        let scene = case(&format!("mtllib_backslash/toml_backslash/{name}.toml"));
        assert!(shows_an_image(&scene), "{name}");
    }
    let uri = case("unlit_required/uri_backslash/m.gltf");
    assert!(shows_an_image(&uri));
}

#[test]
fn names_that_are_not_in_unicode_stay_apart() {
    let scene = case("gbk_names/gbk/s.toml");
    let colors: Vec<Vec3> = scene.materials.iter().map(|material| material.albedo).collect();
    assert!(colors.contains(&Vec3::new(0.8, 0.1, 0.1)), "{colors:?}");
    assert!(colors.contains(&Vec3::new(0.1, 0.1, 0.8)), "{colors:?}");
    warned(&scene, "it is not in UTF-8; read as", false);
    assert!(shows_an_image(&case("gbk_names/gbk_texture/s.toml")));
}

/// A textured triangle whose library and image are named so, and are files of other names.
fn textured(library: &str, image: &str, files: [&str; 2]) -> Scene {
    let obj = format!("mtllib {library}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
    let mtl = format!("newmtl m\nmap_Kd {image}\n");
    let png = png(&QUARTERS);
    let [library, image] = files;
    load_bytes(&[("m.obj", obj.as_bytes()), (library, mtl.as_bytes()), (image, &png)]).unwrap()
}

#[test]
fn one_rule_finds_all_files() {
    for (library, image, files) in [
        ("M.MTL", "A.PNG", ["m.mtl", "a.png"]),
        ("./mats/m.mtl", "../tex/a.png", ["m.mtl", "a.png"]),
        ("C:\\work\\m.mtl", "\\\\server\\share\\a.png", ["m.mtl", "a.png"]),
        ("\"m.mtl\"", "\"a b.png\"", ["m.mtl", "a b.png"]),
        // Composed here, decomposed there.
        ("m\u{e4}.mtl", "a\u{e9}.png", ["ma\u{308}.mtl", "ae\u{301}.png"]),
        ("file:///D:/models/m.mtl", "file:///C:/maps/a.png", ["m.mtl", "a.png"]),
        // The library was renamed with its mesh.
        ("untitled.mtl", "a.png", ["m.mtl", "a.png"]),
    ] {
        let scene = textured(library, image, files);
        assert!(shows_an_image(&scene), "{library}, {image}: {:?}", scene.warnings);
    }
}

#[test]
fn scene_files_and_gltf_find_by_the_same_rule() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
    let toml = |mesh: &str, image: &str| {
        format!(
            "{CAMERA}[[mesh]]\nfile = '{mesh}'\nmaterial = \"m\"\n\
             [materials.m]\ntexture = '{image}'\n\
             [[light]]\ntype = \"environment\"\ntexture = '{image}'\n"
        )
    };
    let png = png(&QUARTERS);
    for (mesh, image) in [("M.obj", "A.png"), ("..\\x\\m.OBJ", "D:\\tex\\a.PNG")] {
        let text = toml(mesh, image);
        let files = [("s.toml", text.as_bytes()), ("m.obj", obj.as_bytes()), ("a.png", &png)];
        let scene = load_bytes(&files).unwrap();
        assert!(shows_an_image(&scene));
        let sky = scene.environment.as_ref().unwrap();
        assert!(sky.image.is_some());
        warned(&scene, "is not there; ", false);
    }
    // Escapes that TOML has not are named as the fault.
    let wrong = "[[mesh]]\nfile = \"meshes\\chair.obj\"\n";
    refused(load(&[("s.toml", wrong)]), "s.toml:2", "a backslash begins an escape");
}

#[test]
fn utf_16_and_padding_are_read() {
    let obj = "mtllib m.mtl\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nusemtl W\u{fc}rfel\r\nf 1 2 3\r\n";
    let mtl = "newmtl W\u{fc}rfel\r\nKd 0.25 0.5 0.75\r\n";
    let wide = |text: &str| {
        let units = std::iter::once(0xfeff).chain(text.encode_utf16());
        units.flat_map(u16::to_le_bytes).collect::<Vec<u8>>()
    };
    let latin = |text: &str| text.chars().map(|c| c as u8).collect::<Vec<u8>>();
    let padded = [obj.as_bytes(), b"\0\0\0\x1a"].concat();
    for (obj, mtl) in [
        (wide(obj), wide(mtl)),
        (wide(obj), mtl.as_bytes().to_vec()),
        (latin(obj), mtl.as_bytes().to_vec()),
        (padded, latin(mtl)),
    ] {
        let scene = load_bytes(&[("m.obj", &obj), ("m.mtl", &mtl)]).unwrap();
        assert_eq!(scene.materials[0].albedo, Vec3::new(0.25, 0.5, 0.75));
    }
    let utf32: Vec<u8> = "\u{feff}v".chars().flat_map(|c| (c as u32).to_le_bytes()).collect();
    refused(load_bytes(&[("m.obj", &utf32)]), "m.obj", "UTF-32; save it as UTF-8");
    let scene = wide(&format!(
        "{CAMERA}[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n[materials.m]\nemission = [1, 1, 1]\n"
    ));
    assert!(load_bytes(&[("s.toml", &scene)]).is_ok());
}
