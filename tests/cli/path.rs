//! `render --method path` as its users meet it.

#![expect(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;

/// Standard output of a render that succeeds, in a directory.
fn render(directory: &Path, options: &str) -> Vec<u8> {
    let output = Command::new(env!("CARGO_BIN_EXE_gpu-vpl"))
        .args("render --size 24x16 --method path --quiet".split_whitespace())
        .args(options.split_whitespace())
        .current_dir(directory)
        .output()
        .unwrap();
    assert!(output.status.success(), "{options}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

#[test]
fn the_same_bytes_come_of_any_number_of_threads() {
    let png = |options: &str| {
        render(&std::env::temp_dir(), &format!("--bounces unlimited -o - {options}"))
    };
    let first = png("--threads 1");
    assert_eq!(png("--threads 2"), first);
    assert_eq!(png("--threads 3"), first);
    assert_ne!(png("--seed 1"), first);
}

#[test]
fn the_standard_error_is_an_image_and_a_number() {
    let directory = tempfile::tempdir().unwrap();
    let files = "-o a.png -o b.exr --report r.json --aov standard-error,depth";
    render(directory.path(), files);
    for name in ["a.depth.png", "a.png", "a.standard-error.png"] {
        assert!(directory.path().join(name).is_file(), "{name} is missing");
    }
    let exr = directory.path().join("b.exr");
    let exr = exr::prelude::read_all_flat_layers_from_file(exr).unwrap();
    let channels = exr.layer_data[0].channel_data.list.iter();
    let errors = channels.filter(|c| c.name.to_string().starts_with("standard-error."));
    let values: Vec<f32> = errors.flat_map(|c| c.sample_data.values_as_f32()).collect();
    assert_eq!(values.len(), 3 * 24 * 16);
    let square: f64 = values.iter().map(|&value| f64::from(value).powi(2)).sum();
    let report = fs::read(directory.path().join("r.json")).unwrap();
    let report: Value = serde_json::from_slice(&report).unwrap();
    let told = report["standard_error"].as_f64().unwrap();
    assert!((told / (square / values.len() as f64).sqrt() - 1.0).abs() < 1e-6, "{report}");
    assert_eq!((&report["samples"], &report["vpls"]), (&16.into(), &0.into()));
    assert_eq!((&report["light_paths"], &report["clamp"]), (&0.into(), &Value::Null));
    assert!(report["shadow_rays"].as_u64() > Some(24 * 16), "{report}");
}
