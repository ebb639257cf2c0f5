//! `info` as its users meet it: what it says of a scene, in words and as JSON.

#![expect(clippy::expect_used, reason = "a helper of tests fails by panicking")]

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use gpu_vpl::gpu::{AdapterChoice, Gpu};
use gpu_vpl::render::{Prepared, Settings};
use gpu_vpl::scene::Scene;
use serde_json::{Value, json};
use tempfile::TempDir;

/// Every kind of material and light, a texture that is not there, and a triangle without area.
const ALL: &str = r#"
[camera]
position = [0, 1, -5]
target = [0, 1, 0]
fov = 40
size = [64, 48]

[[mesh]]
file = "quad.obj"
material = "wood"

[[sphere]]
center = [0, 1, 0]
radius = 0.5
material = "lens"
[[sphere]]
center = [1.5, 1, 0]
radius = 0.5
material = "chrome"
[[sphere]]
center = [-1.5, 1, 0]
radius = 0.5
material = "varnish"

[materials.wood]
texture = "wood.png"
[materials.lens]
type = "glass"
ior = 1.4
[materials.chrome]
type = "mirror"
specular = [0.9, 0.8, 0.7]
[materials.varnish]
type = "phong"
albedo = [0.3, 0.2, 0.1]
specular = [0.4, 0.4, 0.4]
shininess = 50

[[light]]
type = "point"
position = [0, 4, 0]
intensity = [1, 1, 1]
[[light]]
type = "spot"
position = [0, 4, 0]
target = [0, 0, 0]
intensity = [1, 1, 1]
angle = 180
[[light]]
type = "directional"
direction = [0, -1, 0]
irradiance = [1, 1, 1]
[[light]]
type = "quad"
corners = [[-1, 3, -1], [1, 3, -1], [1, 3, 1], [-1, 3, 1]]
radiance = [1, 2, 3]
[[light]]
type = "sphere"
center = [0, 2, 0]
radius = 0.1
radiance = [3, 3, 3]
[[light]]
type = "environment"
radiance = [0.5, 0.5, 0.5]
"#;

const QUAD: &str = "v -3 0 -3\nv -3 0 3\nv 3 0 3\nv 3 0 -3\n\
                    vt 0 0\nvt 0 1\nvt 1 1\nvt 1 0\n\
                    f 1/1 2/2 3/3 4/4\nf 1/1 1/1 1/1\n";

fn directory() -> TempDir {
    let directory = tempfile::tempdir().expect("a directory for the test");
    for (name, text) in [("all.toml", ALL), ("quad.obj", QUAD)] {
        fs::write(directory.path().join(name), text).expect("it can be written");
    }
    directory
}

/// Runs `info` where there is a driver or none: its code, standard output and standard error.
fn info(directory: &Path, line: &str, driver: bool) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gpu-vpl"));
    command.arg("info").args(line.split_whitespace()).current_dir(directory);
    command.env_remove("WGPU_ADAPTER_NAME");
    if !driver {
        command.env("VK_ICD_FILENAMES", "/nonexistent").env("VK_DRIVER_FILES", "/nonexistent");
    }
    let output = command.output().expect("the program starts");
    let [stdout, stderr] =
        [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("it is UTF-8"));
    (output.status.code().expect("it ends by itself"), stdout, stderr)
}

fn said(line: &str) -> String {
    let (code, stdout, stderr) = info(directory().path(), line, true);
    assert_eq!((code, stderr.as_str()), (0, ""), "{line}");
    stdout
}

fn scene(name: &str) -> Value {
    let json: Value = serde_json::from_str(&said(&format!("{name} --json"))).expect("it is JSON");
    json["scene"].clone()
}

fn names<'a>(list: &'a Value, key: &str) -> Vec<&'a str> {
    list.as_array().expect("a list").iter().filter_map(|entry| entry[key].as_str()).collect()
}

fn near(value: &Value, expected: f64) {
    let value = value.as_f64().expect("a number");
    assert!((value - expected).abs() < 1e-5 * expected.abs(), "{value}, not {expected}");
}

