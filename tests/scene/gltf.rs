//! glTF 2.0, built here: JSON with its buffer in a data URI, and GLB.

mod bad;
pub mod build;
mod material;
mod texture;

use glam::{DVec3, Vec3};
use gpu_vpl::scene::Scene;
use serde_json::json;

use super::{CAMERA, load, refused, warned};
use build::{Edit, glb, gltf, load_files, load_gltf, quad, textured};

fn center(scene: &Scene) -> DVec3 {
    scene.units.center
}

fn area(scene: &Scene) -> f64 {
    let area: f64 = scene.triangles.iter().map(|triangle| f64::from(triangle.area())).sum();
    area * scene.units.scale.powi(2)
}

fn normals(scene: &Scene) -> Vec<Vec3> {
    scene.triangles.iter().map(|triangle| triangle.scaled_normal().normalize()).collect()
}

fn edited(edits: &[(&str, serde_json::Value)]) -> Scene {
    load_gltf(&quad().edit(edits)).unwrap()
}

#[test]
fn a_quad_is_read_framed_and_lit() {
    let files = [gltf(&quad()).into_bytes(), glb(&quad())];
    for (name, bytes) in ["mesh.gltf", "mesh.glb"].into_iter().zip(&files) {
        let scene = load_files(&[(name, bytes)]).unwrap();
        assert_eq!(scene.triangles.len(), 2, "{name}");
        assert_eq!((area(&scene), center(&scene)), (4.0, DVec3::ZERO));
        assert_eq!(normals(&scene), [Vec3::Z; 2]);
        let from = -scene.camera.forward;
        assert!((from.y - 0.5).abs() < 1e-6 && from.z > 0.7, "{from}");
        assert_eq!(scene.camera.size, [512, 512]);
        assert_eq!(scene.point_lights[0].position, scene.camera.position);
        warned(&scene, "no light", false);
        warned(&scene, "without a material", false);
    }
}

#[test]
fn a_buffer_may_lie_beside_the_file() {
    let text = gltf(&quad().edit(&[("/buffers/0/uri", json!("the%20quad.bin"))]));
    let files = [("mesh.gltf", text.as_bytes()), ("the quad.bin", &build::buffer())];
    assert_eq!(area(&load_files(&files).unwrap()), 4.0);
    refused(load_files(&files[..1]), "mesh.gltf", "the%20quad.bin is not there");
}

#[test]
fn indices_of_every_kind_and_none_are_read() {
    // After the indices of 16 bits, the buffer holds them in 8 and in 32.
    for (view, kind) in [(1, 5123), (2, 5121), (3, 5125)] {
        let scene = edited(&[
            ("/accessors/1/bufferView", json!(view)),
            ("/accessors/1/componentType", json!(kind)),
        ]);
        assert_eq!((scene.triangles.len(), area(&scene)), (2, 4.0), "{kind}");
    }
    // The corners in their order: a strip of two triangles, wound alike; a fan crosses itself.
    for (mode, count) in [(5, 2), (6, 2)] {
        let primitive = json!({"attributes": {"POSITION": 0}, "mode": mode});
        let scene = edited(&[("/meshes/0/primitives/0", primitive)]);
        assert_eq!(scene.triangles.len(), count);
        assert_eq!(normals(&scene)[0], Vec3::Z);
    }
    let strip = json!({"attributes": {"POSITION": 0}, "mode": 5});
    assert_eq!(normals(&edited(&[("/meshes/0/primitives/0", strip)])), [Vec3::Z; 2]);
}

#[test]
fn points_and_lines_are_left_out_with_a_note() {
    let lines = json!([
        {"attributes": {"POSITION": 0}, "indices": 1},
        {"attributes": {"POSITION": 0}, "mode": 1},
    ]);
    let scene = edited(&[("/meshes/0/primitives", lines)]);
    assert_eq!(scene.triangles.len(), 2);
    warned(&scene, "1 sets of points or lines", false);
}

