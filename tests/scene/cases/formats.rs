//! Each row of the list of what formats have and we do not show is a warning.

use std::io::Cursor;

use gpu_vpl::scene::{Scene, omissions};
use image::ImageFormat::Png;
use image::{Delay, Frame, RgbaImage};
use serde_json::{Value, json};

use super::super::gltf::build::{load_gltf, quad, textured};
use super::super::pictures::{self, QUARTERS, png};
use super::super::{CAMERA, load, load_bytes, load_obj, warned};

fn obj(text: &str) -> Scene {
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    load_obj(&format!("{vertices}{text}\nf 1 2 3\n")).unwrap()
}

/// A textured triangle of this material.
fn mtl(text: &str) -> Scene {
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
    let mtl = format!("newmtl m\nKd 0.5\n{text}\n");
    load_bytes(&[("m.obj", obj.as_bytes()), ("m.mtl", mtl.as_bytes()), ("a.png", &png(&QUARTERS))])
        .unwrap()
}

fn of_obj(what: &str) -> Scene {
    match what {
        "p, l, f of 1 or 2" => obj("l 1 2"),
        "vn" => obj("vn 0 0 1\nvn 0 1 1\nf 1//1 2//2 4//1"),
        "s" => obj("s 1"),
        "v x y z r g b a" => obj("v 0 0 0 1 1 1 0.5"),
        "vt u v w" => obj("vt 0 0 0.5"),
        "#MRGB" => obj("#MRGB ffff0000ffff0000"),
        "any other statement" => obj("polygon 1 2 3"),
        "curv, curv2, surf" => obj("surf 0 1 0 1 1 2 3 4"),
        "bsp, bzp, cdc, cdp, res" => obj("bzp 1 2 3"),
        "call, csh" => obj("call other.obj"),
        "usemap" => obj("usemap bricks"),
        "shadow_obj, trace_obj" => obj("shadow_obj other.obj"),
        _ => unreachable!("no example of OBJ's {what}"),
    }
}

fn of_mtl(what: &str) -> Scene {
    match what {
        "map_Ks, map_Ns, map_Pr, map_Pm, bump, disp, decal, refl, norm" => mtl("map_Pr a.png"),
        "Pr, Pm, Ps, Pc, aniso" => mtl("Pm 1.0"),
        "d -halo" => mtl("d -halo 0.5"),
        "illum 10" => mtl("illum 10"),
        "illum of other numbers" => mtl("illum 11"),
        "sharpness, map_aat, xyz" => mtl("sharpness 60"),
        "any other statement" => mtl("colour red"),
        "options -mm, -t, -cc, -imfchan, -boost, -colorspace, -type" => mtl("map_Kd -cc on a.png"),
        "alpha of map_Kd" => mtl("map_Kd a.png"),
        "a second newmtl of one name" => mtl("newmtl m\nKd 0.25"),
        _ => unreachable!("no example of MTL's {what}"),
    }
}

fn of_material(material: Value) -> Scene {
    load_gltf(&textured().edit(&[("/materials", json!([material]))])).unwrap()
}

fn of_node(node: Value, edits: &[(&str, Value)]) -> Scene {
    let edits = [&[("/nodes/0", node)], edits].concat();
    load_gltf(&quad().edit(&edits)).unwrap()
}

fn of_primitive(primitive: Value) -> Scene {
    load_gltf(&textured().edit(&[("/meshes/0/primitives/0", primitive)])).unwrap()
}