#[test]
fn counts_and_bounds_are_those_of_the_file() {
    let scene = scene("all.toml");
    for (key, count) in [
        ("triangles", json!(4)),
        ("spheres", json!(4)),
        ("dropped_triangles", json!(1)),
        ("emitting_triangles", json!(2)),
        ("emitting_spheres", json!(1)),
        ("point_lights", json!(2)),
        ("directional_lights", json!(1)),
        ("environment", json!(true)),
        ("images", json!(1)),
        ("materials_by_kind", json!({"diffuse": 3, "phong": 1, "mirror": 1, "glass": 1})),
        ("bounds", json!([[-3.0, 0.0, -3.0], [3.0, 3.0, 3.0]])),
    ] {
        assert_eq!(scene[key], count, "{key}");
    }
    assert_eq!(scene["camera"]["size"], json!([64, 48]));
    let directory = directory();
    let read = Scene::load(&directory.path().join("all.toml").display().to_string());
    assert_eq!(read.expect("it can be read").light_count(), 7);
}

#[test]
fn lights_are_in_the_order_of_their_power() {
    use std::f64::consts::PI;
    let scene = scene("all.toml");
    let lights = &scene["lights"];
    // The sphere around the scene, half the diagonal of its box of 6 × 3 × 6.
    let disk = PI * (36.0 + 9.0 + 36.0) / 4.0;
    let expected = [
        ("environment", Value::Null, 4.0 * PI * disk * 0.5),
        ("directional", Value::Null, disk),
        ("area", json!("light 4"), PI * 4.0 * 2.0),
        ("point", Value::Null, 4.0 * PI),
        ("spot", Value::Null, 2.0 * PI),
        ("area", json!("light 5"), PI * 4.0 * PI * 0.01 * 3.0),
    ];
    assert_eq!(lights.as_array().expect("a list").len(), expected.len());
    let total: f64 = expected.iter().map(|light| light.2).sum();
    for (at, (kind, material, power)) in expected.into_iter().enumerate() {
        assert_eq!((&lights[at]["kind"], &lights[at]["material"]), (&json!(kind), &material));
        near(&lights[at]["power"], power);
        near(&lights[at]["share"], power / total);
    }
}

#[test]
fn materials_have_what_their_kind_has() {
    let scene = scene("all.toml");
    let materials = scene["materials"].as_array().expect("a list");
    let of = |name: &str| materials.iter().find(|m| m["name"] == name).expect("it is listed");
    let (lens, chrome, varnish, wood) = (of("lens"), of("chrome"), of("varnish"), of("wood"));
    assert_eq!((&lens["kind"], &lens["ior"]), (&json!("glass"), &json!(1.4)));
    assert_eq!((&lens["shininess"], &lens["shapes"]), (&Value::Null, &json!(1)));
    assert_eq!(chrome["kind"], "mirror");
    assert_eq!(chrome["specular"], json!([0.9, 0.8, 0.7]));
    assert_eq!((&varnish["kind"], &varnish["shininess"]), (&json!("phong"), &json!(50.0)));
    assert_eq!(varnish["albedo"], json!([0.3, 0.2, 0.1]));
    assert_eq!((&wood["kind"], &wood["texture"]), (&json!("diffuse"), &json!("wood.png")));
    assert_eq!(of("light 4")["emission"], json!([1.0, 2.0, 3.0]));
    assert_eq!(names(&scene["textures"], "image"), ["wood.png"]);
    assert_eq!(scene["textures"][0]["bytes"], 4);
}

#[test]
fn what_is_used_and_left_out_follows_the_scene() {
    let words = |list: &Value| -> Vec<String> {
        serde_json::from_value(list.clone()).expect("a list of names")
    };
    let all = scene("all.toml");
    let cornell = scene("builtin:cornell");
    for feature in ["spheres", "phong", "mirror", "glass", "textures", "point lights"] {
        let is = |list: &Value| words(list).iter().any(|name| name == feature);
        assert!(is(&all["used"]) && !is(&all["left_out"]), "{feature}");
        assert!(is(&cornell["left_out"]) && !is(&cornell["used"]), "{feature}");
    }
    assert_eq!(cornell["bvh"]["traversal"], "literals");
    assert_eq!(all["bvh"]["traversal"], "hierarchy");
    assert_eq!(all["bvh"]["nodes"].as_u64(), all["bvh"]["leaves"].as_u64().map(|n| 2 * n - 1));
}

