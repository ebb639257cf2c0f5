//! Wavefront MTL.

use glam::{Vec2, Vec3};
use gpu_vpl::error::SceneError;
use gpu_vpl::scene::{Bsdf, Material, Scene};
use image::ImageFormat::Png;

use super::pictures::{self, QUARTERS, png};
use super::{load, load_bytes, refused, warned};

/// A triangle of the material `m` of this library.
fn with(mtl: &str) -> Result<Scene, SceneError> {
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
    load(&[("mesh.obj", obj), ("m.mtl", mtl)])
}

fn albedo(mtl: &str) -> [f32; 3] {
    with(&format!("newmtl m\n{mtl}")).unwrap().materials[0].albedo.to_array()
}

#[test]
fn colours_are_linear_and_ka_is_ignored() {
    assert_eq!(albedo("Kd 0.1 0.2 0.3\nKa 1 1 1\nmap_Ka a.png\n"), [0.1, 0.2, 0.3]);
    assert_eq!(albedo("\t kd 0.1 0.2 0.3 # comment\r\nillum 2\r\n"), [0.1, 0.2, 0.3]);
    assert_eq!(albedo("Kd 0.5\n"), [0.5; 3]);
    assert_eq!(albedo("Ke 1 1 1\n"), [0.0; 3]);
}

#[test]
fn a_material_without_colour_is_grey() {
    let scene = with("# nothing\nnewmtl m\nKa 1 1 1\n").unwrap();
    assert_eq!(scene.materials[0].albedo.to_array(), [0.8; 3]);
    warned(&scene, "m.mtl:2: material `m` has no Kd, 0.8", false);
}

#[test]
fn what_reflects_too_much_is_scaled() {
    let scene = with("newmtl m\nKd 0.9 0.6 0\nKs 0.6 0.6 0.6\nNs 7\n").unwrap();
    let [r, g, b] = scene.materials[0].albedo.to_array();
    assert!((r - 0.6).abs() < 1e-6 && (g - 0.4).abs() < 1e-6 && b == 0.0);
    warned(&scene, "m.mtl:1: material `m` reflects more", true);
}

/// The one material of a library, made of these statements.
fn material(mtl: &str) -> Material {
    with(&format!("newmtl m\n{mtl}")).unwrap().materials[0].clone()
}

#[test]
fn illum_d_ks_and_ns_tell_the_kind() {
    let phong =
        |specular: f32, shininess: f32| Bsdf::Phong { specular: Vec3::splat(specular), shininess };
    let mirror = |specular: f32| Bsdf::Mirror { specular: Vec3::splat(specular) };
    let glass = |ior: f32| Bsdf::Glass { specular: Vec3::ONE, ior };
    for (text, albedo, bsdf) in [
        ("Kd 0.5\nKs 0\nNs 50\nillum 2", 0.5, Bsdf::Diffuse),
        ("Kd 0.5\nKs 0.25\nNs 50", 0.5, phong(0.25, 50.0)),
        ("Kd 0.5\nKs 0.25\nNs 50\nillum 2", 0.5, phong(0.25, 50.0)),
        ("Kd 0\nKs 0.25", 0.0, phong(0.25, 0.0)),
        ("Kd 0\nKs 0.25\nNs 1e9", 0.0, phong(0.25, 1e6)),
        ("Kd 0\nKs 0.75\nillum 3", 0.0, mirror(0.75)),
        ("Ks 0.75\nKe 1\nillum 5", 0.0, mirror(0.75)),
        ("Kd 0\nKs 0.75\nillum 5\nNs 1000", 0.0, mirror(0.75)),
        ("Kd 0.125\nKs 0.75\nillum 3\nNs 999", 0.125, phong(0.75, 999.0)),
        ("Kd 0.5\nKs 0\nillum 3\nNs 2000", 0.5, Bsdf::Diffuse),
        ("Kd 0\nKs 1\nillum 7\nNi 1.25", 0.0, glass(1.25)),
        ("Kd 0.5\nillum 4", 0.5, Bsdf::Diffuse),
        ("Kd 0.5\nillum 6\nKs 0\nNi 1", 0.5, Bsdf::Diffuse),
        ("illum 9\nTf 0 0 0", 0.0, glass(1.5)),
        ("Kd 1\nd 0.75", 0.0, glass(1.5)),
        ("Kd 1\nTr 0.25", 0.0, glass(1.5)),
        ("Kd 0.5\nTr 1\nd 1", 0.5, Bsdf::Diffuse),
        ("Kd 0.5\nd -halo 1\nNi 1.5\nTf 1 1 1", 0.5, Bsdf::Diffuse),
    ] {
        let scene = with(&format!("newmtl m\n{text}\n")).unwrap();
        let Material { albedo: got, bsdf: got_bsdf, .. } = scene.materials[0];
        assert_eq!((got.to_array(), got_bsdf), ([albedo; 3], bsdf), "{text}");
        assert!(scene.warnings.iter().all(|w| !w.message.contains("m.mtl")), "{text}");
    }
    let tinted = Bsdf::Glass { specular: Vec3::new(0.5, 0.25, 1.0), ior: 1.5 };
    assert_eq!(material("illum 7\nTf 0.5 0.25 1\n").bsdf, tinted);
}

