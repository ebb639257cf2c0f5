//! The `gpu-vpl` program: everything is in the library.

use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let started = Instant::now();
    silence_device_select();
    ExitCode::from(gpu_vpl::cli::main(std::env::args_os(), started))
}

/// Mesa's layer that sorts adapters by what the desktop prefers asks Wayland first, and that
/// library complains on standard error where there is no session: on every server. We choose
/// the adapter ourselves.
fn silence_device_select() {
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        #[expect(unsafe_code, reason = "no safe way to set a variable; no other thread runs yet")]
        // SAFETY: the first thing that main does, before any thread is started.
        unsafe {
            std::env::set_var("NODEVICE_SELECT", "1");
        }
    }
}
