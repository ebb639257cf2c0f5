//! When a material of MTL is glass, and what its `Ks` means.

use glam::Vec3;
use gpu_vpl::scene::{Bsdf, Material, Scene};

use super::super::{load, warned};
use super::{case, material};

/// A cube of the material `m` of this library.
fn with(mtl: &str) -> Scene {
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
    load(&[("mesh.obj", obj), ("m.mtl", mtl)]).unwrap()
}

fn of(mtl: &str) -> Material {
    with(mtl).materials[0].clone()
}

fn same_paint(name: &str, reference: &str) {
    let (got, right) = (case(name), case(reference));
    let (got, right) = (material(&got, "paint"), material(&right, "paint"));
    assert_eq!((got.albedo, got.bsdf), (right.albedo, right.bsdf), "{name}");
}

#[test]
fn illum_4_of_maya_is_paint() {
    same_paint("illum4_maya/maya_illum4/s.toml", "illum4_maya/ref/s.toml");
    let textured = case("illum4_maya/maya_illum4_tex/s.toml");
    let paint = material(&textured, "paint");
    assert_eq!((paint.albedo, paint.bsdf), (Vec3::ONE, Bsdf::Diffuse));
    assert!(paint.texture.is_some());
    warned(&textured, "has a Ks without an Ns above 0", true);
}

#[test]
fn what_is_clear_but_has_a_colour_is_opaque() {
    for name in ["tr1", "d0"] {
        let scene = case(&format!("tr1_meshlab/{name}/s.toml"));
        let paint = material(&scene, "paint");
        assert_eq!(paint.bsdf, Bsdf::Diffuse, "{name}");
        assert_eq!(paint.texture.is_some(), name == "tr1");
        warned(&scene, "is clear by its d or Tr, but has a colour", false);
    }
    let d0 = case("tr1_meshlab/d0/s.toml");
    assert_eq!(material(&d0, "paint").albedo, Vec3::new(0.1, 0.5, 0.9));
}

#[test]
fn illum_1_has_no_highlight() {
    same_paint("ks_illum1/illum1_ks/s.toml", "ks_illum1/illum1_noks/s.toml");
    warned(&case("ks_illum1/illum1_ks/s.toml"), "has a Ks, of which its illum of 0 or 1", false);
}

#[test]
fn blenders_slider_of_one_half_is_4_percent() {
    for name in ["s", "env", "lamp"] {
        let scene = case(&format!("ks_illum1/blender_default/{name}.toml"));
        let Bsdf::Phong { specular, shininess } = material(&scene, "paint").bsdf else {
            unreachable!("{:?}", material(&scene, "paint"));
        };
        assert!((specular - 0.04).abs().max_element() < 1e-6 && shininess == 250.0);
        warned(&scene, "Blender's Ks of 0.5, which means 4.0 %", false);
    }
    let said = "# Blender 3.6.0 MTL File: 'a.blend'\nnewmtl m\nNs 96\nKd 0.5\nKs 0.25\nillum 2\n";
    assert!(matches!(of(said).bsdf, Bsdf::Phong { specular, .. } if specular.x == 0.02));
    // Others mean what they write, and so does Blender of metal and of colours.
    let as_it_stands = |mtl: &str, ks: f32| {
        let bsdf = of(mtl).bsdf;
        assert!(
            matches!(bsdf, Bsdf::Phong { specular, .. } if specular.x == ks),
            "{mtl}: {bsdf:?}"
        );
    };
    as_it_stands("newmtl m\nNs 96\nKd 0.5\nKs 0.5\nillum 2\n", 0.5);
    as_it_stands("# Blender\nnewmtl m\nNs 96\nKa 1\nKd 0.5\nKs 0.5\nillum 3\n", 0.5);
    as_it_stands("# Blender\nnewmtl m\nNs 96\nKd 0.5\nKs 0.5 0.25 0.25\nillum 2\n", 0.5);
}