#[test]
fn what_reflects_too_much_keeps_its_colour() {
    let scaled = |text: &str, warning: &str| {
        let scene = with(&format!("newmtl m\n{text}\n")).unwrap();
        warned(&scene, &format!("m.mtl:1: material `m` {warning}"), true);
        scene.materials[0].bsdf
    };
    let half = Vec3::new(0.5, 1.0, 0.0);
    assert_eq!(
        scaled("Kd 0\nKs 1 2 0\nillum 3", "reflects more than it receives (Ks = 2.0000)"),
        Bsdf::Mirror { specular: half }
    );
    assert_eq!(
        scaled("illum 7\nTf 1 2 0", "reflects more than it receives (Tf = 2.0000)"),
        Bsdf::Glass { specular: half, ior: 1.5 }
    );
    assert_eq!(
        scaled("Kd 1\nKs 0.5 1 0\nNs 7", "reflects more than it receives (Kd + Ks = 2.0000)"),
        Bsdf::Phong { specular: 0.5 * half, shininess: 7.0 }
    );
    let impossible = scaled("illum 7\nNi 0", "has an impossible Ni of 0, 1.5 is used");
    assert_eq!(impossible, Bsdf::Glass { specular: Vec3::ONE, ior: 1.5 });
}

#[test]
fn maps_that_are_not_shown_are_named_once() {
    for (text, what) in [
        ("map_Ks a.png\nmap_Bump -bm 2 a.png\nnorm a.png", "map_Ks, map_Bump, norm"),
        ("bump -bm 2 a.png", "bump"),
        ("disp a.png", "disp"),
    ] {
        let scene = with(&format!("\nnewmtl m\nKd 0.5 0.5 0.5\n{text}\n")).unwrap();
        warned(&scene, &format!("m.mtl:2: material `m` has {what}, not shown"), true);
        let of_mtl = scene.warnings.iter().filter(|warning| warning.message.contains("m.mtl"));
        assert_eq!(of_mtl.count(), 1, "{text}");
    }
}

#[test]
fn faults_are_refused_with_their_line() {
    refused(with("newmtl m\n\nKd 1 x 1\n"), "m.mtl:3", "Kd is followed by no number");
    refused(with("newmtl m\nKd 1 1\n"), "m.mtl:2", "three numbers");
    refused(with("newmtl m\nKd\n"), "m.mtl:2", "three numbers");
    refused(with("newmtl m\nNs nan\n"), "m.mtl:2", "no number");
    refused(with("newmtl m\nillum\n"), "m.mtl:2", "no number");
    refused(with("newmtl m\nKd spectral a.rfl\n"), "m.mtl:2", "not supported");
    refused(with("Kd 1 1 1\nnewmtl m\n"), "m.mtl:1", "before any newmtl");
    refused(with("newmtl a\nnewmtl m\nKd -1 0 0\n"), "m.mtl:2", "material `m`: albedo");
    refused(with("newmtl m\nKd 0\nKs -1 0 0\n"), "m.mtl:1", "material `m`: specular");
    refused(with("newmtl m\nKe -1 0 0\n"), "m.mtl:1", "material `m`: emission");
}

#[test]
fn of_two_materials_of_one_name_the_first_counts() {
    assert_eq!(albedo("Kd 0.1 0.1 0.1\nnewmtl m\nKd 0.2 0.2 0.2\n"), [0.1; 3]);
}

