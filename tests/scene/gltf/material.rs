//! Metal-roughness materials and their nearest.

use glam::Vec3;
use gpu_vpl::scene::{Bsdf, Scene};
use serde_json::{Value, json};

use super::build::{load_gltf, textured};
use crate::{refused, warned};

const PBR: &str = "/materials/0/pbrMetallicRoughness";

/// A scene of this metal-roughness material, and what more the material has.
fn surface(pbr: Value, more: &[(&str, Value)]) -> Scene {
    let pbr = [(PBR, pbr)];
    load_gltf(&textured().edit(&[&pbr[..], more].concat())).unwrap()
}

/// Albedo and BSDF of a material that loses nothing.
fn exact(pbr: Value, more: &[(&str, Value)]) -> (Vec3, Bsdf) {
    let scene = surface(pbr, more);
    let material = &scene.materials[0];
    assert!(scene.warnings.iter().all(|w| !w.message.contains("wood")), "{:?}", scene.warnings);
    (material.albedo, material.bsdf)
}

const COLOR: Vec3 = Vec3::new(0.25, 0.5, 1.0);

#[test]
fn metalness_and_roughness_tell_the_finish() {
    let of = |metalness: f64, roughness: f64| {
        let pbr = json!({"baseColorFactor": [0.25, 0.5, 1, 1], "metallicFactor": metalness,
            "roughnessFactor": roughness});
        exact(pbr, &[])
    };
    assert_eq!(of(0.0, 1.0), (COLOR, Bsdf::Diffuse));
    assert_eq!(of(0.0, 0.6), (COLOR, Bsdf::Diffuse));
    assert_eq!(of(1.0, 0.04), (Vec3::ZERO, Bsdf::Mirror { specular: COLOR }));
    let phong = |(albedo, bsdf): (Vec3, Bsdf)| match bsdf {
        Bsdf::Phong { specular, shininess } => (albedo, specular, shininess),
        other => panic!("{other:?}"),
    };
    let near = |got: Vec3, expected: Vec3| {
        assert!(got.distance(expected) < 1e-6, "{got} {expected}");
    };
    // α = 0.25: 2 / 0.0625 - 2 = 30.
    let (albedo, specular, shininess) = phong(of(0.0, 0.5));
    near(albedo, 0.96 * COLOR);
    near(specular, Vec3::splat(0.04));
    assert_eq!(shininess, 30.0);
    let (albedo, specular, shininess) = phong(of(1.0, 0.5));
    assert_eq!((albedo, specular, shininess), (Vec3::ZERO, COLOR, 30.0));
    let (albedo, specular, shininess) = phong(of(0.25, 1.0));
    near(albedo, 0.75 * 0.96 * COLOR);
    near(specular, 0.75 * Vec3::splat(0.04) + 0.25 * COLOR);
    assert_eq!(shininess, 0.0);
    assert_eq!(phong(of(0.25, 0.0)).2, 1e5);
    // What glTF allows never reflects more than it receives.
    for metalness in [0.0, 0.1, 0.49, 0.5, 0.9, 1.0, 7.0, -1.0] {
        for roughness in [0.0, 0.049, 0.05, 0.3, 0.599, 0.6, 1.0, 7.0, -1.0] {
            let white = json!({"metallicFactor": metalness, "roughnessFactor": roughness});
            exact(white, &[]);
        }
    }
}

#[test]
fn transmission_is_glass() {
    let glass = |extensions: Value| {
        let pbr = json!({"baseColorFactor": [0.25, 0.5, 1, 0.1], "metallicFactor": 1});
        exact(
            pbr,
            &[("/materials/0/extensions", extensions), ("/materials/0/alphaMode", json!("BLEND"))],
        )
    };
    let clear = json!({"KHR_materials_transmission": {"transmissionFactor": 1}});
    assert_eq!(glass(clear), (Vec3::ZERO, Bsdf::Glass { specular: COLOR, ior: 1.5 }));
    let dense = json!({"KHR_materials_transmission": {"transmissionFactor": 0.75},
        "KHR_materials_ior": {"ior": 2.25}});
    assert_eq!(glass(dense), (Vec3::ZERO, Bsdf::Glass { specular: COLOR, ior: 2.25 }));
    let little = json!({"KHR_materials_transmission": {"transmissionFactor": 0.5}});
    let scene = surface(json!({"metallicFactor": 0}), &[("/materials/0/extensions", little)]);
    assert_eq!(scene.materials[0].bsdf, Bsdf::Diffuse);
    warned(&scene, "material `wood` has a little transmission", true);
    let bad = json!({"KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_ior": {"ior": "x"}});
    let bad = textured().edit(&[("/materials/0/extensions", bad)]);
    refused(load_gltf(&bad), "mesh.gltf", "ior is no number");
    let none = json!({"KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_ior": {"ior": 0}});
    let none = textured().edit(&[("/materials/0/extensions", none)]);
    refused(load_gltf(&none), "mesh.gltf", "material `wood`: ior is not within");
}

