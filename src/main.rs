//! The `gpu-vpl` program: everything is in the library.

use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let started = Instant::now();
    ExitCode::from(gpu_vpl::cli::main(std::env::args_os(), started))
}