#[test]
fn quantised_and_sparse_positions_are_read() {
    // Corners of ±1 in bytes of ±127.
    let bytes = json!({"bufferView": 4, "componentType": 5120, "normalized": true, "count": 4,
        "type": "VEC3"});
    assert_eq!(area(&edited(&[("/accessors/0", bytes)])), 4.0);
    // The last corner, element 3, is replaced by (3, 3, 0): the quad of corners
    // (-1, -1), (1, -1), (3, 3), (-1, 1) has the area 8.
    let sparse = json!({"count": 1,
        "indices": {"bufferView": 5, "componentType": 5121},
        "values": {"bufferView": 6}});
    assert_eq!(area(&edited(&[("/accessors/0/sparse", sparse)])), 8.0);
}

#[test]
fn nested_nodes_move_meshes_and_mirrors_keep_the_front() {
    let half = 0.5_f64.sqrt();
    let nodes = json!([
        {"children": [1], "translation": [10, 0, 0], "scale": [2, 2, 2]},
        // A quarter turn about Y takes Z to X.
        {"children": [2], "rotation": [0, half, 0, half]},
        {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 5, 3, 1]},
    ]);
    let scene = edited(&[("/nodes", nodes)]);
    assert!(center(&scene).distance(DVec3::new(16.0, 10.0, 0.0)) < 1e-12, "{}", center(&scene));
    assert!((area(&scene) - 16.0).abs() < 1e-5);
    assert!(normals(&scene)[0].distance(Vec3::X) < 1e-6);

    let mirrored = edited(&[("/nodes/0/scale", json!([-1, 1, 1]))]);
    assert_eq!(normals(&mirrored), [Vec3::Z; 2]);
    let behind = edited(&[("/nodes/0/scale", json!([1, 1, -1]))]);
    assert_eq!(normals(&behind), [-Vec3::Z; 2]);
}

#[test]
fn only_the_default_scene_is_read() {
    let nodes = json!([{"mesh": 0}, {"mesh": 0, "translation": [0, 0, 9]}]);
    let scenes = json!([{"nodes": [0]}, {"nodes": [1]}]);
    let of = |edits: &[(&str, serde_json::Value)]| {
        let common = [("/nodes", nodes.clone()), ("/scenes", scenes.clone())];
        edited(&[&common[..], edits].concat())
    };
    assert_eq!(center(&of(&[])).z, 0.0);
    assert_eq!(center(&of(&[("/scene", json!(1))])).z, 9.0);
    assert_eq!(of(&[("/scenes", json!([]))]).triangles.len(), 4);
}

#[test]
fn colours_and_emission_are_the_files() {
    let material = json!({"name": "lamp", "doubleSided": true, "emissiveFactor": [0.5, 1, 0],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}},
        "pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 0.75, 1], "metallicFactor": 0}});
    let edits = [("/materials", json!([material])), ("/meshes/0/primitives/0/material", json!(0))];
    let scene = edited(&edits);
    let lamp = &scene.materials[0];
    assert_eq!((lamp.name.as_str(), lamp.two_sided), ("lamp", true));
    assert_eq!(lamp.albedo.to_array(), [0.25, 0.5, 0.75]);
    assert_eq!(lamp.emission.to_array(), [2.0, 4.0, 0.0]);
    assert!(scene.warnings.is_empty() && scene.point_lights.is_empty(), "{:?}", scene.warnings);
}

#[test]
fn what_else_changes_the_image_is_a_warning() {
    let primitive = json!({"attributes": {"POSITION": 0, "COLOR_0": 0}, "indices": 1,
        "targets": [{}]});
    let node = json!({"mesh": 0, "skin": 0, "extensions": {"EXT_mesh_gpu_instancing": {}}});
    let scene = edited(&[("/meshes/0/primitives/0", primitive), ("/nodes/0", node)]);
    // Colours beyond 0 and 1, as these that are positions, are cut off.
    assert_eq!(scene.colors[0], [Vec3::ZERO, Vec3::X, Vec3::Y]);
    warned(&scene, "1 meshes have a skin", true);
    warned(&scene, "1 nodes have EXT_mesh_gpu_instancing", true);
}