fn of_gltf(what: &str) -> Scene {
    let info = || json!({"index": 0});
    let turn = |angle: f64| json!({"index": 0, "extensions": {"KHR_texture_transform": {"rotation": angle}}});
    let extended = |name: &str, content: Value| of_material(json!({"extensions": {name: content}}));
    match what {
        "normalTexture" => of_material(json!({"normalTexture": info()})),
        "metallicRoughnessTexture" => of_material(json!({"pbrMetallicRoughness":
            {"metallicRoughnessTexture": info()}})),
        "textures of metals" => of_material(json!({"pbrMetallicRoughness":
            {"baseColorTexture": info()}})),
        "alphaMode BLEND" => of_material(json!({"alphaMode": "BLEND", "pbrMetallicRoughness":
            {"baseColorFactor": [1, 1, 1, 0.75]}})),
        "TEXCOORD_n beside one a material" => of_material(json!({"pbrMetallicRoughness":
            {"metallicFactor": 0, "baseColorTexture": info()}, "emissiveFactor": [1, 1, 1],
            "emissiveTexture": {"index": 0, "texCoord": 1}})),
        "several turns by KHR_texture_transform" => of_material(json!({"pbrMetallicRoughness":
            {"metallicFactor": 0, "baseColorTexture": turn(0.0)}, "emissiveFactor": [1, 1, 1],
            "emissiveTexture": turn(1.0)})),
        "NORMAL" => of_primitive(json!({"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1})),
        "alpha of COLOR_0" => {
            let bytes: Vec<u8> = [[255, 0, 0, 128_u8]; 4].concat();
            let uri = base64(&bytes);
            let mut document = quad().edit(&[
                ("/meshes/0/primitives/0/attributes/COLOR_0", json!(2)),
            ]);
            let mut push = |list: &str, item: Value| {
                document.0[list].as_array_mut().unwrap().push(item);
            };
            push("buffers", json!({"uri": uri, "byteLength": bytes.len()}));
            push("bufferViews", json!({"buffer": 1, "byteLength": bytes.len()}));
            let view = document.0["bufferViews"].as_array().unwrap().len() - 1;
            document.0["accessors"].as_array_mut().unwrap().push(json!(
                {"bufferView": view, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4"}));
            let scene = load_gltf(&document).unwrap();
            assert_eq!(scene.colors[0], [glam::Vec3::X; 3]);
            scene
        }
        "skins" => of_node(json!({"mesh": 0, "skin": 0}), &[]),
        "weights of morph targets" => of_node(json!({"mesh": 0, "weights": [1]}),
            &[("/meshes/0/primitives/0/targets", json!([{}]))]),
        "animations" => of_node(json!({"mesh": 0}), &[("/animations", json!([{}]))]),
        "points and lines" => {
            let line = json!([{"attributes": {"POSITION": 0}, "indices": 1},
                {"attributes": {"POSITION": 0}, "mode": 1}]);
            load_gltf(&quad().edit(&[("/meshes/0/primitives", line)])).unwrap()
        }
        "orthographic cameras" => of_node(json!({"mesh": 0, "camera": 0}),
            &[("/cameras", json!([{"type": "orthographic", "orthographic": {}}]))]),
        "cameras after the first" => load_gltf(&quad().edit(&[
            ("/cameras", json!([{"type": "perspective", "perspective": {"yfov": 0.5}}])),
            ("/nodes", json!([{"mesh": 0, "camera": 0, "translation": [0, 0, 5], "children": [1]}, {"camera": 0}])),
        ])).unwrap(),
        "scenes beside one" => of_node(json!({"mesh": 0}),
            &[("/scenes", json!([{"nodes": [0]}, {"nodes": []}]))]),
        "range of lights" => of_node(
            json!({"mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}),
            &[("/extensions", json!({"KHR_lights_punctual": {"lights":
                [{"type": "point", "range": 5.0}]}}))]),
        "KHR_materials_transmission of less than one half" =>
            extended("KHR_materials_transmission", json!({"transmissionFactor": 0.25})),
        "KHR_materials_unlit" => extended("KHR_materials_unlit", json!({})),
        "KHR_materials_pbrSpecularGlossiness" =>
            extended("KHR_materials_pbrSpecularGlossiness", json!({})),
        "other extensions of materials" => extended("KHR_materials_clearcoat", json!({})),
        "EXT_mesh_gpu_instancing and other extensions of nodes" =>
            of_node(json!({"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {}}}), &[]),
        "other extensions" => of_node(json!({"mesh": 0}),
            &[("/extensionsUsed", json!(["EXT_lights_image_based"]))]),
        "images in KTX2, DDS or AVIF" => load_gltf(&textured().edit(&[
            ("/textures", json!([{"extensions": {"KHR_texture_basisu": {"source": 0}}}])),
        ])).unwrap(),
        _ => unreachable!("no example of glTF's {what}"),
    }
}

fn base64(bytes: &[u8]) -> String {
    use base64::Engine as _;
    let encoded = base64::engine::general_purpose::STANDARD.encode(bytes);
    format!("data:application/octet-stream;base64,{encoded}")
}

/// A triangle with a texture of these bytes.
fn of_image(bytes: &[u8]) -> Scene {
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
    load_bytes(&[
        ("m.obj", obj.as_bytes()),
        ("m.mtl", b"newmtl m\nmap_Kd a.img\n"),
        ("a.img", bytes),
    ])
    .unwrap()
}

fn of_textures(what: &str) -> Scene {
    match what {
        "frames after the first" => {
            let mut file = Cursor::new(Vec::new());
            let mut encoder = image::codecs::gif::GifEncoder::new(&mut file);
            let frame = || {
                let image = RgbaImage::from_pixel(2, 2, image::Rgba([255, 0, 0, 255]));
                Frame::from_parts(image, 0, 0, Delay::from_numer_denom_ms(100, 1))
            };
            encoder.encode_frames([frame(), frame()]).unwrap();
            drop(encoder);
            of_image(&file.into_inner())
        }
        "colour profiles" => {
            let mut file = png(&QUARTERS);
            let mut chunk = b"\0\0\0\x04gAMA\0\x01\x86\xa0".to_vec();
            // The checksum that PNG asks for.
            chunk.extend([0x31, 0xe8, 0x96, 0x5f]);
            file.splice(33..33, chunk);
            of_image(&file)
        }
        "EXIF orientation" => {
            let jpeg =
                pictures::rgb(image::ImageFormat::Jpeg, 2, &QUARTERS.map(|[r, g, b, _]| [r, g, b]));
            let exif = b"Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0";
            let length = (exif.len() as u16 + 2).to_be_bytes();
            let mut file = jpeg;
            file.splice(2..2, [&[0xff, 0xe1][..], &length, exif].concat());
            of_image(&file)
        }
        "files that are no PNG, JPEG, WebP, TIFF, GIF, BMP or TGA" => of_image(b"DDS |\0\0\0"),
        _ => unreachable!("no example of {what} in textures"),
    }
}

/// A sphere under a map of these bytes.
fn under(bytes: &[u8]) -> Scene {
    let scene = format!(
        "{CAMERA}[[light]]\ntype = \"environment\"\ntexture = \"a.img\"\n\
         [[light]]\ntype = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nradiance = [1, 1, 1]\n"
    );
    load_bytes(&[("scene.toml", scene.as_bytes()), ("a.img", bytes)]).unwrap()
}

/// A map of these extents, all of one radiance.
fn grey(width: u32, height: u32) -> Vec<u8> {
    pictures::rgb(Png, width, &vec![[128; 3]; (width * height) as usize])
}

fn of_maps(what: &str) -> Scene {
    let case = |name: &str| std::fs::read(super::path(name)).unwrap();
    match what {
        "layers beside one" => under(&case("compare_layers/multilayer/passes.exr")),
        "data windows other than the display window" => {
            under(&case("compare_windows/windows/cropped.exr"))
        }
        "chromaticities or PRIMARIES that span no colours" => {
            under(b"#?RADIANCE\nPRIMARIES=.3 .3 .3 .3 .3 .3 .3 .3\n\n-Y 1 +X 1\n\x80\x80\x80\x81")
        }
        "angular maps, mirrored balls, faces of cubes" => under(&grey(64, 64)),
        "crosses and strips of cubes" => under(&grey(128, 96)),
        "negative and not finite texels" => under(&pictures::exr(2, &[[-1.0; 3], [1.0; 3]])),
        _ => unreachable!("no example of {what} in maps"),
    }
}

#[test]
fn each_row_of_the_list_is_a_warning() {
    let mut count = 0;
    for row in omissions() {
        let scene = match row.format {
            "OBJ" => of_obj(row.what),
            "MTL" => of_mtl(row.what),
            "glTF" => of_gltf(row.what),
            "textures" => of_textures(row.what),
            "EXR and HDR" => of_maps(row.what),
            other => unreachable!("no examples of {other}"),
        };
        warned(&scene, row.instead, row.changes_image);
        count += 1;
    }
    assert!(count > 50, "{count} rows");
}

#[test]
fn warnings_of_texts_name_their_line() {
    for (text, place) in [
        ("vn 0 0 1\nvn 0 1 1\nf 1//1 2//2 4//1", "mesh.obj:7: 1 faces"),
        ("call x", "mesh.obj:5: 1 calls"),
    ] {
        warned(&obj(text), place, true);
    }
    warned(&mtl("newmtl m\nKd 0.25"), "m.mtl:3: a second material `m`", false);
    // Normals that are the same all over ask for nothing else.
    let flat = obj("vn 0 0 1\nvn 0 0 1\nf 1//1 2//2 4//1");
    assert!(flat.warnings.iter().all(|w| !w.message.contains("normals")), "{:?}", flat.warnings);
    // In a scene file, an unknown key is an error.
    let unknown = load(&[("s.toml", &format!("{CAMERA}fnord = 1\n"))]).unwrap_err();
    assert!(unknown.to_string().starts_with("s.toml:5: unknown key"), "{unknown}");
}
