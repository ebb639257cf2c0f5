//! The JSON report of a render: what was done, and how long each phase took.

pub mod warnings;

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::gpu::{AdapterInfo, DispatchTimes};
use crate::image::Image;
use crate::render::{self, Bounces, Frame, Prepared, Settings};

/// The layout of [`Report`]; it grows when a key changes its meaning, not when one is added.
pub const SCHEMA: u32 = 1;

/// All that the report says. Counts are those of the first frame.
#[derive(Debug, Clone, Serialize)]
#[expect(missing_docs, reason = "the keys are the names; those that need a word have one")]
pub struct Report {
    pub schema: u32,
    pub version: &'static str,
    pub scene: String,
    pub method: &'static str,
    pub seed: u32,
    pub width: u32,
    pub height: u32,
    pub samples: u32,
    pub adapter: AdapterInfo,
    pub triangles: usize,
    pub spheres: usize,
    /// Of all kinds; each triangle and sphere that emits is one.
    pub lights: usize,
    pub visible_points: u64,
    pub light_paths: u64,
    pub bounces: BounceLimit,
    pub vpls: u64,
    /// VPLs of which those were chosen; null where all are gathered.
    pub vpl_candidates: Option<u64>,
    /// How many equal VPLs would leave as much to chance as those that were chosen; null where all
    /// are gathered.
    pub effective_vpls: Option<f64>,
    /// Null where VPLs are not clustered.
    pub vpl_clusters: Option<u64>,
    /// Null where visible points are not clustered.
    pub point_clusters: Option<u64>,
    pub shadow_rays: u64,
    pub shading_terms: u64,
    pub seconds: Seconds,
    pub phases: RunPhases,
    pub frames: Vec<FrameTimes>,
    /// By the device's own clock, for the last frame; empty where it has none.
    pub passes: Vec<KernelTime>,
    pub threads: usize,
    /// The most memory the process ever held; null where the system does not say.
    pub peak_memory_bytes: Option<u64>,
    /// In 1/length² of the scene file's units; null when off or unused.
    pub clamp: Option<f64>,
    pub clamped_fraction: f64,
    /// Whether that share of the indirect light was given back; false where nothing is bounded.
    pub compensated: bool,
    /// At which 8-bit images show light, in EV.
    pub exposure: f32,
    /// The share of the flux that light paths still carry when `bounces` ends them; null where it
    /// does not.
    pub truncated_fraction: Option<f64>,
    /// Root mean square over pixels and channels of the standard error of the pixels; null where
    /// there is none.
    pub standard_error: Option<f64>,
    /// The version of the Open Image Denoise that denoised the image; null where none did.
    pub denoiser: Option<String>,
    pub nonfinite_pixels: u64,
    pub dropped_triangles: u64,
    pub left_out: Vec<&'static str>,
    pub warnings: Vec<String>,
}

/// A number of bounces, or `"unlimited"`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(untagged)]
#[expect(missing_docs, reason = "as in `render::Bounces`")]
pub enum BounceLimit {
    Finite(u32),
    Named(&'static str),
}

/// The sums of interest, in seconds.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct Seconds {
    /// pT of the first frame: VPLs and clusters.
    pub preprocess: f64,
    /// rT of the first frame: visibility, shading and compensation.
    pub render: f64,
    /// The whole process until the outputs were encoded.
    pub total: f64,
}

/// Seconds of every phase, of the first frame where a phase belongs to frames. They do not
/// overlap; with more than one frame, or AOVs, their sum is below the total.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct RunPhases {
    /// Reading the scene.
    pub load: f64,
    /// Building the BVH.
    pub bvh: f64,
    /// Opening the device, and uploading the scene.
    pub device: f64,
    /// Linking and compiling shaders.
    pub pipelines: f64,
    /// The phases of the first frame.
    #[serde(flatten)]
    pub frame: FramePhases,
    /// Encoding the image files.
    pub write: f64,
}

/// Seconds of the phases of one frame.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "as in `render::Phases`")]
pub struct FramePhases {
    pub visible_points: f64,
    pub direct: f64,
    pub vpls: f64,
    pub cluster_points: f64,
    pub cluster_vpls: f64,
    pub visibility: f64,
    pub shading: f64,
    #[serde(default)]
    pub compensation: f64,
    pub readback: f64,
    #[serde(default)]
    pub denoise: f64,
}

/// How long a kernel ran on the device, over all its dispatches.
#[derive(Debug, Clone, Copy, Serialize)]
#[expect(missing_docs, reason = "as in `gpu::DispatchTimes`")]
pub struct KernelTime {
    pub kernel: &'static str,
    pub dispatches: u32,
    pub seconds: f64,
}

impl From<&DispatchTimes> for KernelTime {
    fn from(pass: &DispatchTimes) -> Self {
        let DispatchTimes { label: kernel, dispatches, time } = *pass;
        Self { kernel, dispatches, seconds: time.as_secs_f64() }
    }
}

/// How long one of the repeated frames took.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameTimes {
    /// Wall clock of the whole frame.
    pub seconds: f64,
    /// pT.
    pub preprocess: f64,
    /// rT.
    pub render: f64,
    /// What they are made of.
    pub phases: FramePhases,
}

impl FrameTimes {
    /// From what the renderer measured, and the wall clock around it.
    pub fn new(wall: Duration, phases: &render::Phases) -> Self {
        Self {
            seconds: wall.as_secs_f64(),
            preprocess: phases.preprocess().as_secs_f64(),
            render: phases.render().as_secs_f64(),
            phases: FramePhases::from(phases),
        }
    }
}