/// What programs write for paint that is opaque.
#[test]
fn paints_of_many_programs_are_opaque() {
    for (who, mtl) in [
        ("Maya, lambert", "illum 4\nKd 0.5 0.5 0.5\nKa 0 0 0\nTf 1.00 1.00 1.00\nNi 1.00"),
        ("Maya, black", "illum 4\nKd 0.00 0.00 0.00\nKa 0 0 0\nTf 1.00 1.00 1.00\nNi 1.00"),
        ("3ds Max", "Ns 10\nNi 1.5\nd 1\nTr 0\nTf 1 1 1\nillum 2\nKa 0.5\nKd 0.5\nKs 0\nKe 0"),
        ("3ds Max, old", "Ns 10\nd 1\nTr 1\nTf 1 1 1\nillum 2\nKd 0.5\nKs 0"),
        ("Rhino", "Ka 0 0 0\nKd 0.5\nKs 0 0 0\nTf 0 0 0\nd 1\nNs 0"),
        ("DAZ Studio", "illum 4\nKd 0.5\nKs 0.1 0.1 0.1\nKa 0 0 0\nTf 0 0 0\nNs 0\nd 1"),
        ("Cinema 4D", "Kd 0.5\nKs 0\nillum 7\nNi 1.5"),
        ("OpenMVS", "Ka 0 0 0\nKd 1 1 1\nKs 0 0 0\nTr 1.000000\nillum 1\nNs 1.000000"),
        ("RealityCapture", "Kd 1 1 1\nTr 1\nillum 2"),
        ("Wings", "Ns 100\nd 1\nillum 2\nKd 0.5\nKa 0.5\nKs 0 0 0\nKe 0 0 0"),
        ("rounded", "Kd 0.5\nd 0.999999\nillum 2"),
        ("both of 0", "Kd 0.5\nd 0\nTr 0"),
        ("the coloured, wrongly clear", "illum 7\nKd 0.9 0.1 0.1\nNi 1.5\nd 0"),
    ] {
        let material = of(&format!("newmtl m\n{mtl}\n"));
        assert_eq!(material.bsdf, Bsdf::Diffuse, "{who}");
    }
}

/// What programs write for glass.
#[test]
fn glasses_of_many_programs_are_glass() {
    let tint = |mtl: &str| match of(&format!("newmtl m\n{mtl}\n")).bsdf {
        Bsdf::Glass { specular, ior } => (specular, ior),
        other => unreachable!("{mtl}: {other:?}"),
    };
    for (who, mtl, expected, ior) in [
        ("SketchUp", "Ka 0 0 0\nKd 0.2 0.6 1\nKs 0.33\nd 0.5", [0.6, 0.8, 1.0], 1.5),
        ("3ds Max", "Ns 10\nNi 1.5\nd 0.25\nTr 0.75\nTf 1 1 1\nillum 2\nKd 1", [1.0; 3], 1.5),
        ("Blender", "Ns 250\nKa 1\nKd 0.2\nKs 0.5\nNi 1.45\nd 0.5\nillum 9", [0.6; 3], 1.45),
        ("black and clear", "Kd 0 0 0\nKs 1\nd 0\nillum 7\nNi 1.33", [1.0; 3], 1.33),
        ("grey, clear thrice", "Kd 1 1 1\nd 0\nillum 7\nNi 1.5", [1.0; 3], 1.5),
        ("the format's filter", "Kd 0 0 0\nTf 0.5 0.25 1\nillum 6\nNi 1.5", [0.5, 0.25, 1.0], 1.5),
        ("Maya, half clear", "illum 4\nKd 0.5\nTf 0.5 0.5 0.5\nNi 1", [0.5; 3], 1.0),
        ("without a colour", "d 0.5", [1.0; 3], 1.5),
    ] {
        let (got, got_ior) = tint(mtl);
        let close = (got - Vec3::from_array(expected)).abs().max_element() < 1e-6;
        assert!(close && (got_ior - ior).abs() < 1e-6, "{who}: {got} {got_ior}");
    }
}

#[test]
fn colours_that_glass_and_mirrors_do_not_show_are_named() {
    let named = |mtl: &str, what: &str, changes: bool| {
        warned(&with(&format!("newmtl m\n{mtl}\n")), what, changes);
    };
    named(
        "illum 4\nKd 0.5\nTf 0.5 0.5 0.5",
        "has a Kd or map_Kd, not shown by a glass of a Tf",
        true,
    );
    named("Kd 1\nd 0\nillum 7\nNi 1.5", "has a Kd, not shown by clear glass", false);
    named("Kd 0.1 0 0\nKs 0.9\nNs 1000\nillum 3", "has a Kd, not shown by mirrors", true);
    named("Kd 0.5\nTf 0.5 0 0\nillum 2", "has a Tf, not shown by what is opaque", true);
    named("Kd 0.5\nmap_Kd gone.png\nd 0.5", "of which the mean is used", true);
    named("Kd 0.5\nd 0\nTr 0", "has a d of 0 beside a Tr of 0, read as opaque", false);
    named("Kd 0.5\nd 0.5\nmap_d gone.png", "has a map_d over an opacity of 0.5, read as 1", false);
}
