//! Lights, spheres and environments of the scene file.

use glam::{DVec3, Vec3};
use gpu_vpl::error::SceneError;
use gpu_vpl::scene::{Environment, Scene};
use image::ImageFormat::{Jpeg, Png};

use super::{CAMERA, MESH, MTL, load_bytes, load_more, pictures, refused, warned};

fn light(text: &str) -> Result<Scene, SceneError> {
    load_more(&format!("material = \"one\"\n[[light]]\n{text}"))
}

#[test]
fn a_spot_light_fades_over_its_softness() {
    let spot = "type = \"spot\"\nposition = [0, 0, 3]\ntarget = [0, 0, 1]\nintensity = [1, 2, 3]\n";
    let cosines = |text: &str| {
        let scene = light(&format!("{spot}{text}")).unwrap();
        let spot = scene.point_lights[0];
        let position = spot.position.as_dvec3() * scene.units.scale + scene.units.center;
        assert!(position.distance(DVec3::new(0.0, 0.0, 3.0)) < 1e-6);
        let intensity = spot.intensity.as_dvec3() * scene.units.scale.powi(2);
        assert!(intensity.distance(DVec3::new(1.0, 2.0, 3.0)) < 1e-6);
        let cone = spot.cone.unwrap();
        assert_eq!(cone.axis, -Vec3::Z);
        [cone.cos_inner, cone.cos_outer]
    };
    let near = |got: [f32; 2], angles: [f32; 2]| {
        for (cosine, angle) in got.into_iter().zip(angles) {
            assert!((cosine - angle.to_radians().cos()).abs() < 2e-5, "{cosine} {angle}");
        }
    };
    near(cosines("angle = 60\nsoftness = 0.5\n"), [15.0, 30.0]);
    near(cosines("angle = 60\n"), [30.0, 30.0]);
    near(cosines("angle = 360\nsoftness = 1\n"), [0.0, 180.0]);

    refused(light(&format!("{spot}angle = 0\n")), "scene.toml:13", "greater than 0");
    refused(light(&format!("{spot}angle = 361\n")), "scene.toml:13", "at most 360");
    let soft = |softness: &str| light(&format!("{spot}angle = 9\nsoftness = {softness}\n"));
    refused(soft("-0.1"), "scene.toml:14", "`softness` must lie within 0 and 1");
    refused(soft("1.1"), "scene.toml:14", "`softness` must lie within 0 and 1");
    refused(light(spot), "scene.toml:8", "`angle` is missing");
    let nowhere = spot.replace("[0, 0, 1]", "[0, 0, 3]");
    refused(light(&format!("{nowhere}angle = 9\n")), "scene.toml:11", "apart from `position`");
    refused(light(&format!("{spot}radius = 9\n")), "scene.toml:13", "`radius` in [[light]] of");
}

#[test]
fn a_directional_light_keeps_its_irradiance() {
    let sun = "type = \"directional\"\ndirection = [0, -3, 4]\nirradiance = [1, 2, 3]\n";
    let scene = light(sun).unwrap();
    assert_eq!(scene.directional_lights.len(), 1);
    let light_of = scene.directional_lights[0];
    assert!(light_of.direction.distance(Vec3::new(0.0, -0.6, 0.8)) < 1e-6);
    assert_eq!(light_of.irradiance, Vec3::new(1.0, 2.0, 3.0));
    let none = sun.replace("[0, -3, 4]", "[0, 0, 0]");
    refused(light(&none), "scene.toml:10", "`direction` must not be 0");
    refused(light(&sun.replace("2, 3", "2, -3")), "scene.toml:11", "negative");
}

