//! `study`: a plan from the command line, measured, and what was found written as tables, plots
//! and a page.

mod args;
mod axes;
mod extremes;
mod outputs;
mod process;
mod progress;
mod sweep;

use super::adapter::adapter_choice;
use super::render;
use crate::error::Error;
use crate::gpu::GpuError;
use crate::study::{Store, Study};
use outputs::Outputs;
use process::{command, interrupt};
use progress::Progress;

pub use args::StudyArgs;
pub use extremes::front;

/// Measures what is planned, as far as it is not measured yet, and writes what was found. An
/// interrupted study writes what is done, and goes on when it is run again.
///
/// # Errors
/// Usage is refused, an input cannot be read, an output cannot be written, or the device fails.
pub fn run(args: &StudyArgs) -> Result<(), Error> {
    if args.preset == Some(crate::extremes::NAME) {
        return extremes::run(args);
    }
    let plan = args.plan()?;
    let outputs = Outputs::check(&args.output)?;
    render::start_threads(args.threads)?;
    let store = Store::open(&outputs.store(), args.fresh)?;
    let progress = Progress::new(&plan, args.quiet);
    let adapter = adapter_choice(args.adapter.as_deref());
    let mut study = Study::new(plan, store, adapter, interrupt()?);
    let result = study.run(&|event| progress.tell(event));
    let interrupted = match result {
        Err(Error::Gpu(GpuError::Interrupted)) => true,
        other => {
            other?;
            false
        }
    };
    let results = study.results(command());
    outputs.write(&study, &results)?;
    match interrupted {
        false => Ok(()),
        true => Err(Error::Interrupted(format!(
            "interrupted: {} of {} frames are measured, {} shows them; the same command goes on",
            results.finished,
            results.planned,
            args.output.join(outputs::PAGE).display()
        ))),
    }
}
