//! Files that are not to the letter of their format, and say all the same what is meant.

use glam::Vec3;
use gpu_vpl::scene::{Bsdf, Scene};
use serde_json::{Value, json};

use super::super::gltf::build::{glb, gltf, load_files, load_gltf, quad};
use super::super::{CAMERA, load_more, load_obj, refused, warned};
use super::case;

#[test]
fn the_cases_are_read() {
    for name in [
        "integers_as_floats/count_float",
        "integers_as_floats/offset_float",
        "matrix_w/matrix_w",
        "unlit_required/unlit_required",
        "unlit_required/specgloss",
    ] {
        assert_eq!(case(&format!("{name}/m.gltf")).triangles.len(), 2, "{name}");
    }
    let [padded, plain] = ["m", "ok"].map(|name| case(&format!("glb_nul/glb_nul/{name}.glb")));
    assert_eq!(padded.triangles, plain.triangles);
    warned(&case("integers_as_floats/count_float/m.gltf"), "read by its sense", false);
    let unlit = case("unlit_required/unlit_required/m.gltf");
    assert!(unlit.materials[0].texture.is_some() && unlit.materials[0].bsdf == Bsdf::Diffuse);
    warned(&unlit, "KHR_materials_unlit", true);
    let green = case("unlit_required/specgloss/m.gltf");
    assert_eq!(green.materials[0].albedo, Vec3::new(0.1, 0.7, 0.1));
}

/// The text of the quad with one piece of it replaced.
fn rewritten(from: &str, to: &str) -> Result<Scene, gpu_vpl::error::SceneError> {
    let text = gltf(&quad());
    assert!(text.contains(from), "{from} is not in {text}");
    load_files(&[("m.gltf", text.replacen(from, to, 1).as_bytes())])
}

#[test]
fn json_that_is_nearly_gltf_is_read() {
    let text = gltf(&quad());
    let version = text.find("\"version\"").unwrap();
    let end = version + text[version..].find('}').unwrap();
    let asset = &text[version..end];
    for to in [
        "\"version\": 2.0",
        "\"version\": 2",
        "\"version\": \"2.0\", \"min\": [NaN, -Infinity]",
        "\"version\": \"2.0\", \"extras\": {\"a\": [1,],}",
    ] {
        let scene = rewritten(asset, to).unwrap();
        assert_eq!(scene.triangles.len(), 2, "{to}");
        warned(&scene, "no strict glTF", false);
    }
    // What says nothing to the letter, says nothing by its sense.
    assert!(rewritten(asset, "\"version\": \"1.0\",").is_err());
    assert!(rewritten(asset, "\"version\" 2.0").is_err());
    let half = json!(4.5);
    refused(
        load_gltf(&quad().edit(&[("/accessors/0/count", half)])),
        "mesh.gltf:6",
        "no valid glTF",
    );
}