/// Loads a material of these statements, from line 2 on, beside [`QUARTERS`] as images of
/// several names and a grey one without alpha.
fn mapped(mtl: &str) -> Scene {
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n\
        usemtl m\nf 1/1 2/2 3/3\n";
    let mtl = format!("newmtl m\n{mtl}\n");
    let color = png(&QUARTERS);
    let grey = pictures::rgb(Png, 2, &[[0, 0, 0], [255, 255, 255]]);
    load_bytes(&[
        ("mesh.obj", obj.as_bytes()),
        ("m.mtl", mtl.as_bytes()),
        ("a.png", &color),
        ("the wood #2.png", &color),
        ("grey.png", &grey),
        ("plain.png", &pictures::rgb(Png, 2, &QUARTERS.map(|[r, g, b, _]| [r, g, b]))),
    ])
    .unwrap()
}

/// What the texture of the albedo shows at a place from the bottom left.
fn shown(mtl: &str, u: f32, v: f32) -> [f32; 3] {
    let scene = mapped(mtl);
    let told = |message: &str| message.contains("m.mtl") && !message.contains("with alpha");
    assert!(scene.warnings.iter().all(|w| !told(&w.message)), "{:?}", scene.warnings);
    let texture = scene.textures[scene.materials[0].texture.unwrap() as usize];
    texture.sample(&scene.images, Vec2::new(u, 1.0 - v)).truncate().to_array()
}

const RED: [f32; 3] = [1.0, 0.0, 0.0];
const GREEN: [f32; 3] = [0.0, 1.0, 0.0];
const BLUE: [f32; 3] = [0.0, 0.0, 1.0];

#[test]
fn textures_lie_with_their_first_row_on_top() {
    assert_eq!(shown("map_Kd a.png", 0.25, 0.75), RED);
    assert_eq!(shown("map_Kd a.png", 0.75, 0.75), GREEN);
    assert_eq!(shown("map_Kd a.png", 0.25, 0.25), BLUE);
    let scene = mapped("map_Kd a.png");
    assert_eq!(scene.uvs, [[Vec2::Y, Vec2::ONE, Vec2::ZERO]]);
}

#[test]
fn options_move_scale_and_clamp_a_texture() {
    assert_eq!(shown("map_Kd -o 0.5 a.png", 0.25, 0.75), GREEN);
    assert_eq!(shown("map_Kd -o 0 0.5 a.png", 0.25, 0.25), RED);
    assert_eq!(shown("map_Kd -o 0.5 0.5 0 a.png", 0.75, 0.25), RED);
    assert_eq!(shown("map_Kd -s 2 a.png", 0.375, 0.75), GREEN);
    assert_eq!(shown("map_Kd -s 1 3 a.png", 0.25, 0.25), RED);
    assert_eq!(shown("map_Kd -s 1 1.5 a.png", 0.25, 0.5), RED);
    assert_eq!(shown("map_Kd -s 1 3 1 -o 0 0.5 a.png", 0.25, 0.25), BLUE);
    assert_eq!(shown("map_Kd -clamp off a.png", 1.25, 0.75), RED);
    assert_eq!(shown("map_Kd -clamp on a.png", 1.25, 1.75), GREEN);
    assert_eq!(shown("map_Kd -clamp on a.png", -7.0, -7.0), BLUE);
    // Nothing that is shown.
    for option in [
        "-blendu on",
        "-blendv off",
        "-texres 512",
        "-bm 2",
        "-cc off",
        "-mm 0 1",
        "-colorspace sRGB",
    ] {
        assert_eq!(shown(&format!("map_Kd {option} a.png"), 0.25, 0.75), RED, "{option}");
    }
    assert_eq!(shown("map_Kd -BLENDU on -s 1 1 1 -t 0 0 0 -boost 0 a.png", 0.25, 0.75), RED);
}

#[test]
fn options_that_are_not_supported_are_warned_of_with_their_line() {
    for option in [
        "-mm 0.5 1",
        "-mm 0 2",
        "-cc on",
        "-boost 2",
        "-t 0.5",
        "-imfchan r",
        "-type sphere",
        "-colorspace linear",
    ] {
        let scene = mapped(&format!("\nmap_Kd {option} a.png"));
        let name = option.split(' ').next().unwrap();
        warned(&scene, &format!("m.mtl:3: map_Kd has {name}, not supported"), true);
        assert_eq!(scene.images[0].size, [2, 2]);
    }
    let scene = mapped("map_Kd -cc on -boost 2 a.png");
    warned(&scene, "m.mtl:2: map_Kd has -cc, -boost, not supported", true);
    for bad in ["-o a.png", "-s x a.png", "-mm a.png", "-bm nan a.png", "-o 1e999 a.png"] {
        let text = format!("newmtl m\nKd 1\nmap_Kd {bad}\n");
        refused(with(&text), "m.mtl:3", "without a number");
    }
}

