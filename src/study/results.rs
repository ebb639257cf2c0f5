//! What a study found: the data that its tables, plots and page show, and that `study.json` is.

use serde::Serialize;

use super::parts::Decomposed;
pub use super::spread::Spread;
use super::verdict::Claim;
use crate::gpu::AdapterInfo;
use crate::report::{BounceLimit, FramePhases};

/// The layout of [`Results`]; it grows when a key changes its meaning, not when one is added.
pub const SCHEMA: u32 = 2;

/// All that a study found so far.
#[derive(Debug, Clone, Serialize)]
#[expect(missing_docs, reason = "the keys are the names; those that need a word have one")]
pub struct Results {
    pub schema: u32,
    pub version: &'static str,
    /// The preset, or the sweep's own name.
    pub name: String,
    /// The command that repeats it.
    pub command: String,
    pub adapter: AdapterInfo,
    pub threads: usize,
    pub seeds: Vec<u32>,
    /// Frames to measure, and those measured: fewer if the study was interrupted.
    pub planned: usize,
    pub finished: usize,
    pub scenes: Vec<SceneResults>,
    /// Only of the thesis.
    pub claims: Vec<Claim>,
}

/// What was found of one scene.
#[derive(Debug, Clone, Serialize)]
#[expect(missing_docs, reason = "the keys are the names; those that need a word have one")]
pub struct SceneResults {
    pub scene: String,
    pub width: u32,
    pub height: u32,
    pub triangles: usize,
    /// In stops, at which FLIP looks and the viewer starts.
    pub exposure: f32,
    /// Pixels near any of the reference brighter than this are left out of all errors.
    pub mask_above: Option<f64>,
    /// One for each kind of transport (bounces, direct light) among the rows.
    pub references: Vec<Reference>,
    pub experiments: Vec<Curve>,
    pub rows: Vec<Row>,
}

/// An image that rows are compared with.
#[derive(Debug, Clone, Serialize)]
#[expect(missing_docs, reason = "the keys are the names; those that need a word have one")]
pub struct Reference {
    /// What rows call it.
    pub id: String,
    /// What it is, in words: "path, 4096 samples, 2 bounces", or a file.
    pub label: String,
    /// A command for an image like it, in one go; null for a file.
    pub command: Option<String>,
    /// Null for a file.
    pub samples: Option<u32>,
    pub seconds: Option<f64>,
    /// The mean of all channels of all pixels.
    pub mean: f64,
    /// The errors that its own noise gives a perfect image; null for a file.
    pub noise: Option<Noise>,
    /// What is wrong with it.
    pub warnings: Vec<String>,
    /// The id of its picture.
    pub image: Option<String>,
}

/// The errors that a reference's own noise gives a perfect image.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[expect(missing_docs, reason = "as in `metrics::Metrics`")]
pub struct Noise {
    /// The standard error, root mean square over pixels and channels.
    pub rmse: f64,
    pub nrmse: f64,
    pub relmse: f64,
    pub tile_nrmse: Option<f64>,
}

/// The rows of one experiment: a curve of the plot.
#[derive(Debug, Clone, Serialize)]
#[expect(missing_docs, reason = "the keys are the names; those that need a word have one")]
pub struct Curve {
    /// What rows call it.
    pub name: String,
    /// What it is about.
    pub title: String,
    pub fits: Vec<Fit>,
}

/// A power law with a floor, fitted to the errors of a curve over seconds: slope −0.5 is that of
/// independent samples.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the keys are the names; those that need a word have one")]
pub struct Fit {
    pub metric: Metric,
    pub against: Against,
    /// Of log error over log seconds, above the floor.
    pub slope: f64,
    /// The error that more time does not go below; null where there are too few rows to tell.
    pub floor: Option<f64>,
    /// Seconds and errors along the fitted curve, from the fastest row to the slowest.
    pub line: Vec<[f64; 2]>,
}

/// An error that rows have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "as in `metrics::Comparison`")]
pub enum Metric {
    Rmse,
    Mae,
    Bias,
    Nrmse,
    Relmse,
    TileNrmse,
    Flip,
    MaxAbs,
}

/// What an error is measured against.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Against {
    /// The reference: the total error.
    Total,
    /// `vpl` with the same VPLs and clamp: the error of clustering.
    Clustering,
}

