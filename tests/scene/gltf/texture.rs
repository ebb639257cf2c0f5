//! Textures, their coordinates and samplers.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::{Vec2, Vec3};
use gpu_vpl::scene::texture::{Filter, Interpolation};
use gpu_vpl::scene::{Scene, Wrap};
use serde_json::{Value, json};

use super::build::{glb, gltf, load_files, load_gltf, textured};
use crate::pictures::{QUARTERS, png};
use crate::{CAMERA, load, refused, warned};

const BASE: &str = "/materials/0/pbrMetallicRoughness/baseColorTexture";

fn edited(edits: &[(&str, Value)]) -> Scene {
    load_gltf(&textured().edit(edits)).unwrap()
}

/// What the texture of the albedo shows at a corner of a triangle, a quarter inside.
fn shown(scene: &Scene, triangle: usize, corner: usize) -> [f32; 3] {
    let material = &scene.materials[scene.triangles[triangle].material as usize];
    let texture = scene.textures[material.texture.unwrap() as usize];
    let uvs = scene.uvs[triangle];
    let middle = (uvs[0] + uvs[1] + uvs[2]) / 3.0;
    let uv = uvs[corner].lerp(middle, 0.25);
    texture.sample(&scene.images, uv).truncate().round().to_array()
}

const RED: [f32; 3] = [1.0, 0.0, 0.0];
const GREEN: [f32; 3] = [0.0, 1.0, 0.0];
const BLUE: [f32; 3] = [0.0, 0.0, 1.0];

#[test]
fn images_are_found_wherever_they_are() {
    let image = png(&QUARTERS);
    let uri =
        |uri: &str| gltf(&textured().edit(&[("/images/0", json!({"uri": uri}))])).into_bytes();
    let data = format!("data:image/png;base64,{}", STANDARD.encode(&image));
    for (name, bytes) in [
        ("mesh.gltf", gltf(&textured()).into_bytes()),
        ("mesh.glb", glb(&textured())),
        ("mesh.gltf", uri("the%20wood.png")),
        ("mesh.gltf", uri("the wood.png")),
        ("mesh.gltf", uri(&data)),
    ] {
        let scene = load_files(&[(name, &bytes), ("the wood.png", &image)]).unwrap();
        assert_eq!((scene.images[0].size, &scene.images[0].rgba[..]), ([2, 2], &QUARTERS[..]));
        // Corners of the first triangle: bottom left, bottom right, top left.
        assert_eq!([shown(&scene, 0, 0), shown(&scene, 0, 2)], [BLUE, RED], "{name}");
        assert_eq!(shown(&scene, 1, 2), GREEN);
        assert_eq!(scene.materials[0].albedo, Vec3::ONE);
        assert_eq!(scene.warnings.len(), 1, "no light, {:?}", scene.warnings);
    }
}

#[test]
fn images_that_cannot_be_read_are_magenta() {
    for (edit, what) in [
        (("/images/0", json!({"uri": "gone.png"})), "gone.png is not there"),
        (("/images/0", json!({"uri": "http://a.b/c.png"})), "is not beside this file"),
        (("/images/0", json!({"uri": "data:image/png;base64,!!!!"})), "is no base64"),
        (("/images/0", json!({})), "neither a URI nor a buffer view"),
        (("/images/0/bufferView", json!(0)), "unknown format"),
        (("/textures/0", json!({})), "has no PNG or JPEG"),
    ] {
        let scene = edited(&[edit]);
        warned(&scene, what, true);
        warned(&scene, "; magenta is shown", true);
        assert_eq!(scene.images[0].rgba, [[255, 0, 255, 255]]);
        assert!(scene.warnings[0].message.starts_with("mesh.gltf: image "), "{what}");
    }
    for (edit, what) in [
        (("/images/0/bufferView", json!(99)), "buffer view 99"),
        (("/textures/0/source", json!(9)), "image 9, but there are 1"),
        ((BASE, json!({"index": 9})), "texture 9, but there are 1"),
        (("/textures/0/sampler", json!(0)), "sampler 0, but there are 0"),
    ] {
        refused(load_gltf(&textured().edit(&[edit])), "mesh.gltf", what);
    }
}

