//! Bad files: each refused in one line that names the file, none a panic.

use serde_json::{Value, json};

use super::build::{glb, gltf, load_files, load_gltf, quad};
use crate::refused;

/// A value put somewhere in the quad, and what the refusal says.
fn faults() -> Vec<(&'static str, Value, &'static str)> {
    let huge = u64::MAX;
    vec![
        ("/asset", json!({}), "glTF version \"\""),
        ("/asset/version", json!("1.0"), "glTF version \"1.0\""),
        ("/asset/minVersion", json!("2.1"), "glTF version \"2.1\""),
        ("/extensionsRequired", json!(["KHR_draco_mesh_compression"]), "KHR_draco"),
        ("/scene", json!(3), "scene 3, but there are 1"),
        ("/scenes/0/nodes", json!([]), "nothing to render"),
        ("/scenes/0/nodes", json!([1]), "node 1"),
        ("/scenes/0/nodes", json!([0, 0]), "named twice"),
        ("/nodes", json!([{"children": [0]}]), "their own ancestors"),
        ("/nodes", json!([{}, {"children": [2]}, {"children": [1]}]), "their own ancestors"),
        ("/nodes", json!([{"children": [1, 2]}, {"children": [2]}, {}]), "node 2 has two parents"),
        ("/nodes", json!([{"children": [1, 1]}, {}]), "node 1 has two parents"),
        ("/nodes", json!([{"children": [9]}]), "node 9"),
        ("/nodes/0/rotation", json!([0, 0, 0, 0]), "no quaternion"),
        ("/nodes/0/matrix", json!(vec![0; 16]), "no affine map"),
        ("/nodes/0/scale", json!([1e308, 1, 1e308]), "1e100"),
        ("/nodes/0/translation", json!([1e200, 0, 0]), "1e100"),
        ("/nodes/0/mesh", json!(7), "mesh 7"),
        ("/nodes/0/camera", json!(7), "camera 7"),
        ("/nodes/0/extensions", json!({"KHR_lights_punctual": {"light": 0}}), "light 0"),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(9), "accessor 9"),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(1), "not VEC3"),
        ("/meshes/0/primitives/0/indices", json!(0), "not SCALAR"),
        ("/meshes/0/primitives/0/material", json!(0), "material 0"),
        ("/meshes/0/primitives/0/mode", json!(7), "mode 7"),
        ("/accessors/0/componentType", json!(5130), "unknown type 5130"),
        ("/accessors/1/componentType", json!(5122), "no unsigned integers"),
        ("/accessors/0/normalized", json!(true), "calls normalised"),
        ("/accessors/0/count", json!(3), "3 is asked for"),
        ("/accessors/0/count", json!(5), "beyond buffer view 0"),
        ("/accessors/0/count", json!(huge), "beyond buffer view 0"),
        ("/accessors/0/count", json!(-1), "no valid glTF"),
        ("/accessors/0/byteOffset", json!(4), "beyond buffer view 0"),
        ("/accessors/0/byteOffset", json!(huge), "beyond buffer view 0"),
        ("/accessors/1/count", json!(5), "5 corners"),
        ("/accessors/0/bufferView", json!(99), "buffer view 99"),
        (
            "/accessors/0",
            json!({"componentType": 5126, "count": huge, "type": "VEC3"}),
            "no buffer view",
        ),
        (
            "/accessors/0/sparse",
            json!({"count": 1, "indices": {"bufferView": 1, "componentType": 5123,
                "byteOffset": huge}, "values": {"bufferView": 6}}),
            "beyond buffer view 1",
        ),
        (
            "/accessors/0/sparse",
            json!({"count": huge, "indices": {"bufferView": 1, "componentType": 5123},
                "values": {"bufferView": 6}}),
            "beyond buffer view 1",
        ),
        (
            "/accessors/0/sparse",
            json!({"count": 1, "indices": {"bufferView": 0, "componentType": 5125},
                "values": {"bufferView": 6}}),
            "not there",
        ),
        ("/bufferViews/0/byteStride", json!(4), "every 4 bytes"),
        ("/bufferViews/0/byteStride", json!(huge), "beyond buffer view 0"),
        ("/bufferViews/0/byteOffset", json!(huge), "beyond buffer 0"),
        ("/bufferViews/0/byteLength", json!(9999), "beyond buffer 0"),
        ("/bufferViews/0/buffer", json!(1), "buffer 1"),
        ("/buffers/0/byteLength", json!(huge), "truncated"),
        ("/buffers/0/uri", Value::Null, "neither a URI"),
        ("/buffers/0/uri", json!("gone.bin"), "gone.bin is not there"),
        ("/buffers/0/uri", json!("http://a.b/c.bin"), "not beside"),
        ("/buffers/0/uri", json!("/dev/zero"), "not there"),
        ("/buffers/0/uri", json!("data:x"), "no comma"),
        ("/buffers/0/uri", json!("data:text/plain,x"), "not in base64"),
        ("/buffers/0/uri", json!("data:;base64,***"), "no base64"),
    ]
}

