//! How the shadow rays between points and VPLs are traced.

use crate::gpu::Module;
use crate::gpu::module::{
    PACKET_RAYS, PACKET_SHAFT, TRAVERSE, VISIBILITY, VISIBILITY_LITERALS, VISIBILITY_PACKET,
};
use crate::render::Plan;

/// How the shadow rays between points and VPLs are traced.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tracing {
    /// Each ray by itself, for adapters without subgroups.
    Single,
    /// Packets against boxes as a whole.
    Shaft,
    /// Packets against boxes ray by ray.
    Rays,
    /// Four rays an invocation against triangles that are written into the shader.
    Literals,
}

impl Tracing {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Single, Self::Shaft, Self::Rays, Self::Literals];
    /// Hierarchies of more nodes have boxes so small that a packet is best tested ray by ray.
    const SHAFT_NODES: usize = 1000;

    /// The one that suits a scene and its device.
    pub fn of(plan: &Plan) -> Self {
        match plan.target() {
            target if target.literal_packets => Self::Literals,
            target if !target.subgroups => Self::Single,
            _ if plan.bvh.nodes.len() <= Self::SHAFT_NODES => Self::Shaft,
            _ => Self::Rays,
        }
    }

    /// Points for which an invocation traces rays.
    pub fn points(self) -> u32 {
        if self == Self::Single { 1 } else { 4 }
    }

    /// What traces them, after what they may meet.
    pub(super) fn modules(self) -> Vec<&'static Module> {
        match self {
            Self::Single => vec![&TRAVERSE, &VISIBILITY],
            Self::Shaft => vec![&PACKET_SHAFT, &VISIBILITY_PACKET],
            Self::Rays => vec![&PACKET_RAYS, &VISIBILITY_PACKET],
            Self::Literals => vec![&VISIBILITY_LITERALS],
        }
    }
}
