//! Clusters of VPLs: each becomes one light that stands for its members.

use std::collections::{BTreeMap, HashMap};

use glam::{DVec3, Vec3};

use crate::cluster::{Options, Points, kmeans};
use crate::render::settings::{Clustering, Merge, Representative};
use crate::render::virtual_light::{GlossyLobe, VirtualLight};

/// Clusters of lights by position, where their normals agree. Glossy lights merge only with those
/// of their own material that mirror light the same way.
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
        let mut clusters = Self { lights: Vec::new(), of_lights: vec![0; lights.len()] };
        // Lights that share visibility alone remain what they are.
        let merges = clustering.merge == Merge::Light;
        let mut classes: BTreeMap<Option<u32>, Vec<u32>> = BTreeMap::new();
        for (index, light) in (0..).zip(lights) {
            let material = light.gloss.filter(|_| merges).map(|gloss| gloss.material);
            classes.entry(material).or_default().push(index);
        }
        for members in classes.values() {
            let share = u64::from(clustering.vpls) * members.len() as u64;
            let count = share.div_ceil(lights.len() as u64) as u32;
            clusters.add(lights, members, count, clustering, seed);
        }
        clusters
    }

    /// Clusters some of the lights.
    fn add(
        &mut self,
        lights: &[VirtualLight],
        members: &[u32],
        count: u32,
        clustering: &Clustering,
        seed: u32,
    ) {
        let own: Vec<VirtualLight> = members.iter().map(|&index| lights[index as usize]).collect();
        let positions: Vec<Vec3> = own.iter().map(|light| light.position).collect();
        let normals: Vec<Vec3> = own.iter().map(|light| light.normal).collect();
        let found = kmeans(
            &Points { positions: &positions, normals: &normals },
            &Options {
                clusters: count,
                iterations: clustering.vpl_iterations,
                normal_threshold: clustering.normal_threshold,
                stride: 1,
                seed,
            },
        );
        let representatives = found.clusters.iter().map(|c| c.representative).collect();
        let parts = match clustering.merge {
            Merge::Light => SplitClusters::of(&own, &found.assignment, representatives, clustering),
            Merge::Visibility => SplitClusters { of_lights: found.assignment, representatives },
        };
        let mut sums = vec![Sum::default(); parts.representatives.len()];
        for (light, &part) in own.iter().zip(&parts.of_lights) {
            sums[part as usize].add(light);
        }
        let first = self.lights.len() as u32;
        for (&index, &part) in members.iter().zip(&parts.of_lights) {
            self.of_lights[index as usize] = first + part;
        }
        self.lights.extend(
            parts
                .representatives
                .iter()
                .zip(&sums)
                .map(|(&member, sum)| sum.merged(&own[member as usize], clustering.representative)),
        );
        if clustering.representative == Representative::Mean {
            lift(&mut self.lights[first as usize..], &own, &parts.of_lights);
        }
    }
}

/// Lifts means to the surface: the mean of a cluster on a convex one is under it, and all its
/// shadow rays would be blocked. A convex surface is under the tangent plane of each member, so that
/// the mean rises along its normal up to the first of these that it meets: not at all where all
/// members are in a plane, or the surface is hollow.
fn lift(means: &mut [VirtualLight], members: &[VirtualLight], of_members: &[u32]) {
    let mut heights = vec![f32::INFINITY; means.len()];
    for (member, &of) in members.iter().zip(of_members) {
        let mean = &means[of as usize];
        let cosine = member.normal.dot(mean.normal);
        if cosine > 0.0 {
            let height = member.normal.dot(member.position - mean.position) / cosine;
            heights[of as usize] = heights[of as usize].min(height);
        }
    }
    for (mean, height) in means.iter_mut().zip(heights) {
        if height.is_finite() {
            mean.position += height.max(0.0) * mean.normal;
        }
    }
}

/// Clusters of which those that mirror light in different ways are split.
struct SplitClusters {
    of_lights: Vec<u32>,
    representatives: Vec<u32>,
}

impl SplitClusters {
    /// A member that the first of a cluster does not accept founds a part of its own, in the order
    /// of the lights.
    fn of(
        lights: &[VirtualLight],
        clusters: &[u32],
        representatives: Vec<u32>,
        clustering: &Clustering,
    ) -> Self {
        let mut parts = Self { of_lights: clusters.to_vec(), representatives };
        let mirrored = |light: u32| lights[light as usize].gloss.map(|gloss| gloss.mirrored);
        let mut founded: HashMap<u32, Vec<u32>> = HashMap::new();
        for (light, &cluster) in (0..).zip(clusters) {
            let Some(way) = mirrored(light) else { continue };
            let accepts = |part: u32, parts: &Self| {
                let other = mirrored(parts.representatives[part as usize]);
                other.is_some_and(|other| way.dot(other) > clustering.normal_threshold)
            };
            let others = founded.entry(cluster).or_default();
            let candidates = std::iter::once(cluster).chain(others.iter().copied());
            let part = match candidates.into_iter().find(|&part| accepts(part, &parts)) {
                Some(part) => part,
                None if parts.representatives[cluster as usize] == light => cluster,
                None => {
                    let part = parts.representatives.len() as u32;
                    parts.representatives.push(light);
                    others.push(part);
                    part
                }
            };
            parts.of_lights[light as usize] = part;
        }
        parts
    }
}

/// What the members of a cluster come to.
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    count: f64,
    position: DVec3,
    normal: DVec3,
    intensity: DVec3,
    specular: DVec3,
    mirrored: DVec3,
}

impl Sum {
    fn add(&mut self, light: &VirtualLight) {
        self.count += 1.0;
        self.position += light.position.as_dvec3();
        self.normal += light.normal.as_dvec3();
        self.intensity += light.intensity.as_dvec3();
        if let Some(gloss) = light.gloss {
            self.specular += gloss.specular.as_dvec3();
            self.mirrored += gloss.mirrored.as_dvec3();
        }
    }

    /// The light that stands for the members, of which `member` is the representative.
    fn merged(&self, member: &VirtualLight, representative: Representative) -> VirtualLight {
        let mean = |sum: DVec3, member: Vec3| match representative {
            // The mean of unit vectors that oppose each other has no direction.
            Representative::Mean => sum.as_vec3().try_normalize().unwrap_or(member),
            Representative::Member | Representative::Drawn => member,
        };
        let gloss = |gloss: GlossyLobe| GlossyLobe {
            specular: self.specular.as_vec3(),
            mirrored: mean(self.mirrored, gloss.mirrored),
            ..gloss
        };
        VirtualLight {
            position: match representative {
                Representative::Mean => (self.position / self.count).as_vec3(),
                Representative::Member | Representative::Drawn => member.position,
            },
            normal: mean(self.normal, member.normal),
            intensity: self.intensity.as_vec3(),
            gloss: member.gloss.map(gloss),
        }
    }
}
