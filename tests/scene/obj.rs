//! Wavefront OBJ.

use glam::{Vec2, Vec3};
use gpu_vpl::scene::Scene;

use super::{MESH, load, load_obj, refused, warned};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn area(scene: &Scene) -> f64 {
    let area: f64 = scene.triangles.iter().map(|triangle| f64::from(triangle.area())).sum();
    area * scene.units.scale.powi(2)
}

#[test]
fn a_bare_mesh_is_framed_and_lit() {
    let scene = load_obj(&format!("{SQUARE}f 1 2 3 4\n")).unwrap();
    assert_eq!(scene.triangles.len(), 2);
    warned(&scene, "no light", false);
    warned(&scene, "without a material", false);
    // The corners lie within the angle of view, from three quarters above.
    let distance = scene.camera.position.length();
    let half = scene.camera.half_tangents()[1] * distance;
    let diagonal = scene.triangles[0].vertices[0].length();
    assert!(half > diagonal && half < 1.5 * diagonal, "{half} {diagonal}");
    let Vec3 { x, y, z } = scene.camera.position / distance;
    assert!((y - 0.5).abs() < 1e-6 && x > 0.4 && z > 0.7, "{}", scene.camera.position);
    // What is nearest receives irradiance π.
    let light = scene.point_lights[0];
    assert_eq!(light.position, scene.camera.position);
    let nearest = light.position.distance(Vec3::new(1.0, 1.0, 0.0));
    assert!((light.intensity.x / (nearest * nearest) - std::f32::consts::PI).abs() < 1e-3);
}

#[test]
fn a_bare_mesh_that_emits_lights_itself() {
    let scene = load_obj(MESH).unwrap();
    assert!(scene.point_lights.is_empty() && scene.warnings.is_empty());
}

#[test]
fn indices_count_from_either_end() {
    for faces in ["f 1 2 3 4", "f -4 -3 -2 -1", "f 1/1/1 2//1 3/1 -1", "f 1 2 \\\n3 4"] {
        let scene = load_obj(&format!("vt 0 0\nvn 0 0 1\n{SQUARE}{faces} # a square\n")).unwrap();
        assert!((area(&scene) - 1.0).abs() < 1e-6, "{faces}");
    }
    // Faces may come before their vertices.
    assert_eq!(load_obj(&format!("f 1 2 3\n{SQUARE}")).unwrap().triangles.len(), 1);
}

#[test]
fn faults_are_refused_with_their_line() {
    let face = |text: &str| load_obj(&format!("{SQUARE}\n{text}\n"));
    refused(face("f 1 2 5"), "mesh.obj:6", "vertex 5");
    refused(face("f 1 2 -5"), "mesh.obj:6", "vertex -5");
    refused(face("f 0 1 2"), "mesh.obj:6", "vertex 0");
    refused(face("f 1 2 x"), "mesh.obj:6", "`x`");
    refused(face("f 1 2 3/1/1/1"), "mesh.obj:6", "v/vt/vn");
    refused(face("f 1 2 99999999999999999999"), "mesh.obj:6", "does not begin");
    refused(face("f 1 2 -9223372036854775808"), "mesh.obj:6", "so far");
    refused(face("v 1 2"), "mesh.obj:6", "vertex of 2 numbers");
    refused(face("v 1 2 3 4 5"), "mesh.obj:6", "vertex of 5 numbers");
    refused(face("v 1 nan 3"), "mesh.obj:6", "`nan` is not a finite number");
    refused(face("v 1 1e999 3"), "mesh.obj:6", "`1e999`");
    refused(face("v 1 1.#INF 3"), "mesh.obj:6", "`1.#INF`");
    refused(face("v 1 1 1 0"), "mesh.obj:6", "weight 0");
    refused(face("v 1 \\\n1 \\\n1e999"), "mesh.obj:6", "`1e999`");
}

#[test]
fn nothing_to_render_is_refused() {
    refused(load_obj(""), "mesh.obj", "no face of three corners");
    let empty = format!("{SQUARE}l 1 2\np 3\nf 1 2\n");
    refused(load_obj(&empty), "mesh.obj:5", "no face of three corners");
    refused(load_obj(&format!("{SQUARE}f 1 2 2\n")), "mesh.obj", "nothing to render");
    refused(load_obj("v 1e200 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"), "mesh.obj", "1e100");
}

#[test]
fn points_and_lines_are_left_out_with_a_warning() {
    let scene = load_obj(&format!("{SQUARE}f 1 2 3\nl 1 2 3\nf 1\n")).unwrap();
    assert_eq!(scene.triangles.len(), 1);
    warned(&scene, "mesh.obj:6: 2 points, lines", false);
    let scene = load_obj(&format!("{SQUARE}f 1 2 3\nsurf 0 1 0 1 1 2 3 4\n")).unwrap();
    warned(&scene, "mesh.obj:6: 1 free-form", true);
}

#[test]
fn weights_divide_and_colours_are_left_out() {
    let scene = load_obj("v 0 0 0 1\nv 1 0 0 0.5\nv 0 1 0 1 0 0\nf 1 2 3\n").unwrap();
    assert!((area(&scene) - 1.0).abs() < 1e-6);
    warned(&scene, "mesh.obj:2: 1 vertices have a weight", false);
}

