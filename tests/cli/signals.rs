//! Signals and limits of the system: one line, the code that shells give, and no half file.

#![cfg(unix)]

use std::io::Read as _;
use std::os::unix::process::ExitStatusExt as _;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

use super::child::Started;
use super::entries;

/// Hours of work, if it were let.
const LONG: &str =
    "render builtin:room --method path --samples 65536 --size 1024x1024 -o x.exr -o x.png";

/// Within this a process ends that is told to, whose work takes hours: on an idle machine at once, but
/// others of these tests render beside it.
const SOON: Duration = Duration::from_secs(30);

fn directory() -> TempDir {
    tempfile::tempdir().expect("a directory for the test")
}

/// Starts the program by these words before it, and waits until it renders.
fn started(directory: &TempDir, before: &[&str]) -> Started {
    let program = env!("CARGO_BIN_EXE_gpu-vpl");
    let words: Vec<&str> = before.iter().copied().chain([program]).chain(LONG.split(' ')).collect();
    let mut child = Started::of(
        Command::new(words[0])
            .args(&words[1..])
            .current_dir(directory.path())
            .stdout(Stdio::null())
            .stderr(Stdio::piped()),
    );
    let mut line = Vec::new();
    let stderr = child.stderr.as_mut().expect("it is piped");
    while !line.ends_with(b"\n") {
        let mut byte = [0];
        assert_eq!(stderr.read(&mut byte).expect("it speaks"), 1, "it ended before it rendered");
        line.push(byte[0]);
    }
    let line = String::from_utf8_lossy(&line).into_owned();
    assert!(line.starts_with("adapter: "), "{line}");
    child
}

/// What is left when it has ended by a signal: its code, and what it said since.
fn ended(child: &mut Started) -> (Option<i32>, String) {
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().expect("it is a child of this process") {
            break status;
        }
        assert!(start.elapsed() < SOON, "it goes on");
        std::thread::sleep(Duration::from_millis(20));
    };
    let mut said = String::new();
    let stderr = child.stderr.as_mut().expect("it is piped");
    stderr.read_to_string(&mut said).expect("UTF-8");
    assert_eq!(status.signal(), None, "{said}");
    (status.code(), said)
}

#[test]
fn signals_end_it_with_their_code_and_one_line() {
    for (signal, name, code) in [
        (libc::SIGTERM, "SIGTERM", 143),
        (libc::SIGINT, "SIGINT", 130),
        (libc::SIGHUP, "SIGHUP", 129),
    ] {
        let place = directory();
        let mut child = started(&place, &[]);
        child.send(signal);
        let (got, said) = ended(&mut child);
        assert_eq!(got, Some(code), "{said}");
        assert_eq!(said, format!("error: ended by {name}; no output is left half written\n"));
        assert!(entries(place.path()).is_empty(), "{:?}", entries(place.path()));
    }
}

#[test]
fn what_was_ignored_stays_ignored() {
    let place = directory();
    let mut child = started(&place, &["sh", "-c", "trap '' HUP; exec \"$@\"", "sh"]);
    child.send(libc::SIGHUP);
    std::thread::sleep(Duration::from_millis(500));
    assert!(child.try_wait().expect("a child").is_none(), "it has ended");
    child.send(libc::SIGTERM);
    assert_eq!(ended(&mut child).0, Some(143));
}

/// The first process of a container has no default actions. Where namespaces are not allowed, there is
/// nothing to test.
#[test]
fn the_first_process_of_a_container_ends_as_well() {
    let unshare = ["unshare", "--user", "--map-root-user", "--pid", "--fork", "--kill-child"];
    let allowed = Command::new(unshare[0]).args(&unshare[1..]).arg("true").output();
    if !allowed.is_ok_and(|output| output.status.success()) {
        return;
    }
    for (signal, code) in [("TERM", 143), ("INT", 130)] {
        let place = directory();
        let mut child = started(&place, &unshare);
        let of = format!("/proc/{0}/task/{0}/children", child.id());
        let first = std::fs::read_to_string(of).expect("the system tells").trim().to_owned();
        assert!(first.parse::<u32>().is_ok(), "{first}");
        let sent = Command::new("sh").args(["-c", &format!("kill -{signal} {first}")]).status();
        assert!(sent.is_ok_and(|status| status.success()), "{signal} {first}");
        assert_eq!(ended(&mut child).0, Some(code));
        assert!(entries(place.path()).is_empty());
    }
}

#[test]
fn a_limit_of_file_sizes_is_an_error_of_the_write() {
    let place = directory();
    let program = env!("CARGO_BIN_EXE_gpu-vpl");
    let line = format!(
        "ulimit -f 8; exec {program} render --size 256x256 --method direct --quiet -o x.exr"
    );
    let output = Command::new("sh").args(["-c", &line]).current_dir(place.path()).output();
    let output = output.expect("a shell");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said} {:?}", output.status);
    assert!(
        said.starts_with("error: x.exr: cannot write: ") && said.lines().count() == 1,
        "{said}"
    );
    assert!(entries(place.path()).is_empty());
}

/// A device that is always full.
#[test]
fn a_full_disk_is_an_error_of_the_write() {
    if !std::path::Path::new("/dev/full").exists() {
        return;
    }
    super::run(&format!("{} -o /dev/full", super::SMALL)).fails(1, "No space left");
}