impl From<&render::Phases> for FramePhases {
    fn from(phases: &render::Phases) -> Self {
        Self {
            visible_points: phases.visible_points.as_secs_f64(),
            direct: phases.direct.as_secs_f64(),
            vpls: phases.vpls.as_secs_f64(),
            cluster_points: phases.cluster_points.as_secs_f64(),
            cluster_vpls: phases.cluster_vpls.as_secs_f64(),
            visibility: phases.visibility.as_secs_f64(),
            shading: phases.shading.as_secs_f64(),
            compensation: phases.compensation.as_secs_f64(),
            readback: phases.readback.as_secs_f64(),
            denoise: phases.denoise.as_secs_f64(),
        }
    }
}

impl RunPhases {
    /// Name and seconds of each phase in the order in which they run.
    pub fn rows(&self) -> [(&'static str, f64); 15] {
        let frame = &self.frame;
        [
            ("load", self.load),
            ("bvh", self.bvh),
            ("device", self.device),
            ("pipelines", self.pipelines),
            ("visible_points", frame.visible_points),
            ("direct", frame.direct),
            ("vpls", frame.vpls),
            ("cluster_points", frame.cluster_points),
            ("cluster_vpls", frame.cluster_vpls),
            ("visibility", frame.visibility),
            ("shading", frame.shading),
            ("compensation", frame.compensation),
            ("readback", frame.readback),
            ("denoise", frame.denoise),
            ("write", self.write),
        ]
    }
}

impl Report {
    /// The report of what was prepared and of the first frame. Times, warnings, the denoiser and
    /// the frames after it are the caller's to fill in.
    pub fn new(prepared: &Prepared, settings: &Settings, seed: u32, first: &Frame) -> Self {
        let scene = &prepared.scene;
        let Image { width, height, .. } = first.image;
        let counts = &first.counts;
        Self {
            schema: SCHEMA,
            version: env!("CARGO_PKG_VERSION"),
            scene: scene.name.clone(),
            method: settings.method.name(),
            seed,
            width,
            height,
            samples: settings.samples,
            adapter: prepared.gpu.info.clone(),
            triangles: scene.triangles.len(),
            spheres: scene.spheres.len(),
            lights: scene.light_count(),
            visible_points: counts.visible_points,
            light_paths: counts.light_paths,
            bounces: match settings.bounces {
                Bounces::Finite(bounces) => BounceLimit::Finite(bounces),
                Bounces::Unlimited => BounceLimit::Named("unlimited"),
            },
            vpls: counts.vpls,
            vpl_candidates: counts.vpl_candidates,
            effective_vpls: counts.effective_vpls,
            vpl_clusters: counts.vpl_clusters,
            point_clusters: counts.point_clusters,
            shadow_rays: counts.shadow_rays,
            shading_terms: counts.shading_terms,
            seconds: Seconds::default(),
            phases: RunPhases::default(),
            frames: Vec::new(),
            passes: first.dispatches.iter().map(KernelTime::from).collect(),
            threads: rayon::current_num_threads(),
            peak_memory_bytes: peak_memory_bytes(),
            clamp: counts.clamp,
            clamped_fraction: counts.clamped_fraction,
            compensated: counts.clamp.is_some() && settings.compensates(),
            exposure: prepared.scene.exposure,
            truncated_fraction: counts.truncated_fraction,
            standard_error: first.standard_error.as_ref().map(root_mean_square),
            denoiser: None,
            nonfinite_pixels: counts.nonfinite_pixels,
            dropped_triangles: scene.dropped_triangles,
            left_out: prepared.left_out(),
            warnings: Vec::new(),
        }
    }
}

fn root_mean_square(image: &Image) -> f64 {
    let values = image.pixels.as_flattened();
    let sum: f64 = values.iter().map(|&value| f64::from(value).powi(2)).sum();
    (sum / values.len() as f64).sqrt()
}

/// The largest resident set of this process so far, where Linux's /proc tells it.
pub fn peak_memory_bytes() -> Option<u64> {
    high_water_mark(&std::fs::read_to_string("/proc/self/status").ok()?)
}

fn high_water_mark(status: &str) -> Option<u64> {
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_high_water_mark_is_read_in_bytes() {
        let status = "Name:\tx\nVmPeak:\t  9 kB\nVmHWM:\t   2048 kB\n";
        assert_eq!(high_water_mark(status), Some(2048 * 1024));
        assert_eq!(high_water_mark("Name:\tx\n"), None);
        assert_eq!(high_water_mark("VmHWM:\t much kB\n"), None);
    }

    #[test]
    fn phases_are_one_flat_object_in_json() {
        let phases = RunPhases::default();
        let json = serde_json::to_value(phases).unwrap();
        let names: Vec<_> = phases.rows().iter().map(|row| row.0).collect();
        let keys = json.as_object().unwrap();
        assert!(names.iter().all(|name| keys[*name].is_number()), "{keys:?}");
        assert_eq!(keys.len(), names.len());
    }

    #[test]
    fn bounces_are_a_number_or_a_word() {
        let json = |limit: BounceLimit| serde_json::to_string(&limit).unwrap();
        assert_eq!(json(BounceLimit::Finite(2)), "2");
        assert_eq!(json(BounceLimit::Named("unlimited")), "\"unlimited\"");
    }
}
