//! The options of `render`.

use std::path::PathBuf;

use clap::Args;

use super::super::parse::{self, Compensate, Exposure, LightSamples};
use super::aov::Aov;
use crate::denoise;
use crate::error::Error;
use crate::render::{Bounces, Clamp, Clustering, Direct, Merge, Method, Representative, Settings};

#[derive(Debug, Args)]
pub struct RenderArgs {
    /// A .toml scene file, a bare .obj, .gltf or .glb, or builtin:NAME (see `gpu-vpl info`)
    #[arg(default_value = "builtin:cornell")]
    pub scene: String,

    /// Image to write, .png or .exr; may be repeated; - is standard output, as PNG
    #[arg(short, long = "output", value_name = "OUT", required = true)]
    pub outputs: Vec<PathBuf>,

    /// What to show: vpl, vplc, vpc, both; path, the reference; direct, normal, depth, albedo;
    /// point-clusters, vpl-map, vpl-clusters-map
    #[arg(long, default_value = "both", value_parser = parse::method)]
    pub method: Method,

    /// VPLs that are gathered; without candidates, light paths, each of which leaves up to one VPL
    /// a bounce [default: 32000 with vpc and both, else 8000]
    #[arg(long, allow_negative_numbers = true, value_name = "N",
          value_parser = clap::value_parser!(u32).range(1..=i64::from(Settings::MOST_LIGHT_PATHS)))]
    pub vpls: Option<u32>,

    /// Light paths are traced until they have left so many VPLs for each one that is gathered; those
    /// that the image needs are kept, by chance, and stand for the others; 1 is off [default: 4 with
    /// vpc and both, 8 with fewer than 24000 VPLs; else 1]
    #[arg(long, allow_negative_numbers = true, value_name = "C",
          value_parser = clap::value_parser!(u32).range(1..=i64::from(Settings::MOST_CANDIDATES)))]
    pub vpl_candidates: Option<u32>,

    /// Indirect bounces, or unlimited
    #[arg(long, value_name = "B", default_value = "2", value_parser = parse::bounces,
          allow_hyphen_values = true)]
    pub bounces: Bounces,

    #[command(flatten)]
    pub clustering: ClusteringArgs,

    /// Interleaved sampling: a pixel gathers one of s × s subsets of the VPLs, and combines what
    /// the pixels around it gathered; 1 is off [default: 8 with vpc
    /// and both, 4 with fewer than 24000 VPLs; else 1]
    #[arg(long, allow_negative_numbers = true, value_name = "S",
          value_parser = clap::value_parser!(u32).range(1..=i64::from(Settings::MOST_INTERLEAVE)))]
    pub interleave: Option<u32>,

    /// Light straight from its source: per-pixel; clustered, its visibility shared by clusters of
    /// visible points as that of VPLs; or off
    #[arg(long, default_value = "per-pixel", value_parser = parse::direct)]
    pub direct: Direct,

    /// Shadow rays from each visible point, or cluster, to all lights that have some extent and, if
    /// these are more than 8, to all point, spot and directional lights, which else have one each; as
    /// many more from glossy surfaces by their lobes. Or auto: 4 a pixel, up to 16 where few pixels
    /// around see the same surface or --direct-filter is off, and 256 a cluster. Of 64 or more, every
    /// light without extent has one. Not for path, which has one a vertex
    #[arg(long, allow_negative_numbers = true, value_name = "S|auto", default_value = "auto",
          value_parser = parse::light_samples)]
    pub light_samples: LightSamples,

    /// Whether light samples are combined over pixels that see the same surface, as far as their
    /// noise hides a difference: on or off
    #[arg(long, value_name = "WHETHER", default_value = "on", value_parser = parse::switch,
          action = clap::ArgAction::Set)]
    pub direct_filter: bool,

    /// Bound on the geometry term, in 1/length² of the scene's units, or auto, or off
    #[arg(long, value_name = "BOUND", default_value = "auto", value_parser = parse::clamp,
          allow_hyphen_values = true)]
    pub clamp: Clamp,

    /// Give back what the bound removed, by short paths from the visible points: no bias, and no
    /// dark corners, for some noise and time: on, as without a value; off; or auto, which is on where
    /// the bound is auto and pixels combine what they gather (--interleave above 1). Nothing where
    /// nothing is bounded; light of point, spot and directional lights that mirrors or glass have
    /// turned stays bounded
    #[arg(long, value_name = "auto|on|off", num_args = 0..=1, require_equals = true,
          default_value = "off", default_missing_value = "on", value_parser = parse::compensate,
          action = clap::ArgAction::Set)]
    pub compensate: Compensate,

    /// Shadow rays of each visible point, up to 256, that correct what it shares of the visibility of
    /// VPLs, where that is likely to be wrong: no bias of clusters, for some noise and time. Nothing where
    /// nothing is shared
    #[arg(long, value_name = "K|off", default_value = "off", value_parser = parse::corrections)]
    pub correct: u32,

    /// Take the noise away by Intel's Open Image Denoise: of all light with path, else of direct
    /// light, as VPLs leave no noise of the kind. Needs its library, version 2: the file or
    /// folder that $OIDN_LIBRARY names, else where the system finds it
    #[arg(long)]
    pub denoise: bool,

    /// Seed of all random numbers
    #[arg(long, allow_negative_numbers = true, default_value_t = 0)]
    pub seed: u32,

    /// Width and height in pixels [default: the scene's]
    #[arg(long, value_name = "WxH", value_parser = parse::size, allow_hyphen_values = true)]
    pub size: Option<[u32; 2]>,

    /// Exposure of the PNG in stops, or auto: one at which nearly all of the image is seen [default:
    /// the scene's]
    #[arg(long, value_name = "EV|auto", value_parser = parse::exposure_or_auto,
          allow_hyphen_values = true)]
    pub exposure: Option<Exposure>,

    /// Samples per pixel; all share one set of VPLs [default: 16 with path, else 1]
    #[arg(long, allow_negative_numbers = true, visible_alias = "spp", value_name = "S",
          value_parser = clap::value_parser!(u32).range(1..))]
    pub samples: Option<u32>,

    /// Camera rays in a pixel where surfaces of unlike radiance meet, over all its samples; other
    /// pixels have 4 (or as many, if fewer). Each takes the light of a visible point around on its
    /// surface; emission and background are its own. 1 is none but the samples
    #[arg(long, allow_negative_numbers = true, value_name = "E",
          default_value_t = Settings::default().edge_samples,
          value_parser = clap::value_parser!(u32).range(1..=i64::from(Settings::MOST_EDGE_SAMPLES)))]
    pub edge_samples: u32,

    /// Further images: normal, albedo, depth, and of path standard-error, that of each pixel's
    /// mean; layers of an EXR, NAME.normal.png beside a PNG
    #[arg(long = "aov", value_name = "AOV,...", value_delimiter = ',', value_parser = Aov::parse)]
    pub aovs: Vec<Aov>,

    /// Frames to render on one prepared scene; the report times each
    #[arg(long, allow_negative_numbers = true, value_name = "N", default_value_t = 1,
          value_parser = clap::value_parser!(u32).range(1..))]
    pub repeat: u32,

    /// Part of an adapter's name or driver, its index in `gpu-vpl info`, or cpu
    /// [default: $WGPU_ADAPTER_NAME, else hardware before software]
    #[arg(long, value_name = "NAME|INDEX")]
    pub adapter: Option<String>,

    /// Host threads [default: one a core]
    #[arg(long, allow_negative_numbers = true, value_name = "N",
          value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,

    /// Write what was done and how long each phase took, as JSON
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,

    /// Fail on warnings that change the image, and on pixels that are not finite
    #[arg(long)]
    pub strict: bool,

    /// Say nothing on standard error but errors
    #[arg(long)]
    pub quiet: bool,

    /// Print how long each phase took
    #[arg(long, conflicts_with = "quiet")]
    pub verbose: bool,

    /// Link every feature, whatever the scene has: for measuring what leaving out saves
    #[arg(long, hide = true)]
    pub link_everything: bool,
}

