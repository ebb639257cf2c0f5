//! What watches a run from outside: its time, and its memory.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// A frame that takes longer hangs: those asked for take seconds on one slow core.
const LONGEST: Duration = Duration::from_secs(120);

/// What is being done, and since when.
type Doing = Option<(Instant, String)>;

/// Ends the process when something takes too long: nothing else stops a driver that hangs.
#[derive(Debug, Clone, Default)]
pub struct Watchdog(Arc<Mutex<Doing>>);

impl Watchdog {
    /// Watches from another thread, for as long as the process lives.
    pub fn start() -> Self {
        let watchdog = Self::default();
        let watched = watchdog.clone();
        std::thread::spawn(move || {
            loop {
                std::thread::sleep(Duration::from_secs(1));
                let doing = watched.0.lock().unwrap_or_else(PoisonError::into_inner);
                if let Some((since, what)) =
                    doing.as_ref().filter(|(since, _)| since.elapsed() > LONGEST)
                {
                    eprintln!("it hangs, for {} s already: {what}", since.elapsed().as_secs());
                    std::process::exit(1);
                }
            }
        });
        watchdog
    }

    /// Something new begins.
    pub fn now(&self, doing: impl Into<String>) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) =
            Some((Instant::now(), doing.into()));
    }

    /// Nothing is done any more.
    pub fn done(&self) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = None;
    }

    /// What was begun last.
    pub fn doing(&self) -> String {
        let doing = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        doing.as_ref().map_or_else(String::new, |(_, what)| what.clone())
    }
}

/// Bytes of the process in memory, where Linux's /proc tells them.
pub fn resident() -> Option<u64> {
    const PAGE: u64 = 4096;
    let text = std::fs::read_to_string("/proc/self/statm").ok()?;
    Some(PAGE * text.split_whitespace().nth(1)?.parse::<u64>().ok()?)
}

/// The memory of a run between its scenes, when all that a scene took has been given back.
#[derive(Debug, Default)]
pub struct Memory(Vec<u64>);

impl Memory {
    pub fn note(&mut self) {
        self.0.extend(resident());
    }

    /// How far the floor of the last quarter lies above that of the second: the first warms up,
    /// and the allocator keeps pages of a large scene for a while, which lifts single values but
    /// not the floor. What leaks lifts the floor.
    /// Nothing grows in fewer scenes than there are quarters.
    pub fn growth(&self) -> u64 {
        let quarter = self.0.len() / 4;
        let floor = |of: &[u64]| of.iter().min().copied();
        let (early, late) = (&self.0[quarter..2 * quarter], &self.0[3 * quarter..]);
        floor(early).zip(floor(late)).map_or(0, |(early, late)| late.saturating_sub(early))
    }

    pub fn summary(&self) -> String {
        let mib = |bytes: Option<&u64>| bytes.map_or(0, |bytes| bytes >> 20);
        let (first, last, most) = (self.0.first(), self.0.last(), self.0.iter().max());
        format!(
            "resident: {} MiB after the first scene, {} at most, {} after the last; its floor grew by {} MiB",
            mib(first),
            mib(most),
            mib(last),
            self.growth() >> 20
        )
    }
}
