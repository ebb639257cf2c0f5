//! Wavefront MTL.

use glam::Vec3;
use gpu_vpl::error::SceneError;
use gpu_vpl::scene::{Finish, Material, Scene};

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

/// The one material of a library, made of these statements.
fn material(mtl: &str) -> Material {
    with(&format!("newmtl m\n{mtl}")).unwrap().materials[0].clone()
}

#[test]
fn illum_d_ks_and_ns_tell_the_kind() {
    let phong = |specular: f32, shininess: f32| Finish::Phong {
        specular: Vec3::splat(specular),
        shininess,
    };
    let mirror = |specular: f32| Finish::Mirror { specular: Vec3::splat(specular) };
    let glass = |ior: f32| Finish::Glass { specular: Vec3::ONE, ior };
    for (text, albedo, finish) in [
        ("Kd 0.5\nKs 0\nNs 50\nillum 2", 0.5, Finish::Diffuse),
        ("Kd 0.5\nKs 0.25\nNs 50", 0.5, phong(0.25, 50.0)),
        ("Kd 0.5\nKs 0.25\nNs 50\nillum 2", 0.5, phong(0.25, 50.0)),
        ("Kd 0.5\nKs 0.25", 0.5, phong(0.25, 0.0)),
        ("Kd 0\nKs 0.25\nNs 1e9", 0.0, phong(0.25, 1e6)),
        ("Kd 0\nKs 0.75\nillum 3", 0.0, mirror(0.75)),
        ("Ks 0.75\nKe 1\nillum 5", 0.0, mirror(0.75)),
        ("Kd 0.125\nKs 0.75\nillum 5\nNs 1000", 0.0, mirror(0.75)),
        ("Kd 0.125\nKs 0.75\nillum 3\nNs 999", 0.125, phong(0.75, 999.0)),
        ("Kd 0.5\nKs 0\nillum 3\nNs 2000", 0.5, Finish::Diffuse),
        ("Kd 0\nKs 1\nillum 7\nNi 1.25", 0.0, glass(1.25)),
        ("Kd 0.5\nillum 4", 0.0, glass(1.5)),
        ("Kd 0.5\nillum 6\nKs 0\nNi 1", 0.0, glass(1.0)),
        ("illum 9\nTf 0 0 0", 0.0, glass(1.5)),
        ("Kd 0.5\nd 0.75", 0.0, glass(1.5)),
        ("Kd 0.5\nTr 0.25", 0.0, glass(1.5)),
        ("Kd 0.5\nTr 1\nd 1", 0.5, Finish::Diffuse),
        ("Kd 0.5\nd -halo 1\nNi 1.5\nTf 1 1 1", 0.5, Finish::Diffuse),
    ] {
        let scene = with(&format!("newmtl m\n{text}\n")).unwrap();
        let Material { albedo: got, finish: got_finish, .. } = scene.materials[0];
        assert_eq!((got.to_array(), got_finish), ([albedo; 3], finish), "{text}");
        assert!(scene.warnings.iter().all(|w| !w.message.contains("m.mtl")), "{text}");
    }
    let tinted = Finish::Glass { specular: Vec3::new(0.5, 0.25, 1.0), ior: 1.5 };
    assert_eq!(material("illum 7\nTf 0.5 0.25 1\n").finish, tinted);
}

#[test]
fn what_reflects_too_much_keeps_its_colour() {
    let scaled = |text: &str, warning: &str| {
        let scene = with(&format!("newmtl m\n{text}\n")).unwrap();
        warned(&scene, &format!("m.mtl:1: material `m` {warning}"), true);
        scene.materials[0].finish
    };
    let half = Vec3::new(0.5, 1.0, 0.0);
    assert_eq!(
        scaled("Kd 0\nKs 1 2 0\nillum 3", "reflects more than it receives (Ks = 2.0000)"),
        Finish::Mirror { specular: half }
    );
    assert_eq!(
        scaled("illum 7\nTf 1 2 0", "reflects more than it receives (Tf = 2.0000)"),
        Finish::Glass { specular: half, ior: 1.5 }
    );
    assert_eq!(
        scaled("Kd 1\nKs 0.5 1 0\nNs 7", "reflects more than it receives (Kd + Ks = 2.0000)"),
        Finish::Phong { specular: 0.5 * half, shininess: 7.0 }
    );
    let impossible = scaled("illum 7\nNi 0", "has an impossible Ni of 0, 1.5 is used");
    assert_eq!(impossible, Finish::Glass { specular: Vec3::ONE, ior: 1.5 });
}

#[test]
fn maps_that_are_not_shown_are_named_once() {
    for (text, what) in [
        ("map_Ks a.png\nmap_Bump -bm 2 a.png\nnorm a.png", "map_Ks, map_Bump, norm"),
        ("bump -bm 2 a.png", "bump"),
        ("disp a.png", "disp"),
    ] {
        let scene = with(&format!("\nnewmtl m\nKd 0.5 0.5 0.5\n{text}\n")).unwrap();
        warned(&scene, &format!("m.mtl:2: material `m` has {what}, which are not shown"), true);
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
