//! What formats have and we do not show: the lists that readers warn by, and that `info --formats`
//! prints.

/// Something that a format has and we do not show, or not as it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Omission {
    /// The format.
    pub format: &'static str,
    /// What it has.
    pub what: &'static str,
    /// What is done instead: what the warning says.
    pub instead: &'static str,
    /// Whether the image is another for it (an error under `--strict`).
    pub changes_image: bool,
}

/// How often something occurs, and the line where it does first.
#[derive(Debug, Default, Clone, Copy)]
pub struct Tally {
    /// How often.
    pub count: u64,
    /// The line of the first, counted from 1.
    pub first: usize,
}

impl Tally {
    /// Counts one more.
    pub fn add(&mut self, line: usize) {
        self.first = if self.count == 0 { line } else { self.first };
        self.count += 1;
    }
}