#[test]
fn bad_documents_are_refused() {
    for (pointer, value, text) in faults() {
        let result = load_gltf(&quad().edit(&[(pointer, value)]));
        let place = if text == "no valid glTF" { "mesh.gltf:6" } else { "mesh.gltf" };
        refused(result, place, text);
    }
}

#[test]
fn impossible_materials_are_refused() {
    let material = |text: &str| {
        let material: Value = serde_json::from_str(text).unwrap_or_default();
        let use_it = ("/meshes/0/primitives/0/material", json!(0));
        load_gltf(&quad().edit(&[("/materials", json!([material])), use_it]))
    };
    let bright = r#"{"pbrMetallicRoughness": {"baseColorFactor": [2, 0, 0, 1]}}"#;
    refused(material(bright), "mesh.gltf", "material `material 0`: albedo [2, 0, 0]");
    refused(material(r#"{"emissiveFactor": [-1, 0, 0]}"#), "mesh.gltf", "emission");
    let strength = r#"{"extensions": {"KHR_materials_emissive_strength":
        {"emissiveStrength": "much"}}}"#;
    refused(material(strength), "mesh.gltf", "emissiveStrength is no number");
}

#[test]
fn numbers_that_are_none_are_refused() {
    let mut bytes = glb(&quad());
    // The first corner begins the last chunk.
    let start = bytes.len() - super::build::buffer().len();
    bytes[start..start + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    refused(load_files(&[("mesh.glb", &bytes)]), "mesh.glb", "element 0 that is not finite");
    // An index beyond the vertices.
    let mut bytes = glb(&quad());
    bytes[start + 48] = 200;
    refused(load_files(&[("mesh.glb", &bytes)]), "mesh.glb", "200 is asked for");
}

#[test]
fn broken_containers_are_refused() {
    let good = glb(&quad());
    let with = |at: usize, byte: u8| {
        let mut bytes = good.clone();
        bytes[at] = byte;
        bytes
    };
    let of = |bytes: &[u8], text: &str| refused(load_files(&[("a.glb", bytes)]), "a.glb", text);
    of(b"", "does not begin with `glTF`");
    of(&with(0, b'G'), "does not begin with `glTF`");
    of(&with(4, 1), "version 1");
    of(&with(11, 0xff), "truncated");
    of(&with(15, 0xff), "truncated");
    of(&with(16, b'B'), "begin with its JSON");
    for length in [4, 8, 12, 19, 30, good.len() - 1] {
        of(&good[..length], "truncated");
    }
    let text = gltf(&quad());
    let half = &text.as_bytes()[..text.len() / 2];
    for text in [&b""[..], b"{\n\n\xff}", half] {
        let error = load_files(&[("a.gltf", text)]).unwrap_err().to_string();
        assert!(error.starts_with("a.gltf:") && error.contains("no valid glTF"), "{error}");
    }
    let nested = r#"{"materials": [{"extensions": {"x": "#.to_owned() + &"[".repeat(100_000);
    refused(load_files(&[("a.gltf", nested.as_bytes())]), "a.gltf:1", "recursion limit");
}

#[test]
fn nodes_may_be_nested_deeply() {
    let count = 100_000;
    let mut nodes: Vec<Value> = (1..count).map(|child| json!({"children": [child]})).collect();
    nodes.push(json!({"mesh": 0}));
    assert_eq!(load_gltf(&quad().edit(&[("/nodes", json!(nodes))])).unwrap().triangles.len(), 2);
}
