//! Studies that are broken off, and references that are not what they should be.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use gpu_vpl::image::{Image, exr, read};
use serde_json::Value;

use super::{command, json, stderr, study};
use crate::common::child::Started;

const SWEEP: &str = "builtin:cornell --method both,vpl,path --vpls 20,200 --samples 4 \
                     --size 48x32 --seeds 3 --reference-samples 32 --clustering-seeds 3";

fn run(directory: &Path, options: &str) -> (Option<i32>, String) {
    let output = study(directory, options);
    (output.status.code(), stderr(&output))
}

/// Without what time changes, and without the name of the directory.
fn timeless(mut value: Value) -> Value {
    const TIMES: [&str; 9] = [
        "seconds",
        "preprocess",
        "render",
        "phases",
        "speedup",
        "efficiency",
        "pareto",
        "fits",
        "command",
    ];
    match &mut value {
        Value::Object(map) => {
            map.retain(|key, _| !TIMES.contains(&key.as_str()));
            map.values_mut().for_each(|value| *value = timeless(value.take()));
        }
        Value::Array(items) => items.iter_mut().for_each(|item| *item = timeless(item.take())),
        _ => {}
    }
    value
}

/// Waits until so many lines are in the log of a study under way.
fn wait_for(log: &Path, lines: usize, child: &mut Child) {
    let start = Instant::now();
    loop {
        let text = fs::read_to_string(log).unwrap_or_default();
        if text.lines().count() >= lines {
            return;
        }
        assert!(child.try_wait().unwrap().is_none(), "it ended before it could be broken off");
        assert!(start.elapsed() < Duration::from_secs(120), "nothing was measured");
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn a_killed_study_goes_on() {
    let place = tempfile::tempdir().unwrap();
    assert_eq!(run(place.path(), &format!("{SWEEP} -o whole")).0, Some(0));
    let options = format!("{SWEEP} -o killed");
    // In the midst of the reference, and in the midst of the rows.
    let log = place.path().join("killed/measured/measured.jsonl");
    for lines in [5, 22] {
        let mut child = Started::of(command(place.path(), &options).stderr(Stdio::null()));
        wait_for(&log, lines, &mut child);
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(!place.path().join("killed/study.json").exists());
    }
    let (code, stderr) = run(place.path(), &options);
    assert_eq!(code, Some(0), "{stderr}");
    assert!(stderr.contains("(kept)"), "{stderr}");
    let [whole, killed] = ["whole", "killed"].map(|name| timeless(json(&place.path().join(name))));
    assert_eq!(whole, killed);
    // Once more there is nothing left to measure, unless it is asked for.
    let (_, stderr) = run(place.path(), &options);
    let frames = |text: &str| text.lines().filter(|line| line.contains(" seed ")).count();
    assert_eq!(stderr.lines().filter(|line| line.ends_with("(kept)")).count(), frames(&stderr));
    let (_, stderr) = run(place.path(), &format!("{options} --fresh"));
    assert!(frames(&stderr) > 0 && !stderr.contains("(kept)"), "{stderr}");
}

#[cfg(unix)]
#[test]
fn ctrl_c_writes_what_is_done() {
    let place = tempfile::tempdir().unwrap();
    let options = format!("{SWEEP} -o out");
    let mut child = Started::of(command(place.path(), &options).stderr(Stdio::piped()));
    wait_for(&place.path().join("out/measured/measured.jsonl"), 20, &mut child);
    child.send(libc::SIGINT);
    let mut stderr = String::new();
    child.stderr.take().unwrap().read_to_string(&mut stderr).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{stderr}");
    assert!(stderr.lines().last().unwrap().starts_with("error: interrupted: "), "{stderr}");
    let out = place.path().join("out");
    let partial = json(&out);
    let finished = partial["finished"].as_u64().unwrap();
    assert!((1..partial["planned"].as_u64().unwrap()).contains(&finished), "{finished}");
    assert!(!partial["scenes"][0]["rows"].as_array().unwrap().is_empty());
    let markdown = fs::read_to_string(out.join("study.md")).unwrap();
    assert!(markdown.contains("Interrupted: "));
    let page = fs::read_to_string(out.join("study.html")).unwrap();
    assert!(page.contains(&format!("\"finished\":{finished}")));
    let (code, stderr) = run(place.path(), &options);
    assert_eq!(code, Some(0), "{stderr}");
    assert_eq!(json(&out)["finished"], json(&out)["planned"]);
}

#[cfg(unix)]
#[test]
fn broken_off_extremes_are_written_and_go_on() {
    let place = tempfile::tempdir().unwrap();
    // Breaks it off after its first case, of which it gives what is said.
    let first_case = |options: &str| {
        let options = format!("--preset extremes -o out {options}");
        let mut child = Started::of(command(place.path(), &options).stderr(Stdio::piped()));
        let mut told = BufReader::new(child.stderr.take().unwrap()).lines().map_while(Result::ok);
        let first = told.find(|line| line.starts_with("1 of ")).expect("no case was run");
        child.send(libc::SIGINT);
        let last = told.last().unwrap();
        assert!(last.starts_with("error: interrupted: "), "{last}");
        assert_eq!(child.wait().unwrap().code(), Some(130), "{last}");
        let table = fs::read_to_string(place.path().join("out/extremes.md")).unwrap();
        assert!(table.contains("\nInterrupted: "), "{table}");
        let figure = "| point light over a plane |";
        (first, table.lines().find(|line| line.starts_with(figure)).unwrap().to_owned())
    };
    let (measured, figure) = first_case("");
    assert!(!measured.contains("(kept)"), "{measured}");
    assert_eq!(first_case(""), (format!("{measured} (kept)"), figure.clone()));
    assert_eq!(first_case("--fresh"), (measured, figure));
}

fn write(file: &Path, image: &Image) {
    let planes = [exr::Plane { layer: "", channels: "RGB", image }];
    let staged = gpu_vpl::image::Destination::check(file)
        .unwrap()
        .stage(|out| exr::write(out, &planes, &Vec::new()))
        .unwrap();
    gpu_vpl::image::output::commit(vec![staged]).unwrap();
}

#[test]
fn a_wrong_reference_is_caught_and_named() {
    let place = tempfile::tempdir().unwrap();
    let render = "render builtin:cornell --method path --samples 1024 --size 48x48 --seed 99 \
                  -o good.exr";
    let status = Command::new(env!("CARGO_BIN_EXE_gpu-vpl"))
        .args(render.split_whitespace())
        .current_dir(place.path())
        .status();
    assert!(status.unwrap().success());
    let good = read(&place.path().join("good.exr")).unwrap();
    let perturbed = |name: &str, change: &dyn Fn(&mut Image)| {
        let mut image = good.clone();
        change(&mut image);
        write(&place.path().join(name), &image);
    };
    perturbed("bright.exr", &|image| {
        image.pixels.as_flattened_mut().iter_mut().for_each(|value| *value *= 1.01);
    });
    perturbed("nan.exr", &|image| image.pixels[48 * 5 + 7][1] = f32::NAN);
    perturbed("small.exr", &|image| {
        image.height = 47;
        image.pixels.truncate(48 * 47);
    });
    let against = |reference: &str| {
        let options = "builtin:cornell --method both --vpls 20 --seeds 1";
        run(place.path(), &format!("{options} --size 48x48 --reference {reference} -o out"))
    };

    let (code, stderr) = against("good.exr");
    assert_eq!(code, Some(0), "{stderr}");
    assert!(!stderr.contains("warning"), "{stderr}");
    let (code, stderr) = against("bright.exr");
    assert_eq!(code, Some(0), "{stderr}");
    let warning = stderr.lines().find(|line| line.starts_with("warning: bright.exr: it is "));
    assert!(warning.is_some_and(|line| line.contains(" % brighter than")), "{stderr}");
    let json = json(&place.path().join("out"));
    assert!(json["scenes"][0]["references"][0]["warnings"][0].as_str().unwrap().contains("bright"));
    let (code, stderr) = against("nan.exr");
    assert_eq!(code, Some(2), "{stderr}");
    assert!(stderr.contains("nan.exr: pixel (7, 5) is not finite"), "{stderr}");
    let (code, stderr) = against("small.exr");
    assert_eq!(code, Some(2), "{stderr}");
    assert!(stderr.contains("small.exr: it is 48 x 47 pixels"), "{stderr}");
}

#[test]
fn a_kept_reference_that_was_changed_is_rendered_anew() {
    let place = tempfile::tempdir().unwrap();
    let options = "builtin:cornell --method both --vpls 20 --seeds 1 --size 32x32 \
                   --reference-samples 32 -o out";
    assert_eq!(run(place.path(), options).0, Some(0));
    let before = timeless(json(&place.path().join("out")));
    let images = place.path().join("out/measured/images");
    let mut changed = 0;
    for entry in fs::read_dir(&images).unwrap() {
        let file = entry.unwrap().path();
        if file.extension().is_some_and(|ending| ending == "exr") {
            let mut image = read(&file).unwrap();
            image.pixels.as_flattened_mut().iter_mut().for_each(|value| *value *= 1.01);
            write(&file, &image);
            changed += 1;
        }
    }
    assert!(changed >= 16);
    let (code, stderr) = run(place.path(), options);
    assert_eq!(code, Some(0), "{stderr}");
    assert_eq!(stderr.matches("16 of 16 parts of the reference").count(), 1, "{stderr}");
    let mut after = timeless(json(&place.path().join("out")));
    assert!(!after["scenes"][0]["references"][0]["warnings"].as_array().unwrap().is_empty());
    after["scenes"][0]["references"][0]["warnings"] =
        before["scenes"][0]["references"][0]["warnings"].clone();
    assert_eq!(before, after);
}