#[test]
fn spheres_have_a_material_of_the_scene_file() {
    let sphere = "[[sphere]]\ncenter = [1, 2, 3]\nradius = 2\nmaterial = \"a\"\n";
    let glow = "[materials.a]\nemission = [1, 1, 1]\n";
    let scene = load_more(&format!("{sphere}{glow}")).unwrap();
    let [sphere_of] = scene.spheres[..] else { panic!("{:?}", scene.spheres) };
    let center = sphere_of.center.as_dvec3() * scene.units.scale + scene.units.center;
    assert!(center.distance(DVec3::new(1.0, 2.0, 3.0)) < 1e-6);
    assert!((f64::from(sphere_of.radius) * scene.units.scale / 2.0 - 1.0).abs() < 1e-6);
    assert!(scene.materials[sphere_of.material as usize].emits() && scene.is_lit());

    let with = |from: &str, to: &str| load_more(&format!("{glow}{}", sphere.replace(from, to)));
    refused(with("radius = 2", "radius = 0"), "scene.toml:11", "greater than 0");
    refused(with("radius = 2", "radius = -1"), "scene.toml:11", "greater than 0");
    refused(with("radius = 2\n", ""), "scene.toml:9", "`radius` is missing");
    refused(with("center", "centre"), "scene.toml:10", "`centre` in [[sphere]]");
    refused(with("\"a\"", "\"one\""), "scene.toml:12", "`one` is not in [materials]");
    refused(with("material = \"a\"", ""), "scene.toml:9", "`material` is missing");
}

#[test]
fn a_sphere_light_is_a_black_sphere_that_emits() {
    let text = "type = \"sphere\"\ncenter = [0, 0, 2]\nradius = 0.5\nradiance = [4, 5, 6]\n";
    let scene = light(text).unwrap();
    let material = &scene.materials[scene.spheres[0].material as usize];
    assert_eq!((material.name.as_str(), material.albedo), ("light 1", Vec3::ZERO));
    assert_eq!((material.emission, material.two_sided), (Vec3::new(4.0, 5.0, 6.0), false));
    let both = light(&format!("{text}two_sided = true\n")).unwrap();
    assert!(both.materials[both.spheres[0].material as usize].two_sided);
    refused(light(&text.replace("0.5", "0")), "scene.toml:11", "greater than 0");
}

/// Loads a scene whose environment, at line 8, is this file.
fn around(more: &str, name: &str, bytes: Option<&[u8]>) -> Scene {
    let text = format!(
        "{CAMERA}[[mesh]]\nfile = \"mesh.obj\"\nmaterial = \"one\"\n[[light]]\n\
         type = \"environment\"\ntexture = {name:?}\n{more}"
    );
    let mut files = vec![
        ("scene.toml", text.as_bytes()),
        ("mesh.obj", MESH.as_bytes()),
        ("mesh.mtl", MTL.as_bytes()),
    ];
    files.extend(bytes.map(|bytes| (name, bytes)));
    load_bytes(&files).unwrap()
}

fn environment(scene: &Scene) -> &Environment {
    scene.environment.as_ref().unwrap()
}

#[test]
fn an_environment_may_be_plain() {
    let text = "type = \"environment\"\nradiance = [1, 2, 3]\n";
    let scene = light(text).unwrap();
    assert_eq!(environment(&scene).radiance, Vec3::new(1.0, 2.0, 3.0));
    assert!(environment(&scene).image.is_none());
    refused(light("type = \"environment\"\n"), "scene.toml:8", "`radiance` or `texture`");
    let two = format!("{text}[[light]]\n{text}");
    refused(light(&two), "scene.toml:11", "second environment");
    refused(light(&text.replace('3', "-3")), "scene.toml:10", "negative");
}

