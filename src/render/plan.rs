//! What is known of a scene before there is a device: its hierarchy, its lights, and so the
//! programs that it needs.

pub mod memory;
mod programs;

use std::time::{Duration, Instant};

use super::features::{Features, Sky, Target};
use super::kernels::Tracing;
use super::kernels::literals::Literals;
use super::lights::{LightKind, Lights};
use super::settings::Settings;
use crate::bvh::{Bvh, WideBvh};
use crate::gpu::Program;
use crate::scene::Scene;

/// A scene, and what is linked for it.
#[derive(Debug)]
pub struct Plan {
    /// The scene.
    pub scene: Scene,
    /// The hierarchy over the scene's triangles and spheres.
    pub bvh: Bvh,
    /// The same for packets of rays, where there are any: not without subgroups, nor where literals suit
    /// shadow rays to VPLs, too.
    pub wide: Option<WideBvh>,
    /// The light sources.
    pub lights: Lights,
    /// What is linked for the scene.
    pub features: Features,
    /// Time spent on building the BVH.
    pub bvh_time: Duration,
    /// Whether area lights are near to surfaces.
    near_lights: bool,
    subgroups: bool,
    literals: Option<Literals>,
    /// Whether what the scene does not need is linked, too.
    everything: bool,
}

impl Plan {
    /// Of a scene, on a device with subgroups of eight lanes or more or without.
    pub fn new(scene: Scene, settings: &Settings, subgroups: bool) -> Self {
        let everything = settings.link_everything;
        let start = Instant::now();
        let bvh = Bvh::of(&scene);
        let literals = if everything { None } else { Literals::of(&scene, &bvh) };
        let without = literals.as_ref().is_some_and(|literals| literals.suit_packets);
        let wide = (subgroups && !without).then(|| WideBvh::of(&bvh));
        let bvh_time = start.elapsed();
        let lights = Lights::of(&scene);
        Self {
            near_lights: everything || lights.any_near(&bvh),
            lights,
            features: Self::features(&scene, settings),
            literals,
            wide,
            everything,
            subgroups,
            bvh_time,
            bvh,
            scene,
        }
    }

    /// What is linked for a scene.
    pub fn features(scene: &Scene, settings: &Settings) -> Features {
        let own = Features::of(scene);
        let everything = || Features {
            // A scene without an environment has an even one that is black.
            sky: if own.sky.shines() { own.sky } else { Sky::Constant },
            ..Features::everything()
        };
        if settings.link_everything { everything() } else { own }
    }

    /// What programs are linked for.
    pub fn target(&self) -> Target {
        let tracing = self.literals.as_ref().map(|literals| literals.suit_packets);
        Target {
            subgroups: self.subgroups,
            features: self.features,
            literals: tracing.is_some(),
            literal_packets: tracing == Some(true),
        }
    }

    /// What programs are linked for in a frame: one without light shows the first surfaces, and
    /// needs nothing of how they reflect.
    pub fn target_of(&self, settings: &Settings) -> Target {
        let lit = settings.method.is_lit();
        let plain = Features { phong: false, mirror: false, glass: false, ..self.features };
        let features = if lit { self.features } else { plain };
        Target { features, ..self.target() }
    }

    /// The kinds of lights that programs are linked for.
    pub fn kinds(&self) -> impl Iterator<Item = LightKind> + '_ {
        let is = |kind: &LightKind| self.everything || self.lights.count(*kind) > 0;
        LightKind::ALL.into_iter().filter(is)
    }

    /// The kinds of lights that have a table on the device.
    pub fn kinds_with_tables(&self) -> impl Iterator<Item = LightKind> + '_ {
        let is = |kind: &LightKind| match kind {
            LightKind::Environment => self.features.sky.shines(),
            _ => self.lights.count(*kind) > 0,
        };
        LightKind::ALL.into_iter().filter(is)
    }

    /// A program with what is written for the scene.
    pub fn complete(&self, program: Program) -> Program {
        match &self.literals {
            Some(literals) => literals.complete(program),
            None => program,
        }
    }

    /// How shadow rays between points and VPLs are traced.
    pub fn tracing(&self) -> Tracing {
        Tracing::of(self.target(), self.bvh.nodes.len())
    }

    /// The tables that the device holds of the scene, and their sizes in bytes.
    pub fn tables(&self) -> Vec<(&'static str, u64)> {
        memory::tables(&self.scene, &self.bvh, self.wide.as_ref(), &self.lights, self.features)
    }
}