#[test]
fn the_memory_on_the_device_is_what_a_device_holds() {
    let directory = directory();
    let path = directory.path().join("all.toml").display().to_string();
    let settings = Settings::default();
    for name in ["builtin:cornell", &path] {
        let gpu = Gpu::open(&AdapterChoice::Auto).expect("a device");
        let read = Scene::load(name).expect("it can be read");
        let prepared = Prepared::new(gpu, read, &settings).expect("it fits");
        let planned: u64 = prepared.tables().iter().map(|(_, bytes)| bytes).sum();
        assert_eq!(planned, prepared.table_bytes(), "{name}");
    }
    let memory = &scene("all.toml")["memory"];
    assert!(names(&memory["device"], "table").contains(&"texels"), "{memory}");
    assert!(memory["host_bytes"].as_u64() > Some(0), "{memory}");
}

#[test]
fn warnings_name_file_and_line() {
    let scene = scene("all.toml");
    let warnings = scene["warnings"].to_string();
    let line = 1 + ALL.lines().position(|line| line.contains("wood.png")).expect("it is there");
    assert!(warnings.contains(&format!("all.toml:{line}: image wood.png")), "{warnings}");
    assert!(warnings.contains("without area"), "{warnings}");
}

#[test]
fn words_hold_the_same_in_aligned_lines_of_bounded_length() {
    let text = said("all.toml");
    for part in [
        "scene all.toml:",
        "and 1 dropped",
        "bounds     -3 0 -3 to 3 3 3",
        "through the hierarchy",
        "\nlights: 6, together",
        "\nmaterials: 6 (3 diffuse, 1 phong, 1 mirror, 1 glass)",
        "\ntextures: 1 of 1 images",
        "on the device",
        "\nwarnings: 2",
    ] {
        assert!(text.contains(part), "{part:?} is not in\n{text}");
    }
    assert!(!text.contains("built-in scenes"), "{text}");
    assert!(text.lines().all(|line| line.trim_end() == line), "{text}");
    let shares = text.lines().filter(|line| line.ends_with(" %"));
    let ends: Vec<_> = shares.map(str::len).collect();
    assert!(ends.len() == 6 && ends.iter().all(|end| *end == ends[0]), "{text}");
}

#[test]
fn long_lists_are_cut_in_words_and_whole_in_json() {
    let directory = directory();
    let light = "[[light]]\ntype = \"point\"\nposition = [0, 4, 0]\nintensity = [1, 1, 1]\n";
    let text = format!("{ALL}{}", light.repeat(100));
    fs::write(directory.path().join("many.toml"), text).expect("it can be written");
    let (code, words, _) = info(directory.path(), "many.toml", true);
    assert_eq!(code, 0);
    assert!(words.contains("... and 86 more") && words.lines().count() < 100, "{words}");
    let (_, json, _) = info(directory.path(), "many.toml --json", true);
    let json: Value = serde_json::from_str(&json).expect("it is JSON");
    assert_eq!(json["scene"]["lights"].as_array().map(Vec::len), Some(106));
}

#[cfg(target_os = "linux")]
#[test]
fn without_an_adapter_a_scene_is_described_all_the_same() {
    let directory = directory();
    let (code, text, _) = info(directory.path(), "all.toml", false);
    assert_eq!(code, 0);
    assert!(text.contains("chosen: none") && text.contains("left out"), "{text}");
    let [with, without] = [true, false].map(|driver| -> Value {
        let (code, json, _) = info(directory.path(), "all.toml --json", driver);
        assert_eq!(code, 0);
        serde_json::from_str(&json).expect("it is JSON")
    });
    assert_eq!(without["chosen"], Value::Null);
    assert!(without["chosen_error"].is_string());
    assert_eq!(with["scene"]["left_out"], without["scene"]["left_out"]);
}

#[test]
fn what_cannot_be_read_is_code_2() {
    let directory = directory();
    let broken = ALL.replace("ior = 1.4", "ior = \"x\"");
    fs::write(directory.path().join("broken.toml"), broken).expect("it can be written");
    for (line, says) in [
        ("none.toml", "none.toml"),
        ("broken.toml", "broken.toml:"),
        ("builtin:none", "there are cornell"),
        ("quad.txt", "unknown kind of scene"),
    ] {
        let (code, stdout, stderr) = info(directory.path(), line, true);
        assert_eq!((code, stdout.as_str()), (2, ""), "{line}: {stderr}");
        assert!(stderr.starts_with("error: ") && stderr.contains(says), "{line}: {stderr}");
        assert_eq!(stderr.lines().count(), 1, "{line}: {stderr}");
    }
}