/// Valid documents, as text and as GLB.
pub fn documents() -> Vec<(Vec<u8>, Vec<u8>)> {
    let rich = textured().edit(&[
        (
            "/materials",
            json!([{"name": "wood", "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
                "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0, "texCoord": 0},
                "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2},
                    "KHR_materials_transmission": {"transmissionFactor": 0.25},
                    "KHR_materials_ior": {"ior": 1.25}},
                "pbrMetallicRoughness": {"metallicFactor": 0.5, "roughnessFactor": 0.5,
                    "baseColorFactor": [0.5, 0.5, 0.5, 0.75],
                    "metallicRoughnessTexture": {"index": 0},
                    "baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform":
                        {"rotation": 0.5, "scale": [1, 2], "offset": [0.5, 0.5]}}}}}]),
        ),
        ("/samplers", json!([{"wrapS": 33648, "wrapT": 33071}])),
        ("/textures/0/sampler", json!(0)),
        ("/nodes/0/matrix", json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 5, 3, 1])),
    ]);
    let sparse = json!({"count": 1, "indices": {"bufferView": 5, "componentType": 5121},
        "values": {"bufferView": 6}});
    let sparse = quad().edit(&[("/accessors/0/sparse", sparse)]);
    let documents = [quad(), sparse, textured(), rich, viewed()];
    documents.iter().map(|document| (gltf(document).into_bytes(), glb(document))).collect()
}

