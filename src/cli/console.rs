//! What is said on standard output and standard error, neither of which may be there.

use std::io::{self, IsTerminal, Write};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Prints text to standard output. A reader that went away (`| head`) is no error.
pub fn print(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}

/// Prints an error as one line to standard error.
pub fn error(message: &str) {
    say(&format!("error: {}", one_line(message)));
}

/// Prints a warning as one line to standard error.
pub fn warning(message: &str) {
    say(&format!("warning: {}", one_line(message)));
}

/// Prints a line to standard error; without one there is nobody to tell.
pub fn say(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}

/// Line breaks and other control characters, which a file name may hold, become blanks.
pub fn one_line(text: &str) -> String {
    text.trim().replace("\r\n", " ").replace(|c: char| c.is_control(), " ")
}

/// A bar on a terminal; nothing anywhere else.
#[derive(Debug)]
pub struct Progress(ProgressBar);

impl Progress {
    /// The bar's resolution.
    const STEPS: u64 = 1000;

    /// Shows a bar if there is a terminal and it is wanted.
    pub fn new(wanted: bool) -> Self {
        let target = if wanted && io::stderr().is_terminal() {
            ProgressDrawTarget::stderr()
        } else {
            ProgressDrawTarget::hidden()
        };
        let bar = ProgressBar::with_draw_target(Some(Self::STEPS), target);
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} % {msg}") {
            bar.set_style(style);
        }
        Self(bar)
    }

    /// Moves the bar to a fraction and names the phase.
    pub fn set(&self, fraction: f64, phase: &'static str) {
        self.0.set_position((fraction.clamp(0.0, 1.0) * Self::STEPS as f64) as u64);
        self.0.set_message(phase);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_is_always_one_line() {
        assert_eq!(one_line("a\nb\r\nc\u{7}d\n"), "a b c d");
    }
}