impl RenderArgs {
    /// The AOVs asked for, each once.
    pub fn aovs(&self) -> Vec<Aov> {
        let mut aovs = self.aovs.clone();
        aovs.sort_by_key(|aov| aov.name());
        aovs.dedup();
        aovs
    }

    /// Refuses what does not go together.
    ///
    /// # Errors
    /// There is such an option.
    pub fn check(&self) -> Result<(), Error> {
        let settings = self.settings();
        settings.check()?;
        let has_error = settings.method == Method::Path && settings.samples >= 2;
        if self.aovs.contains(&Aov::StandardError) && !has_error {
            let what = "--aov standard-error needs --method path with 2 --samples or more";
            return Err(Error::Usage(what.to_owned()));
        }
        if self.denoise {
            denoise::check(&settings)?;
            if self.aovs.contains(&Aov::StandardError) {
                let what = "--denoise leaves no --aov standard-error; leave one of them out";
                return Err(Error::Usage(what.to_owned()));
            }
        }
        Ok(())
    }

    /// What an image is rendered with: [`RenderArgs::settings`], and what `auto` leaves to the others.
    pub fn image_settings(&self) -> Settings {
        let settings = self.settings();
        let compensate = self.compensate.0.unwrap_or(settings.compensates_cheaply());
        Settings { compensate, ..settings }
    }

