//! The frames of a run: the image itself, its repeats, its AOVs.

use std::time::Instant;

use super::aov::Aov;
use crate::cli::console::Progress;
use crate::denoise::Denoiser;
use crate::error::Error;
use crate::image::Image;
use crate::render::{self, Direct, Frame, Prepared, Settings};
use crate::report::FrameTimes;
use crate::scene::Camera;

/// What all frames of a run share.
#[derive(Debug)]
pub struct Job {
    /// Scene and device.
    pub prepared: Prepared,
    /// Where it is seen from, in the size asked for.
    pub camera: Camera,
    /// How it is rendered.
    pub settings: Settings,
    /// Of all random numbers.
    pub seed: u32,
    /// What takes the noise of the image, but not of its AOVs.
    pub denoiser: Option<Denoiser>,
    /// No progress bar.
    pub quiet: bool,
}

impl Job {
    fn frame(&self, settings: &Settings, denoiser: Option<&Denoiser>) -> Result<Frame, Error> {
        let bar = Progress::new(!self.quiet);
        let progress = |fraction, phase| bar.set(fraction, phase);
        let Self { prepared, camera, seed, .. } = self;
        match denoiser {
            Some(denoiser) => Ok(denoiser.frame(prepared, camera, settings, *seed, &progress)?),
            None => Ok(render::frame(prepared, camera, settings, *seed, &progress)?),
        }
    }

    fn timed_frame(&self) -> Result<(Frame, FrameTimes), Error> {
        let start = Instant::now();
        let frame = self.frame(&self.settings, self.denoiser.as_ref())?;
        let times = FrameTimes::new(start.elapsed(), &frame.phases);
        Ok((frame, times))
    }

    /// Renders the same frame several times: the first, with the times of dispatches of the last, and the
    /// times of all.
    ///
    /// # Errors
    /// The device or the denoiser fails.
    pub fn repeated(&self, repeat: u32) -> Result<(Frame, Vec<FrameTimes>), Error> {
        let (mut first, cold) = self.timed_frame()?;
        let mut times = vec![cold];
        for _ in 1..repeat {
            let (frame, warm) = self.timed_frame()?;
            first.dispatches = frame.dispatches;
            times.push(warm);
        }
        Ok((first, times))
    }

    /// The images beside a frame: what the camera sees as data, or of the frame itself.
    ///
    /// # Errors
    /// The device fails.
    pub fn aovs(&self, aovs: &[Aov], frame: &Frame) -> Result<Vec<(Aov, Image)>, Error> {
        let image = |aov: &Aov| match aov {
            Aov::Of(method) => {
                // It shows no light, whichever way that comes.
                let direct = Direct::default();
                let settings = Settings { method: *method, direct, ..self.settings };
                Some(self.frame(&settings, None).map(|frame| frame.image))
            }
            Aov::StandardError => frame.standard_error.clone().map(Ok),
        };
        aovs.iter().filter_map(|aov| Some(image(aov)?.map(|image| (*aov, image)))).collect()
    }
}
