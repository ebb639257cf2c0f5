//! `study`: experiments on one scene, written as tables.

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;

use super::{console, parse, render};
use crate::error::{Error, OutputError};
use crate::gpu::Gpu;
use crate::image::Destination;
use crate::image::output::commit;
use crate::render::{Prepared, Settings};
use crate::scene::Scene;
use crate::study::{Results, Row, Runner, SCHEMA, csv, markdown, thesis};

/// The options of `study`.
#[derive(Debug, Args)]
pub struct StudyArgs {
    #[arg(hide = true)]
    scenes: Vec<String>,

    /// Which experiments: thesis
    #[arg(long, value_name = "PRESET", value_parser = parse::preset)]
    preset: Option<&'static str>,

    /// Directory for thesis.md, thesis.csv and thesis.json; made if it is not there
    #[arg(short, long = "output", value_name = "DIR", required = true)]
    output: PathBuf,

    /// Width and height in pixels [default: the thesis's 512x512]
    #[arg(long, value_name = "WxH", value_parser = parse::size, allow_hyphen_values = true)]
    size: Option<[u32; 2]>,

    /// Seed of all random numbers
    #[arg(long, allow_negative_numbers = true, default_value_t = 0)]
    seed: u32,

    /// Part of an adapter's name or driver, its index in `gpu-vpl info`, or cpu
    /// [default: $WGPU_ADAPTER_NAME, else hardware before software]
    #[arg(long, value_name = "NAME|INDEX")]
    adapter: Option<String>,

    /// Host threads [default: one a core]
    #[arg(long, allow_negative_numbers = true, value_name = "N",
          value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

    /// Say nothing on standard error but errors
    #[arg(long)]
    quiet: bool,

    #[arg(long, hide = true)]
    sweep: Option<PathBuf>,
    #[arg(long, hide = true)]
    reference: Option<PathBuf>,
    #[arg(long, hide = true)]
    seeds: Option<String>,
    #[arg(long, hide = true)]
    fresh: bool,
}

impl StudyArgs {
    /// The preset asked for, after what is still to come was refused.
    fn checked_preset(&self) -> Result<&'static str, Error> {
        let later = [
            ("a SCENE", !self.scenes.is_empty()),
            ("--sweep", self.sweep.is_some()),
            ("--reference", self.reference.is_some()),
            ("--seeds", self.seeds.is_some()),
            ("--fresh", self.fresh),
        ];
        if let Some((name, _)) = later.into_iter().find(|(_, given)| *given) {
            let what = format!("study: {name} is not supported yet; leave it out");
            return Err(Error::Usage(what));
        }
        let missing = || Error::Usage("study: what to study? Give --preset thesis".to_owned());
        self.preset.ok_or_else(missing)
    }
}

/// Runs a preset's experiments and writes what they found.
///
/// # Errors
/// Usage is refused, an output cannot be written, or the device fails.
pub fn run(args: &StudyArgs) -> Result<(), Error> {
    let preset = args.checked_preset()?;
    let directory = Directory::make(&args.output)?;
    let file = |ending: &str| Destination::check(&args.output.join(format!("{preset}.{ending}")));
    let (md, csv_file, json) = (file("md")?, file("csv")?, file("json")?);
    render::start_threads(args.threads)?;

    let experiments = thesis::experiments();
    let results = measure(args, preset, &experiments)?;
    let staged = vec![
        md.stage(|out| markdown::write(out, &experiments, &results))?,
        csv_file.stage(|out| csv::write(out, &results.rows))?,
        json.stage(|out| {
            serde_json::to_writer_pretty(&mut *out, &results)?;
            out.write_all(b"\n")
        })?,
    ];
    commit(staged)?;
    directory.keep();
    Ok(())
}

fn measure(
    args: &StudyArgs,
    preset: &'static str,
    experiments: &[crate::study::Experiment],
) -> Result<Results, Error> {
    let scene = Scene::load(thesis::SCENE)?;
    let gpu = Gpu::open(&super::adapter_choice(args.adapter.as_deref()))?;
    let adapter = gpu.info.clone();
    let mut camera = scene.camera;
    camera.size = args.size.unwrap_or(thesis::SIZE);
    let [width, height] = camera.size;
    let settings = Settings::default();
    let prepared = Prepared::new(gpu, scene, &settings)?;
    let tell = |row: &Row| {
        if !args.quiet {
            let Row { experiment, setting, times, .. } = row;
            console::say(&format!("{experiment}, {setting}: {:.3} s", times.seconds));
        }
    };
    let rows = Runner::new(&prepared, camera, args.seed).run(experiments, &tell)?;
    Ok(Results {
        schema: SCHEMA,
        version: env!("CARGO_PKG_VERSION"),
        preset,
        scene: thesis::SCENE.to_owned(),
        adapter,
        threads: rayon::current_num_threads(),
        seed: args.seed,
        width,
        height,
        samples: settings.samples,
        claims: thesis::claims(&rows),
        rows,
    })
}

/// The directory of the outputs; removed again if it was made here and nothing came of it.
#[derive(Debug)]
struct Directory {
    made: Option<PathBuf>,
}

impl Directory {
    fn make(name: &Path) -> Result<Self, OutputError> {
        let refuse = |why: String| OutputError::Write { file: name.to_owned(), why };
        if name.is_dir() {
            return Ok(Self { made: None });
        }
        if fs::symlink_metadata(name).is_ok() {
            return Err(refuse("it is no directory; name one, or one to be made".to_owned()));
        }
        fs::create_dir(name).map_err(|error| refuse(error.kind().to_string()))?;
        Ok(Self { made: Some(name.to_owned()) })
    }

    fn keep(mut self) {
        self.made = None;
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        if let Some(made) = &self.made {
            // An empty directory left behind does no harm; one with files in it is not removed.
            let _ = fs::remove_dir(made);
        }
    }
}
