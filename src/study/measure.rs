//! Frames timed and compared, on one prepared scene.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::options;
use super::parts::Decomposition;
use crate::image::Image;
use crate::metrics::Comparison;
use crate::render::{self, Counts, Frame, Prepared, RenderError, Settings};
use crate::report::FrameTimes;
use crate::scene::Camera;

/// What is kept of a frame.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// Of the fastest of its warm frames.
    pub times: FrameTimes,
    /// What was counted.
    pub counts: Counts,
    /// Against the reference.
    pub total: Option<Comparison>,
    /// Against the frame without clusters.
    pub clustering: Option<Comparison>,
    /// The error against the reference, taken apart.
    pub decomposition: Option<Decomposition>,
}

/// Renders frames of a scene, warm.
#[derive(Debug)]
pub struct Bench<'a> {
    /// The scene, on its device.
    pub prepared: &'a Prepared,
    /// In the size of the study.
    pub camera: Camera,
    /// Frames, the fastest of which counts.
    pub frames: u32,
    /// Settings whose kernels are linked and warm.
    warm: Vec<Settings>,
}

impl<'a> Bench<'a> {
    /// The longest side of the frames that warm settings up, and their samples.
    const WARM_UP: u32 = 64;
    const WARM_UP_SAMPLES: u32 = 2;

    /// Nothing is warm yet.
    pub fn new(prepared: &'a Prepared, camera: Camera, frames: u32) -> Self {
        Self { prepared, camera, frames, warm: Vec::new() }
    }

    /// Renders and times a frame.
    ///
    /// # Errors
    /// The device fails, or the user interrupts.
    pub fn frame(
        &mut self,
        settings: &Settings,
        seed: u32,
    ) -> Result<(Frame, FrameTimes), RenderError> {
        self.warm_up(settings)?;
        let (frame, mut times) = self.timed(settings, seed)?;
        for _ in 1..self.frames {
            let again = self.timed(settings, seed)?.1;
            if again.seconds < times.seconds {
                times = again;
            }
        }
        Ok((frame, times))
    }

    /// Renders a frame whose time does not matter.
    ///
    /// # Errors
    /// The device fails, or the user interrupts.
    pub fn image(&self, settings: &Settings, seed: u32) -> Result<Image, RenderError> {
        Ok(render::frame(self.prepared, &self.camera, settings, seed, &|_, _| {})?.image)
    }

    fn timed(&self, settings: &Settings, seed: u32) -> Result<(Frame, FrameTimes), RenderError> {
        let start = Instant::now();
        let frame = render::frame(self.prepared, &self.camera, settings, seed, &|_, _| {})?;
        let times = FrameTimes::new(start.elapsed(), &frame.phases);
        Ok((frame, times))
    }

    /// Renders a small frame with settings that are new, so that linking shaders is in no row.
    fn warm_up(&mut self, settings: &Settings) -> Result<(), RenderError> {
        if self.warm.iter().any(|known| options::same(known, settings)) {
            return Ok(());
        }
        let mut camera = self.camera;
        camera.size = camera.size.map(|extent| extent.min(Self::WARM_UP));
        let samples = settings.samples.min(Self::WARM_UP_SAMPLES);
        let small = Settings { samples, ..*settings };
        render::frame(self.prepared, &camera, &small, 0, &|_, _| {})?;
        self.warm.push(*settings);
        Ok(())
    }
}

/// How images are compared: which pixels, and at which exposure FLIP looks.
#[derive(Debug, Clone, PartialEq)]
pub struct Lens {
    /// A flag for each pixel.
    pub keep: Vec<bool>,
    /// In stops.
    pub exposure: f32,
}

impl Lens {
    /// How far an image is from another; none if no pixel is left to compare.
    pub fn compare(&self, reference: &Image, image: &Image) -> Option<Comparison> {
        let mut comparison = Comparison::of(reference, image, &self.keep, self.exposure)?;
        // Nobody looks at it, and there will be many.
        comparison.flip_map = Vec::new();
        Some(comparison)
    }
}
