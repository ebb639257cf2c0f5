//! Signals that end the process: one line, the code that shells give them, and no half file.
//!
//! By handlers of its own, the process ends wherever it runs: for the first process of a container there
//! are no default actions. What was ignored when the process began, as SIGHUP is under `nohup`, stays ignored.

use std::ffi::OsStr;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::thread;

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
use signal_hook::iterator::Signals;
use signal_hook::{flag, low_level};

use super::console;
use crate::image::output;

/// Listens to signals for the rest of the process. `study` ends by SIGINT as it sees fit.
pub fn listen(command: Option<&OsStr>) {
    // That a file grows beyond its limit is then an error of the write, as any.
    let _ = flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
    let is_study = command == Some(OsStr::new("study"));
    let ignored = ignored();
    let ends = |signal: &i32| ignored >> (signal - 1) & 1 == 0 && !(is_study && *signal == SIGINT);
    let ending: Vec<i32> = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(ends).collect();
    // Without handlers or a thread for them, the default actions stay.
    let Ok(mut signals) = Signals::new(&ending) else { return };
    let _ = thread::Builder::new().name("signals".to_owned()).spawn(move || {
        if let Some(signal) = signals.forever().next() {
            end(signal);
        }
    });
}

/// Ends the process at once: what runs on the device may take longer than anybody waits.
fn end(signal: i32) {
    output::discard_all();
    let name = match signal {
        SIGHUP => "SIGHUP",
        SIGINT => "SIGINT",
        _ => "SIGTERM",
    };
    console::error(&format!("ended by {name}; no output is left half written"));
    low_level::exit(128 + signal);
}

/// A bit for each signal that is ignored, the first signal lowest; none where the system does not tell.
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or_default()
}