#[test]
fn concave_polygons_keep_their_area() {
    let text = "v 0 0 1\nv 3 0 1\nv 3 1 1\nv 1 1 1\nv 1 3 1\nv 0 3 1\nf 4 5 6 1 2 3\n";
    assert!((area(&load_obj(text).unwrap()) - 5.0).abs() < 1e-5);
    let star = "v 0 3 0\nv 2 -2 0\nv -3 1 0\nv 3 1 0\nv -2 -2 0\nf 1 2 3 4 5\n";
    warned(&load_obj(star).unwrap(), "cross themselves", true);
}

#[test]
fn materials_that_are_not_there_are_grey_with_a_warning() {
    let alone = format!("mtllib gone.mtl\n{SQUARE}usemtl red car\nf 1 2 3\n");
    let scene = load(&[("mesh.obj", &alone)]).unwrap();
    assert_eq!(scene.materials[0].albedo.to_array(), [0.8; 3]);
    warned(&scene, "mesh.obj:6: no material `red car`", true);
    warned(&scene, "mesh.obj:1: no material library `gone.mtl`", false);
    // A missing library that nothing misses changes nothing.
    let scene = load_obj(&format!("mtllib gone.mtl\n{MESH}")).unwrap();
    warned(&scene, "no library `gone.mtl` here; mesh.mtl is read", false);
}

#[test]
fn libraries_may_be_many_and_names_may_hold_blanks() {
    let mtl = "newmtl my green\nKd 0 1 0\n";
    let obj = |library: &str| format!("mtllib {library}\r\n{SQUARE}usemtl  my green \nf 1 2 3\n");
    for library in ["the lib.mtl", "other.mtl the\\ lib.mtl", "gone.mtl  the\\ lib.mtl"] {
        let files = [("mesh.obj", &*obj(library)), ("the lib.mtl", mtl), ("other.mtl", "")];
        let scene = load(&files).unwrap();
        assert_eq!(scene.materials[0].albedo.to_array(), [0.0, 1.0, 0.0], "{library}");
    }
}

#[test]
fn all_ends_of_line_and_a_byte_order_mark_are_read() {
    for text in [MESH.replace('\n', "\r\n"), MESH.replace('\n', "\r"), format!("\u{feff}{MESH}")] {
        assert_eq!(load_obj(&text).unwrap().emitters().count(), 1);
    }
}

/// A square with texture coordinates, a triangle of which emits so that no light lacks.
const PLACED: &str = "mtllib mesh.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n\
    vt 0 0\nvt 0.5 0 0.9\nvt 0.5 0.25\nvt 0 0.25\nusemtl wood\n";

fn uvs(faces: &str, more: &str) -> Vec<[Vec2; 3]> {
    let scene = load(&[
        ("scene.toml", &format!("{}{POINT}[[mesh]]\nfile = \"mesh.obj\"\n{more}", super::CAMERA)),
        ("mesh.obj", &format!("{PLACED}{faces}\n")),
        ("mesh.mtl", "newmtl wood\nmap_Kd gone.png\n"),
    ]);
    scene.unwrap().uvs
}

const POINT: &str = "[[light]]\ntype = \"point\"\nposition = [0, 0, 1]\nintensity = [1, 1, 1]\n";

#[test]
fn texture_coordinates_follow_their_corners_from_the_top_left() {
    let [a, b, c, d] = [(0.0, 1.0), (0.5, 1.0), (0.5, 0.75), (0.0, 0.75)].map(Vec2::from);
    let square = [[a, b, c], [a, c, d]];
    for faces in ["f 1/1 2/2 3/3 4/4", "f 1/-4 2/-3/7 3/3/-1 -1/-1", "o x\nf 1/1/ 2/2 3/3 4/4"] {
        assert_eq!(uvs(faces, ""), square, "{faces}");
    }
    // Corners without are 0, and do not shift the others.
    let faces = "f 1 2//1 3\nf 1/1 3/3 4\nusemtl wood\nf 1/4 2/3 4/2";
    assert_eq!(uvs(faces, ""), [[Vec2::ZERO; 3], [a, c, Vec2::ZERO], [d, c, b]]);
    // A mirror swaps corners and coordinates alike.
    assert_eq!(uvs("f 1/1 2/2 3/3 4/4", "scale = [-1, 1, 1]\n"), [[a, c, b], [a, d, c]]);
    assert_eq!(uvs("f 1/1 2/2 3/3 4/4", "scale = [-1, -1, 1]\n"), square);
}

#[test]
fn texture_coordinates_that_are_not_there_are_refused() {
    let face = |text: &str| load_obj(&format!("{PLACED}{text}\n"));
    refused(face("f 1/1 2/5 3/1"), "mesh.obj:11", "texture coordinates 5, but there are 4");
    refused(face("f 1/1 2/-5 3/1"), "mesh.obj:11", "texture coordinates -5");
    refused(face("f 1/0 2/1 3/1"), "mesh.obj:11", "texture coordinates 0; the first is 1");
    // They may come later.
    assert!(face("f 1/1 2/5 3/1\nvt 1 1").is_ok());
    let scene = face("vt -1.#IND nan\nvt x\nvt 1e99 0\nf 1/5 2/6 3/7").unwrap();
    warned(&scene, "mesh.obj:11: 3 texture coordinates are no finite numbers", true);
}

#[test]
fn without_a_texture_there_are_no_texture_coordinates() {
    let scene = load_obj(&format!("{SQUARE}vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")).unwrap();
    assert!(scene.uvs.is_empty());
}
