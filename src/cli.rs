//! Arguments and their conversion to jobs.

mod adapter;
mod compare;
mod console;
mod info;
mod parse;
mod render;
#[cfg(unix)]
mod signals;
mod study;

use std::ffi::{OsStr, OsString};
use std::panic;
use std::time::Instant;

use clap::error::ErrorKind;
use clap::{Parser, Subcommand};

pub use study::front;

/// Headless global illumination with virtual point lights.
#[derive(Debug, Parser)]
#[command(name = "gpu-vpl", version, arg_required_else_help = false)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Render one image of a scene
    Render(Box<render::RenderArgs>),
    /// List adapters and built-in scenes; say what a scene holds
    Info(info::InfoArgs),
    /// Measure error against run time: tables, plots and a page
    Study(study::StudyArgs),
    /// Measure how far an image is from a reference
    Compare(compare::CompareArgs),
}

/// Runs the program with these arguments and returns its exit code. Whatever goes wrong is one
/// line on standard error; a panic, which would be a fault of this program, is too.
pub fn main(arguments: impl IntoIterator<Item = OsString>, started: Instant) -> u8 {
    panic::set_hook(Box::new(|fault| {
        console::error(&format!("internal error, please report it: {fault}"));
    }));
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    panic::catch_unwind(|| run(arguments, started)).unwrap_or(1)
}

fn run(arguments: Vec<OsString>, started: Instant) -> u8 {
    let command = arguments.get(1).cloned();
    #[cfg(unix)]
    signals::listen(command.as_deref());
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(refusal) => return refuse(&refusal, command.as_deref()),
    };
    let result = match cli.command {
        Command::Render(args) => render::run(&args, started),
        Command::Info(args) => info::run(&args),
        Command::Study(args) => study::run(&args),
        Command::Compare(args) => compare::run(&args),
    };
    match result {
        Ok(()) => 0,
        Err(error) => {
            console::error(&error.to_string());
            error.exit_code()
        }
    }
}

/// Help and version are no errors; all else becomes one line.
fn refuse(refusal: &clap::Error, command: Option<&OsStr>) -> u8 {
    match refusal.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            match console::print(&refusal.to_string()) {
                Ok(()) => 0,
                Err(error) => {
                    console::error(&format!("standard output: cannot write: {error}"));
                    1
                }
            }
        }
        ErrorKind::MissingSubcommand => {
            console::error(
                "no command given; there are render, study, compare and info; see gpu-vpl --help",
            );
            2
        }
        _ => {
            let help = match command.and_then(OsStr::to_str) {
                Some(command @ ("render" | "study" | "compare" | "info")) => {
                    format!("gpu-vpl {command} --help")
                }
                _ => "gpu-vpl --help".to_owned(),
            };
            console::error(&format!("{}; see {help}", parse::one_clause(&refusal.to_string())));
            2
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