/// A quad, a camera that looks along +X and a light.
fn viewed() -> Edit {
    let half = 0.5_f64.sqrt();
    quad().edit(&[
        (
            "/cameras",
            json!([
                {"type": "orthographic", "name": "flat"},
                {"type": "perspective", "perspective":
                    {"yfov": 1.0, "znear": 0.1, "aspectRatio": 2.0}},
            ]),
        ),
        (
            "/extensions",
            json!({"KHR_lights_punctual": {"lights": [
                {"type": "point", "color": [1, 0.5, 0], "intensity": 8},
                {"type": "spot", "name": "beam", "spot": {}},
                {"type": "directional", "color": [1, 0, 1], "intensity": 3},
                {"type": "area", "name": "lamp"},
            ]}}),
        ),
        (
            "/nodes",
            json!([
                {"mesh": 0},
                {"camera": 0},
                {"camera": 1, "translation": [-4, 0, 1], "rotation": [0, -half, 0, half]},
                {"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [0, 0, 2]},
                {"extensions": {"KHR_lights_punctual": {"light": 1}}, "translation": [0, 1, 0],
                    "rotation": [0, -half, 0, half]},
                {"extensions": {"KHR_lights_punctual": {"light": 2}}},
                {"extensions": {"KHR_lights_punctual": {"light": 3}}},
            ]),
        ),
        ("/scenes", json!([{"nodes": [0, 1, 2, 3, 4, 5, 6]}])),
    ])
}

#[test]
fn the_camera_and_the_lights_are_the_files() {
    let scene = load_gltf(&viewed()).unwrap();
    let camera = &scene.camera;
    assert_eq!((camera.position, camera.size), (Vec3::new(-4.0, 0.0, 1.0), [512, 256]));
    assert!(camera.forward.distance(Vec3::X) < 1e-6 && camera.up.distance(Vec3::Y) < 1e-6);
    assert!((camera.half_tangents()[1] - 0.5_f32.tan()).abs() < 1e-6);
    assert_eq!(scene.point_lights.len(), 2);
    let [point, spot] = [scene.point_lights[0], scene.point_lights[1]];
    assert_eq!((point.position, point.cone), (Vec3::new(0.0, 0.0, 2.0), None));
    assert_eq!(point.intensity, Vec3::new(8.0, 4.0, 0.0));
    assert_eq!((spot.position, spot.intensity), (Vec3::new(0.0, 1.0, 0.0), Vec3::ONE));
    let cone = spot.cone.unwrap();
    assert!(cone.axis.distance(Vec3::X) < 1e-6, "{}", cone.axis);
    let cosines = [0.0_f32.cos(), std::f32::consts::FRAC_PI_4.cos()];
    assert!((cone.cos_inner - cosines[0]).abs() < 1e-6);
    assert!((cone.cos_outer - cosines[1]).abs() < 1e-6);
    let sun = scene.directional_lights[0];
    assert!(sun.direction.distance(-Vec3::Z) < 1e-6);
    assert_eq!((sun.irradiance, scene.directional_lights.len()), (Vec3::new(3.0, 0.0, 3.0), 1));
    warned(&scene, "camera `flat` is orthographic", true);
    warned(&scene, "light `lamp` is of the unknown type \"area\"", true);
    assert!(!scene.warnings.iter().any(|warning| warning.message.contains("no light")));
}

#[test]
fn a_camera_of_the_file_carries_the_light_that_is_missing() {
    let scenes = json!([{"nodes": [0, 1, 2, 6]}]);
    let scene = load_gltf(&viewed().edit(&[("/scenes", scenes)])).unwrap();
    warned(&scene, "no light", false);
    assert_eq!(scene.point_lights[0].position, scene.camera.position);
}

#[test]
fn a_scene_file_places_its_meshes_alone() {
    let mesh = gltf(&viewed().edit(&[
        (
            "/materials",
            json!([{"name": "paint", "pbrMetallicRoughness":
            {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0}}]),
        ),
        ("/meshes/0/primitives/0/material", json!(0)),
    ]));
    let light = "[[light]]\ntype = \"point\"\nposition = [0, 0, 4]\nintensity = [1, 1, 1]\n";
    let of = |more: &str| {
        let text = format!("{CAMERA}{light}[[mesh]]\nfile = \"mesh.gltf\"\n{more}");
        load(&[("scene.toml", &text), ("mesh.gltf", &mesh)])
    };
    let scene = of("translate = [1, 0, 0]\nscale = [-3, 1, 1]\n").unwrap();
    assert_eq!(center(&scene), DVec3::X);
    assert!((area(&scene) / 12.0 - 1.0).abs() < 1e-6);
    assert_eq!((normals(&scene)[0], scene.camera.forward), (Vec3::Z, -Vec3::Z));
    assert_eq!((scene.point_lights.len(), scene.warnings.len()), (1, 0));
    assert_eq!(scene.materials[0].albedo.to_array(), [0.5; 3]);

    let scene = of("[materials.paint]\nalbedo = [0.1, 0.2, 0.3]\n").unwrap();
    assert_eq!(scene.materials.len(), 1);
    assert_eq!(scene.materials[0].albedo.to_array(), [0.1, 0.2, 0.3]);
    assert_eq!(of("material = \"paint\"\n").unwrap().materials[0].name, "paint");
    refused(of("material = \"gone\"\n"), "scene.toml:11", "nor among the mesh's own");
}

#[test]
fn the_image_has_the_shape_that_the_camera_asks_for() {
    let size = |aspect: f64| {
        let aspect = ("/cameras/1/perspective/aspectRatio", json!(aspect));
        load_gltf(&viewed().edit(&[aspect])).unwrap().camera.size
    };
    assert_eq!(size(16.0 / 9.0), [512, 288]);
    assert_eq!(size(0.5), [512, 1024]);
    assert_eq!((size(1e-9), size(1e9)), ([512, 4096], [512, 8]));
    assert_eq!((size(0.0), size(-2.0)), ([512, 512], [512, 512]));
}

#[test]
fn cones_and_intensities_are_checked() {
    let spot = |spot: serde_json::Value| {
        let edit = ("/extensions/KHR_lights_punctual/lights/1/spot", spot);
        load_gltf(&viewed().edit(&[edit]))
    };
    let scene = spot(json!({"innerConeAngle": 0.25, "outerConeAngle": 0.5})).unwrap();
    let cone = scene.point_lights[1].cone.unwrap();
    assert!((cone.cos_inner - 0.25_f32.cos()).abs() < 1e-6);
    assert!((cone.cos_outer - 0.5_f32.cos()).abs() < 1e-6);
    refused(spot(json!({"innerConeAngle": 1, "outerConeAngle": 0.5})), "mesh.gltf", "cone of 1");
    refused(spot(json!({"outerConeAngle": 4})), "mesh.gltf", "cone of 0 to 4");
    refused(spot(json!({"outerConeAngle": 0})), "mesh.gltf", "cone of 0 to 0");
    let dark = ("/extensions/KHR_lights_punctual/lights/2/intensity", json!(-1));
    refused(load_gltf(&viewed().edit(&[dark])), "mesh.gltf", "its intensity is negative");
}
