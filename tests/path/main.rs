//! The path tracer: against closed forms, against itself and the other methods.

#[path = "../common/mod.rs"]
mod common;

mod closed_forms;
mod convergence;
