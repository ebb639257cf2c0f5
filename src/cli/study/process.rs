//! The process: how it was called, and how it is stopped.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use signal_hook::{consts::SIGINT, flag};

use crate::cli::console;
use crate::error::Error;
use crate::study::options;

/// A flag that Ctrl-C sets; pressed again, it ends the program at once.
pub fn interrupt() -> Result<Arc<AtomicBool>, Error> {
    let pressed = Arc::new(AtomicBool::new(false));
    let refuse = |error| Error::Usage(format!("study: cannot listen to Ctrl-C: {error}"));
    flag::register_conditional_shutdown(SIGINT, 130, pressed.clone()).map_err(refuse)?;
    flag::register(SIGINT, pressed.clone()).map_err(refuse)?;
    Ok(pressed)
}

/// The command as it was given.
pub fn command() -> String {
    let words = std::env::args_os().skip(1);
    let words = words.map(|word| options::quoted(&console::one_line(&word.to_string_lossy())));
    std::iter::once("gpu-vpl".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}
