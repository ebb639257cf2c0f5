//! Studies: experiments as data, run one after another on one prepared scene, and what comes
//! out of them as rows, claims and files.

mod claims;
pub mod csv;
pub mod markdown;
pub mod page;
pub mod plot;
pub mod results;
pub mod thesis;

use std::time::Instant;

use serde::Serialize;

use crate::gpu::{AdapterInfo, GpuError};
use crate::image::Image;
use crate::metrics::Metrics;
use crate::render::{self, Bounces, Clustering, Counts, Frame, Method, Prepared, Settings};
use crate::report::{BounceLimit, FrameTimes};
use crate::scene::Camera;

pub use claims::{Claim, Verdict};

/// The layout of [`Results`]; it grows when a key changes its meaning, not when one is added.
pub const SCHEMA: u32 = 1;

/// Frames to compare with each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    /// The name that rows refer to.
    pub name: &'static str,
    /// What it is about.
    pub title: &'static str,
    /// Its frames.
    pub runs: Vec<Run>,
}

/// One frame of an experiment.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// What sets it apart from the others of its experiment.
    pub setting: String,
    /// How it is rendered.
    pub settings: Settings,
    /// What the thesis measured, where it did.
    pub thesis: Option<Published>,
}

/// Seconds that the thesis publishes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Published {
    /// pT, where it is given.
    pub preprocess: Option<f64>,
    /// rT, where it is given.
    pub render: Option<f64>,
    /// tT.
    pub total: f64,
    /// How many times faster than its unclustered frame of the same VPLs, for clustered ones.
    pub speedup: Option<f64>,
}

/// A measured run.
#[derive(Debug, Clone, Serialize)]
#[expect(missing_docs, reason = "the keys are the names; those that need a word have one")]
pub struct Row {
    pub experiment: &'static str,
    pub setting: String,
    pub method: &'static str,
    pub light_paths: u32,
    pub bounces: BounceLimit,
    /// C as asked for; null where points are not clustered.
    pub wanted_point_clusters: Option<u32>,
    /// K_v as asked for; null where VPLs are not clustered.
    pub wanted_vpl_clusters: Option<u32>,
    pub options: String,
    pub vpls: u64,
    pub point_clusters: Option<u64>,
    pub vpl_clusters: Option<u64>,
    pub shadow_rays: u64,
    pub shading_terms: u64,
    /// Of the fastest frame, warm: pT, rT, the wall clock of the whole frame, and the phases.
    pub times: FrameTimes,
    /// Frames rendered to time it.
    pub frames: u32,
    /// The wall clock of the slowest of them, which tells how quiet the machine was.
    pub slowest: f64,
    /// How many times faster the frame is than `vpl` with the same VPLs; null for that itself.
    pub speedup: Option<f64>,
    pub thesis: Option<Published>,
    /// Against `vpl` with the same VPLs and clamp; null for that itself.
    pub error: Option<Metrics>,
}

/// All that a study found.
#[derive(Debug, Clone, Serialize)]
#[expect(missing_docs, reason = "the keys are the names")]
pub struct Results {
    pub schema: u32,
    pub version: &'static str,
    pub preset: &'static str,
    pub scene: String,
    pub adapter: AdapterInfo,
    pub threads: usize,
    pub seed: u32,
    pub width: u32,
    pub height: u32,
    pub samples: u32,
    pub rows: Vec<Row>,
    pub claims: Vec<Claim>,
}

/// Measures experiments on one prepared scene.
#[derive(Debug)]
pub struct Runner<'a> {
    prepared: &'a Prepared,
    camera: Camera,
    seed: u32,
    /// Methods whose kernels are linked and warm.
    warm: Vec<Method>,
    measured: Vec<Measured>,
}

#[derive(Debug, Clone)]
struct Measured {
    settings: Settings,
    counts: Counts,
    times: FrameTimes,
    frames: u32,
    slowest: f64,
    error: Option<Metrics>,
    speedup: Option<f64>,
    /// Kept where it is a reference of others.
    image: Option<Image>,
}

impl<'a> Runner<'a> {
    /// The longest side of the frames that warm a method up.
    const WARM_UP: u32 = 64;
    /// Frames of a reference, the fastest of which counts: all others are compared with them.
    const REFERENCE_FRAMES: u32 = 2;

    /// Nothing is measured yet.
    pub fn new(prepared: &'a Prepared, camera: Camera, seed: u32) -> Self {
        Self { prepared, camera, seed, warm: Vec::new(), measured: Vec::new() }
    }

    /// Measures all runs in their order and tells each row. Runs of equal settings are
    /// rendered once and share their numbers.
    ///
    /// # Errors
    /// The device fails.
    pub fn run(
        &mut self,
        experiments: &[Experiment],
        tell: &dyn Fn(&Row),
    ) -> Result<Vec<Row>, GpuError> {
        let mut rows = Vec::new();
        for experiment in experiments {
            for run in &experiment.runs {
                let measured = self.measured(&run.settings)?;
                let row = row(experiment, run, measured);
                tell(&row);
                rows.push(row);
            }
        }
        Ok(rows)
    }

    fn measured(&mut self, settings: &Settings) -> Result<&Measured, GpuError> {
        let settings = normal_form(settings);
        let index = match self.measured.iter().position(|known| known.settings == settings) {
            Some(index) => index,
            None => {
                let measured = self.measure(&settings)?;
                self.measured.push(measured);
                self.measured.len() - 1
            }
        };
        Ok(&self.measured[index])
    }

