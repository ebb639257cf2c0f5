//! `render`: one image of a scene.

mod aov;
mod args;
mod job;
mod outputs;
mod warnings;

use std::time::Instant;

pub use aov::Aov;
pub use args::RenderArgs;
use job::Job;
use outputs::{Outputs, Shown};
use warnings::Warnings;

use super::adapter::adapter_choice;
use super::console;
use super::parse::Exposure;
use crate::denoise::Denoiser;
use crate::error::{Error, OutputError};
use crate::gpu::{Gpu, GpuError};
use crate::image::output::{Staged, commit};
use crate::image::{Image, exposure};
use crate::render::{Frame, Method, Prepared};
use crate::report::warnings::caustics;
use crate::report::{Report, RunPhases, Seconds};
use crate::scene::{Scene, Warning};

/// Renders as the arguments ask for. What can be refused early is: usage first, then outputs,
/// the scene, the adapter.
///
/// # Errors
/// Any of those is refused, the device fails, or an output cannot be written.
pub fn run(args: &RenderArgs, started: Instant) -> Result<(), Error> {
    args.check()?;
    let aovs = args.aovs();
    let outputs = Outputs::check(&args.outputs, &aovs, args.report.as_ref())?;
    start_threads(args.threads)?;
    let denoiser = match args.denoise {
        true => Some(Denoiser::open(rayon::current_num_threads())?),
        false => None,
    };

    let mut phases = RunPhases::default();
    let mut warnings = Warnings::new(args.quiet, args.strict);
    let mut scene = timed(&mut phases.load, || Scene::load(&args.scene))?;
    let caustic = caustics(&scene, &args.image_settings());
    for warning in std::mem::take(&mut scene.warnings).into_iter().chain(caustic) {
        warnings.add(warning)?;
    }
    let of_scene = scene.exposure;

    let job = Job { denoiser, ..prepare(args, scene, &mut phases)? };
    let (frame, frames) = job.repeated(args.repeat)?;
    let aovs = job.aovs(&aovs, &frame)?;
    warnings.check(&frame, &job.settings)?;
    let exposure = match args.exposure {
        None => of_scene,
        Some(Exposure::Stops(stops)) => stops,
        Some(Exposure::Auto) => exposure::fitting(&frame.image).unwrap_or(of_scene),
    };
    let method = job.settings.method;
    if method.is_indirect() || matches!(method, Method::Path | Method::Direct) {
        let message = warnings::look(&frame.image, exposure, outputs.has_png());
        message.into_iter().try_for_each(|message| warnings.add(Warning::note(message)))?;
    }
    let write = || stage_images(&outputs, &job, &frame, &aovs, exposure, started);
    let mut staged = timed(&mut phases.write, write)?;

    let mut report = Report::new(&job.prepared, &job.settings, job.seed, &frame);
    if let Some(first) = frames.first() {
        phases.frame = first.phases;
        report.seconds = Seconds {
            preprocess: first.preprocess,
            render: first.render,
            total: started.elapsed().as_secs_f64(),
        };
    }
    report.phases = phases;
    report.frames = frames;
    report.warnings = warnings.messages;
    report.exposure = exposure;
    report.denoiser = job.denoiser.map(|denoiser| denoiser.version().to_owned());
    staged.extend(stage_report(&outputs, &report)?);
    commit(staged)?;
    if args.verbose {
        print_phases(&report);
    }
    Ok(())
}

/// Sets the number of host threads, once in a process.
///
/// # Errors
/// They cannot be started.
pub fn start_threads(threads: Option<u16>) -> Result<(), Error> {
    let Some(threads) = threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new()
        .num_threads(usize::from(threads))
        .build_global()
        .map_err(|error| Error::Usage(format!("--threads {threads}: {error}; ask for fewer")))
}

/// Opens the device and puts the scene on it. The time that is neither the BVH's nor the
/// shaders' is the device's.
fn prepare(args: &RenderArgs, scene: Scene, phases: &mut RunPhases) -> Result<Job, GpuError> {
    let start = Instant::now();
    let gpu = Gpu::open(&adapter_choice(args.adapter.as_deref()))?;
    if !args.quiet {
        let info = &gpu.info;
        let line = format!("adapter: {} ({}, {})", info.name, info.backend, info.driver);
        console::say(&console::one_line(&line));
    }
    let mut camera = scene.camera;
    camera.size = args.size.unwrap_or(camera.size);
    let settings = args.image_settings();
    let prepared = Prepared::new(gpu, scene, &settings)?;
    phases.bvh = prepared.bvh_time.as_secs_f64();
    phases.pipelines = prepared.pipelines_time.as_secs_f64();
    phases.device = (start.elapsed().as_secs_f64() - phases.bvh - phases.pipelines).max(0.0);
    Ok(Job { prepared, camera, settings, seed: args.seed, denoiser: None, quiet: args.quiet })
}

fn stage_images(
    outputs: &Outputs,
    job: &Job,
    frame: &Frame,
    aovs: &[(Aov, Image)],
    exposure: f32,
    started: Instant,
) -> Result<Vec<Staged>, OutputError> {
    let method = job.settings.method;
    let adapter = &job.prepared.gpu.info.name;
    let mut metadata =
        outputs::metadata(method, job.seed, &frame.counts, adapter, started.elapsed());
    metadata.extend(job.denoiser.as_ref().map(outputs::denoised));
    let main = Shown { method, image: &frame.image };
    outputs.stage(main, aovs, exposure, &metadata)
}

fn stage_report(outputs: &Outputs, report: &Report) -> Result<Option<Staged>, OutputError> {
    let Some(destination) = &outputs.report else { return Ok(None) };
    let staged = destination.stage(|out| {
        serde_json::to_writer_pretty(&mut *out, report)?;
        out.write_all(b"\n")
    })?;
    Ok(Some(staged))
}

fn print_phases(report: &Report) {
    let row = |name: &str, seconds: f64| console::say(&format!("{name:>15} {seconds:10.4} s"));
    for (phase, seconds) in report.phases.rows() {
        row(phase, seconds);
    }
    for (index, frame) in report.frames.iter().enumerate() {
        row(&format!("frame {index}"), frame.seconds);
    }
    row("pT, preprocess", report.seconds.preprocess);
    row("rT, render", report.seconds.render);
    row("tT, total", report.seconds.total);
}

/// Runs something and notes the seconds it took.
fn timed<T>(seconds: &mut f64, what: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = what();
    *seconds = start.elapsed().as_secs_f64();
    result
}
