//! `study --preset extremes`: cases in which renderers fail first, at full size.

use super::args::{OPTIONS_OF_RENDER, StudyArgs};
use super::axes::render_args;
use super::outputs::{TABLE, Tables};
use super::process::{command, interrupt};
use crate::cli::adapter::adapter_choice;
use crate::cli::{console, render};
use crate::error::Error;
use crate::extremes::table::Report;
use crate::extremes::{Asked, CASES, Cases, Front, Judged, Runner, Scale, Verdict};
use crate::gpu::{Gpu, GpuError};
use crate::study::{Store, name_of_program};

/// How the program's command line reads the options of cases.
pub fn front() -> Front {
    Front {
        options: |words| {
            let args = render_args(words.iter().cloned())?;
            Ok(Asked { settings: args.settings(), seed: args.seed, size: args.size })
        },
    }
}

/// Runs all cases, but for those that this build found right on this device before, and writes the
/// tables. Interrupted, it writes those of the cases that it has come to.
///
/// # Errors
/// Usage is refused, an output cannot be written, there is no device, the user interrupts; or,
/// after all is written, a figure is not what it must be.
pub fn run(args: &StudyArgs) -> Result<(), Error> {
    check(args)?;
    let outputs = Tables::check(&args.output)?;
    render::start_threads(args.threads)?;
    let cases = Cases::parse(CASES).map_err(|what| Error::Usage(format!("study: {what}")))?;
    let adapter = adapter_choice(args.adapter.as_deref());
    let info = Gpu::open(&adapter)?.info;
    let mut store: Store<Vec<Judged>> = Store::open(&outputs.store(), args.fresh)?;
    let build = format!("{} {info:?}", name_of_program());
    let mut report = Report {
        cases: &cases,
        command: command(),
        adapter: Some(info),
        judged: Vec::new(),
        broken_off: None,
    };
    let mut runner =
        Runner::new(&cases, Scale::Full, front(), adapter).interrupted_by(interrupt()?);
    for (number, case) in (1..).zip(&cases.cases) {
        let key = format!("{build} {}", case.name);
        let kept = store.get(&key).cloned();
        let how = if kept.is_some() { " (kept)" } else { "" };
        let judged = match kept.map_or_else(|| runner.run(case), Ok) {
            Err(Error::Gpu(GpuError::Interrupted)) => {
                report.broken_off = Some(number - 1);
                break;
            }
            judged => judged?,
        };
        if !args.quiet {
            let (of, name) = (cases.cases.len(), &case.name);
            let line = format!("{number} of {of}: {name}: {}{how}", told(&judged));
            console::say(&console::one_line(&line));
        }
        // What is wrong is looked at again.
        if how.is_empty() && judged.iter().all(|judged| judged.verdict != Verdict::Wrong) {
            store.put(&key, judged.clone())?;
        }
        report.judged.extend(judged);
    }
    outputs.write(&report)?;
    let (table, figures) = (args.output.join(TABLE), report.judged.len());
    match report.wrong() {
        _ if report.broken_off.is_some() => Err(Error::Interrupted(format!(
            "interrupted: {} shows the {figures} figures that there are; the same command goes on",
            table.display()
        ))),
        0 => Ok(()),
        wrong => Err(Error::Wrong(format!(
            "{}: {wrong} of {figures} figures are wrong; look at those that say so",
            table.display(),
        ))),
    }
}

/// What a case came to, in a line: the figure that uses most of its tolerance.
fn told(judged: &[Judged]) -> String {
    let wrong = judged.iter().find(|judged| judged.verdict == Verdict::Wrong);
    let share = |judged: &&Judged| {
        let figure = &judged.figure;
        if figure.within > 0.0 { figure.error / figure.within } else { figure.error }
    };
    let nearest = judged.iter().max_by(|a, b| share(a).total_cmp(&share(b)));
    let Some(Judged { figure, refusal, verdict, .. }) = wrong.or(nearest) else {
        return "nothing".to_owned();
    };
    let verdict = match verdict {
        Verdict::Right => "right",
        Verdict::Refused => "refused as it must be",
        Verdict::Wrong => "WRONG",
    };
    match refusal {
        Some(why) => format!("{verdict}, {why}"),
        None => format!(
            "{verdict}, {} {} {:.4e} for {:.4e}, off by {:.1e} of {:.1e}",
            figure.method,
            figure.what,
            figure.measured,
            figure.expected,
            figure.error,
            figure.within
        ),
    }
}

/// Refuses what makes no sense here.
fn check(args: &StudyArgs) -> Result<(), Error> {
    let refuse = |what: String| Err(Error::Usage(format!("study: {what}")));
    if !args.scenes.is_empty() {
        return refuse("the extremes have their own scenes; leave SCENE out".to_owned());
    }
    if !args.axes.is_empty() {
        return refuse(OPTIONS_OF_RENDER.to_owned());
    }
    let given = [
        ("--reference", args.reference.is_some()),
        ("--reference-samples", args.reference_samples.is_some()),
        ("--seeds", args.seeds.is_some()),
        ("--seed", args.seed.is_some()),
        ("--clustering-seeds", args.clustering_seeds.is_some()),
        ("--decompose", args.decompose.is_some()),
        ("--mask-above", args.mask_above.is_some()),
        ("--size", args.size.is_some()),
    ];
    match given.iter().find(|(_, given)| *given) {
        None => Ok(()),
        Some((name, _)) => refuse(format!(
            "--preset extremes goes without {name}, as its cases say how they are rendered"
        )),
    }
}
