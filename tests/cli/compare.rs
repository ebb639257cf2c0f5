//! `compare` as its users meet it, without a device: metrics of images made here against closed
//! forms, limits, error maps, and what is refused.

#![expect(clippy::expect_used, reason = "a helper of tests fails by panicking")]

use std::fs::{self, File};
use std::io::BufWriter;
use std::path::PathBuf;

use assert_cmd::Command;
use gpu_vpl::image::exr::{self, Plane};
use gpu_vpl::image::{Image, Tone, png, read};
use serde_json::Value;
use tempfile::TempDir;

/// A directory of images to compare.
pub struct Images(TempDir);

/// What a comparison left behind.
pub struct Outcome {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Images {
    pub fn new() -> Self {
        Self(tempfile::tempdir().expect("a directory for the test"))
    }

    /// Two constant images of 32 × 16 pixels, r.exr and x.exr.
    pub fn constant(reference: f32, image: f32) -> Self {
        let images = Self::new();
        images.add("r.exr", [32, 16], |_, _| [reference; 3]);
        images.add("x.exr", [32, 16], |_, _| [image; 3]);
        images
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Adds an image whose pixels are a function of column and row.
    fn add(&self, name: &str, [width, height]: [u32; 2], pixel: impl Fn(u32, u32) -> [f32; 3]) {
        let at = |index: u32| pixel(index % width, index / width);
        let image = Image { width, height, pixels: (0..width * height).map(at).collect() };
        let mut out = BufWriter::new(File::create(self.path(name)).expect("a file"));
        let written = if name.ends_with(".png") {
            png::write(&mut out, &image, Tone::Radiance { exposure: 0.0 })
        } else {
            exr::write(&mut out, &[Plane { layer: "", channels: "RGB", image: &image }], &vec![])
        };
        written.expect("an image is written");
    }

    /// Runs `compare` with arguments split at blanks.
    pub fn compare(&self, arguments: &str) -> Outcome {
        let output = Command::new(env!("CARGO_BIN_EXE_gpu-vpl"))
            .arg("compare")
            .args(arguments.split_whitespace())
            .current_dir(self.0.path())
            .output()
            .expect("the program starts");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        Outcome {
            code: output.status.code().expect("the program ends by itself"),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }

    /// The metrics; the comparison is fine and has nothing to complain about.
    pub fn metrics(&self, arguments: &str) -> Value {
        let outcome = self.compare(&format!("{arguments} --json"));
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{arguments}");
        serde_json::from_str(&outcome.stdout).expect("JSON")
    }

    /// The comparison ends with this code and one line on standard error.
    pub fn fails(&self, arguments: &str, code: i32, says: &str) -> Outcome {
        let outcome = self.compare(arguments);
        let Outcome { stderr, .. } = &outcome;
        assert_eq!(outcome.code, code, "{arguments}: {stderr}");
        assert!(stderr.starts_with("error: ") && stderr.contains(says), "{arguments}: {stderr}");
        assert_eq!(stderr.lines().count(), 1, "{arguments}: {stderr}");
        outcome
    }

    fn read(&self, name: &str) -> Image {
        read(&self.path(name)).expect("an image")
    }
}

fn near(value: &Value, expected: f64, tolerance: f64) {
    let value = value.as_f64().expect("a number");
    assert!((value - expected).abs() <= tolerance, "{value} instead of {expected}");
}

#[test]
fn metrics_follow_their_closed_forms() {
    let images = Images::constant(2.0, 2.5);
    let metrics = images.metrics("r.exr x.exr");
    for (name, expected) in [
        ("rmse", 0.5),
        ("mae", 0.5),
        ("bias", 0.25),
        ("nrmse", 0.25),
        ("relmse", 0.25 / 4.04),
        ("tile_nrmse", 0.25),
        ("flip", 0.0), // Both are white.
        ("max_abs", 0.5),
        ("nonfinite", 0.0),
    ] {
        near(&metrics[name], expected, 1e-12);
    }
    assert_eq!(metrics.as_object().expect("an object").len(), 9);

    // A checkerboard about the mean: errors in every pixel, none in a tile.
    images.add("x.exr", [32, 16], |x, y| [if (x + y) % 2 == 0 { 1.0 } else { 3.0 }; 3]);
    let metrics = images.metrics("r.exr x.exr");
    for (name, expected) in [("rmse", 1.0), ("bias", 0.0), ("tile_nrmse", 0.0), ("max_abs", 1.0)] {
        near(&metrics[name], expected, 1e-12);
    }
}

#[test]
fn what_has_no_value_is_null() {
    let images = Images::new();
    images.add("r.exr", [15, 15], |_, _| [0.0; 3]);
    images.add("x.exr", [15, 15], |_, _| [1.0; 3]);
    let metrics = images.metrics("r.exr x.exr");
    for name in ["nrmse", "bias", "relmse", "tile_nrmse"] {
        assert!(metrics[name].is_null(), "{name}");
    }
    near(&metrics["rmse"], 1.0, 0.0);
    // What is infinite is over any limit.
    images.fails("r.exr x.exr --max-relmse 1e300", 4, "relmse inf is over --max-relmse");
}

#[test]
fn a_png_is_linearised() {
    let images = Images::new();
    // Bytes 188 and 128 of sRGB, by the formula of IEC 61966-2-1.
    let linear = |byte: f32| ((byte / 255.0 + 0.055) / 1.055).powf(2.4);
    let pixel = |x: u32, _| [linear(188.0), linear(128.0), (x % 2) as f32];
    images.add("a.exr", [20, 20], pixel);
    images.add("a.png", [20, 20], pixel);
    let metrics = images.metrics("a.exr a.png --max-rmse 1e-6 --max-flip 1e-3");
    near(&metrics["max_abs"], 0.0, 1e-6);
    near(&images.metrics("a.png a.png")["flip"], 0.0, 0.0);
}

#[test]
fn the_text_is_a_table() {
    let outcome = Images::constant(1.0, 1.01).compare("r.exr x.exr");
    let names: Vec<_> =
        outcome.stdout.lines().filter_map(|l| l.split_whitespace().next()).collect();
    let expected =
        ["rmse", "mae", "bias", "nrmse", "relmse", "tile_nrmse", "flip", "max_abs", "nonfinite"];
    assert_eq!(names, expected);
    assert!(outcome.stdout.contains("bias            0.010000\n"), "{}", outcome.stdout);
}

#[test]
fn exposure_is_for_flip_alone() {
    let images = Images::constant(0.25, 0.5);
    let [plain, bright] =
        ["0", "2"].map(|ev| images.metrics(&format!("r.exr x.exr --exposure {ev}")));
    assert_eq!(plain["rmse"], bright["rmse"]);
    near(&bright["flip"], 0.0, 0.0);
    assert!(plain["flip"].as_f64() > Some(0.1));
}

#[test]
fn lights_seen_directly_are_masked() {
    let images = Images::constant(1.0, 1.0);
    let light = |wide: u32| move |x: u32, _| [if x < wide { 9.0 } else { 1.0 }; 3];
    images.add("r.exr", [32, 16], light(3));
    images.add("x.exr", [32, 16], light(5));
    images.add("wide.exr", [32, 16], light(6));
    images.add("none.exr", [32, 16], light(0));
    let rmse = |arguments: &str| images.metrics(arguments)["rmse"].as_f64().expect("a number");
    assert!(rmse("r.exr x.exr") > 1.0);
    near(&images.metrics("r.exr x.exr --mask-above 5")["flip"], 0.0, 0.0);
    assert_eq!(rmse("r.exr x.exr --mask-above 5"), 0.0);
    assert!(rmse("r.exr wide.exr --mask-above 5") > 0.0);
    assert_eq!(rmse("r.exr wide.exr --mask-above 5 --mask-from x.exr"), 0.0);
    assert!(rmse("r.exr x.exr --mask-above 5 --mask-from none.exr") > 1.0);
    assert!(rmse("r.exr x.exr --mask-above 9") > 1.0);
    images.fails("r.exr x.exr --mask-above -1", 2, "leaves no pixel");
    images.add("small.exr", [16, 16], light(0));
    images.fails("r.exr x.exr --mask-above 5 --mask-from small.exr", 2, "small.exr: it is 16 x 16");
}

#[test]
fn one_percent_of_light_is_caught() {
    let images = Images::constant(1.0, 1.01);
    images.fails("r.exr x.exr --max-bias 0.005", 4, "is over --max-bias 0.005");
    images.fails("x.exr r.exr --max-bias 0.005", 4, "bias -0.0099");
    images.fails("r.exr x.exr --max-rmse 0.005", 4, "is over --max-rmse 0.005");
    images.fails("r.exr x.exr --max-relmse 1e-5", 4, "is over --max-relmse 1e-5");
    images.fails("r.exr x.exr --max-flip 0 --exposure -1", 4, "is over --max-flip 0.0");
    let both = images.fails("r.exr x.exr --max-rmse 0.005 --max-bias 0.005 --json", 4, "rmse");
    assert!(both.stderr.contains("x.exr: ") && both.stderr.contains("bias"), "{}", both.stderr);
    let metrics: Value = serde_json::from_str(&both.stdout).expect("JSON");
    near(&metrics["bias"], 0.01, 1e-6);
    images.metrics("r.exr x.exr --max-bias 0.011 --max-rmse 0.011 --max-relmse 1e-3 --max-flip 1");
    images.metrics("r.exr r.exr --max-bias 0 --max-rmse 0 --max-relmse 0 --max-flip 0");
}

#[test]
fn one_wrong_value_is_caught() {
    let images = Images::constant(0.5, 0.5);
    images.add("x.exr", [32, 16], |x, y| [0.5, if (x, y) == (7, 9) { 0.501 } else { 0.5 }, 0.5]);
    for limit in ["rmse", "relmse", "flip", "bias"] {
        images.fails(&format!("r.exr x.exr --max-{limit} 0"), 4, &format!("--max-{limit}"));
    }
}

#[test]
fn what_is_not_finite_never_passes() {
    let images = Images::constant(1.0, 1.0);
    let broken = |value: f32| {
        move |x: u32, y: u32| if (x, y) == (3, 2) { [1.0, value, 1.0] } else { [1.0; 3] }
    };
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        images.add("x.exr", [32, 16], broken(value));
        for limit in ["rmse", "relmse", "flip", "bias"] {
            let says = "1 pixel is not finite, the first at (3, 2) of x.exr";
            images.fails(&format!("r.exr x.exr --max-{limit} 1000"), 4, says);
            images.fails(&format!("x.exr r.exr --max-{limit} 1000"), 4, says);
            images.fails(&format!("x.exr x.exr --max-{limit} 1000"), 4, says);
        }
        let outcome = images.compare("r.exr x.exr --json");
        assert!(outcome.stderr.starts_with("warning: 1 pixel is not finite"), "{}", outcome.stderr);
        assert_eq!((outcome.code, outcome.stderr.lines().count()), (0, 1));
        let metrics: Value = serde_json::from_str(&outcome.stdout).expect("JSON");
        assert_eq!(metrics["nonfinite"], 1);
        near(&metrics["mae"], 1.0 / (32.0 * 16.0 * 3.0), 1e-12);
    }
}

#[test]
fn an_error_map_shows_where() {
    let images = Images::constant(1.0, 1.0);
    images.add("x.exr", [32, 16], |x, _| [1.0, 1.0, 1.0 + x as f32 / 16.0]);
    let metrics = images.metrics("r.exr x.exr -o map.png -o map.exr --map-scale 0.5");
    near(&metrics["map_scale"], 0.5, 0.0);
    let picture = images.read("map.png");
    assert!(picture.width >= 32 && picture.height > 16, "room for the scale");
    let map = images.read("map.exr");
    assert_eq!([map.width, map.height], [32, 16]);
    assert!(map.pixels[0] == [0.0; 3] && (map.pixels[16][0] - 3.0_f32.sqrt().recip()).abs() < 1e-6);
    let squares: f64 = map.pixels.iter().map(|pixel| f64::from(pixel[0]).powi(2)).sum();
    near(&metrics["rmse"], (squares / 512.0).sqrt(), 1e-6);

    images.metrics("x.exr r.exr --map signed -o map.exr");
    assert!((images.read("map.exr").pixels[16][0] + 1.0 / 3.0).abs() < 1e-6);
    let flip = images.metrics("r.exr x.exr --map flip -o map.exr --exposure -1");
    near(&flip["map_scale"], 1.0, 0.0);
    let mean: f32 = images.read("map.exr").pixels.iter().map(|pixel| pixel[0]).sum::<f32>() / 512.0;
    near(&flip["flip"], f64::from(mean), 1e-5);
    let text = images.compare("r.exr x.exr -o map.png").stdout;
    assert!(text.lines().last().is_some_and(|line| line.starts_with("map_scale")), "{text}");

    // That an image is over a limit is a result: the map shows why.
    fs::remove_file(images.path("map.png")).expect("a map");
    images.fails("r.exr x.exr -o map.png --max-rmse 0.1", 4, "rmse");
    assert!(images.path("map.png").exists());
}

#[test]
fn what_cannot_be_compared_leaves_nothing() {
    let images = Images::constant(1.0, 1.0);
    images.add("x.png", [8, 4], |_, _| [0.5; 3]);
    let whole = fs::read(images.path("x.exr")).expect("an image");
    fs::write(images.path("cut.exr"), &whole[..whole.len() - 9]).expect("a file");
    let mut png = fs::read(images.path("x.png")).expect("an image");
    fs::write(images.path("cut.png"), &png[..png.len() / 2]).expect("a file");
    // A header that claims 4294967295 pixels a row.
    png[16..20].fill(0xff);
    fs::write(images.path("huge.png"), &png).expect("a file");
    fs::write(images.path("empty.exr"), "").expect("a file");
    fs::write(images.path("text.png"), "no image").expect("a file");
    let files = || fs::read_dir(images.0.path()).expect("a directory").count();
    let before = files();
    for (name, says) in [
        ("x.png", "x.png: it is 8 x 4 pixels, but r.exr is 32 x 16"),
        ("cut.exr", "cut.exr: cannot be read as EXR"),
        ("cut.png", "cut.png: cannot be read as PNG"),
        ("huge.png", "huge.png: cannot be read as PNG"),
        ("empty.exr", "neither PNG nor EXR"),
        ("text.png", "neither PNG nor EXR"),
        ("missing.exr", "missing.exr: cannot read it"),
        (".", ".: cannot read it"),
    ] {
        let outcome = images.fails(&format!("r.exr {name} -o map.png --max-rmse 9"), 2, says);
        assert_eq!((outcome.stdout.as_str(), files()), ("", before), "{name}");
    }
    images.fails("missing.exr r.exr -o map.png", 2, "missing.exr: cannot read it");
    images.fails("r.exr x.exr -o no/map.png", 1, "no/map.png: cannot write");
    images.fails("r.exr x.exr -o map.jpg", 2, "unknown image format");
    images.fails("r.exr x.exr -o -", 2, "standard output is for the metrics");
    images.fails("r.exr x.exr -o x.exr", 2, "one of the images compared");
    images.fails("r.exr x.exr -o map.exr -o ./map.exr", 2, "two outputs go here");
    assert_eq!(files(), before);
    assert_eq!(fs::read(images.path("x.exr")).expect("an image"), whole);
}

#[test]
fn wrong_usage_is_code_2() {
    let images = Images::constant(1.0, 1.0);
    for (arguments, says) in [
        ("r.exr", "<IMAGE>"),
        ("r.exr x.exr r.exr", "unexpected argument"),
        ("r.exr x.exr --max-rmse -1", "give a number from 0"),
        ("r.exr x.exr --max-flip nan", "give a number from 0"),
        ("r.exr x.exr --map-scale 0 -o map.png", "give a number above 0"),
        ("r.exr x.exr --map bogus -o map.png", "give magnitude, signed or flip"),
        ("r.exr x.exr --map flip", "--output"),
        ("r.exr x.exr --mask-from r.exr", "--mask-above"),
        ("r.exr x.exr --exposure x", "give a number of stops"),
    ] {
        images.fails(arguments, 2, says);
    }
}