#[test]
fn matrices_may_be_off_by_rounding() {
    let with = |last: [f64; 4]| {
        let mut matrix =
            vec![1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        for (column, value) in last.into_iter().enumerate() {
            matrix[4 * column + 3] = value;
        }
        load_gltf(&quad().edit(&[("/nodes/0/matrix", json!(matrix))]))
    };
    for last in [[0.0, 0.0, 0.0, 0.9999999], [1e-16, -1e-9, 0.0, 1.0], [0.0, 0.0, 0.0, 1.0000002]] {
        assert_eq!(with(last).unwrap().triangles.len(), 2);
    }
    for last in [[0.0; 4], [0.1, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 2.0], [0.0, 0.0, 0.0, -1.0]] {
        refused(with(last), "mesh.gltf", "no affine map");
    }
    let toml =
        |last: &str| load_more(&format!("matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, {last}]\n"));
    assert!(toml("0, 1e-17, 0, 0.99999994").is_ok());
    refused(toml("0, 0, 0, 3"), "scene.toml:7", "must end in the row");
}

#[test]
fn glb_chunks_may_be_padded_with_anything() {
    let plain = glb(&quad());
    for (extra, of) in
        [(&b"\0\0\0\0"[..], "NUL"), (b"    ", "blanks"), (b"\n\n\n\n", "ends of lines")]
    {
        let json = u32::from_le_bytes(plain[12..16].try_into().unwrap()) as usize;
        let mut padded = plain.clone();
        padded.splice(20 + json..20 + json, extra.iter().copied());
        padded[12..16].copy_from_slice(&(json as u32 + 4).to_le_bytes());
        padded[8..12].copy_from_slice(&(plain.len() as u32 + 4).to_le_bytes());
        assert_eq!(load_files(&[("m.glb", &padded)]).unwrap().triangles.len(), 2, "{of}");
    }
    // What is left of the file is too short for a chunk, and empty.
    let mut trailing = [&plain[..], b"\0\0"].concat();
    trailing[8..12].copy_from_slice(&(plain.len() as u32 + 2).to_le_bytes());
    assert!(load_files(&[("m.glb", &trailing)]).is_ok());
}

#[test]
fn extensions_of_materials_are_shown_by_the_nearest_though_required() {
    let with = |extension: &str, content: Value| {
        let material = json!([{"extensions": {extension: content}}]);
        let name = json!([extension]);
        load_gltf(&quad().edit(&[
            ("/materials", material),
            ("/meshes/0/primitives/0/material", json!(0)),
            ("/extensionsRequired", name),
        ]))
    };
    for name in ["KHR_materials_clearcoat", "KHR_materials_sheen", "EXT_materials_of_tomorrow"] {
        warned(&with(name, json!({})).unwrap(), name, true);
    }
    for name in ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing"]
    {
        refused(with(name, json!({})), "mesh.gltf", "unpacks it");
    }
    refused(with("EXT_of_tomorrow", json!({})), "mesh.gltf", "export it without");
    let name = "KHR_materials_pbrSpecularGlossiness";
    let shiny = with(
        name,
        json!({"diffuseFactor": [0.5, 0.5, 0.5, 1], "specularFactor": [0.5, 0.5, 0.5],
        "glossinessFactor": 0.8}),
    )
    .unwrap();
    assert_eq!(shiny.materials[0].albedo, Vec3::splat(0.25));
    assert!(
        matches!(shiny.materials[0].bsdf, Bsdf::Phong { specular, .. } if specular == Vec3::splat(0.5))
    );
    let metal =
        with(name, json!({"diffuseFactor": [0, 0, 0, 1], "specularFactor": [0.9, 0.8, 0.7]}))
            .unwrap();
    assert!(matches!(metal.materials[0].bsdf, Bsdf::Mirror { .. }));
}

#[test]
fn obj_of_loose_writers_is_read() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    for faces in ["f 1/1 2/2 3/3", "f 1/1/1 2/2/1 3/3/1", "f -4/-4 -3/-3 -2/-2"] {
        let scene = load_obj(&format!("{square}{faces}\n")).unwrap();
        assert_eq!(scene.triangles.len(), 1, "{faces}");
        warned(&scene, "mesh.obj:5: faces name texture coordinates, but the file has none", true);
    }
    let comma = load_obj("v 0,0 0,0 0,0\nv 1,5 0 0\nv 0 1,5 0\nf 1 2 3\n").unwrap();
    assert!(
        (f64::from(comma.triangles[0].area()) * comma.units.scale.powi(2) - 1.125).abs() < 1e-6
    );
    warned(&comma, "mesh.obj:1: 5 numbers have a comma", false);
    let obj = format!("mtllib m.mtl\n{square}usemtl m\nf 1 2 3\n");
    let mtl = "newmtl m\nKd 0,25 0,5 0,75\n";
    let scene = super::super::load(&[("m.obj", &obj), ("m.mtl", mtl)]).unwrap();
    assert_eq!(scene.materials[0].albedo, Vec3::new(0.25, 0.5, 0.75));
    assert!(load_obj(&format!("{square}f 1.0 2.0 3.0\nfo 1 3 4\n")).unwrap().triangles.len() == 2);
    refused(load_obj(&format!("{square}f 1.5 2 3\n")), "mesh.obj:5", "does not begin");
    let toml = format!("{CAMERA}[[mesh]]\nfile = \"mesh.obj\"\nscale = 2.0\n");
    assert!(super::super::load_toml(&toml).is_ok());
}
