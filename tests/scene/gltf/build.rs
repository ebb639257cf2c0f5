//! Builds small glTF files.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gpu_vpl::error::SceneError;
use gpu_vpl::scene::Scene;
use serde_json::{Value, json};

use crate::load_bytes;
use crate::pictures::{QUARTERS, png};

/// A document to be changed.
#[derive(Clone)]
pub struct Edit(pub Value);

impl Edit {
    /// With values set at JSON pointers; the last part of one may be new.
    pub fn edit(&self, edits: &[(&str, Value)]) -> Self {
        let mut document = self.0.clone();
        for (pointer, value) in edits {
            let (parent, key) = pointer.rsplit_once('/').unwrap();
            match document.pointer_mut(parent).unwrap() {
                Value::Array(items) => items[key.parse::<usize>().unwrap()] = value.clone(),
                parent => parent[key] = value.clone(),
            }
        }
        Self(document)
    }
}

const CORNERS: [[i8; 3]; 4] = [[-1, -1, 0], [1, -1, 0], [-1, 1, 0], [1, 1, 0]];
/// From the top left.
const UVS: [[u8; 2]; 4] = [[0, 1], [1, 1], [0, 0], [1, 0]];
const INDICES: [u8; 6] = [0, 1, 2, 2, 1, 3];

/// Corners, indices in 16, 8 and 32 bits, corners in bytes, and what a sparse accessor
/// replaces corner 3 by; texture coordinates as floats, in 8 and in 16 bits (a fifth as large),
/// and [`QUARTERS`] as a PNG.
pub fn buffer() -> Vec<u8> {
    let mut bytes: Vec<u8> =
        CORNERS.as_flattened().iter().flat_map(|&x| f32::from(x).to_le_bytes()).collect();
    bytes.extend(INDICES.iter().flat_map(|&i| u16::from(i).to_le_bytes()));
    bytes.extend(INDICES);
    bytes.extend([0; 2]);
    bytes.extend(INDICES.iter().flat_map(|&i| u32::from(i).to_le_bytes()));
    bytes.extend(CORNERS.iter().flat_map(|c| [c[0] * 127, c[1] * 127, 0, 0].map(|x| x as u8)));
    bytes.extend([3, 0, 0, 0]);
    bytes.extend([3.0_f32, 3.0, 0.0].iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend(UVS.as_flattened().iter().flat_map(|&x| f32::from(x).to_le_bytes()));
    bytes.extend(UVS.as_flattened().iter().map(|x| 255 * x));
    bytes.extend(UVS.as_flattened().iter().flat_map(|&x| (51 * u16::from(x)).to_le_bytes()));
    bytes.extend(png(&QUARTERS));
    bytes
}

/// The document with a textured material `wood` that is no metal, an image in its buffer, and
/// texture coordinates as floats.
pub fn textured() -> Edit {
    let accessor = |view: u32, kind: u32| {
        json!({"bufferView": view, "componentType": kind, "count": 4, "type": "VEC2",
            "normalized": kind != 5126})
    };
    let mut document = quad().edit(&[
        (
            "/materials",
            json!([{"name": "wood", "pbrMetallicRoughness":
                {"metallicFactor": 0, "baseColorTexture": {"index": 0}}}]),
        ),
        ("/textures", json!([{"source": 0}])),
        ("/images", json!([{"bufferView": 10, "mimeType": "image/png"}])),
        ("/meshes/0/primitives/0/material", json!(0)),
        ("/meshes/0/primitives/0/attributes/TEXCOORD_0", json!(2)),
    ]);
    let of = |list: &str, item: Value, document: &mut Edit| {
        document.0[list].as_array_mut().unwrap().push(item);
    };
    for (view, kind) in [(7, 5126), (8, 5121), (9, 5123)] {
        of("accessors", accessor(view, kind), &mut document);
    }
    for (offset, length) in [(124, 32), (156, 8), (164, 16), (180, buffer().len() - 180)] {
        let view = json!({"buffer": 0, "byteOffset": offset, "byteLength": length});
        of("bufferViews", view, &mut document);
    }
    document
}

/// A square of ±1 that faces +Z, without material, camera or light.
pub fn quad() -> Edit {
    let bytes = buffer();
    let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes));
    Edit(json!({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 48},
            {"buffer": 0, "byteOffset": 48, "byteLength": 12},
            {"buffer": 0, "byteOffset": 60, "byteLength": 6},
            {"buffer": 0, "byteOffset": 68, "byteLength": 24},
            {"buffer": 0, "byteOffset": 92, "byteLength": 16, "byteStride": 4},
            {"buffer": 0, "byteOffset": 108, "byteLength": 1},
            {"buffer": 0, "byteOffset": 112, "byteLength": 12},
        ],
        "buffers": [{"uri": uri, "byteLength": bytes.len()}],
    }))
}

/// The document as text, a key a line.
pub fn gltf(document: &Edit) -> String {
    serde_json::to_string_pretty(&document.0).unwrap()
}

/// The document and [`buffer`] in one file.
pub fn glb(document: &Edit) -> Vec<u8> {
    let length = buffer().len();
    let document = document.edit(&[("/buffers/0", json!({"byteLength": length}))]);
    let mut json = serde_json::to_vec(&document.0).unwrap();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = Vec::new();
    for (kind, content) in [(b"JSON", json), (b"BIN\0", buffer())] {
        bytes.extend((content.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(content);
    }
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend((bytes.len() as u32 + 12).to_le_bytes());
    file.extend(bytes);
    file
}

/// Loads a document as a bare mesh.
pub fn load_gltf(document: &Edit) -> Result<Scene, SceneError> {
    load_files(&[("mesh.gltf", gltf(document).as_bytes())])
}

/// Loads the first of some files.
pub fn load_files(files: &[(&str, &[u8])]) -> Result<Scene, SceneError> {
    load_bytes(files)
}
