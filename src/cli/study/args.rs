//! The options of `study`, and the plan that they make.

use std::path::PathBuf;

use clap::Args;

use super::axes::Axes;
use super::sweep;
use crate::cli::parse;
use crate::error::Error;
use crate::extremes;
use crate::study::{Decompose, Plan, ReferencePlan, presets, thesis};

pub const OPTIONS_OF_RENDER: &str = "options of render go neither with --preset nor with --sweep";

/// The options of `study`.
#[derive(Debug, Args)]
pub struct StudyArgs {
    /// Scenes, as for render
    pub scenes: Vec<String>,

    /// A study with a name: thesis (its experiments), quick (every method, 256x256, 3 seeds),
    /// extremes (what renderers fail at first, against what it must be: extremes.md, .csv, .json)
    #[arg(long, value_name = "PRESET", value_parser = preset, conflicts_with = "sweep")]
    pub preset: Option<&'static str>,

    /// What to measure, from a file: [[experiment]] tables of render's options, a list for each
    /// that varies; see the README
    #[arg(long, value_name = "FILE.toml")]
    pub sweep: Option<PathBuf>,

    /// Directory for study.html, .md, .csv, .json and plots; made if it is not there. What it
    /// holds already is not measured again
    #[arg(short, long = "output", value_name = "DIR", required = true)]
    pub output: PathBuf,

    /// Measure anew what DIR holds already
    #[arg(long)]
    pub fresh: bool,

    /// Image to compare with [default: the path tracer's, rendered once]
    #[arg(long, value_name = "FILE.exr", conflicts_with = "reference_samples")]
    pub reference: Option<PathBuf>,

    /// Samples of the path tracer's reference [default: 1024; thesis: 256]
    #[arg(long, allow_negative_numbers = true, value_name = "S",
          value_parser = clap::value_parser!(u32).range(32..=1 << 24))]
    pub reference_samples: Option<u32>,

    /// Seeds of each frame [default: 5; quick: 3; thesis: 1]
    #[arg(long, allow_negative_numbers = true, value_name = "N",
          value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub seeds: Option<u32>,

    /// The first seed [default: 0]
    #[arg(long, allow_negative_numbers = true)]
    pub seed: Option<u32>,

    /// Of the seeds, how many to measure the error of clustering with, which takes a frame of vpl
    /// [default: 1; thesis: all]
    #[arg(long, allow_negative_numbers = true, value_name = "N",
          value_parser = clap::value_parser!(u32).range(0..=1000))]
    pub clustering_seeds: Option<u32>,

    /// Of the seeds, how many to take the error of each row apart with [default: 1]: what is left
    /// with direct light, indirect light, antialiasing, the clamp, shared visibility and
    /// interleaving each replaced by the converged part. Takes some fifty times the frame; shared
    /// visibility is within --clustering-seeds
    #[arg(long, value_name = "N", num_args = 0..=1, require_equals = true,
          default_missing_value = "1", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub decompose: Option<u32>,

    /// Shadow rays to lights, a pixel, of direct light converged for --decompose [default: 256]
    #[arg(long, allow_negative_numbers = true, value_name = "S", requires = "decompose",
          value_parser = clap::value_parser!(u32).range(16..=1 << 16))]
    pub decompose_samples: Option<u32>,

    /// Leave out pixels within 2 of any brighter than this in the reference: lights seen directly
    #[arg(long, value_name = "L", value_parser = parse::number, allow_hyphen_values = true)]
    pub mask_above: Option<f64>,

    /// Width and height in pixels [default: the scene's; quick: 256x256; thesis: 512x512]
    #[arg(long, value_name = "WxH", value_parser = parse::size, allow_hyphen_values = true)]
    pub size: Option<[u32; 2]>,

    #[command(flatten)]
    pub axes: Axes,

    /// Part of an adapter's name or driver, its index in `gpu-vpl info`, or cpu
    /// [default: $WGPU_ADAPTER_NAME, else hardware before software]
    #[arg(long, value_name = "NAME|INDEX")]
    pub adapter: Option<String>,

    /// Host threads [default: one a core]
    #[arg(long, allow_negative_numbers = true, value_name = "N",
          value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,

    /// Say nothing on standard error but errors and warnings
    #[arg(long)]
    pub quiet: bool,
}

impl StudyArgs {
    /// What is to be measured.
    pub fn plan(&self) -> Result<Plan, Error> {
        let mut plan = self.base()?;
        plan.size = self.size.or(plan.size);
        plan.mask_above = self.mask_above.or(plan.mask_above);
        if let Some(count) = self.clustering_seeds {
            plan.clustering_seeds = count as usize;
        }
        let count = self.seeds.unwrap_or(plan.seeds.len() as u32);
        plan.seeds = (0..count).map(|index| self.seed.unwrap_or(0).wrapping_add(index)).collect();
        if let Some(seeds) = self.decompose {
            let light_samples = self.decompose_samples.unwrap_or(Decompose::LIGHT_SAMPLES);
            plan.decompose = Some(Decompose { seeds: seeds as usize, light_samples });
        }
        if let Some(samples) = self.reference_samples {
            plan.reference = ReferencePlan::Path { samples };
        }
        if let Some(file) = &self.reference {
            check_one_image(&plan)?;
            plan.reference = ReferencePlan::File(file.clone());
        }
        Ok(plan)
    }

    /// The preset, the sweep of a file, that of options, or every method.
    fn base(&self) -> Result<Plan, Error> {
        let refuse = |what: &str| Err(Error::Usage(format!("study: {what}")));
        let swept = !self.axes.is_empty();
        if swept && (self.preset.is_some() || self.sweep.is_some()) {
            return refuse(OPTIONS_OF_RENDER);
        }
        let scenes = self.scenes.clone();
        match (self.preset, &self.sweep) {
            (Some(thesis::NAME), _) if !scenes.is_empty() => {
                refuse("the thesis has its own scene; leave SCENE out")
            }
            (Some(thesis::NAME), _) => Ok(thesis::plan()),
            (Some(_), _) => Ok(presets::quick(scenes)),
            (None, Some(file)) => sweep::read(file, scenes),
            (None, None) if scenes.is_empty() => refuse(
                "what to study? Give a SCENE, --sweep FILE.toml, or --preset thesis, quick or extremes",
            ),
            (None, None) if swept => Ok(Plan {
                name: "sweep".to_owned(),
                experiments: self.axes.experiments()?,
                ..presets::of_scenes(scenes)
            }),
            (None, None) => Ok(presets::of_scenes(scenes)),
        }
    }
}

/// A given reference is of one scene and one kind of transport.
fn check_one_image(plan: &Plan) -> Result<(), Error> {
    let refuse = |what: &str| Err(Error::Usage(format!("study: --reference is one image, {what}")));
    if plan.scenes.len() > 1 {
        return refuse("but there are several scenes; study one at a time");
    }
    if plan.transports().len() > 1 {
        return refuse("but the settings differ in --bounces or --direct off; study one at a time");
    }
    Ok(())
}

/// The experiments of `study`.
fn preset(text: &str) -> Result<&'static str, String> {
    match text {
        thesis::NAME => Ok(thesis::NAME),
        presets::QUICK => Ok(presets::QUICK),
        extremes::NAME => Ok(extremes::NAME),
        _ => Err("give thesis, quick or extremes".to_owned()),
    }
}
