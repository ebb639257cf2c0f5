//! The VPLs of a frame: traced, bounded, and clustered where the method does so.

use std::time::Instant;

use super::bound::GeometryBound;
use super::candidates::{candidates, keep};
use super::sights::sights;
use super::trace::{LightPaths, Vpl, truncated_fraction};
use crate::render::clusters::VplClusters;
use crate::render::plan::Plan;
use crate::render::result::{Counts, Tally};
use crate::render::settings::{Merge, Settings};
use crate::render::virtual_light::VirtualLight;
use crate::scene::Camera;

/// Rays of the camera that tell what is seen.
const SIGHTS: u32 = 1 << 16;

/// The VPLs of a frame.
#[derive(Debug)]
pub struct VplSet {
    /// What light paths have left.
    pub vpls: Vec<Vpl>,
    /// The bound on the geometry term in normalised units; none when it is off or there are no VPLs.
    pub bound: Option<GeometryBound>,
    /// The lights that stand for them: one each, or one for each cluster that merges its members.
    pub lights: Vec<VirtualLight>,
    /// Clusters whose visibility the lights share, if they do.
    pub clusters: Option<VplClusters>,
}

impl VplSet {
    /// Traces the light paths that the settings ask for, and clusters what they leave.
    pub fn trace(
        plan: &Plan,
        camera: &Camera,
        settings: &Settings,
        seed: u32,
        tally: &mut Tally,
    ) -> Self {
        let Tally { phases, counts } = tally;
        let start = Instant::now();
        let vpls = match settings.chooses_vpls() {
            true => chosen(plan, camera, settings, seed, counts),
            false => all(plan, settings, seed, counts),
        };
        counts.vpls = vpls.len() as u64;
        let bound = GeometryBound::of(&plan.scene, settings, &vpls);
        let scale = plan.scene.units.scale;
        counts.clamp = bound.as_ref().map(|bound| f64::from(bound.median(&vpls)) / (scale * scale));
        let lights: Vec<_> = vpls.iter().map(|vpl| vpl.light(&plan.scene)).collect();
        phases.vpls = start.elapsed();
        if !settings.method.clusters_vpls() {
            return Self { vpls, bound, lights, clusters: None };
        }
        let start = Instant::now();
        let clusters = VplClusters::of(&lights, &settings.clustering, seed);
        counts.vpl_clusters = Some(clusters.lights.len() as u64);
        phases.cluster_vpls = start.elapsed();
        match settings.clustering.merge {
            Merge::Visibility if settings.method.is_indirect() => {
                Self { vpls, bound, lights, clusters: Some(clusters) }
            }
            _ => Self { vpls, bound, lights: clusters.lights, clusters: None },
        }
    }

    /// The lights that visible points gather: none where VPLs are shown alone.
    pub fn gathered(&self, settings: &Settings) -> &[VirtualLight] {
        if settings.method.is_indirect() { &self.lights } else { &[] }
    }

    /// So many of the lights, evenly spaced in their order, for every point to trace a ray to.
    pub fn probes(&self, settings: &Settings) -> Vec<VirtualLight> {
        let count = if settings.probes() { settings.clustering.probes as usize } else { 0 };
        let count = count.min(self.lights.len());
        (0..count).map(|i| self.lights[i * self.lights.len() / count]).collect()
    }
}

/// All that light paths leave.
fn all(plan: &Plan, settings: &Settings, seed: u32, counts: &mut Counts) -> Vec<Vpl> {
    let vpls = light_paths(plan, settings, seed);
    counts.light_paths =
        if settings.method.traces_paths() { settings.light_paths.into() } else { 0 };
    counts.truncated_fraction = truncated_fraction(&vpls, settings.bounces, &plan.scene);
    vpls
}

/// Of what light paths leave that which the image needs.
fn chosen(
    plan: &Plan,
    camera: &Camera,
    settings: &Settings,
    seed: u32,
    counts: &mut Counts,
) -> Vec<Vpl> {
    let sights = sights(plan, camera, SIGHTS, seed);
    let (candidates, paths) = candidates(plan, settings, seed, &sights);
    counts.light_paths = paths.into();
    counts.truncated_fraction = truncated_fraction(&candidates, settings.bounces, &plan.scene);
    counts.vpl_candidates = Some(candidates.len() as u64);
    let kept = keep(plan, settings, seed, &sights, &candidates);
    counts.effective_vpls = Some(kept.effective);
    kept.vpls
}

/// The VPLs that so many light paths leave as the settings ask for, all of them.
pub fn light_paths(plan: &Plan, settings: &Settings, seed: u32) -> Vec<Vpl> {
    match settings.method.traces_paths() {
        true => LightPaths::of(plan, settings, seed).trace(),
        false => Vec::new(),
    }
}
