//! How rays are traced: the modules that a scene's shapes choose, and its size.

use super::catalogue::{
    BLOCKER_ANY, BLOCKER_TRIANGLE, LITERAL_SEGMENTS, LITERALS, MEMBERS_LITERALS, MEMBERS_PACKET,
    MEMBERS_SINGLE, OPAQUE_ALL, OPAQUE_CUTOUT, PACKET_RAYS, PACKET_SEGMENTS, PACKET_SHAFT, RAY,
    SHAPE_ANY, SHAPE_TRIANGLE, TABLE, TEXTURE, TRAVERSE, TRAVERSE_PACKET, UV_ANY, UV_TRIANGLE,
    VISIBILITY_LITERALS, VISIBILITY_PACKET, VISIBILITY_SINGLE, WIDE_NODES,
};
use crate::gpu::Module;
use crate::render::features::{Features, Target};

/// The shapes that there are.
pub fn shape(features: Features) -> &'static Module {
    if features.spheres { &SHAPE_ANY } else { &SHAPE_TRIANGLE }
}

/// Rays, and the shapes that they meet.
pub fn shapes(features: Features) -> Vec<&'static Module> {
    let mut modules: Vec<&Module> = vec![&RAY];
    modules.push(shape(features));
    match features.cutouts {
        true => modules.extend(textures(features).into_iter().chain([&OPAQUE_CUTOUT])),
        false => modules.push(&OPAQUE_ALL),
    }
    modules
}

/// Rays, the shapes that they meet, and how those are traced that neighbours trace alike.
pub fn rays(target: Target) -> Vec<&'static Module> {
    if target.literals {
        return vec![&RAY, &LITERALS];
    }
    let mut modules = shapes(target.features);
    match target.subgroups {
        true => modules.extend([&TABLE, &WIDE_NODES, &TRAVERSE_PACKET]),
        false => modules.push(&TRAVERSE),
    }
    modules
}

/// Rays, and the shapes that block those of a packet.
pub fn blockers(features: Features) -> Vec<&'static Module> {
    match features.spheres || features.cutouts {
        true => [&shapes(features)[..], &[&BLOCKER_ANY]].concat(),
        false => vec![&RAY, &BLOCKER_TRIANGLE],
    }
}

/// Textures, and where on the shapes they lie.
pub fn textures(features: Features) -> Vec<&'static Module> {
    vec![&TEXTURE, if features.spheres { &UV_ANY } else { &UV_TRIANGLE }]
}

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

    /// The one that suits a scene, whose hierarchy has so many nodes, and its device.
    pub fn of(target: Target, nodes: usize) -> Self {
        match target {
            target if target.literal_packets => Self::Literals,
            target if !target.subgroups => Self::Single,
            _ if nodes <= Self::SHAFT_NODES => Self::Shaft,
            _ => Self::Rays,
        }
    }

    /// Points for which an invocation traces rays.
    pub fn points(self) -> u32 {
        if self == Self::Single { 1 } else { 4 }
    }

    /// What traces them, after what they may meet and tables.
    pub(super) fn modules(self) -> Vec<&'static Module> {
        match self {
            Self::Single => vec![&TRAVERSE],
            Self::Shaft => vec![&WIDE_NODES, &PACKET_SHAFT, &PACKET_SEGMENTS],
            Self::Rays => vec![&WIDE_NODES, &PACKET_RAYS, &PACKET_SEGMENTS],
            Self::Literals => vec![&LITERAL_SEGMENTS],
        }
    }

    /// From lights to neighbouring points.
    pub(super) fn of_lights(self) -> &'static Module {
        match self {
            Self::Single => &VISIBILITY_SINGLE,
            Self::Shaft | Self::Rays => &VISIBILITY_PACKET,
            Self::Literals => &VISIBILITY_LITERALS,
        }
    }

    /// From a point to members of clusters of lights.
    pub(super) fn of_members(self) -> &'static Module {
        match self {
            Self::Single => &MEMBERS_SINGLE,
            Self::Shaft | Self::Rays => &MEMBERS_PACKET,
            Self::Literals => &MEMBERS_LITERALS,
        }
    }

    /// Workgroups of a dispatch over so many rows and words of lights that draws members.
    pub fn groups_of_members(self, rows: u32, words: u32) -> [u32; 2] {
        match self {
            Self::Single | Self::Literals => [rows.div_ceil(64), words],
            // One has up to eight words of a row.
            Self::Shaft | Self::Rays => {
                const MOST_ACROSS: u64 = 1 << 15;
                let all = u64::from(rows) * u64::from(words.div_ceil(8));
                [all.min(MOST_ACROSS) as u32, all.div_ceil(MOST_ACROSS) as u32]
            }
        }
    }
}
