//! What a study says while it runs: a line a frame, and how long it will take.

use std::cell::RefCell;
use std::time::Duration;

use indicatif::HumanDuration;

use crate::cli::console;
use crate::study::parts::{Decomposition, Replaced};
use crate::study::{Event, Measured, Plan, options};

/// Tells events on standard error.
#[derive(Debug)]
pub struct Progress {
    quiet: bool,
    state: RefCell<State>,
}

#[derive(Debug)]
struct State {
    planned: usize,
    done: usize,
    /// Of all frames planned, in order: which settings.
    frames: Vec<String>,
    /// Seconds of settings measured so far.
    known: Vec<(String, f64)>,
}

impl Progress {
    /// For a plan; `quiet` tells warnings only.
    pub fn new(plan: &Plan, quiet: bool) -> Self {
        let seeds = || 0..plan.seeds.len();
        let of_scene = |_| {
            seeds().flat_map(|index| plan.frames_of_seed(index)).map(|frame| options::all(&frame))
        };
        let frames = plan.scenes.iter().flat_map(of_scene).collect();
        let state = State { planned: plan.planned(), done: 0, frames, known: Vec::new() };
        Self { quiet, state: RefCell::new(state) }
    }

    /// Tells an event.
    pub fn tell(&self, event: Event<'_>) {
        match event {
            Event::Warning(what) => console::warning(what),
            Event::Pass { scene, done, passes, seconds } if !self.quiet => {
                console::say(&console::one_line(&format!(
                    "{scene}: reference {done} of {passes}: {seconds:.2} s"
                )));
            }
            Event::Frame { scene, settings, seed, measured, kept } => {
                let mut state = self.state.borrow_mut();
                state.done += 1;
                state.known.push((options::all(settings), measured.times.seconds));
                if !self.quiet {
                    let text = options::changed(settings);
                    let line = format!(
                        "{} of {}: {scene} {text}, seed {seed}: {}{}",
                        state.done,
                        state.planned,
                        result(measured, kept),
                        state.left()
                    );
                    console::say(&console::one_line(&line));
                }
            }
            Event::Part { scene, settings, seed, seconds } if !self.quiet => {
                let text = options::changed(settings);
                let line = format!("{scene}: part {text}, seed {seed}: {seconds:.2} s");
                console::say(&console::one_line(&line));
            }
            Event::Decomposed { scene, settings, seed, decomposition, kept } if !self.quiet => {
                let text = options::changed(settings);
                let left = left(decomposition, kept);
                let line = format!("{scene}: taken apart {text}, seed {seed}: {left}");
                console::say(&console::one_line(&line));
            }
            Event::Pass { .. } | Event::Part { .. } | Event::Decomposed { .. } => {}
        }
    }
}

fn result(measured: &Measured, kept: bool) -> String {
    let error =
        measured.total.as_ref().map(|error| format!(", relMSE {:.2e}", error.metrics.relmse));
    let kept = if kept { " (kept)" } else { "" };
    format!("{:.3} s{}{kept}", measured.times.seconds, error.unwrap_or_default())
}

/// What is left of an error with each part replaced.
fn left(decomposition: &Decomposition, kept: bool) -> String {
    let part = |own: &Replaced| format!(", {} {:.2e}", own.part.name(), own.left.relmse);
    let parts: String = decomposition.parts.iter().map(part).collect();
    let kept = if kept { " (kept)" } else { "" };
    format!("relMSE {:.2e}, without{}{kept}", decomposition.whole.relmse, &parts[1..])
}

impl State {
    /// The time that the frames to come take, where settings are known; others count as a mean
    /// frame.
    fn left(&self) -> String {
        let total: f64 = self.known.iter().map(|known| known.1).sum();
        let mean = total / self.known.len().max(1) as f64;
        let seconds = |frame: &String| {
            let known = self.known.iter().rev().find(|known| known.0 == *frame);
            known.map_or(mean, |known| known.1)
        };
        let left: f64 = self.frames.iter().skip(self.done).map(seconds).sum();
        match Duration::try_from_secs_f64(left) {
            Ok(left) if left >= Duration::from_secs(10) => {
                format!("; about {} left", HumanDuration(left))
            }
            _ => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_to_come_take_as_long_as_those_like_them() {
        let frames = ["a", "b", "a", "b", "c"].map(str::to_owned).into();
        let known = vec![("a".to_owned(), 10.0), ("b".to_owned(), 110.0)];
        let state = State { planned: 5, done: 2, frames, known };
        // 10 + 110 + a mean one of 60.
        assert_eq!(state.left(), "; about 3 minutes left");
    }
}
