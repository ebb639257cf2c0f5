//! What comes of a frame: the image, what was counted, and how long each phase took.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::settings::SettingsError;
use crate::gpu::{DispatchTimes, GpuError};
use crate::image::Image;

/// Why a frame is not rendered.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// What is asked for cannot be done.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// The device failed, or ran out of memory.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

/// Told about the progress of a frame: the fraction done, in [0, 1], and the phase.
pub type Progress<'a> = &'a dyn Fn(f64, &'static str);

/// Wall-clock time of each phase of a frame. They do not overlap.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Phases {
    /// Camera rays.
    pub visible_points: Duration,
    /// Direct light.
    pub direct: Duration,
    /// Light paths on the host.
    pub vpls: Duration,
    /// K-means of the visible points.
    pub cluster_points: Duration,
    /// K-means of the VPLs.
    pub cluster_vpls: Duration,
    /// Shadow rays between visible points and VPLs; of [`Method::Path`](super::settings::Method::Path), all rays but those of
    /// the camera and the shadow rays of visible points.
    pub visibility: Duration,
    /// Shading every point by every VPL, and resolving points to pixels; of [`Method::Path`](super::settings::Method::Path),
    /// all that traces no rays.
    pub shading: Duration,
    /// Giving back what the bound on G removed.
    pub compensation: Duration,
    /// Copies from the device.
    pub readback: Duration,
    /// Of frames of [`Denoiser`](crate::denoise::Denoiser): what is rendered for denoising alone, and denoising.
    pub denoise: Duration,
}

impl Phases {
    /// pT of the thesis: generating VPLs (and clustering).
    pub fn preprocess(&self) -> Duration {
        self.vpls + self.cluster_points + self.cluster_vpls
    }

    /// Those of this frame and another.
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            visible_points: self.visible_points + other.visible_points,
            direct: self.direct + other.direct,
            vpls: self.vpls + other.vpls,
            cluster_points: self.cluster_points + other.cluster_points,
            cluster_vpls: self.cluster_vpls + other.cluster_vpls,
            visibility: self.visibility + other.visibility,
            shading: self.shading + other.shading,
            compensation: self.compensation + other.compensation,
            readback: self.readback + other.readback,
            denoise: self.denoise + other.denoise,
        }
    }

    /// rT of the thesis: visibility and shading, and what compensates the shading's bound.
    pub fn render(&self) -> Duration {
        self.visibility + self.shading + self.compensation
    }
}

/// What a frame counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    /// Visible points that hit a surface.
    pub visible_points: u64,
    /// Light paths traced, see [`Settings::candidates`](super::settings::Settings::candidates).
    #[serde(default)]
    pub light_paths: u64,
    /// VPLs gathered: all that light paths have left, or those that are kept of more.
    pub vpls: u64,
    /// VPLs that light paths have left, where some of them are kept.
    #[serde(default)]
    pub vpl_candidates: Option<u64>,
    /// How many equal VPLs would leave as much to chance as those that are kept: Kish's effective
    /// number of what they add to the image.
    #[serde(default)]
    pub effective_vpls: Option<f64>,
    /// Clusters of VPLs, where the method makes them.
    pub vpl_clusters: Option<u64>,
    /// Clusters of visible points, where the method makes them.
    pub point_clusters: Option<u64>,
    /// Segments traced between visible points and VPLs: pairs whose cosines are both
    /// positive. Of [`Method::Path`](super::settings::Method::Path), between vertices and lights.
    pub shadow_rays: u64,
    /// Pairs of visible point and VPL.
    pub shading_terms: u64,
    /// The bound on G used, in 1/length² of the scene file's units; none when off or unused.
    pub clamp: Option<f64>,
    /// The share of the reflected indirect light that the clamp removed.
    pub clamped_fraction: f64,
    /// The share of the flux that reaches surfaces which paths of a finite number of bounces
    /// still carry when they are ended; none where they are not ended, or there are none.
    #[serde(default)]
    pub truncated_fraction: Option<f64>,
    /// Pixels that are not finite.
    pub nonfinite_pixels: u64,
}

/// What a frame has come to so far.
#[derive(Debug, Clone, Copy, Default)]
pub struct Tally {
    /// How long each phase took.
    pub phases: Phases,
    /// What was counted.
    pub counts: Counts,
}

/// A rendered frame.
#[derive(Debug, Clone)]
pub struct Frame {
    /// Linear radiance, or the data that the method shows.
    pub image: Image,
    /// Of [`Method::Path`](super::settings::Method::Path) with two samples or more: the standard error of each pixel's mean, from
    /// the variance of its samples as if they were independent. They are stratified, so that the
    /// true error tends to be smaller.
    pub standard_error: Option<Image>,
    /// What was counted.
    pub counts: Counts,
    /// How long each phase took, by the wall clock.
    pub phases: Phases,
    /// How long each kernel ran, by the device's clock; empty where it has none.
    pub dispatches: Vec<DispatchTimes>,
}
