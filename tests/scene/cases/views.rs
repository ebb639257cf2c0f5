//! Views and lights that the program chooses for bare meshes.

use glam::Vec3;
use gpu_vpl::scene::Scene;

use super::super::{MTL, load, warned};
use super::case;

fn is_lit_from_the_camera(scene: &Scene) -> bool {
    scene.point_lights.iter().any(|light| light.position == scene.camera.position)
}

#[test]
fn planes_and_boxes_are_seen_from_above_and_lit_within_white() {
    for (name, nearest) in [("bare_cube/cube", 1.0), ("bare_plane/plane", 0.0)] {
        let scene = case(&format!("bare_view/{name}.obj"));
        assert!((scene.camera.forward.y + 0.5).abs() < 1e-6, "{name}");
        assert!(is_lit_from_the_camera(&scene));
        // Nothing is nearer than what receives π.
        let light = scene.point_lights[0];
        for triangle in &scene.triangles {
            for vertex in triangle.vertices {
                let square = vertex.distance_squared(light.position);
                let received = light.intensity.x / square;
                assert!(received <= std::f32::consts::PI * 1.0001, "{name}: {received} {nearest}");
            }
        }
    }
}

#[test]
fn surfaces_that_glow_a_little_do_not_light_a_mesh() {
    for name in ["emissive_spot", "glow_and_body"] {
        let scene = case(&format!("glow_no_lamp/{name}/m.gltf"));
        assert!(is_lit_from_the_camera(&scene), "{name}");
        warned(&scene, "no light but surfaces that glow a little", false);
    }
    // A large lamp does, and so does a small one that is bright; a small dim one does not.
    let with = |size: f64, radiance: f64| {
        let obj = format!(
            "mtllib m.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 1\nv {size} 0 1\nv 0 {size} 1\n\
             usemtl one\nf 1 2 3 4\nusemtl lamp\nf 5 6 7\n"
        );
        let mtl = format!("{MTL}newmtl lamp\nKd 0\nKe {radiance}\n");
        is_lit_from_the_camera(&load(&[("m.obj", &obj), ("m.mtl", &mtl)]).unwrap())
    };
    assert!(!with(4.0, 1.0) && !with(0.5, 20.0) && with(0.5, 1.0) && with(4.0, 0.01));
}

#[test]
fn a_camera_within_the_mesh_lights_what_is_around_it() {
    let inside = |z: f64| {
        super::super::gltf::build::load_gltf(&super::super::gltf::build::quad().edit(&[
            (
                "/cameras",
                serde_json::json!([{"type": "perspective", "perspective": {"yfov": 0.5}}]),
            ),
            ("/nodes", serde_json::json!([{"mesh": 0}, {"camera": 0, "translation": [0, 0, z]}])),
            ("/scenes", serde_json::json!([{"nodes": [0, 1]}])),
        ]))
        .unwrap()
    };
    let near = inside(0.1).point_lights[0].intensity;
    assert!((near.x / (std::f32::consts::PI * 0.01) - 1.0).abs() < 1e-3, "{near}");
    let within = inside(0.0).point_lights[0].intensity;
    assert!(within.cmpgt(Vec3::splat(1.0)).all(), "{within}");
}
