//! What is left behind, and what is not.

use super::*;

fn entries(directory: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn stage(path: &Path, text: &str) -> Staged {
    Destination::check(path).unwrap().stage(|out| out.write_all(text.as_bytes())).unwrap()
}

#[test]
fn nothing_is_left_by_a_check_nor_by_what_is_staged_and_dropped() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("a.png");
    Destination::check(&file).unwrap();
    assert_eq!(entries(directory.path()), [""; 0]);
    drop(stage(&file, "half"));
    assert_eq!(entries(directory.path()), [""; 0]);
}

#[test]
fn an_encoder_that_fails_leaves_the_old_file() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("a.png");
    fs::write(&file, "old").unwrap();
    let error = Destination::check(&file)
        .unwrap()
        .stage(|out| out.write_all(b"half").and(Err(io::Error::other("disk full"))))
        .unwrap_err();
    assert!(error.to_string().ends_with("a.png: cannot write: disk full"), "{error}");
    assert_eq!(entries(directory.path()), ["a.png"]);
    assert_eq!(fs::read_to_string(&file).unwrap(), "old");
}

#[test]
fn committed_files_replace_old_ones_and_leave_no_temporary() {
    let directory = tempfile::tempdir().unwrap();
    let (a, b) = (directory.path().join("a.png"), directory.path().join("b.exr"));
    fs::write(&a, "old").unwrap();
    commit(vec![stage(&a, "new a"), stage(&b, "new b")]).unwrap();
    assert_eq!(entries(directory.path()), ["a.png", "b.exr"]);
    assert_eq!(fs::read_to_string(&a).unwrap(), "new a");
    assert_eq!(fs::read_to_string(&b).unwrap(), "new b");
}

#[test]
fn when_the_second_cannot_be_moved_the_first_is_gone_too() {
    let directory = tempfile::tempdir().unwrap();
    let (a, b) = (directory.path().join("a.png"), directory.path().join("b.exr"));
    let staged = vec![stage(&a, "a"), stage(&b, "b")];
    fs::create_dir(&b).unwrap();
    assert!(commit(staged).is_err());
    assert_eq!(entries(directory.path()), ["b.exr"]);
}

#[cfg(unix)]
#[test]
fn a_new_file_has_the_permissions_the_umask_leaves() {
    use std::os::unix::fs::PermissionsExt;
    let directory = tempfile::tempdir().unwrap();
    let (ours, plain) = (directory.path().join("a.png"), directory.path().join("plain"));
    commit(vec![stage(&ours, "a")]).unwrap();
    fs::write(&plain, "b").unwrap();
    let mode = |path| fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&ours), mode(&plain));
}

#[cfg(unix)]
#[test]
fn a_symbolic_link_stays_and_its_target_is_written() {
    let directory = tempfile::tempdir().unwrap();
    let (target, link) = (directory.path().join("target.png"), directory.path().join("link.png"));
    fs::write(&target, "old").unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    let (to_target, to_link) = (Destination::check(&target), Destination::check(&link));
    assert!(to_target.unwrap().clashes_with(&to_link.unwrap()));
    commit(vec![stage(&link, "new")]).unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::read_to_string(&target).unwrap(), "new");
}

#[cfg(unix)]
#[test]
fn a_device_is_written_and_stays_a_device() {
    let null = Path::new("/dev/null");
    let destination = Destination::check(null).unwrap();
    assert_eq!(destination.format().unwrap(), Format::Png);
    commit(vec![stage(null, "gone")]).unwrap();
    assert!(!fs::metadata(null).unwrap().is_file());
}

#[test]
fn what_cannot_be_written_is_refused_with_a_reason() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name);
    let refusal = |path: &Path| Destination::check(path).unwrap_err().to_string();
    assert!(refusal(directory.path()).contains("is a directory"));
    assert!(refusal(&path("missing/a.png")).contains("does not exist"));
    assert!(refusal(&path("a.png/")).contains("names no file"));
    fs::write(path("old.png"), "old").unwrap();
    let mut permissions = fs::metadata(path("old.png")).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(path("old.png"), permissions).unwrap();
    assert!(refusal(&path("old.png")).contains("read-only"));
    assert!(Destination::check(&path("old.png/a.png")).is_err());
}

#[test]
fn the_format_is_that_of_the_ending_in_any_case() {
    let directory = tempfile::tempdir().unwrap();
    let format = |name: &str| Destination::check(&directory.path().join(name)).unwrap().format();
    assert_eq!(format("a.PNG").unwrap(), Format::Png);
    assert_eq!(format("a.b.eXr").unwrap(), Format::Exr);
    assert!(format("a.jpg").is_err());
    assert!(format("png").is_err());
    assert_eq!(Destination::check(Path::new("-")).unwrap().format().unwrap(), Format::Png);
}