    fn measure(&mut self, settings: &Settings) -> Result<Measured, GpuError> {
        self.warm_up(settings)?;
        let is_reference = settings.method == Method::Vpl;
        if !is_reference {
            self.measured(&Settings { method: Method::Vpl, ..*settings })?;
        }
        let (frame, mut times) = self.timed_frame(settings)?;
        let mut slowest = times.seconds;
        let frames = if is_reference { Self::REFERENCE_FRAMES } else { 1 };
        for _ in 1..frames {
            let again = self.timed_frame(settings)?.1;
            slowest = slowest.max(again.seconds);
            if again.seconds < times.seconds {
                times = again;
            }
        }

        let (mut error, mut speedup) = (None, None);
        if !is_reference {
            let reference = self.measured(&Settings { method: Method::Vpl, ..*settings })?;
            error = reference.image.as_ref().and_then(|image| Metrics::of(&frame.image, image));
            speedup = Some(reference.times.seconds / times.seconds);
        }
        let image = is_reference.then_some(frame.image);
        let (settings, counts) = (*settings, frame.counts);
        Ok(Measured { settings, counts, times, frames, slowest, error, speedup, image })
    }

    fn timed_frame(&self, settings: &Settings) -> Result<(Frame, FrameTimes), GpuError> {
        let start = Instant::now();
        let frame = render::frame(self.prepared, &self.camera, settings, self.seed, &|_, _| {})?;
        let times = FrameTimes::new(start.elapsed(), &frame.phases);
        Ok((frame, times))
    }

    /// Renders a small frame with a method that is new, so that linking shaders is in no row.
    fn warm_up(&mut self, settings: &Settings) -> Result<(), GpuError> {
        if self.warm.contains(&settings.method) {
            return Ok(());
        }
        let mut camera = self.camera;
        camera.size = camera.size.map(|extent| extent.min(Self::WARM_UP));
        render::frame(self.prepared, &camera, settings, self.seed, &|_, _| {})?;
        self.warm.push(settings.method);
        Ok(())
    }
}

/// Settings without what the method does not look at, so that equal frames have equal ones.
fn normal_form(settings: &Settings) -> Settings {
    let mut settings = *settings;
    let (given, default) = (settings.clustering, Clustering::default());
    settings.clustering = default;
    if settings.method.clusters_points() {
        settings.clustering = Clustering {
            vpls: default.vpls,
            vpl_iterations: default.vpl_iterations,
            representative: default.representative,
            merge: default.merge,
            ..given
        };
    }
    if settings.method.clusters_vpls() {
        settings.clustering.vpls = given.vpls;
        settings.clustering.vpl_iterations = given.vpl_iterations;
        settings.clustering.representative = given.representative;
        settings.clustering.merge = given.merge;
        settings.clustering.normal_threshold = given.normal_threshold;
    }
    settings
}

fn row(experiment: &Experiment, run: &Run, measured: &Measured) -> Row {
    let settings = &run.settings;
    let (method, clustering) = (settings.method, &settings.clustering);
    let Counts { vpls, point_clusters, vpl_clusters, shadow_rays, shading_terms, .. } =
        measured.counts;
    Row {
        experiment: experiment.name,
        setting: run.setting.clone(),
        method: method.name(),
        light_paths: settings.light_paths,
        bounces: match settings.bounces {
            Bounces::Finite(bounces) => BounceLimit::Finite(bounces),
            Bounces::Unlimited => BounceLimit::Named("unlimited"),
        },
        wanted_point_clusters: method.clusters_points().then_some(clustering.points),
        wanted_vpl_clusters: method.clusters_vpls().then_some(clustering.vpls),
        options: options(settings),
        vpls,
        point_clusters,
        vpl_clusters,
        shadow_rays,
        shading_terms,
        times: measured.times,
        frames: measured.frames,
        slowest: measured.slowest,
        speedup: measured.speedup,
        thesis: run.thesis,
        error: measured.error,
    }
}

/// The options that the method looks at beside those with a column, as the command line has
/// them.
fn options(settings: &Settings) -> String {
    let Settings { method, clustering, interleave, edge_samples, .. } = settings;
    let mut options = Vec::new();
    if method.clusters_points() {
        let Clustering { point_iterations, stride, fuzzy, probes, .. } = clustering;
        options.push(format!("--point-iterations {point_iterations}"));
        options.push(format!("--kmeans-stride {stride} --fuzzy {fuzzy} --probes {probes}"));
    }
    if method.clusters_vpls() {
        let Clustering { vpl_iterations, representative, merge, .. } = clustering;
        let lower = |what: String| what.to_lowercase();
        options.push(format!("--vpl-iterations {vpl_iterations}"));
        options.push(format!("--representative {}", lower(format!("{representative:?}"))));
        options.push(format!("--merge {}", lower(format!("{merge:?}"))));
    }
    if !options.is_empty() {
        options.push(format!("--normal-threshold {}", clustering.normal_threshold));
    }
    options.push(format!("--interleave {interleave} --edge-samples {edge_samples}"));
    options.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_that_a_method_ignores_make_no_new_frame() {
        let clustering = Clustering { points: 7, vpls: 9, ..Clustering::default() };
        let form = |method| {
            normal_form(&Settings { method, clustering, ..Settings::default() }).clustering
        };
        let counts = |method| (form(method).points, form(method).vpls);
        assert_eq!(counts(Method::Vpl), (2600, 1000));
        assert_eq!(counts(Method::Vpc), (7, 1000));
        assert_eq!(counts(Method::Vplc), (2600, 9));
        assert_eq!(counts(Method::Both), (7, 9));
    }

    #[test]
    fn options_are_those_that_count() {
        let text = |method| options(&Settings { method, ..Settings::default() });
        assert!(text(Method::Vpl).starts_with("--interleave"));
        assert!(text(Method::Vpc).contains("--kmeans-stride 4"));
        assert!(!text(Method::Vpc).contains("representative"));
        assert!(text(Method::Vplc).contains("--representative member --merge visibility"));
    }
}
