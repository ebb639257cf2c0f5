//! How kernels trace rays: through the hierarchy, or by triangles written into them.

use std::sync::Arc;

use super::Prepared;
use crate::gpu::module::{
    CORNERS, HIT_POINT, LITERAL_RAY, PACKET_RAYS, PACKET_SHAFT, RAY, TRAVERSE, TRAVERSE_PACKET,
    VISIBILITY, VISIBILITY_LITERALS, VISIBILITY_PACKET,
};
use crate::gpu::{Module, Program};

/// How a kernel traces the rays of its invocations.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Traversal {
    /// Each ray by itself, for adapters without subgroups.
    Single,
    /// The rays of a subgroup together.
    Packets,
    /// Each ray against triangles that are written into the shader.
    Literals(Arc<str>),
}

/// What rays are for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// To find what they meet first, from anywhere.
    Nearest,
    /// To find whether anything is between two places of the scene.
    Shadow,
}

impl Traversal {
    /// The one that suits a scene, its device, and what the rays are for.
    pub fn of(prepared: &Prepared, purpose: Purpose) -> Self {
        match (&prepared.literals, purpose) {
            (Some(literals), Purpose::Nearest) => Self::Literals(literals.all.clone()),
            (Some(literals), Purpose::Shadow) => Self::Literals(literals.blockers.clone()),
            _ if prepared.gpu.has_subgroups() => Self::Packets,
            _ => Self::Single,
        }
    }

    /// A program whose modules call `traverse`.
    pub fn link(&self, label: &'static str, modules: &[&'static Module]) -> Program {
        let (traverse, generated) = match self {
            Self::Single => (&TRAVERSE, None),
            Self::Packets => (&TRAVERSE_PACKET, None),
            Self::Literals(text) => (&LITERAL_RAY, Some(text.clone())),
        };
        let mut all = vec![&RAY, traverse];
        // The hierarchy's traversals have the triangles.
        all.extend((generated.is_some() && modules.contains(&&HIT_POINT)).then_some(&CORNERS));
        all.extend(modules);
        Program { label, modules: all, generated }
    }
}

/// How the shadow rays between points and VPLs are traced.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Tracing {
    /// Each ray by itself, for adapters without subgroups.
    Single,
    /// Packets against boxes as a whole.
    Shaft,
    /// Packets against boxes ray by ray.
    Rays,
    /// Four rays an invocation against triangles that are written into the shader.
    Literals(Arc<str>),
}

impl Tracing {
    /// Hierarchies of more nodes have boxes so small that a packet is best tested ray by ray.
    const SHAFT_NODES: usize = 1000;

    /// The one that suits a scene and its device.
    pub fn of(prepared: &Prepared) -> Self {
        match &prepared.literals {
            Some(literals) if literals.suit_packets => Self::Literals(literals.blockers.clone()),
            _ if !prepared.gpu.has_subgroups() => Self::Single,
            _ if prepared.bvh.nodes.len() <= Self::SHAFT_NODES => Self::Shaft,
            _ => Self::Rays,
        }
    }

    /// Points for which an invocation traces rays.
    pub fn points(&self) -> u32 {
        if *self == Self::Single { 1 } else { 4 }
    }

    /// The visibility program of these modules.
    pub(super) fn link(&self, modules: &[&'static Module]) -> Program {
        let (own, generated) = match self {
            Self::Single => ([&TRAVERSE, &VISIBILITY].to_vec(), None),
            Self::Shaft => ([&PACKET_SHAFT, &VISIBILITY_PACKET].to_vec(), None),
            Self::Rays => ([&PACKET_RAYS, &VISIBILITY_PACKET].to_vec(), None),
            Self::Literals(text) => ([&VISIBILITY_LITERALS].to_vec(), Some(text.clone())),
        };
        Program { label: "visibility", modules: [modules, &own].concat(), generated }
    }
}
