//! Rays: what they hit on host and device, who sees whom, the sum over all that is seen, and how
//! fast all that is.

#[path = "../common/mod.rs"]
mod common;

mod rates;
mod shading;
mod spheres;
mod ties;
mod traversal;
mod visibility;