#[test]
fn coordinates_of_all_types_and_sets_are_read() {
    let uvs = edited(&[]).uvs;
    assert_eq!(uvs[0], [Vec2::Y, Vec2::ONE, Vec2::ZERO]);
    let eight = edited(&[("/meshes/0/primitives/0/attributes/TEXCOORD_0", json!(3))]);
    assert_eq!(eight.uvs, uvs);
    let sixteen = edited(&[("/meshes/0/primitives/0/attributes/TEXCOORD_0", json!(4))]);
    let fifth = |uv: Vec2| uv * (51.0 / 65535.0);
    assert_eq!(sixteen.uvs, uvs.iter().map(|uvs| uvs.map(fifth)).collect::<Vec<_>>());
    // Another set, named by the texture or by its transform, which counts more.
    let set = |info: Value| {
        let attributes = json!({"POSITION": 0, "TEXCOORD_0": 3, "TEXCOORD_7": 4});
        edited(&[("/meshes/0/primitives/0/attributes", attributes), (BASE, info)]).uvs
    };
    assert_eq!(set(json!({"index": 0})), uvs);
    assert_eq!(set(json!({"index": 0, "texCoord": 7})), sixteen.uvs);
    let transform = json!({"KHR_texture_transform": {"texCoord": 7}});
    assert_eq!(set(json!({"index": 0, "extensions": transform})), sixteen.uvs);

    let none = edited(&[("/meshes/0/primitives/0/attributes", json!({"POSITION": 0}))]);
    assert_eq!(none.uvs, [[Vec2::ZERO; 3]; 2]);
    warned(&none, "1 meshes lack the texture coordinates", true);
    let bad = [("/meshes/0/primitives/0/attributes/TEXCOORD_0", json!(0))];
    refused(load_gltf(&textured().edit(&bad)), "mesh.gltf", "not VEC2");
    let few = [("/accessors/2/count", json!(3))];
    refused(load_gltf(&textured().edit(&few)), "mesh.gltf", "3 is asked for");
}

#[test]
fn samplers_wrap() {
    let wrap = |s: Value, t: Value| {
        let sampler = json!([{"wrapS": s, "wrapT": t}]);
        let scene = edited(&[("/samplers", sampler), ("/textures/0/sampler", json!(0))]);
        let texture = scene.textures[0];
        let at = |u: f32, v: f32| texture.sample(&scene.images, Vec2::new(u, v)).truncate();
        (texture.wrap, [at(1.25, 0.25), at(0.25, -0.25), at(9.0, 0.25)].map(|c| c.to_array()))
    };
    let half = [0.5, 0.5, 0.0];
    let (modes, colors) = wrap(json!(33071), json!(33648));
    assert_eq!(modes, [Wrap::Clamp, Wrap::Mirror]);
    // Clamped to the last column; mirrored back into the first row; clamped.
    assert_eq!(colors, [GREEN, RED, GREEN]);
    let (modes, colors) = wrap(json!(10497), json!(33071));
    assert_eq!(modes, [Wrap::Repeat, Wrap::Clamp]);
    assert_eq!(colors, [RED, RED, half]);
    let (modes, colors) = wrap(json!(33648), json!(10497));
    assert_eq!(modes, [Wrap::Mirror, Wrap::Repeat]);
    assert_eq!(colors, [GREEN, BLUE, GREEN]);
    let bad = [("/samplers", json!([{"wrapS": 3}])), ("/textures/0/sampler", json!(0))];
    refused(load_gltf(&textured().edit(&bad)), "mesh.gltf", "unknown way 3");
}

#[test]
fn samplers_filter() {
    let of = |sampler: Value| {
        let edits = [("/samplers", json!([sampler])), ("/textures/0/sampler", json!(0))];
        let scene = edited(&edits);
        let place = Vec2::new(0.45, 0.25);
        (scene.textures[0].filter, scene.textures[0].sample(&scene.images, place).truncate())
    };
    let (linear, nearest) = (Interpolation::Linear, Interpolation::Nearest);
    let (filter, between) = of(json!({}));
    assert_eq!(filter, Filter { magnified: linear, minified: linear, mipmaps: true });
    let (filter, red) = of(json!({"magFilter": 9728, "minFilter": 9729}));
    assert_eq!(filter, Filter { magnified: nearest, minified: linear, mipmaps: false });
    assert_eq!(red.to_array(), RED);
    assert!(between.y > 0.1 && between.x < 0.9, "{between}");
    for (code, minified, mipmaps) in [
        (9728, nearest, false),
        (9729, linear, false),
        (9984, nearest, true),
        (9985, linear, true),
        (9986, nearest, true),
        (9987, linear, true),
    ] {
        let (filter, _) = of(json!({"magFilter": 9729, "minFilter": code}));
        assert_eq!(filter, Filter { magnified: linear, minified, mipmaps }, "{code}");
    }
    for (key, what) in [("magFilter", "magnifies"), ("minFilter", "minifies")] {
        let bad = [("/samplers", json!([{key: 9987 + 1}])), ("/textures/0/sampler", json!(0))];
        refused(
            load_gltf(&textured().edit(&bad)),
            "mesh.gltf",
            &format!("{what} in the unknown way 9988"),
        );
    }
}

