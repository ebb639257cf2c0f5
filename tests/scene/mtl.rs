//! Wavefront MTL.

use gpu_vpl::error::SceneError;
use gpu_vpl::scene::Scene;

use super::{load, refused, warned};

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
    let scene = with("newmtl m\nKd 0.9 0.6 0\nKs 0.6 0.6 0.6\n").unwrap();
    let [r, g, b] = scene.materials[0].albedo.to_array();
    assert!((r - 0.6).abs() < 1e-6 && (g - 0.4).abs() < 1e-6 && b == 0.0);
    warned(&scene, "m.mtl:1: material `m` reflects more", true);
}

#[test]
fn what_is_not_rendered_yet_is_named_once() {
    let cases = [
        ("Kd 0.5 0.5 0.5\nKs 0.2 0.2 0.2\nNs 50", "a Phong highlight"),
        ("Kd 0 0 0\nKs 0.9 0.9 0.9\nillum 3", "a mirror"),
        ("Kd 0.1 0.1 0.1\nKs 0.9 0.9 0.9\nillum 5\nNs 1000", "a mirror"),
        ("Kd 0.1 0.1 0.1\nKs 0.8 0.8 0.8\nillum 3\nNs 10", "a Phong highlight"),
        ("Kd 0 0 0\nKs 1 1 1\nillum 7\nNi 1.5", "glass"),
        ("Kd 0.5 0.5 0.5\nd 0.5", "glass"),
        ("Kd 0.5 0.5 0.5\nTr 0.5", "glass"),
        ("Kd 0.5 0.5 0.5\nd 0.5\nmap_d a.png\nmap_Kd b.png", "map_d, map_Kd"),
        ("Kd 0.5 0.5 0.5\nbump -bm 2 a.png", "bump"),
    ];
    for (text, what) in cases {
        let scene = with(&format!("\nnewmtl m\n{text}\n")).unwrap();
        warned(&scene, &format!("m.mtl:2: material `m` has {what}, not supported yet"), true);
        let of_mtl = scene.warnings.iter().filter(|warning| warning.message.contains("m.mtl"));
        assert_eq!(of_mtl.count(), 1, "{text}");
    }
    for plain in ["Ks 0 0 0\nillum 2", "Tr 1\nd 1", "d -halo 1", "Ni 1.5\nTf 1 1 1"] {
        let scene = with(&format!("newmtl m\nKd 1 1 1\n{plain}\n")).unwrap();
        assert!(scene.warnings.iter().all(|w| !w.message.contains("m.mtl")), "{plain}");
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
    refused(with("newmtl m\nKe -1 0 0\n"), "m.mtl:1", "material `m`: emission");
}

#[test]
fn of_two_materials_of_one_name_the_first_counts() {
    assert_eq!(albedo("Kd 0.1 0.1 0.1\nnewmtl m\nKd 0.2 0.2 0.2\n"), [0.1; 3]);
}
