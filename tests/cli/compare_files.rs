//! Which image of a file `compare` reads: layers, data windows, alpha, other formats.

use std::fs::File;
use std::io::BufWriter;

use gpu_vpl::image::Image;
use gpu_vpl::image::exr::{self, Plane};
use serde_json::Value;

use super::compare::Images;

/// A file of `tests/cases`.
fn case(name: &str) -> String {
    format!("{}/tests/cases/{name}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn of_several_layers_combined_is_compared_and_named() {
    let images = Images::new();
    let [passes, thrice] =
        ["passes", "passes_3x"].map(|name| case(&format!("compare_layers/multilayer/{name}.exr")));
    let outcome = images.compare(&format!("{passes} {thrice} --max-rmse 0.001"));
    assert_eq!(outcome.code, 4, "{}", outcome.stdout);
    assert!(outcome.stdout.starts_with("layer ViewLayer.Combined against ViewLayer.Combined\n"));
    let metrics = images.metrics(&format!("{passes} {passes}"));
    assert_eq!(metrics["layers"][0], "ViewLayer.Combined");
    assert_eq!(metrics["rmse"], 0.0);
    // A plain image against it, and layers by name.
    let reference = case("compare_layers/multilayer/ref.exr");
    assert!(images.metrics(&format!("{reference} {passes}"))["layers"][0].is_null());
    for layer in ["ViewLayer.AO", "AO", "ao"] {
        let ao = images.metrics(&format!("{passes} {thrice} --layer {layer}"));
        assert_eq!(
            (&ao["rmse"], &ao["layers"][1]),
            (&Value::from(0.0), &Value::from("ViewLayer.AO"))
        );
    }
    images.fails(
        &format!("{passes} {passes} --layer Mist"),
        2,
        "there are ViewLayer.AO, ViewLayer.Combined",
    );
}

#[test]
fn several_layers_of_which_none_is_the_image_are_refused() {
    let images = Images::new();
    let image = Image { width: 2, height: 1, pixels: vec![[0.5; 3]; 2] };
    let plane =
        |layer: &'static str, channels: &'static str| Plane { layer, channels, image: &image };
    let write = |name: &str, planes: &[Plane<'_>]| {
        let mut out = BufWriter::new(File::create(images.path(name)).expect("a file"));
        exr::write(&mut out, planes, &vec![]).expect("an image is written");
    };
    write("two.exr", &[plane("key", "RGB"), plane("fill", "RGB"), plane("depth", "Z")]);
    write("grey.exr", &[plane("", "Y")]);
    write("small.exr", &[plane("", "rgb")]);
    images.fails("two.exr two.exr", 2, "choose one by --layer: fill, key");
    assert_eq!(images.metrics("two.exr two.exr --layer key")["rmse"], 0.0);
    assert_eq!(images.metrics("grey.exr small.exr")["rmse"], 0.0);
}

#[test]
fn data_windows_are_placed_in_the_display_window() {
    let images = Images::new();
    let window = |name: &str| case(&format!("compare_windows/windows/{name}.exr"));
    let rmse = |one: &str, two: &str| {
        let outcome = images.compare(&format!("{} {} --json", window(one), window(two)));
        assert_eq!(outcome.code, 0, "{}", outcome.stderr);
        let json: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
        (json["rmse"].as_f64().expect("a number"), outcome.stderr)
    };
    let (shifted, says) = rmse("top", "bottom");
    assert!(shifted > 0.01, "{shifted}");
    assert!(says.contains("has a data window other than its display window"), "{says}");
    assert!(rmse("whole", "cropped").0 > 0.0);
    assert_eq!(rmse("bottom", "bottom").0, 0.0);
}

#[test]
fn alphas_that_differ_are_named() {
    let images = Images::new();
    let [a, b] = ["a", "b"].map(|name| case(&format!("compare_alpha/alpha/{name}.png")));
    let outcome = images.compare(&format!("{a} {b}"));
    assert_eq!(outcome.code, 0);
    assert!(outcome.stderr.starts_with("warning: the alpha of "), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("colours alone are compared"), "{}", outcome.stderr);
    images.metrics(&format!("{a} {a}"));
}

#[test]
fn images_of_other_formats_are_compared() {
    let images = Images::constant(0.5, 0.5);
    let grey = image::RgbImage::from_pixel(32, 16, image::Rgb([188; 3]));
    for name in ["a.png", "a.tiff", "a.jpg", "a.webp", "a.bmp", "a.gif"] {
        grey.save(images.path(name)).expect("it is written");
        let rmse = images.metrics(&format!("r.exr {name}"))["rmse"].as_f64().expect("a number");
        assert!(rmse < 0.01, "{name}: {rmse}");
    }
    let hdr = image::Rgb32FImage::from_pixel(32, 16, image::Rgb([0.5; 3]));
    image::DynamicImage::from(hdr.clone()).save(images.path("a.hdr")).expect("it is written");
    image::DynamicImage::from(hdr).save(images.path("f.tiff")).expect("it is written");
    for name in ["a.hdr", "f.tiff"] {
        let rmse = images.metrics(&format!("r.exr {name}"))["rmse"].as_f64().expect("a number");
        assert!(rmse < 0.002, "{name}: {rmse}");
    }
    images.fails("a.png a.png --layer key", 2, "--layer key is for EXR");
}
