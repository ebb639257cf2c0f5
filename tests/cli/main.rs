//! The program as its users meet it: command lines, exit codes, what is said, what is left.

#![expect(clippy::expect_used, reason = "a helper of tests fails by panicking")]

#[cfg(unix)]
#[path = "../common/child.rs"]
mod child;
mod compare;
mod compare_files;
mod denoise;
mod exposure;
mod info;
mod outputs;
mod path;
mod signals;

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

/// The program in a directory of its own, and the number of files put there beforehand.
struct Run {
    directory: TempDir,
    arguments: Vec<String>,
    environment: Vec<(&'static str, &'static str)>,
}

/// What a run left behind.
struct Outcome {
    code: i32,
    stdout: Vec<u8>,
    stderr: String,
    files: Vec<String>,
}

/// Splits a command line at blanks.
fn run(line: &str) -> Run {
    let directory = tempfile::tempdir().expect("a directory for the test");
    let arguments = line.split_whitespace().map(str::to_owned).collect();
    Run { directory, arguments, environment: Vec::new() }
}

impl Run {
    fn env(mut self, name: &'static str, value: &'static str) -> Self {
        self.environment.push((name, value));
        self
    }

    fn path(&self, name: &str) -> std::path::PathBuf {
        self.directory.path().join(name)
    }

    fn go(&self) -> Outcome {
        let output = Command::new(env!("CARGO_BIN_EXE_gpu-vpl"))
            .args(&self.arguments)
            .env_remove("WGPU_ADAPTER_NAME")
            .envs(self.environment.iter().copied())
            .current_dir(self.directory.path())
            .output()
            .expect("the program starts");
        Outcome {
            code: output.status.code().expect("the program ends by itself"),
            stdout: output.stdout,
            stderr: String::from_utf8(output.stderr).expect("standard error is UTF-8"),
            files: entries(self.directory.path()),
        }
    }

