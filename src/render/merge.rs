//! Clusters of VPLs: each becomes one light that stands for its members.

use std::f32::consts::PI;

use glam::{DVec3, Vec3};

use super::settings::{Clustering, Representative};
use super::vpl::Vpl;
use crate::cluster::{Options, Points, kmeans};

/// A diffuse light of a point and a side: what is gathered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VirtualLight {
    /// Where it is.
    pub position: Vec3,
    /// Unit normal of the side that it lights.
    pub normal: Vec3,
    /// Intensity along the normal, per channel: exitant flux over π.
    pub intensity: Vec3,
}

impl VirtualLight {
    /// The light that a VPL's surface reflects.
    pub fn of(vpl: &Vpl) -> Self {
        let intensity = vpl.flux * vpl.albedo / PI;
        Self { position: vpl.position, normal: vpl.normal, intensity }
    }
}

/// Clusters of lights by position, where their normals agree.
#[derive(Debug, Clone)]
pub struct VplClusters {
    /// A light for each cluster. Its exitant flux is the sum over the members, channel by
    /// channel, so that members of different albedo keep their colour.
    pub lights: Vec<VirtualLight>,
    /// The cluster of each light.
    pub of_lights: Vec<u32>,
}

impl VplClusters {
    /// Clusters lights. Sums are in f64 and in the order of the lights.
    pub fn of(lights: &[VirtualLight], clustering: &Clustering, seed: u32) -> Self {
        let positions: Vec<Vec3> = lights.iter().map(|light| light.position).collect();
        let normals: Vec<Vec3> = lights.iter().map(|light| light.normal).collect();
        let found = kmeans(
            &Points { positions: &positions, normals: &normals },
            &Options {
                clusters: clustering.vpls,
                iterations: clustering.vpl_iterations,
                normal_threshold: clustering.normal_threshold,
                stride: 1,
                seed,
            },
        );
        let mut intensities = vec![DVec3::ZERO; found.clusters.len()];
        for (light, &cluster) in lights.iter().zip(&found.assignment) {
            intensities[cluster as usize] += light.intensity.as_dvec3();
        }
        let merged = found.clusters.iter().zip(intensities).map(|(cluster, intensity)| {
            let member = &lights[cluster.representative as usize];
            let (position, normal) = match clustering.representative {
                Representative::Mean => (cluster.position, cluster.normal),
                Representative::Member => (member.position, member.normal),
            };
            VirtualLight { position, normal, intensity: intensity.as_vec3() }
        });
        Self { lights: merged.collect(), of_lights: found.assignment }
    }
}
