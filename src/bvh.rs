//! The bounding volume hierarchy: built by obvhs, flattened to depth-first nodes with skip
//! pointers for the device, and traversed on the host for light paths.
//!
//! A traversal needs no stack: it goes to the next node where a box is hit, else to the
//! node's skip pointer (Smits, "Efficiency Issues for Ray Tracing", 1998). The WGSL twin is
//! `shaders/trace/traverse.wgsl`; a test holds the two against each other. Packets of rays go through
//! nodes of four children instead ([`WideBvh`]), with a stack, and find the same: of all shapes that
//! a ray meets the nearest, of equally near ones the first, whatever the order.

mod build;
mod quality;
mod ray;
mod shape;
mod traverse;
mod wide;

pub use build::Bvh;
pub use quality::Quality;
pub use ray::{Hit, Ray};
pub use wide::{WideBvh, WideChild, WideNode};
