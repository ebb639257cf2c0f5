//! The thesis's experiments through the program, at a size that takes next to no time: the
//! numbers are worth nothing, what is there and agrees is.

#![expect(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use std::fs;
use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

fn study(directory: &Path, options: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_gpu-vpl"))
        .args(["study", "--preset", "thesis", "--size", "16x16"])
        .args(options.split_whitespace())
        .env_remove("WGPU_ADAPTER_NAME")
        .current_dir(directory)
        .output()
        .unwrap()
}

fn entries(directory: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
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
    let output = study(place.path(), "-o out --seed 3");
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{stderr}");
    assert_eq!(output.stdout, b"");
    let out = place.path().join("out");
    assert_eq!(entries(&out), ["thesis.csv", "thesis.json", "thesis.md"]);

    let json: Value = serde_json::from_slice(&fs::read(out.join("thesis.json")).unwrap()).unwrap();
    let rows = json["rows"].as_array().unwrap();
    assert_eq!(rows.len(), TABLES.len() + 4 + 10 + 4 + 2);
    assert_eq!(stderr.lines().count(), rows.len(), "a line of progress a row: {stderr}");
    assert_eq!((&json["seed"], &json["width"]), (&Value::from(3), &Value::from(16)));

    let csv = fs::read_to_string(out.join("thesis.csv")).unwrap();
    let lines: Vec<_> = csv.lines().map(fields).collect();
    assert_eq!(lines.len(), rows.len() + 1);
    let column = |name: &str| lines[0].iter().position(|heading| heading == name).unwrap();
    for (line, row) in lines[1..].iter().zip(rows) {
        assert_eq!(line.len(), lines[0].len());
        assert_eq!(line[column("setting")], row["setting"].as_str().unwrap());
        assert_eq!(line[column("vpls")], row["vpls"].to_string());
        assert!(row["times"]["seconds"].as_f64().unwrap() > 0.0);
        let total: f64 = line[column("total")].parse().unwrap();
        assert_eq!(total, row["times"]["seconds"].as_f64().unwrap());
        // Only what is clustered has an error, a finite one.
        let clustered = row["method"] != "vpl";
        assert_eq!(row["error"]["nrmse"].as_f64().is_some(), clustered, "{row}");
        assert_eq!(line[column("nrmse")].is_empty(), !clustered);
    }

    let markdown = fs::read_to_string(out.join("thesis.md")).unwrap();
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
    assert!(verdicts[..5].iter().all(|verdict| ["confirmed", "refuted"].contains(verdict)));
    assert_eq!(verdicts[5], "not-measured");
    assert!(claims.iter().all(|claim| markdown.contains(claim["claim"].as_str().unwrap())));
}

#[test]
fn a_directory_that_cannot_be_written_is_refused_before_the_work() {
    let place = tempfile::tempdir().unwrap();
    fs::write(place.path().join("file"), "mine").unwrap();
    fs::create_dir_all(place.path().join("taken/thesis.csv")).unwrap();
    let before = entries(place.path());
    for options in ["-o file", "-o missing/out", "-o file/out", "-o taken"] {
        let output = study(place.path(), options);
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{options}: {stderr}");
        assert!(stderr.starts_with("error: ") && stderr.lines().count() == 1, "{stderr}");
        assert_eq!(entries(place.path()), before, "{options}");
    }
    assert_eq!(entries(&place.path().join("taken")), ["thesis.csv"]);
}

#[test]
fn a_study_that_fails_leaves_no_directory() {
    let place = tempfile::tempdir().unwrap();
    let output = study(place.path(), "-o out --adapter no-such-adapter --quiet");
    assert_eq!(output.status.code(), Some(3));
    assert_eq!(entries(place.path()), [""; 0]);
}
