//! What the user should know, told once and kept for the report.

use crate::cli::console;
use crate::error::Error;
use crate::image::Image;
use crate::image::exposure::{self, Look};
use crate::render::{Frame, Settings};
use crate::report::warnings;
use crate::scene::Warning;

/// The warnings of a run; under `--strict` those that change the image end it.
#[derive(Debug)]
pub struct Warnings {
    quiet: bool,
    strict: bool,
    /// All of them so far, a line each.
    pub messages: Vec<String>,
}

impl Warnings {
    /// None yet.
    pub fn new(quiet: bool, strict: bool) -> Self {
        Self { quiet, strict, messages: Vec::new() }
    }

    /// Tells one, unless it ends the run.
    ///
    /// # Errors
    /// It changes the image, and the run is strict.
    pub fn add(&mut self, warning: Warning) -> Result<(), Error> {
        if self.strict {
            warnings::strict(&warning)?;
        }
        if !self.quiet {
            console::warning(&warning.message);
        }
        self.messages.push(warning.message);
        Ok(())
    }

    /// Warns of what a frame lacks.
    ///
    /// # Errors
    /// It lacks something, and the run is strict.
    pub fn check(&mut self, frame: &Frame, settings: &Settings) -> Result<(), Error> {
        warnings::of_frame(frame, settings)
            .try_for_each(|message| self.add(Warning { message, changes_image: true }))
    }
}

/// What to say of an image of light that cannot be seen.
pub fn look(image: &Image, exposure: f32, has_png: bool) -> Option<String> {
    let fits = |what: &str, stops: f32| {
        format!(
            "nearly all that is seen is {what} at this exposure; --exposure {stops} would fit it"
        )
    };
    match exposure::look(image, exposure) {
        Look::Black => Some(
            "the image is black all over: no surface is seen, or no light reaches those that are"
                .to_owned(),
        ),
        Look::Dark(stops) if has_png => Some(fits("black", stops)),
        Look::Clipped(stops) if has_png => Some(fits("white", stops)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strictness_passes_what_does_not_change_the_image() {
        let warning = Warning { message: "slow".to_owned(), changes_image: false };
        assert!(Warnings::new(true, true).add(warning).is_ok());
    }
}