    /// What a frame depends on. Studies measure the bound by itself, unless compensation is asked for.
    pub fn settings(&self) -> Settings {
        let vpls = self.vpls.unwrap_or(Settings::of(self.method).light_paths);
        let defaults = Settings::of_vpls(self.method, vpls);
        Settings {
            method: self.method,
            light_paths: vpls,
            candidates: self.vpl_candidates.unwrap_or(defaults.candidates),
            bounces: self.bounces,
            direct: self.direct,
            light_samples: self.light_samples.0,
            direct_filter: self.direct_filter,
            clamp: self.clamp,
            compensate: self.compensate.0.unwrap_or(false),
            correct: self.correct,
            samples: self.samples.unwrap_or(defaults.samples),
            edge_samples: self.edge_samples,
            clustering: self.clustering.settings(),
            interleave: self.interleave.unwrap_or(defaults.interleave),
            link_everything: self.link_everything,
        }
    }
}

/// The options of methods vplc, vpc and both.
#[derive(Debug, Args)]
pub struct ClusteringArgs {
    /// Clusters of visible points, each of which shares its visibility
    #[arg(long, allow_negative_numbers = true, value_name = "C",
          default_value_t = Clustering::default().points,
          value_parser = clap::value_parser!(u32).range(1..))]
    pub point_clusters: u32,

    /// Clusters of VPLs, each of which shares visibility, or becomes one light
    #[arg(long, allow_negative_numbers = true, value_name = "K",
          default_value_t = Clustering::default().vpls,
          value_parser = clap::value_parser!(u32).range(1..))]
    pub vpl_clusters: u32,

    /// K-means iterations over the visible points, at most
    #[arg(long, allow_negative_numbers = true, value_name = "N",
          default_value_t = Clustering::default().point_iterations,
          value_parser = clap::value_parser!(u32).range(1..=i64::from(Clustering::MOST_ITERATIONS)))]
    pub point_iterations: u32,

    /// K-means iterations over the VPLs, at most
    #[arg(long, allow_negative_numbers = true, value_name = "N",
          default_value_t = Clustering::default().vpl_iterations,
          value_parser = clap::value_parser!(u32).range(1..=i64::from(Clustering::MOST_ITERATIONS)))]
    pub vpl_iterations: u32,

    /// Cosine of normals above which a point may join a cluster
    #[arg(long, value_name = "T", allow_hyphen_values = true,
          default_value_t = Clustering::default().normal_threshold,
          value_parser = parse::normal_threshold)]
    pub normal_threshold: f32,

    /// Nearest clusters that share a point's visibility; 1 is hard clustering
    #[arg(long, allow_negative_numbers = true, value_name = "M",
          default_value_t = Clustering::default().fuzzy,
          value_parser = clap::value_parser!(u32).range(1..=i64::from(Clustering::MOST_FUZZY)))]
    pub fuzzy: u32,

    /// VPLs to which every visible point traces a shadow ray, which tells where it sees others than
    /// its cluster does; 0 is none
    #[arg(long, allow_negative_numbers = true, value_name = "P",
          default_value_t = Clustering::default().probes,
          value_parser = clap::value_parser!(u32).range(..=i64::from(Clustering::MOST_PROBES)))]
    pub probes: u32,

    /// Middle iterations see one visible point in so many
    #[arg(long, allow_negative_numbers = true, value_name = "S",
          default_value_t = Clustering::default().stride,
          value_parser = clap::value_parser!(u32).range(1..=i64::from(Clustering::MOST_STRIDE)))]
    pub kmeans_stride: u32,

    /// What stands for a VPL cluster: its mean, the member nearest to that, or a member drawn for
    /// each cluster of visible points by what it gives (where visibility alone is shared; else as
    /// member)
    #[arg(long, value_name = "WHAT", default_value = "drawn",
          value_parser = parse::representative)]
    pub representative: Representative,

    /// What a VPL cluster shares: one light, or visibility alone
    #[arg(long, value_name = "WHAT", default_value = "visibility", value_parser = parse::merge)]
    pub merge: Merge,
}

impl ClusteringArgs {
    fn settings(&self) -> Clustering {
        Clustering {
            points: self.point_clusters,
            vpls: self.vpl_clusters,
            point_iterations: self.point_iterations,
            vpl_iterations: self.vpl_iterations,
            normal_threshold: self.normal_threshold,
            stride: self.kmeans_stride,
            fuzzy: self.fuzzy,
            probes: self.probes,
            representative: self.representative,
            merge: self.merge,
        }
    }
}
