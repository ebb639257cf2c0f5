//! Whole images: against references, against each other after changes that must not show, and how
//! far two are apart to the eye.

#[path = "../common/mod.rs"]
mod common;

mod edges;
mod flip;
mod properties;
mod references;