#[test]
fn textures_of_what_has_one_colour_are_averaged() {
    // The mean of the quarters: 0.502886 is the light of 188.
    let mean = 0.25 * Vec3::splat(1.502_886);
    let scene = surface(json!({"roughnessFactor": 0, "baseColorTexture": {"index": 0}}), &[]);
    let Bsdf::Mirror { specular } = scene.materials[0].bsdf else { panic!() };
    assert!(specular.distance(mean) < 1e-6, "{specular}");
    assert_eq!((scene.materials[0].texture, scene.images.len()), (None, 0));
    warned(&scene, "material `wood` has a texture on what it mirrors, of which the mean", true);
    // Roughness is the mean of green, metalness that of blue, as numbers.
    let rough = json!({"metallicRoughnessTexture": {"index": 0}, "metallicFactor": 0.5});
    let scene = surface(rough, &[]);
    let Bsdf::Phong { specular, shininess } = scene.materials[0].bsdf else { panic!() };
    let number = f64::from(255 + 188) / (4.0 * 255.0);
    let expected = 0.04 * (1.0 - 0.5 * number) + 0.5 * number;
    assert!((f64::from(specular.x) - expected).abs() < 1e-6, "{specular} {expected}");
    assert!((f64::from(shininess) - (2.0 / number.powi(4) - 2.0)).abs() < 1e-3);
    warned(&scene, "material `wood` has a metallicRoughnessTexture, of which the mean", true);
    // One that is not there.
    let gone = [("/images/0", json!({"uri": "gone.png"}))];
    let scene = surface(json!({"roughnessFactor": 0, "baseColorTexture": {"index": 0}}), &gone);
    let magenta = Bsdf::Mirror { specular: Vec3::new(1.0, 0.0, 1.0) };
    assert_eq!(scene.materials[0].bsdf, magenta);
    warned(&scene, "gone.png is not there", true);
    let gone = [("/images/0", json!({"uri": "gone.png"}))];
    let scene = surface(json!({"metallicRoughnessTexture": {"index": 0}}), &gone);
    assert_eq!(scene.materials[0].bsdf, Bsdf::Phong { specular: Vec3::ONE, shininess: 0.0 });
    warned(&scene, "; 1 is used", true);
}

/// The alpha of the texture that cuts out, of [`crate::pictures::QUARTERS`] with its 255, 200,
/// 100 and 0.
fn cutout(scene: &Scene) -> Option<Vec<u8>> {
    let texture = scene.textures[scene.materials[0].cutout? as usize];
    Some(scene.images[texture.image as usize].rgba.iter().map(|texel| texel[3]).collect())
}

fn masked(mode: &str, more: &[(&str, Value)]) -> Scene {
    let mode = [("/materials/0/alphaMode", json!(mode))];
    load_gltf(&textured().edit(&[&mode[..], more].concat())).unwrap()
}

#[test]
fn a_mask_cuts_out_below_its_cutoff() {
    let at = |cutoff: f64, alpha: f64| {
        let factor = "/materials/0/pbrMetallicRoughness/baseColorFactor";
        let scene = masked(
            "MASK",
            &[("/materials/0/alphaCutoff", json!(cutoff)), (factor, json!([1, 1, 1, alpha]))],
        );
        assert!(scene.warnings.iter().all(|w| !w.message.contains("wood")), "{:?}", scene.warnings);
        cutout(&scene)
    };
    let scene = masked("MASK", &[]);
    assert_eq!(cutout(&scene), Some(vec![255, 200, 100, 0]));
    assert_eq!(scene.images.len(), 1);
    let kept = |alpha: Option<Vec<u8>>| -> Vec<bool> {
        alpha.unwrap().into_iter().map(|alpha| alpha >= 128).collect()
    };
    assert_eq!(kept(at(0.75, 1.0)), [true, true, false, false]);
    assert_eq!(kept(at(200.0 / 255.0, 1.0)), [true, true, false, false]);
    assert_eq!(kept(at(201.0 / 255.0, 1.0)), [true, false, false, false]);
    assert_eq!(kept(at(100.0 / 255.0, 1.0)), [true, true, true, false]);
    assert_eq!(kept(at(1e-6, 1.0)), [true, true, true, false]);
    // Factor and texture multiply.
    assert_eq!(kept(at(0.5, 0.6)), [true, false, false, false]);
    assert_eq!(at(0.5, 0.4), Some(vec![0]));
    assert_eq!(at(0.5, 0.0), Some(vec![0]));
    assert_eq!(at(0.0, 1.0), None);
    assert_eq!(at(0.0, 0.0), None);
    assert_eq!(cutout(&masked("OPAQUE", &[])), None);
}

#[test]
fn what_blends_is_cut_out_where_it_is_faint() {
    let scene = masked("BLEND", &[]);
    assert_eq!(cutout(&scene), Some(vec![255, 200, 100, 0]));
    warned(&scene, "material `wood` has transparency, cut out where", true);
    // Nothing is transparent, and nothing lost.
    let scene = masked("BLEND", &[(PBR, json!({"metallicFactor": 0}))]);
    assert_eq!((cutout(&scene), scene.warnings.len()), (None, 1));
    let faint = json!({"metallicFactor": 0, "baseColorFactor": [1, 1, 1, 0.25]});
    let scene = masked("BLEND", &[(PBR, faint)]);
    assert_eq!(cutout(&scene), Some(vec![0]));
    warned(&scene, "transparency", true);
}

#[test]
fn what_is_not_shown_is_named_once() {
    let scene = surface(
        json!({"metallicFactor": 0}),
        &[
            ("/materials/0/normalTexture", json!({"index": 0})),
            ("/materials/0/occlusionTexture", json!({"index": 0})),
            (
                "/materials/0/extensions",
                json!({"KHR_materials_clearcoat": {}, "KHR_materials_specular": {}}),
            ),
        ],
    );
    let what = "material `wood` has a normalTexture, KHR_materials_clearcoat, \
        KHR_materials_specular, not shown as it is";
    warned(&scene, what, true);
    assert_eq!(scene.warnings.len(), 2, "{:?}", scene.warnings);
}
