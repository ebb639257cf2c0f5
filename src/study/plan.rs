//! What a study measures: scenes, experiments, seeds, and what images are compared with.

use std::path::PathBuf;

use super::options;
use super::results::Published;
use crate::render::{Bounces, Direct, Method, Settings};

/// A whole study.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// What it is called: the preset, or the sweep's own name.
    pub name: String,
    /// Scenes, as on the command line.
    pub scenes: Vec<String>,
    /// Width and height; the scene's if there is none.
    pub size: Option<[u32; 2]>,
    /// Each frame is measured with each.
    pub seeds: Vec<u32>,
    /// Warm frames of a seed, the fastest of which counts.
    pub frames: u32,
    /// What the total error is against.
    pub reference: ReferencePlan,
    /// Seeds, of the first, whose error of clustering is measured, which takes a frame of `vpl`.
    pub clustering_seeds: usize,
    /// Pixels near any of the reference brighter than this are left out of all errors.
    pub mask_above: Option<f64>,
    /// How errors are taken apart; none if they are not.
    pub decompose: Option<Decompose>,
    /// What is measured of each scene.
    pub experiments: Vec<Experiment>,
}

/// How errors are taken apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Decompose {
    /// Seeds, of the first, whose error is.
    pub seeds: usize,
    /// Shadow rays to lights, a pixel, of converged direct light.
    pub light_samples: u32,
}

impl Decompose {
    /// Sixteen times what a pixel gets by default.
    pub const LIGHT_SAMPLES: u32 = 256;
}

/// What the total error is against.
#[derive(Debug, Clone, PartialEq)]
pub enum ReferencePlan {
    /// The path tracer's image of so many samples, one for each kind of transport.
    Path {
        /// Samples a pixel.
        samples: u32,
    },
    /// A given image.
    File(PathBuf),
}

/// Frames to compare with each other: a curve of the plot, a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    /// The name that rows refer to.
    pub name: String,
    /// What it is about.
    pub title: String,
    /// Its frames.
    pub runs: Vec<Run>,
}

/// A setting of an experiment.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// What sets it apart from the others of its experiment.
    pub setting: String,
    /// How it is rendered.
    pub settings: Settings,
    /// What the thesis measured, where it did.
    pub thesis: Option<Published>,
}

/// The light that an image holds: images of the same are comparable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Transport {
    /// Indirect bounces.
    pub bounces: Bounces,
    /// Whether light comes straight from its sources too.
    pub direct: bool,
}

impl Transport {
    /// That of settings.
    pub fn of(settings: &Settings) -> Self {
        let bounces = match settings.method {
            Method::Direct => Bounces::Finite(0),
            _ => settings.bounces,
        };
        Self { bounces, direct: settings.direct != Direct::Off }
    }

    /// The path tracer's settings for it.
    pub fn reference(self, samples: u32) -> Settings {
        let direct = if self.direct { Direct::PerPixel } else { Direct::Off };
        Settings { bounces: self.bounces, direct, samples, ..Settings::of(Method::Path) }
    }
}

/// The settings without clusters that others are compared with: the same VPLs, clamp and subsets.
/// None for those that cluster nothing.
pub fn unclustered(settings: &Settings) -> Option<Settings> {
    let method = settings.method;
    let direct = match settings.direct {
        Direct::Clustered => Direct::PerPixel,
        direct => direct,
    };
    (method.is_indirect() && (method.clusters_points() || method.clusters_vpls()))
        .then_some(Settings { method: Method::Vpl, direct, ..*settings })
}

impl Plan {
    /// All settings, each once, with those they are compared with before them if it is the turn
    /// of a seed whose error of clustering is measured.
    pub fn frames_of_seed(&self, index: usize) -> Vec<Settings> {
        let mut frames: Vec<Settings> = Vec::new();
        let mut add = |settings: Settings| {
            if !frames.iter().any(|known| options::same(known, &settings)) {
                frames.push(settings);
            }
        };
        for run in self.runs() {
            if let Some(base) = unclustered(&run.settings).filter(|_| self.clusters(index)) {
                add(base);
            }
            add(run.settings);
        }
        frames
    }

    /// Whether the error of clustering is measured with the seed of this index.
    pub fn clusters(&self, index: usize) -> bool {
        index < self.clustering_seeds
    }

    /// Frames of all scenes and seeds.
    pub fn planned(&self) -> usize {
        let seeds = 0..self.seeds.len();
        self.scenes.len() * seeds.map(|index| self.frames_of_seed(index).len()).sum::<usize>()
    }

    /// The kinds of transport among all runs.
    pub fn transports(&self) -> Vec<Transport> {
        let mut transports = Vec::new();
        for transport in self.runs().map(|run| Transport::of(&run.settings)) {
            if !transports.contains(&transport) {
                transports.push(transport);
            }
        }
        transports
    }

    /// The settings of all rows, each once.
    pub fn rows(&self) -> Vec<Settings> {
        let mut rows: Vec<Settings> = Vec::new();
        for run in self.runs() {
            if !rows.iter().any(|known| options::same(known, &run.settings)) {
                rows.push(run.settings);
            }
        }
        rows
    }

    fn runs(&self) -> impl Iterator<Item = &Run> {
        self.experiments.iter().flat_map(|experiment| &experiment.runs)
    }
}
