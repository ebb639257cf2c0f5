//! Studies through the program, at sizes that take next to no time: the numbers are worth
//! nothing, what is there and agrees is. Studies that are broken off; and the page of one, in a
//! browser.

#![expect(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

mod broken_off;
#[path = "../common/mod.rs"]
mod common;
mod decompose;
mod page;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

/// The program, about to study.
fn command(directory: &Path, options: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gpu-vpl"));
    command
        .arg("study")
        .args(options.split_whitespace())
        .env_remove("WGPU_ADAPTER_NAME")
        .current_dir(directory);
    command
}

fn study(directory: &Path, options: &str) -> Output {
    command(directory, options).output().unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn done(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
}

fn entries(directory: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn json(directory: &Path) -> Value {
    serde_json::from_slice(&fs::read(directory.join("study.json")).unwrap()).unwrap()
}

fn rows(study: &Value) -> &Vec<Value> {
    study["scenes"][0]["rows"].as_array().unwrap()
}

/// Splits a line at the commas outside quotes.
fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut quoted = false;
    for character in line.chars() {
        match character {
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            _ => fields.last_mut().unwrap().push(character),
        }
    }
    fields
}

/// Experiment, setting and the thesis's tT of each of its rows.
const TABLES: [(&str, &str, f64); 17] = [
    ("table 5.2", "500 × 2", 45.7),
    ("table 5.2", "1000 × 1", 44.74),
    ("table 5.2", "1000 × 2", 90.61),
    ("table 5.2", "2000 × 2", 183.1),
    ("table 5.3", "K_v = 2000", 91.698),
    ("table 5.3", "K_v = 1300", 64.973),
    ("table 5.3", "K_v = 800", 38.763),
    ("table 5.3", "K_v = 400", 18.705),
    ("table 5.3", "K_v = 200", 9.03),
    ("table 5.3", "K_v = 100", 4.529),
    ("table 5.4", "C = 100", 51.418),
    ("table 5.4", "C = 500", 61.307),
    ("table 5.4", "C = 1250", 73.114),
    ("table 5.4", "C = 2600", 101.693),
    ("table 5.4", "C = 4000", 130.627),
    ("table 5.4", "C = 8000", 211.812),
    ("table 5.5", "C = 2600, K_v = 400", 53.849),
];

#[test]
fn the_thesis_is_studied() {
    let place = tempfile::tempdir().unwrap();
    let output = study(place.path(), "--preset thesis --size 16x16 -o out --seed 3");
    done(&output);
    assert_eq!(output.stdout, b"");
    let out = place.path().join("out");
    let files = entries(&out);
    assert!(["study.csv", "study.json", "study.md"].iter().all(|f| files.contains(&(*f).into())));

    let json = json(&out);
    let rows = rows(&json);
    assert_eq!(rows.len(), TABLES.len() + 4 + 10 + 4 + 2 + 4);
    assert_eq!((&json["seeds"][0], &json["scenes"][0]["width"]), (&3.into(), &16.into()));
    assert_eq!(json["finished"], json["planned"]);

    let csv = fs::read_to_string(out.join("study.csv")).unwrap();
    let lines: Vec<_> = csv.lines().map(fields).collect();
    assert_eq!(lines.len(), rows.len() + 1);
    let column = |name: &str| lines[0].iter().position(|heading| heading == name).unwrap();
    for (line, row) in lines[1..].iter().zip(rows) {
        assert_eq!(line.len(), lines[0].len());
        assert_eq!(line[column("setting")], row["setting"].as_str().unwrap());
        assert_eq!(line[column("vpls")], row["vpls"].to_string());
        let seconds: f64 = line[column("seconds")].parse().unwrap();
        assert!(seconds > 0.0);
        assert_eq!(seconds, row["seconds"]["mean"].as_f64().unwrap());
        // Only what is clustered has an error of clustering; all have a total one.
        let clustered = !["vpl", "path"].contains(&row["method"].as_str().unwrap());
        assert_eq!(row["clustering"]["nrmse"]["mean"].as_f64().is_some(), clustered, "{row}");
        assert_eq!(line[column("clustering_nrmse")].is_empty(), !clustered);
        assert!(row["total"]["relmse"]["mean"].as_f64().unwrap() > 0.0);
    }

    let markdown = fs::read_to_string(out.join("study.md")).unwrap();
    for (experiment, setting, seconds) in TABLES {
        let row =
            rows.iter().find(|row| row["experiment"] == experiment && row["setting"] == setting);
        assert_eq!(row.unwrap()["thesis"]["total"].as_f64(), Some(seconds), "{setting}");
        let shown = markdown.lines().find(|line| {
            line.starts_with(&format!("| {setting} |")) && line.contains(&format!("{seconds:.3}"))
        });
        assert!(shown.is_some(), "{setting}");
    }
    let claims = json["claims"].as_array().unwrap();
    let verdicts: Vec<_> = claims.iter().map(|claim| claim["verdict"].as_str().unwrap()).collect();
    assert_eq!(verdicts.len(), 6);
    assert!(verdicts.iter().all(|verdict| ["confirmed", "refuted"].contains(verdict)));
    assert!(claims.iter().all(|claim| markdown.contains(claim["claim"].as_str().unwrap())));
}

#[test]
fn a_directory_that_cannot_be_written_is_refused_before_the_work() {
    let place = tempfile::tempdir().unwrap();
    fs::write(place.path().join("file"), "mine").unwrap();
    fs::create_dir_all(place.path().join("taken/study.csv")).unwrap();
    let before = entries(place.path());
    for options in ["-o file", "-o missing/out", "-o file/out", "-o taken"] {
        let output = study(place.path(), &format!("--preset quick {options}"));
        let stderr = stderr(&output);
        assert_eq!(output.status.code(), Some(1), "{options}: {stderr}");
        assert!(stderr.starts_with("error: ") && stderr.lines().count() == 1, "{stderr}");
        assert_eq!(entries(place.path()), before, "{options}");
    }
    assert_eq!(entries(&place.path().join("taken")), ["study.csv"]);
}

#[test]
fn what_cannot_be_studied_is_refused_in_a_line() {
    let place = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(place.path().join(name), text).unwrap();
    write("key.toml", "scenes = \"builtin:cornell\"\n\n[[experiment]]\nname = \"a\"\nvpl = 3\n");
    write("value.toml", "scenes = [\"builtin:cornell\"]\n[[experiment]]\nname = \"a\"\nvpls = [0]");
    write("none.toml", "scenes = [\"builtin:cornell\"]\n");
    write("broken.toml", "seeds = \n");
    for (options, words) in [
        ("", "SCENE"),
        ("--preset bogus", "give thesis, quick or extremes"),
        ("--preset extremes", "--preset extremes goes without --size"),
        ("--preset extremes builtin:cornell", "own scenes; leave SCENE out"),
        ("--preset thesis builtin:cornell", "its own scene"),
        ("--preset quick --vpls 3", "neither with --preset"),
        ("builtin:cornell --method normal", "no light"),
        ("builtin:cornell --vpls 5,x", "x"),
        ("builtin:cornell --decompose=0", "--decompose"),
        ("builtin:cornell --decompose-samples 64", "--decompose"),
        ("--preset extremes --decompose", "--preset extremes goes without --decompose"),
        ("builtin:cornell --vpls 5,,6", "empty"),
        ("builtin:cornell --direct clustered --method vpl", "clusters"),
        ("builtin:nowhere", "nowhere"),
        ("--sweep missing.toml", "missing.toml"),
        ("--sweep key.toml", "key.toml:5: "),
        ("--sweep value.toml", "value.toml:2: "),
        ("--sweep none.toml", "experiment"),
        ("--sweep broken.toml", "broken.toml:1: "),
        ("builtin:cornell builtin:room --reference x.exr", "one image"),
        ("builtin:cornell --bounces 1,2 --reference x.exr", "one image"),
    ] {
        let output = study(place.path(), &format!("{options} --size 16x16 -o out"));
        let stderr = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{options}: {stderr}");
        assert!(stderr.starts_with("error: ") && stderr.lines().count() == 1, "{stderr}");
        assert!(stderr.contains(words), "{options}: {stderr}");
    }
    for preset in ["quick", "extremes"] {
        let options = format!("--preset {preset} -o out --adapter no-such-adapter --quiet");
        assert_eq!(study(place.path(), &options).status.code(), Some(3));
        assert!(!place.path().join("out").exists());
    }
}

#[test]
fn a_sweep_measures_all_combinations_with_all_seeds() {
    let place = tempfile::tempdir().unwrap();
    let sweep = "
        name = \"mine\"
        scenes = [\"builtin:cornell\", \"builtin:cornell-point\"]
        size = \"32x32\"
        seeds = 3
        reference_samples = 64
        clustering_seeds = 2
        mask_above = 4

        [common]
        bounces = 1

        [[experiment]]
        name = \"shared\"
        title = \"clusters\"
        method = \"both\"
        vpls = [20, 40]
        point_clusters = [30, 60]

        [[experiment]]
        name = \"path\"
        method = \"path\"
        samples = [1, 2, 4]
    ";
    fs::write(place.path().join("sweep.toml"), sweep).unwrap();
    done(&study(place.path(), "--sweep sweep.toml -o out"));
    let out = place.path().join("out");
    let json = json(&out);
    assert_eq!(json["name"], "mine");
    // 7 settings with 3 seeds, and frames without clusters of 2 numbers of VPLs with 2 seeds.
    assert_eq!(json["planned"], 2 * (7 * 3 + 2 * 2));
    assert_eq!(json["finished"], json["planned"]);
    for scene in json["scenes"].as_array().unwrap() {
        let rows = scene["rows"].as_array().unwrap();
        let settings: Vec<_> = rows.iter().map(|row| row["setting"].as_str().unwrap()).collect();
        let expected = [
            "--vpls 20 --point-clusters 30",
            "--vpls 20 --point-clusters 60",
            "--vpls 40 --point-clusters 30",
            "--vpls 40 --point-clusters 60",
            "--samples 1",
            "--samples 2",
            "--samples 4",
        ];
        assert_eq!(settings, expected);
        let references = scene["references"].as_array().unwrap();
        assert_eq!(references.len(), 1);
        assert!(references[0]["noise"]["relmse"].as_f64().unwrap() > 0.0);
        for row in rows {
            assert_eq!((&row["bounces"], &row["seeds"]), (&1.into(), &3.into()));
            assert_eq!(row["reference"], references[0]["id"]);
            for metric in
                ["rmse", "mae", "bias", "nrmse", "relmse", "tile_nrmse", "flip", "max_abs"]
            {
                assert!(row["total"][metric]["mean"].is_number(), "{metric}");
                assert!(row["total"][metric]["sd"].as_f64().unwrap() > 0.0, "{metric}");
            }
            let clustered = row["method"] == "both";
            assert_eq!(row["clustering"].is_object(), clustered);
            assert!(row["command"].as_str().unwrap().contains("--size 32x32"));
        }
        // Something is fastest, and something is best.
        let front = rows.iter().filter(|row| row["pareto"].to_string().contains("relmse"));
        assert!((1..=7).contains(&front.count()));
    }
    let csv = fs::read_to_string(out.join("study.csv")).unwrap();
    assert_eq!(csv.lines().count(), 1 + 14);
}

#[test]
fn the_command_of_a_row_makes_its_image() {
    let place = tempfile::tempdir().unwrap();
    let options = "builtin:cornell --method vpc --vpls 30,60 --size 24x16 --seeds 1 --seed 7 \
                   --reference-samples 32 -o out";
    done(&study(place.path(), options));
    let json = json(&place.path().join("out"));
    let row = &rows(&json)[1];
    let command = row["command"].as_str().unwrap().strip_prefix("gpu-vpl ").unwrap();
    let status = Command::new(env!("CARGO_BIN_EXE_gpu-vpl"))
        .args(command.split_whitespace())
        .current_dir(place.path())
        .output()
        .unwrap();
    done(&status);
    let image = format!("out/measured/images/{}.exr", row["image"].as_str().unwrap());
    let [kept, made] =
        [&image[..], "vpc.exr"].map(|name| gpu_vpl::image::read(&place.path().join(name)).unwrap());
    assert_eq!(kept, made);
}