/// A setting, measured.
#[derive(Debug, Clone, Serialize)]
#[expect(missing_docs, reason = "the keys are the names; those that need a word have one")]
pub struct Row {
    /// The name of its curve.
    pub experiment: String,
    /// What sets it apart from the others of its experiment.
    pub setting: String,
    pub method: &'static str,
    /// The command that renders it, with its first seed.
    pub command: String,
    pub light_paths: u32,
    pub bounces: BounceLimit,
    pub samples: u32,
    /// C as asked for; null where points are not clustered.
    pub wanted_point_clusters: Option<u32>,
    /// K_v as asked for; null where VPLs are not clustered.
    pub wanted_vpl_clusters: Option<u32>,
    /// Further options that count, as on the command line.
    pub options: String,
    /// Seeds measured. Counts are of the first.
    pub seeds: usize,
    pub vpls: u64,
    pub point_clusters: Option<u64>,
    pub vpl_clusters: Option<u64>,
    pub shadow_rays: u64,
    pub shading_terms: u64,
    pub clamp: Option<f64>,
    pub clamped_fraction: f64,
    /// The wall clock of a whole warm frame.
    pub seconds: Spread,
    /// pT.
    pub preprocess: Spread,
    /// rT.
    pub render: Spread,
    /// Means over the seeds.
    pub phases: FramePhases,
    /// How many times faster the frame is than `vpl` with the same VPLs; null for that itself,
    /// and where that was not rendered.
    pub speedup: Option<f64>,
    /// The id of the reference of the total error.
    pub reference: Option<String>,
    pub total: Option<Errors>,
    /// Null for `vpl` and `path`, and where it was not asked for.
    pub clustering: Option<Errors>,
    /// Where the total error comes from; null where that was not asked for, and for `path`.
    pub decomposition: Option<Decomposed>,
    /// 1 / (MSE · seconds) of the total error.
    pub efficiency: Option<f64>,
    /// The metrics in whose total error no other row of the scene is both faster and better.
    pub pareto: Vec<Metric>,
    /// The id of the picture of the first seed.
    pub image: Option<String>,
    /// What the thesis measured, where it did.
    pub thesis: Option<Published>,
}

/// Errors over the seeds. The means of RMSE, nRMSE and tile nRMSE are roots of the mean of
/// squares.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[expect(missing_docs, reason = "as in `metrics::Comparison`")]
pub struct Errors {
    pub rmse: Spread,
    pub mae: Spread,
    pub bias: Spread,
    pub nrmse: Spread,
    pub relmse: Spread,
    pub tile_nrmse: Option<Spread>,
    pub flip: Spread,
    pub max_abs: Spread,
    /// Pixels that are not finite, over all seeds.
    pub nonfinite: usize,
}

impl Metric {
    /// All, in the order in which they are offered.
    pub const ALL: [Self; 8] = [
        Self::Relmse,
        Self::Rmse,
        Self::Nrmse,
        Self::TileNrmse,
        Self::Flip,
        Self::Mae,
        Self::Bias,
        Self::MaxAbs,
    ];

    /// The name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rmse => "RMSE",
            Self::Mae => "MAE",
            Self::Bias => "|bias|",
            Self::Nrmse => "nRMSE",
            Self::Relmse => "relMSE",
            Self::TileNrmse => "tile nRMSE",
            Self::Flip => "ꟻLIP",
            Self::MaxAbs => "largest error",
        }
    }

    /// Its value among errors; the bias without its sign.
    pub fn of(self, errors: &Errors) -> Option<Spread> {
        let spread = match self {
            Self::Rmse => errors.rmse,
            Self::Mae => errors.mae,
            Self::Bias => Spread { mean: errors.bias.mean.abs(), ..errors.bias },
            Self::Nrmse => errors.nrmse,
            Self::Relmse => errors.relmse,
            Self::TileNrmse => return errors.tile_nrmse,
            Self::Flip => errors.flip,
            Self::MaxAbs => errors.max_abs,
        };
        Some(spread)
    }
}

impl Against {
    /// A row's errors.
    pub fn of(self, row: &Row) -> Option<&Errors> {
        match self {
            Self::Total => row.total.as_ref(),
            Self::Clustering => row.clustering.as_ref(),
        }
    }
}

impl SceneResults {
    /// The rows of a curve.
    pub fn rows_of<'a>(&'a self, curve: &'a Curve) -> impl Iterator<Item = &'a Row> {
        self.rows.iter().filter(move |row| row.experiment == curve.name)
    }

    /// The noise of the reference that a row is compared with.
    pub fn noise_of(&self, row: &Row) -> Option<&Noise> {
        let id = row.reference.as_ref()?;
        self.references.iter().find(|reference| reference.id == *id)?.noise.as_ref()
    }
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