#[test]
fn file_names_may_hold_blanks_backslashes_and_numbers() {
    assert_eq!(shown("map_Kd   the wood #2.png  ", 0.25, 0.75), RED);
    assert_eq!(shown("map_Kd .\\.\\a.png", 0.25, 0.75), RED);
    assert_eq!(shown("map_Kd -o 0 0 a.png # the wood", 0.25, 0.75), RED);
    // A name of a number is the file's all the same.
    let scene = mapped("map_Kd -o 0.5 2");
    warned(&scene, "m.mtl:2: image 2 is not there", true);
    assert!(mapped("map_Kd").textures.is_empty());
    let scene = mapped("Kd 1 1 1\nmap_Kd textures\\gone.png\nmap_Ke textures/gone.png");
    warned(&scene, "m.mtl:3: image textures/gone.png is not there", true);
    assert_eq!(scene.images[0].rgba, [[255, 0, 255, 255]]);
    assert_eq!(scene.warnings.len(), 1, "{:?}", scene.warnings);
}

#[test]
fn a_map_multiplies_its_colour_and_replaces_black() {
    let of = |text: &str| mapped(text).materials[0].clone();
    assert_eq!(of("Kd 0.5 0.25 1\nmap_Kd a.png").albedo.to_array(), [0.5, 0.25, 1.0]);
    assert_eq!(of("map_Kd a.png").albedo, Vec3::ONE);
    let scene = mapped("Kd 0 0 0\nmap_Kd a.png");
    assert_eq!(scene.materials[0].albedo, Vec3::ONE);
    warned(&scene, "m.mtl:1: material `m` has a map_Kd over a Kd of 0, read as 1", false);
    // Its alpha is not opacity.
    assert_eq!(of("map_Kd a.png").cutout, None);

    let lamp = of("map_Ke a.png");
    assert_eq!(
        (lamp.emission, lamp.emission_texture, lamp.albedo),
        (Vec3::ONE, Some(0), Vec3::ZERO)
    );
    assert_eq!(of("Ke 2 3 4\nmap_Ke a.png").emission.to_array(), [2.0, 3.0, 4.0]);
    let scene = mapped("Ke 0 0 0\nmap_Ke a.png");
    assert_eq!(scene.materials[0].emission, Vec3::ONE);
    warned(&scene, "has a map_Ke over a Ke of 0, read as 1", false);
    // A mirror has one colour.
    let scene = mapped("Ks 1\nillum 3\nNs 2000\nmap_Kd a.png");
    assert_eq!(scene.materials[0].texture, None);
    warned(&scene, "has a map_Kd, not shown by mirrors", true);
    let kind = of("Kd 0\nKs 0.25\nillum 3\nNs 20\nmap_Kd a.png").bsdf;
    assert!(matches!(kind, Bsdf::Phong { .. }), "{kind:?}");
}

#[test]
fn map_d_cuts_out_by_alpha_or_luminance() {
    let alpha = |text: &str| {
        let scene = mapped(text);
        let texture = scene.textures[scene.materials[0].cutout.unwrap() as usize];
        let image = scene.images[texture.image as usize].clone();
        (image.rgba.iter().map(|texel| texel[3]).collect::<Vec<_>>(), scene)
    };
    let (own, scene) = alpha("Kd 1\nd 0.5\nmap_Kd a.png\nmap_d a.png");
    assert_eq!((own, scene.images.len()), (vec![255, 200, 100, 0], 1));
    assert_eq!(scene.materials[0].bsdf, Bsdf::Diffuse);
    assert_eq!(alpha("Kd 1\nmap_d -imfchan m a.png").0, [255, 200, 100, 0]);
    let (grey, scene) = alpha("Kd 1\nmap_d grey.png\nmap_Kd grey.png");
    assert_eq!((grey, scene.images.len()), (vec![0, 255], 2));
    assert_eq!(scene.images[scene.textures[0].image as usize].rgba[0][3], 255);
    // The luminance of red, green and blue (Rec. 709).
    assert_eq!(alpha("Kd 1\nmap_d plain.png").0, [54, 182, 18, 188]);
    let (opaque, scene) = alpha("Kd 1\nmap_d gone.png");
    assert_eq!(opaque, [255]);
    warned(
        &scene,
        "m.mtl:3: image gone.png is not there, or no file; put it there; nothing is cut out",
        true,
    );
}