#[test]
fn environment_maps_keep_their_radiance() {
    // Left and right of -Z above the horizon, and below it.
    let values = [[1.0, 0.5, 0.25], [2.0, 4.0, 8.0], [1e-3, 0.0, 0.0], [512.0, 1.0, 0.0]];
    let directions = [[-1.0, 1.0, -0.1], [1.0, 1.0, -0.1], [-1.0, -1.0, -0.1], [1.0, -1.0, -0.1]];
    for (name, bytes) in
        [("a.hdr", pictures::hdr(2, &values)), ("a.exr", pictures::exr(2, &values))]
    {
        let scene = around("radiance = [2, 2, 0.5]\n", name, Some(&bytes));
        assert!(scene.warnings.is_empty(), "{name} {:?}", scene.warnings);
        for (value, direction) in values.iter().zip(directions) {
            let direction = Vec3::from_array(direction).normalize();
            let expected = Vec3::from_array(*value) * Vec3::new(2.0, 2.0, 0.5);
            let got = environment(&scene).from_direction(direction);
            // Radiance files have 8 bits a channel.
            let most = expected.max_element() / 128.0;
            assert!((got - expected).abs().max_element() <= most, "{name} {got} {expected}");
        }
    }
    let colors = [[255, 0, 0], [188, 188, 188], [0, 0, 0], [255, 255, 255]];
    let scene = around("", "a.png", Some(&pictures::rgb(Png, 2, &colors)));
    let got = environment(&scene).from_direction(Vec3::new(1.0, 1.0, -0.1).normalize());
    assert!((got - Vec3::splat(0.502_886)).abs().max_element() < 1e-3, "{got}");
    let scene = around("", "a.jpg", Some(&pictures::rgb(Jpeg, 2, &[[255; 3]; 4])));
    let got = environment(&scene).from_direction(Vec3::X);
    assert!((got - Vec3::ONE).abs().max_element() < 0.02, "{got}");
}

#[test]
fn the_brightest_and_the_impossible_of_a_map_are_bounded() {
    let bright = [[1e9, 1.0, 0.0], [1e5, 0.0, 0.0]];
    let scene = around("", "a.exr", Some(&pictures::exr(2, &bright)));
    let got = environment(&scene).from_direction(-Vec3::X).x;
    assert!((got / 1e9 - 1.0).abs() < 1.0 / 256.0, "{got}");
    let got = environment(&scene).from_direction(Vec3::X).x;
    assert!((got / 1e5 - 1.0).abs() < 0.05, "{got}");

    let bad = [[0.0, 3.0, f32::INFINITY], [1.0, f32::NAN, -1.0]];
    let scene = around("", "a.exr", Some(&pictures::exr(2, &bad)));
    warned(&scene, "scene.toml:10: image a.exr: 2 pixels, the first at 0, 0, are negative", true);
    assert_eq!(environment(&scene).from_direction(Vec3::X), Vec3::X);
    assert_eq!(environment(&scene).from_direction(-Vec3::X), 3.0 * Vec3::Y);
}

#[test]
fn a_map_that_cannot_be_read_is_magenta() {
    let hdr = pictures::hdr(2, &[[1.0; 3]; 4]);
    let exr = pictures::exr(2, &[[1.0; 3]; 4]);
    let huge = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 99999 +X 99999\n".to_vec();
    let large = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 9999 +X 9999\n".to_vec();
    let none = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 0\n".to_vec();
    for (name, bytes, what) in [
        ("a.hdr", None, "is not there"),
        ("a.hdr", Some(hdr[..hdr.len() / 2].to_vec()), "is damaged"),
        ("a.exr", Some(exr[..exr.len() - 3].to_vec()), "is damaged"),
        ("a.png", Some(b"no image".to_vec()), "unknown format"),
        ("a.hdr", Some(huge), "more than 268435456"),
        ("a.hdr", Some(large), "more than its bytes can hold"),
        ("a.hdr", Some(none), "0 x 0 pixels are none"),
    ] {
        let scene = around("radiance = [2, 2, 3]\n", name, bytes.as_deref());
        warned(&scene, &format!("scene.toml:10: image {name} "), true);
        warned(&scene, what, true);
        warned(&scene, "magenta is shown", true);
        assert_eq!(environment(&scene).radiance, Vec3::new(2.0, 0.0, 3.0));
    }
}

/// A map of 8192 x 4096 takes 128 MiB.
#[test]
#[ignore = "takes a gigabyte of memory"]
fn large_maps_fit() {
    let size = (8192, 4096);
    let texels = vec![[1.0, 2.0, 3.0]; size.0 * size.1];
    for (name, bytes) in [
        ("a.hdr", pictures::hdr(size.0 as u32, &texels)),
        ("a.exr", pictures::exr(size.0, &texels)),
    ] {
        let scene = around("", name, Some(&bytes));
        let image = environment(&scene).image.as_ref().unwrap();
        assert_eq!((image.size, image.texels.len()), ([8192, 4096], size.0 * size.1));
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    }
}
