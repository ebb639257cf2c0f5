//! Indirect light: the light paths that leave it, what it adds up to, what the bound takes and
//! compensation gives back, and how its error falls.

#[path = "../common/mod.rs"]
mod common;

mod closed_forms;
mod compensation;
mod convergence;
mod correct;
mod starts;
mod vpls;
