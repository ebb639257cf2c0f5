//! `render`: one image of a scene.

mod args;
mod outputs;

use std::time::{Duration, Instant};

pub use args::RenderArgs;
use outputs::{Outputs, Shown};

use super::console::{self, Progress};
use crate::error::Error;
use crate::gpu::{Gpu, GpuError};
use crate::image::output::commit;
use crate::render::{self, Bounces, Frame, Method, Prepared, Settings};
use crate::report::{FrameTimes, Report, RunPhases, Seconds};
use crate::scene::{Camera, Scene, Warning};

/// Renders as the arguments ask for. What can be refused early is: usage first, then outputs,
/// the scene, the adapter.
///
/// # Errors
/// Any of those is refused, the device fails, or an output cannot be written.
pub fn run(args: RenderArgs, started: Instant) -> Result<(), Error> {
    args.later.check()?;
    let mut aovs = args.aovs.clone();
    aovs.sort_by_key(|aov| aov.name());
    aovs.dedup();
    let outputs = Outputs::check(&args.outputs, &aovs, args.report.as_ref())?;
    start_threads(args.threads)?;

    let mut warnings = Warnings { quiet: args.quiet, strict: args.strict, messages: Vec::new() };
    let mut phases = RunPhases::default();
    let mut scene = timed(&mut phases.load, || Scene::load(&args.scene))?;
    for warning in std::mem::take(&mut scene.warnings) {
        warnings.add(warning)?;
    }
    let exposure = args.exposure.unwrap_or(scene.exposure);
    let mut camera = scene.camera;
    camera.size = args.size.unwrap_or(camera.size);
    let settings = args.settings();

    let prepared = prepare(&args, scene, &settings, &mut phases)?;
    let job = Job { prepared: &prepared, camera: &camera, seed: args.seed, quiet: args.quiet };
    let (frame, times) = job.frames(&settings, args.repeat)?;
    let aov_frames = aovs
        .iter()
        .map(|&method| Ok((method, job.frame(&Settings { method, ..settings })?)))
        .collect::<Result<Vec<_>, GpuError>>()?;
    check_result(&frame, &settings, &mut warnings)?;

    let main = Shown { method: settings.method, image: &frame.image };
    let further: Vec<_> = aov_frames
        .iter()
        .map(|(method, frame)| Shown { method: *method, image: &frame.image })
        .collect();
    let adapter = &prepared.gpu.info.name;
    let elapsed = started.elapsed();
    let metadata = outputs::metadata(settings.method, args.seed, &frame.counts, adapter, elapsed);
    let mut staged =
        timed(&mut phases.write, || outputs.stage(main, &further, exposure, &metadata))?;

    if let Some(first) = times.first() {
        phases.frame = first.phases;
    }
    let mut report = Report::new(&prepared, &settings, args.seed, &frame);
    report.phases = phases;
    report.seconds = seconds(&times, started.elapsed());
    report.frames = times;
    report.warnings = warnings.messages;
    if let Some(destination) = &outputs.report {
        staged.push(destination.stage(|out| {
            serde_json::to_writer_pretty(&mut *out, &report)?;
            out.write_all(b"\n")
        })?);
    }
    commit(staged)?;
    if args.verbose {
        print_phases(&report);
    }
    Ok(())
}

fn start_threads(threads: Option<u16>) -> Result<(), Error> {
    let Some(threads) = threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new()
        .num_threads(usize::from(threads))
        .build_global()
        .map_err(|error| Error::Usage(format!("--threads {threads}: {error}; ask for fewer")))
}

