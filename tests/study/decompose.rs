//! Errors taken apart: settings whose error has one reason, which has to be found.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::{done, fields, json, rows, stderr, study};

/// What errors are made of.
const PARTS: [&str; 6] = ["direct", "antialiasing", "clamp", "sharing", "interleaving", "vpls"];

/// Settings, and the part that most of their error comes from.
type Case = (&'static str, &'static str);

/// One shadow ray to a lamp; no camera rays at edges; a bound on G far too tight.
const LAMP: [Case; 3] = [
    ("method = \"direct\"\nlight_samples = 1", "direct"),
    ("method = \"direct\"\nlight_samples = 64\nedge_samples = 1", "antialiasing"),
    ("method = \"vpl\"\nlight_samples = 64\nvpls = 300\nclamp = 1e-7", "clamp"),
];

/// Three clusters of points; one of 64 subsets of few VPLs at each pixel; hardly any VPLs.
const POINT: [Case; 3] = [
    (
        "method = \"vpc\"\nvpls = 500\npoint_clusters = 3\nfuzzy = 1\nprobes = 0\ninterleave = 1",
        "sharing",
    ),
    ("method = \"vpc\"\nvpls = 100\npoint_clusters = 500\ninterleave = 8", "interleaving"),
    ("method = \"vpl\"\nvpls = 5\nclamp = \"off\"", "vpls"),
];

/// The rows of a study of a scene in these settings.
fn taken_apart(place: &Path, scene: &str, cases: &[Case]) -> Value {
    let mut sweep = format!("scenes = [\"{scene}\"]\nsize = \"32x32\"\nseeds = 2\n");
    sweep += "reference_samples = 1024\n";
    for (settings, part) in cases {
        sweep += &format!("[[experiment]]\nname = \"{part}\"\n{settings}\n");
    }
    fs::write(place.join("sweep.toml"), sweep).unwrap();
    done(&study(place, "--sweep sweep.toml --decompose -o out"));
    json(&place.join("out"))
}

/// A figure of a part; none if the row does not have the part.
fn of_part(row: &Value, part: &str, figure: &str) -> Option<f64> {
    let parts = row["decomposition"]["parts"].as_array().unwrap();
    let figure = &parts.iter().find(|own| own["part"] == part)?[figure];
    figure["mean"].as_f64().or(figure.as_f64())
}

fn whole(row: &Value) -> f64 {
    row["decomposition"]["relmse"]["mean"].as_f64().unwrap()
}

/// The part of the error that goes when a part of the image is replaced.
fn share(row: &Value, part: &str) -> f64 {
    of_part(row, part, "share").unwrap_or(0.0) / whole(row)
}

/// Most of each row's error comes from the part that it is named after.
fn each_is_found(found: &Value) {
    for row in rows(found) {
        let shares = PARTS.map(|part| (part, share(row, part)));
        let most = shares.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        assert_eq!(row["experiment"], most.0, "{shares:?}");
        assert!(most.1 > 0.4, "{shares:?}");
        let left = of_part(row, most.0, "relmse").unwrap() / whole(row);
        assert!((left + most.1 - 1.0).abs() < 0.05, "{left} {shares:?}");
        // All shares and their interaction are all of the error.
        let interaction = row["decomposition"]["interaction"]["mean"].as_f64().unwrap();
        let sum: f64 = shares.iter().map(|(_, share)| share).sum();
        assert!((sum + interaction / whole(row) - 1.0).abs() < 1e-9, "{shares:?}");
        // One of two seeds; the image as it is has the error of the row, less the reference's.
        assert_eq!((&row["decomposition"]["seeds"], &row["seeds"]), (&1.into(), &2.into()));
        assert!(row["decomposition"]["reference_noise"].as_f64().unwrap() > 0.0);
    }
}

#[test]
fn errors_are_found_where_they_come_from() {
    let place = tempfile::tempdir().unwrap();
    let found = taken_apart(place.path(), "builtin:cornell", &LAMP);
    each_is_found(&found);
    // With a converged lamp, what is left of its noise is less than a third, and is told.
    let noisy = &rows(&found)[0];
    let noise = of_part(noisy, "direct", "noise").unwrap();
    assert!(noise > 0.0 && noise < 0.02 * whole(noisy), "{noise}");
}

#[test]
fn point_lights_have_no_noise_to_find() {
    let place = tempfile::tempdir().unwrap();
    let found = taken_apart(place.path(), "builtin:cornell-point", &POINT);
    each_is_found(&found);
    for row in rows(&found) {
        assert_eq!(of_part(row, "direct", "share"), Some(0.0), "{row}");
        assert_eq!(of_part(row, "direct", "noise"), Some(0.0), "{row}");
    }
}

#[test]
fn what_was_taken_apart_is_in_every_table_and_is_not_taken_apart_again() {
    let place = tempfile::tempdir().unwrap();
    let options = "builtin:cornell --method both,path --vpls 50 --size 16x16 --seeds 2 \
                   --reference-samples 32 --decompose=9 --clustering-seeds 0 -o out";
    done(&study(place.path(), options));
    let out = place.path().join("out");
    let found = json(&out);
    let [both, path] = [0, 1].map(|index| &rows(&found)[index]);
    assert!(path["decomposition"].is_null());
    assert_eq!(both["decomposition"]["seeds"], 2);
    assert!(both["decomposition"]["relmse"]["sd"].as_f64().unwrap() > 0.0);
    // No frame without clusters was asked for; there is a bound, and subsets.
    assert_eq!(of_part(both, "sharing", "relmse"), None);
    for part in ["clamp", "interleaving", "indirect", "all"] {
        assert!(of_part(both, part, "relmse").is_some(), "{part}");
    }
    let csv = fs::read_to_string(out.join("study.csv")).unwrap();
    let lines: Vec<_> = csv.lines().map(fields).collect();
    let column = |name: &str| lines[0].iter().position(|own| own == name).unwrap();
    let left = column("without_clamp_relmse");
    assert_eq!(lines[1][left], of_part(both, "clamp", "relmse").unwrap().to_string());
    assert_eq!((&lines[2][left][..], lines[2].len()), ("", lines[0].len()));
    assert_eq!(lines[1][column("without_sharing_relmse")], "");
    let markdown = fs::read_to_string(out.join("study.md")).unwrap();
    assert!(markdown.contains("### Where the error comes from"));
    // Nothing is rendered anew, and the same is found.
    let again = study(place.path(), options);
    let said = stderr(&again);
    assert_eq!(said.lines().filter(|line| line.contains("taken apart")).count(), 2, "{said}");
    assert!(said.lines().all(|line| line.ends_with("(kept)")), "{said}");
    assert_eq!(json(&out)["scenes"][0]["rows"][0]["decomposition"], both["decomposition"]);
    // Without being asked for there are no columns.
    done(&study(place.path(), &options.replace("--decompose=9", "")));
    let csv = fs::read_to_string(out.join("study.csv")).unwrap();
    assert!(!csv.contains("without_") && rows(&json(&out))[0]["decomposition"].is_null());
}
