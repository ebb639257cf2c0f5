//! `render --denoise`: what is refused, and, where Open Image Denoise is installed, what it does.

#![expect(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use std::fs;

use exr::meta::attribute::{AttributeValue, Text};
use gpu_vpl::denoise::Denoiser;
use gpu_vpl::image::{Image, read};
use serde_json::Value;

use super::{Run, run};

/// Whether the library is there; a test that needs it says so if not.
fn is_installed(test: &str) -> bool {
    match Denoiser::open(1) {
        Ok(_) => true,
        Err(why) => {
            eprintln!("{test} is skipped: {why}");
            false
        }
    }
}

fn written(run: &Run) -> Image {
    run.succeeds();
    read(&run.path("a.exr")).unwrap()
}

fn rendered(options: &str) -> Image {
    written(&run(&format!("render --size 64x64 --quiet -o a.exr {options}")))
}

/// Root mean square of the differences.
fn distance(one: &Image, other: &Image) -> f64 {
    let pairs = one.pixels.iter().flatten().zip(other.pixels.iter().flatten());
    let squares: f64 = pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum();
    (squares / (3 * one.pixels.len()) as f64).sqrt()
}

#[test]
fn what_may_not_be_denoised_is_code_2() {
    for (options, says) in [
        ("--method normal", "--method path, direct"),
        ("--method vpl-map", "--method path, direct"),
        ("--direct clustered", "--direct per-pixel"),
        ("--direct off", "--method path"),
        ("--method path --aov standard-error", "leave one of them out"),
    ] {
        run(&format!("render none.obj -o a.png --denoise {options}")).fails(2, says);
    }
}

#[test]
fn without_the_library_it_is_said_how_to_get_it_before_anything_is_read() {
    // The scene is missing, too: the library is looked for first.
    let line = "render none.obj -o a.png --denoise --method path";
    for (place, says) in [("none.so", "none.so: "), (".", "OpenImageDenoise"), ("a.so", "a.so")] {
        let run = run(line).env("OIDN_LIBRARY", place);
        fs::write(run.path("a.so"), "no library").unwrap();
        run.fails(2, says);
        run.fails(2, "pip install pyoidn");
    }
    run("render none.obj -o a.png").env("OIDN_LIBRARY", "none.so").fails(2, "none.obj");
}

#[test]
fn paths_lose_their_noise() {
    if !is_installed("paths_lose_their_noise") {
        return;
    }
    // No light is seen: at its edges, noise is of where the samples are.
    let path = |options: &str| rendered(&format!("builtin:cornell-point --method path {options}"));
    let reference = path("--samples 1024 --seed 9");
    let noisy = distance(&path("--samples 4"), &reference);
    let denoised = distance(&path("--samples 4 --denoise"), &reference);
    assert!(denoised < 0.4 * noisy, "RMSE {noisy} before, {denoised} after");
}

#[test]
fn direct_light_beside_vpls_is_denoised_and_they_are_not() {
    if !is_installed("direct_light_beside_vpls_is_denoised_and_they_are_not") {
        return;
    }
    let shown = |options: &str| rendered(&format!("--light-samples 1 --vpls 200 {options}"));
    let direct = shown("--method direct");
    let denoised = shown("--method direct --denoise");
    assert!(distance(&direct, &denoised) > 1e-3, "nothing was denoised");
    // Without direct light, these are emission, and emission and VPL light.
    let difference = |from: &Image, to: &Image| {
        let pairs = from.pixels.iter().zip(&to.pixels);
        let pixels = pairs.map(|(a, b)| std::array::from_fn(|i| b[i] - a[i])).collect();
        Image { pixels, ..*from }
    };
    let alone = difference(&shown("--method direct --direct off"), &denoised);
    let beside =
        difference(&shown("--method both --direct off"), &shown("--method both --denoise"));
    let apart = distance(&alone, &beside);
    assert!(apart < 1e-5, "denoised direct light differs by {apart} beside VPLs");
}

#[test]
fn a_denoised_image_is_the_same_on_any_number_of_threads_and_says_so() {
    if !is_installed("a_denoised_image_is_the_same_on_any_number_of_threads_and_says_so") {
        return;
    }
    let files = "-o a.exr -o b.png --report r.json --aov albedo --repeat 2";
    let line = format!("render --size 64x48 --method path --samples 2 --quiet --denoise {files}");
    let [one, two] = ["1", "2"].map(|threads| run(&format!("{line} --threads {threads}")));
    assert_eq!(written(&one).pixels, written(&two).pixels);

    let report: Value = serde_json::from_slice(&fs::read(one.path("r.json")).unwrap()).unwrap();
    let version = report["denoiser"].as_str().unwrap();
    assert!(version.starts_with("2."), "{report}");
    assert!(report["frames"][1]["phases"]["denoise"].as_f64() > Some(0.0), "{report}");
    assert_eq!(report["standard_error"], Value::Null);
    let exr = exr::prelude::read_all_flat_layers_from_file(one.path("a.exr")).unwrap();
    let told = exr.layer_data[0].attributes.other.get(&Text::from("denoiser"));
    let expected = format!("Open Image Denoise {version}");
    assert_eq!(told, Some(&AttributeValue::Text(Text::from(expected.as_str()))));
}