/// A texture info with a transform.
fn transformed(transform: Value) -> Value {
    json!({"index": 0, "extensions": {"KHR_texture_transform": transform}})
}

#[test]
fn transforms_move_scale_and_turn() {
    let place = |transform: Value, uv: [f32; 2]| {
        let scene = edited(&[(BASE, transformed(transform))]);
        assert_eq!(scene.warnings.len(), 1, "{:?}", scene.warnings);
        let texture = scene.textures[0];
        // The corners' own coordinates are (0, 1), (1, 1), (0, 0): affine in between.
        let [y, xy, o] = scene.uvs[0];
        let kept = o + uv[0] * (xy - y) + uv[1] * (y - o);
        kept * texture.scale + texture.offset
    };
    let near = |got: Vec2, expected: [f32; 2]| {
        assert!(got.distance(Vec2::from_array(expected)) < 1e-6, "{got} {expected:?}");
    };
    near(place(json!({"offset": [0.1, 0.2]}), [0.5, 0.25]), [0.6, 0.45]);
    near(place(json!({"scale": [2, -3], "offset": [0.1, 0]}), [0.5, 0.25]), [1.1, -0.75]);
    // A quarter turn takes u to -v, v to u.
    let quarter = std::f64::consts::FRAC_PI_2;
    near(place(json!({"rotation": quarter}), [0.5, 0.25]), [0.25, -0.5]);
    let all = json!({"rotation": quarter, "scale": [2, 4], "offset": [0.1, 0.2]});
    near(place(all, [0.5, 0.25]), [1.1, -0.8]);
    // No scale at all cannot be undone.
    let none = edited(&[(BASE, transformed(json!({"rotation": 1, "scale": [0, 0]})))]);
    assert_eq!(none.textures[0].scale, Vec2::ZERO);
}

#[test]
fn an_emission_may_have_a_texture_of_its_own() {
    let of = |base: Value, emissive: Value| {
        edited(&[
            (BASE, base),
            ("/materials/0/emissiveTexture", emissive),
            ("/materials/0/emissiveFactor", json!([1, 0.5, 0.25])),
        ])
    };
    let turned = transformed(json!({"rotation": 0.5, "scale": [2, 2]}));
    let scene = of(turned.clone(), turned.clone());
    assert_eq!((scene.textures.len(), scene.warnings.len()), (1, 0), "{:?}", scene.warnings);
    let material = &scene.materials[0];
    assert_eq!((material.texture, material.emission_texture), (Some(0), Some(0)));
    assert_eq!(material.emission, Vec3::new(1.0, 0.5, 0.25));
    // Turned as the first, and twice as large.
    let scene = of(turned.clone(), transformed(json!({"rotation": 0.5, "scale": [4, 4]})));
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    assert!(scene.textures[1].scale.distance(Vec2::splat(2.0)) < 1e-6);
    warned(&of(turned, json!({"index": 0})), "textures turned differently", true);
    let other = json!({"index": 0, "texCoord": 1});
    warned(&of(json!({"index": 0}), other), "textures on different coordinates", true);
    // Black is black.
    let scene = edited(&[("/materials/0/emissiveTexture", json!({"index": 0}))]);
    assert_eq!(scene.materials[0].emission_texture, None);
}

#[test]
fn a_mirrored_mesh_keeps_its_picture() {
    let light = "[[light]]\ntype = \"point\"\nposition = [0, 0, 4]\nintensity = [1, 1, 1]\n";
    let text = format!("{CAMERA}{light}[[mesh]]\nfile = \"mesh.gltf\"\nscale = [-1, 1, 1]\n");
    let scene = load(&[("scene.toml", &text), ("mesh.gltf", &gltf(&textured()))]).unwrap();
    // Bottom left was blue; it is at the bottom right now, with its colour.
    for (triangle, uvs) in scene.triangles.iter().zip(&scene.uvs) {
        for (corner, uv) in triangle.vertices.iter().zip(uvs) {
            assert_eq!(*uv, Vec2::new(0.5 - 0.5 * corner.x, 0.5 - 0.5 * corner.y));
        }
    }
    assert!(scene.triangles[0].scaled_normal().z > 0.0);
    let node = edited(&[("/nodes/0/scale", json!([-1, 1, 1]))]);
    for (triangle, uvs) in node.triangles.iter().zip(&node.uvs) {
        for (corner, uv) in triangle.vertices.iter().zip(uvs) {
            assert_eq!(*uv, Vec2::new(0.5 - 0.5 * corner.x, 0.5 - 0.5 * corner.y));
        }
    }
}