    /// The run ends with this code and one line on standard error, and leaves no file but what
    /// was there before.
    fn fails(&self, code: i32, says: &str) {
        let before = entries(self.directory.path());
        let outcome = self.go();
        let line = &self.arguments.join(" ");
        assert_eq!(outcome.code, code, "{line}: {}", outcome.stderr);
        assert_eq!(outcome.stdout, b"", "{line}");
        assert!(outcome.stderr.starts_with("error: "), "{line}: {}", outcome.stderr);
        assert_eq!(outcome.stderr.lines().count(), 1, "{line}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(says), "{line}: {}", outcome.stderr);
        assert_eq!(outcome.files, before, "{line}");
    }

    fn succeeds(&self) -> Outcome {
        let outcome = self.go();
        assert_eq!(outcome.code, 0, "{}: {}", self.arguments.join(" "), outcome.stderr);
        outcome
    }
}

fn entries(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).expect("the directory is there");
    let mut names: Vec<_> =
        entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// A render that takes next to no time.
const SMALL: &str = "render --size 16x12 --vpls 20 --quiet";

#[test]
fn wrong_usage_is_code_2() {
    for (line, says) in [
        ("", "no command given; there are render, study, compare and info"),
        ("paint", "paint"),
        ("render", "--output"),
        ("render -o a.png --bogus", "see gpu-vpl render --help"),
        ("render -o a.png b c", "'c'"),
        ("render -o a.png --method bogus", "vpl, vplc, vpc, both, path, direct"),
        ("render -o a.png --method path --direct clustered", "give --method vpc or both"),
        ("render -o a.png --method path --light-samples 4", "one shadow ray a vertex"),
        ("render -o a.png --aov standard-error", "needs --method path"),
        ("render -o a.png --method path --samples 1 --aov standard-error", "2 --samples or more"),
        ("render -o a.png --direct clustered --method vpl", "give --method vpc or both"),
        ("render -o a.png --interleave 9", "9 is not in 1..=8"),
        ("render -o a.png --correct 257", "give a number from 1 to 256, or off"),
        ("render -o a.png --compensate=some", "give auto, on or off"),
        ("study --preset thesis", "--output"),
        ("study -o dir", "what to study?"),
        ("study --preset bogus -o dir", "give thesis, quick or extremes"),
        ("study --preset extremes builtin:cornell -o dir", "own scenes; leave SCENE out"),
        ("study --preset extremes --seeds 3 -o dir", "--preset extremes goes without --seeds"),
        ("study --preset extremes --size 8x8 -o dir", "--preset extremes goes without --size"),
        ("study --preset extremes --vpls 8 -o dir", "neither with --preset"),
        ("study --preset thesis -o dir --size 0", "WIDTHxHEIGHT"),
        ("compare a.exr", "see gpu-vpl compare --help"),
        ("render -o a.png --size 0", "WIDTHxHEIGHT"),
        ("render -o a.png --size 0x5", "WIDTHxHEIGHT"),
        ("render -o a.png --size 5x65537", "WIDTHxHEIGHT"),
        ("render -o a.png --size -5x5", "WIDTHxHEIGHT"),
        ("render -o a.png --clamp 0", "--clamp"),
        ("render -o a.png --clamp -1", "--clamp"),
        ("render -o a.png --clamp nan", "--clamp"),
        ("render -o a.png --clamp inf", "--clamp"),
        ("render -o a.png --vpls 0", "--vpls"),
        ("render -o a.png --vpls 16777217", "--vpls"),
        ("render -o a.png --bounces -1", "--bounces"),
        ("render -o a.png --bounces many", "unlimited"),
        ("render -o a.png --samples 0", "--samples"),
        ("render -o a.png --light-samples 0", "--light-samples"),
        ("render -o a.png --seed -1", "--seed"),
        ("render -o a.png --seed 4294967296", "--seed"),
        ("render -o a.png --seed 1 --seed 2", "--seed"),
        ("render -o a.png --exposure nan", "--exposure"),
        ("render -o a.png --repeat 0", "--repeat"),
        ("render -o a.png --threads 0", "--threads"),
        ("render -o a.png --aov normals", "normal,albedo,depth"),
        ("render -o a.png --quiet --verbose", "--verbose"),
        ("info --bogus", "--bogus"),
    ] {
        run(line).fails(2, says);
    }
}

#[test]
fn scenes_that_cannot_be_read_are_code_2() {
    run("render none.obj -o a.png").fails(2, "none.obj");
    run("render none.toml -o a.png").fails(2, "none.toml");
    run("render none.xyz -o a.png").fails(2, "unknown kind of scene");
    run("render builtin:none -o a.png").fails(2, "none");
    run("info none.obj").fails(2, "none.obj");
}

#[test]
fn a_name_with_a_line_break_is_still_one_line() {
    let mut run = run("render -o a.png");
    run.arguments.push("two\nlines.obj".to_owned());
    run.fails(2, "two lines.obj");
}

#[test]
fn an_adapter_that_is_not_there_is_code_3() {
    let missing = "no-such-adapter";
    run(&format!("{SMALL} -o a.png --adapter {missing}")).fails(3, missing);
    run(&format!("{SMALL} -o a.png")).env("WGPU_ADAPTER_NAME", missing).fails(3, missing);
    run(&format!("info --adapter {missing}")).fails(3, missing);
}

#[test]
fn a_backend_that_is_not_there_is_code_3() {
    for backend in ["voodoo", "gl", "vulkan,voodoo"] {
        run(&format!("{SMALL} -o a.png")).env("WGPU_BACKEND", backend).fails(3, backend);
    }
    #[cfg(target_os = "linux")]
    {
        run(&format!("{SMALL} -o a.png"))
            .env("WGPU_BACKEND", "metal")
            .fails(3, "WGPU_BACKEND=metal");
        run(&format!("{SMALL} -o a.png")).env("WGPU_BACKEND", "gl,Vulkan").succeeds();
    }
}

#[test]
fn the_list_of_what_formats_have_and_is_not_shown_is_printed() {
    let text = String::from_utf8(run("info --formats").succeeds().stdout).expect("UTF-8");
    let rows = run("info --formats --json").succeeds().stdout;
    let rows: Vec<Value> = serde_json::from_slice(&rows).expect("JSON");
    let listed = gpu_vpl::scene::omissions().count();
    assert_eq!(rows.len(), listed);
    let lines = text.lines().filter(|line| line.starts_with("* ") || line.starts_with("  "));
    assert_eq!(lines.count(), listed + 1, "{text}");
    for row in rows {
        assert!(text.contains(row["what"].as_str().expect("a name")), "{row}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn without_a_driver_the_package_to_install_is_named() {
    let without = |run: Run| {
        run.env("VK_ICD_FILENAMES", "/nonexistent").env("VK_DRIVER_FILES", "/nonexistent")
    };
    without(run(&format!("{SMALL} -o a.png"))).fails(3, "mesa-vulkan-drivers");
    // `info` is what one asks in that case, so it answers.
    let outcome = without(run("info")).succeeds();
    let text = String::from_utf8(outcome.stdout).unwrap();
    assert!(text.contains("mesa-vulkan-drivers") && text.contains("builtin:cornell"), "{text}");
}

#[test]
fn help_and_version_go_to_standard_output() {
    for line in ["--help", "render --help", "info -h", "--version"] {
        let outcome = run(line).succeeds();
        assert!(!outcome.stdout.is_empty(), "{line}");
        assert_eq!(outcome.stderr, "", "{line}");
    }
    let help = String::from_utf8(run("render --help").succeeds().stdout).unwrap();
    assert!(!help.contains("--link-everything"), "it is for measuring");
}

#[cfg(unix)]
#[test]
fn a_reader_that_goes_away_is_no_fault() {
    let run = run("");
    let program = env!("CARGO_BIN_EXE_gpu-vpl");
    let script = format!("'{program}' render --help | true; '{program}' --help >&-; echo done");
    let output = Command::new("sh").args(["-c", &script]).output().unwrap();
    assert_eq!(output.stdout, b"done\n");
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(!stderr.contains("panic") && !stderr.contains("internal"), "{stderr}");
    drop(run);
}

#[test]
fn info_lists_adapters_and_built_in_scenes() {
    let text = String::from_utf8(run("info").succeeds().stdout).unwrap();
    assert!(text.contains("adapters:") && text.contains("builtin:cornell"), "{text}");
    let json: Value = serde_json::from_slice(&run("info --json").succeeds().stdout).unwrap();
    let names: Vec<_> = json["builtin_scenes"].as_array().unwrap().iter().collect();
    assert!(names.iter().any(|scene| scene["name"] == "builtin:cornell"), "{json}");
    assert!(json["adapters"][0]["limits"].is_array(), "{json}");
    assert!(json["chosen"]["name"].is_string(), "{json}");
}

#[test]
fn info_says_what_a_scene_holds() {
    let outcome = run("info builtin:cornell --json").succeeds();
    let json: Value = serde_json::from_slice(&outcome.stdout).unwrap();
    let scene = &json["scene"];
    assert!(scene["triangles"].as_u64() > Some(10), "{scene}");
    assert!(scene["emitting_triangles"].as_u64() > Some(0), "{scene}");
    assert!(scene["bounds"][1][2].is_number(), "{scene}");
    assert!(scene["left_out"].is_array(), "{scene}");
    let text = String::from_utf8(run("info builtin:cornell").succeeds().stdout).unwrap();
    assert!(text.contains("triangles") && text.contains("camera"), "{text}");
}

#[test]
fn what_is_said_without_quiet_names_the_adapter() {
    let stderr = run("render --size 4x4 --vpls 5 --verbose -o a.png").succeeds().stderr;
    assert!(stderr.contains("adapter: "), "{stderr}");
    assert!(stderr.contains("shading") && stderr.contains("total"), "{stderr}");
}

#[test]
fn the_report_has_every_key() {
    let run = run(&format!("{SMALL} -o a.png --report r.json --repeat 2 --seed 9 --threads 2"));
    run.succeeds();
    let report: Value = serde_json::from_slice(&fs::read(run.path("r.json")).unwrap()).unwrap();
    let has = |value: &Value, keys: &str| {
        for key in keys.split_whitespace() {
            assert!(value.get(key).is_some(), "{key} is not in {value}");
        }
    };
    has(
        &report,
        "schema version scene method seed width height samples adapter triangles spheres lights \
         visible_points light_paths bounces vpls vpl_candidates effective_vpls vpl_clusters point_clusters shadow_rays \
         shading_terms seconds phases frames threads peak_memory_bytes clamp clamped_fraction \
         compensated truncated_fraction standard_error denoiser nonfinite_pixels dropped_triangles left_out warnings",
    );
    has(&report["adapter"], "name backend driver device_type");
    has(&report["seconds"], "preprocess render total");
    has(
        &report["phases"],
        "load bvh device pipelines visible_points direct vpls cluster_points cluster_vpls \
         visibility shading compensation readback denoise write",
    );
    assert_eq!(report["frames"].as_array().unwrap().len(), 2);
    has(&report["frames"][1], "seconds preprocess render");
    assert_eq!((&report["width"], &report["height"]), (&16.into(), &12.into()));
    assert_eq!((&report["seed"], &report["threads"]), (&9.into(), &2.into()));
    // Twenty VPLs, chosen among about eight times as many.
    let [paths, chosen, candidates] =
        ["light_paths", "vpls", "vpl_candidates"].map(|key| report[key].as_u64().unwrap());
    assert!(paths >= 20 && (19..=21).contains(&chosen), "{chosen} VPLs of {paths} paths");
    assert!((100..300).contains(&candidates), "{candidates} candidates");
    let effective = report["effective_vpls"].as_f64().unwrap();
    assert!(effective > 1.0 && effective <= chosen as f64, "{effective} effective VPLs");
    let counts = ["triangles", "spheres", "lights"].map(|key| report[key].as_u64());
    assert_eq!(counts, [Some(38), Some(0), Some(2)]);
    assert_eq!(report["bounces"], 2);
    let phases: f64 = report["phases"].as_object().unwrap().values().flat_map(Value::as_f64).sum();
    let total = report["seconds"]["total"].as_f64().unwrap();
    assert!(phases > 0.0 && phases <= total, "phases overlap: {phases} s of {total} s");
}

/// That VPLs show no caustics changes no image that they could make: it is told, and no error.
#[test]
fn caustics_are_noted_and_pass_strictness() {
    let scene = "[camera]\nposition = [0, 0, -3]\ntarget = [0, 0, 0]\nfov = 40\n\
                 [[sphere]]\ncenter = [0, 0, 0]\nradius = 0.5\nmaterial = \"glass\"\n\
                 [[sphere]]\ncenter = [0, -9, 0]\nradius = 8\nmaterial = \"floor\"\n\
                 [materials.glass]\ntype = \"glass\"\n[materials.floor]\nalbedo = [1, 1, 1]\n\
                 [[light]]\ntype = \"point\"\nposition = [0, 4, 0]\nintensity = [9, 9, 9]\n";
    for (method, says) in [("both", "not in the image of method both"), ("path", "by paths")] {
        let line = format!("render a.toml --size 16x12 --vpls 50 --method {method} -o a.png");
        let run = run(&format!("{line} --strict --report r.json"));
        fs::write(run.path("a.toml"), scene).expect("it can be written");
        let stderr = run.succeeds().stderr;
        let told: Vec<_> = stderr.lines().filter(|line| line.contains("caustic")).collect();
        assert_eq!(told.len(), 1, "{stderr}");
        assert!(told[0].starts_with("warning: a.toml: ") && told[0].contains(says), "{stderr}");
        let report: Value = serde_json::from_slice(&fs::read(run.path("r.json")).unwrap()).unwrap();
        assert!(report["warnings"].to_string().contains(says), "{report}");
        assert_eq!(report["spheres"], 2);
    }
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    let png = |options: &str| run(&format!("{SMALL} -o - {options}")).succeeds().stdout;
    let first = png("--seed 5 --threads 1");
    assert_eq!(png("--seed 5 --threads 2"), first);
    assert_ne!(png("--seed 6"), first);
}

#[test]
fn direct_light_alone_is_no_reason_to_warn() {
    let run = run(&format!("{SMALL} -o a.png --bounces 0 --strict"));
    assert_eq!(run.succeeds().stderr, "");
}