/// Opens the device and puts the scene on it. The time that is neither the BVH's nor the
/// shaders' is the device's.
fn prepare(
    args: &RenderArgs,
    scene: Scene,
    settings: &Settings,
    phases: &mut RunPhases,
) -> Result<Prepared, GpuError> {
    let mut seconds = 0.0;
    let prepared = timed(&mut seconds, || {
        let gpu = Gpu::open(&super::adapter_choice(args.adapter.as_deref()))?;
        if !args.quiet {
            let info = &gpu.info;
            let line = format!("adapter: {} ({}, {})", info.name, info.backend, info.driver);
            console::say(&console::one_line(&line));
        }
        Prepared::new(gpu, scene, settings)
    })?;
    phases.bvh = prepared.bvh_time.as_secs_f64();
    phases.pipelines = prepared.pipelines_time.as_secs_f64();
    phases.device = (seconds - phases.bvh - phases.pipelines).max(0.0);
    Ok(prepared)
}

/// What all frames of a run share.
struct Job<'a> {
    prepared: &'a Prepared,
    camera: &'a Camera,
    seed: u32,
    quiet: bool,
}

impl Job<'_> {
    fn frame(&self, settings: &Settings) -> Result<Frame, GpuError> {
        let bar = Progress::new(!self.quiet);
        let progress = |fraction, phase| bar.set(fraction, phase);
        render::frame(self.prepared, self.camera, settings, self.seed, &progress)
    }

    /// Renders the frame as often as asked: the first of them, which is cold, and the times of
    /// all.
    fn frames(
        &self,
        settings: &Settings,
        repeat: u32,
    ) -> Result<(Frame, Vec<FrameTimes>), GpuError> {
        let timed_frame = || {
            let start = Instant::now();
            let frame = self.frame(settings)?;
            let times = FrameTimes::new(start.elapsed(), &frame.phases);
            Ok::<_, GpuError>((frame, times))
        };
        let (first, cold) = timed_frame()?;
        let mut times = vec![cold];
        for _ in 1..repeat {
            times.push(timed_frame()?.1);
        }
        Ok((first, times))
    }
}

/// Warns of what a frame lacks.
fn check_result(frame: &Frame, settings: &Settings, warnings: &mut Warnings) -> Result<(), Error> {
    let wants_vpls = settings.method == Method::Vpl && settings.bounces != Bounces::Finite(0);
    if wants_vpls && frame.counts.vpls == 0 {
        let message = "no light path hit a surface, so there are no VPLs; the image is of direct \
                       light alone";
        warnings.add(Warning { message: message.to_owned(), changes_image: true })?;
    }
    let count = frame.counts.nonfinite_pixels;
    let first = frame.image.first_nonfinite();
    if count > 0 || first.is_some() {
        let at =
            first.map_or(String::new(), |[x, y]| format!(", the first at column {x}, row {y}"));
        let message = format!("{} pixels are not finite{at}", count.max(1));
        warnings.add(Warning { message, changes_image: true })?;
    }
    Ok(())
}

/// The warnings of a run; under `--strict` those that change the image end it.
struct Warnings {
    quiet: bool,
    strict: bool,
    messages: Vec<String>,
}

impl Warnings {
    fn add(&mut self, warning: Warning) -> Result<(), Error> {
        if self.strict && warning.changes_image {
            return Err(Error::Strict(format!("{} (an error under --strict)", warning.message)));
        }
        if !self.quiet {
            console::warning(&warning.message);
        }
        self.messages.push(warning.message);
        Ok(())
    }
}

fn seconds(times: &[FrameTimes], total: Duration) -> Seconds {
    let first = times.first().copied().unwrap_or_default();
    Seconds { preprocess: first.preprocess, render: first.render, total: total.as_secs_f64() }
}

fn print_phases(report: &Report) {
    for (phase, seconds) in report.phases.rows() {
        console::say(&format!("{phase:>15} {seconds:10.4} s"));
    }
    for (index, frame) in report.frames.iter().enumerate() {
        console::say(&format!("{:>15} {:10.4} s", format!("frame {index}"), frame.seconds));
    }
    console::say(&format!("{:>15} {:10.4} s", "total", report.seconds.total));
}

/// Runs something and notes the seconds it took.
fn timed<T>(seconds: &mut f64, what: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = what();
    *seconds = start.elapsed().as_secs_f64();
    result
}
