//! The outputs of a render: what is written, what is refused, and what a failure leaves.

use std::fs;

use super::{SMALL, run};

#[test]
fn outputs_that_clash_or_have_no_format_are_code_2() {
    for (line, says) in [
        ("render -o a.jpg", "a.jpg: unknown image format"),
        ("render -o a", "unknown image format"),
        ("render -o a.png -o a.png", "two outputs"),
        ("render -o a.png -o ./a.png", "two outputs"),
        ("render -o - -o -", "two outputs"),
        ("render -o - --report -", "two outputs"),
        ("render -o a.png --report a.png", "two outputs"),
        ("render -o a.png -o a.depth.png --aov depth", "two outputs"),
        ("render -o - --aov depth", "--aov needs files"),
    ] {
        run(line).fails(2, says);
    }
}

#[test]
fn outputs_that_cannot_be_written_are_code_1_before_anything_else() {
    // The scene is missing too, which would be code 2: outputs are looked at first.
    run("render none.obj -o missing/a.png").fails(1, "missing does not exist");
    run("render none.obj -o a.png/").fails(1, "a.png/: cannot write");
    run("render none.obj -o .").fails(1, "is a directory");
    run("render none.obj -o a.png --report .").fails(1, "is a directory");
    run("render none.obj -o a.png --report missing/a.json").fails(1, "does not exist");
    let run = run("render none.obj -o a.png");
    fs::write(run.path("a.png"), "old").unwrap();
    let mut permissions = fs::metadata(run.path("a.png")).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(run.path("a.png"), permissions).unwrap();
    run.fails(1, "a.png: cannot write: it is read-only");
    assert_eq!(fs::read_to_string(run.path("a.png")).unwrap(), "old");
}

#[test]
fn a_render_writes_every_output_and_nothing_else() {
    let run = run(&format!("{SMALL} -o a.png -o b.EXR -o c.exr --aov normal,depth,normal"));
    let outcome = run.succeeds();
    assert_eq!(outcome.stderr, "");
    assert_eq!(outcome.files, ["a.depth.png", "a.normal.png", "a.png", "b.EXR", "c.exr"]);
    let png = image::open(run.path("a.png")).unwrap();
    assert_eq!((png.width(), png.height()), (16, 12));
    let exr = exr::prelude::read_all_flat_layers_from_file(run.path("c.exr")).unwrap();
    let channels: Vec<_> =
        exr.layer_data[0].channel_data.list.iter().map(|c| c.name.to_string()).collect();
    assert_eq!(channels, ["B", "G", "R", "depth.Z", "normal.X", "normal.Y", "normal.Z"]);
    let keys: Vec<_> = exr.layer_data[0].attributes.other.keys().map(ToString::to_string).collect();
    for key in ["time", "method", "vpls", "seed", "clamp", "adapter"] {
        assert!(keys.iter().any(|found| found == key), "{key} is not in {keys:?}");
    }
}

#[test]
fn standard_output_and_devices_are_written_directly() {
    let outcome = run(&format!("{SMALL} -o -")).succeeds();
    assert!(outcome.stdout.starts_with(b"\x89PNG"));
    assert_eq!(outcome.files, [""; 0]);
    if cfg!(unix) {
        run(&format!("{SMALL} -o /dev/null")).succeeds();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_code_1_and_takes_the_other_outputs_with_it() {
    run(&format!("{SMALL} -o a.png -o /dev/full")).fails(1, "/dev/full: cannot write");
}
