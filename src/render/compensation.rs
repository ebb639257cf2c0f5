//! Bias compensation: gives back the light that the bound on the geometry term removes, by paths
//! from the visible points. Kollig and Keller, "Illumination in the Presence of Weak
//! Singularities", 2004.
//!
//! With the bound b, virtual point lights (VPLs) give the share min(G, b) / G of the light that
//! goes from one surface to another. A segment from a visible point, in a direction drawn as the
//! surface scatters, brings back the rest: max(0, G - b) / G of the light that its other end
//! reflects. That light is, as at any visible point, direct light, what VPLs give under the bound,
//! and, recursively, what the bound removes there. Nearly all segments end at once, as only short
//! ones have G > b.
//!
//! Bounces are counted: the vertex after k segments has direct light if k is at most B, and light
//! of VPLs that light has reached in at most B - k bounces.
//!
//! What paths from the camera do not find is not given back: light of lights without extent that
//! mirrors or glass turn onto a surface, of which VPLs have the bounded share.

use std::ops::Range;
use std::time::{Duration, Instant};

use super::camera::{FrameSetup, Tile};
use super::clusters::PointClusters;
use super::filter::LightFilter;
use super::gather::Sights;
use super::kernels::Filtered;
use super::kernels::compensation as programs;
use super::path::stages::next_event;
use super::path::vertices::{Queue, Vertices};
use super::path::{finding_light, finds_light, path_params};
use super::prepared::Prepared;
use super::settings::Bounces;
use super::stage::{Named, Stage};
use super::visibility;
use super::vpls::{GeometryBound, Vpl, VplSet};
use crate::gpu::{ArrivalRecord, CompensatedParams, GpuError, PathParams, StartParams};
use crate::sampling::hash;

/// Paths of a pixel, over all its samples, where pixels do not combine what is given back.
const PATHS: u32 = 32;
/// Where they do, which takes the noise off, at least and at most so many: as many as are traced at
/// once, since small images have fewer pixels that see the same.
const COMBINED_PATHS: [usize; 2] = [2, 8];
/// Paths that are traced at once, at most, but one of each visible point: many, so that the stages
/// themselves cost little in small images, where paths may be long.
const AT_ONCE: usize = 1 << 19;
/// Keeps the random numbers apart from those of other stages.
const STREAM: u32 = 0x636f_6d70;

/// Gives back, tile by tile, what the bound on the geometry term removes.
#[derive(Debug)]
pub struct Compensation<'a> {
    bound: f32,
    bounces: Bounces,
    /// Paths of each visible point, and how many of them are traced at once.
    paths: u32,
    at_once: u32,
    seed: u32,
    /// How many VPLs light has reached in at most so many bounces.
    vpls_within: Vec<u32>,
    vertices: Vertices,
    queue: Queue,
    start: Stage,
    lights: Vec<(Stage, u32)>,
    vpls: Stage,
    segment: Stage,
    /// Adds up what was given back.
    sum: Stage,
    /// The cluster of each visible point, and how many there are in fours, where they share what
    /// they see.
    clusters: Option<(wgpu::Buffer, u32)>,
    /// Where that is combined over pixels.
    filter: Option<LightFilter<'a>>,
}

impl<'a> Compensation<'a> {
    /// For tiles of at most so many visible points, whose light of `vpls` has this bound. The buffers
    /// are of the points, and of the irradiance that is added to.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        setup: &FrameSetup<'a>,
        vpls: &VplSet,
        bound: &GeometryBound,
        sights: Option<Sights<'_>>,
        [visible, output]: [&wgpu::Buffer; 2],
        tile: &[Named<'_>],
    ) -> Result<Self, GpuError> {
        let FrameSetup { prepared, settings, seed, .. } = *setup;
        let (gpu, points) = (&prepared.gpu, setup.most_points());
        let filters = settings.filters_compensation();
        let paths = match filters {
            true => (AT_ONCE / points).clamp(COMBINED_PATHS[0], COMBINED_PATHS[1]) as u32,
            false => PATHS,
        };
        let paths = paths.div_ceil(settings.samples);
        // The difference of two halves is what the filter takes the noise for.
        let paths = if filters { paths.next_multiple_of(2) } else { paths };
        let at_once = (AT_ONCE / points).clamp(1, paths as usize);
        let slots = points * at_once;
        let vertices = Vertices::new(prepared, slots)?;
        let (order, vpls_within) = by_bounces(&vpls.vpls);
        let by_bounce: Vec<_> =
            order.iter().map(|&at| vpls.vpls[at as usize].light(&prepared.scene)).collect();
        let table = visibility::table(prepared, &by_bounce, Some(bound))?;
        let arrivals = match prepared.features.phong {
            true => Some(gpu.storage::<ArrivalRecord>("arrivals", slots)?),
            false => None,
        };
        let mut named = vertices.named(prepared);
        named.extend(arrivals.iter().map(|buffer| ("arrivals", buffer)));
        let of = Filtered::Compensation;
        let filter =
            filters.then(|| LightFilter::new(setup, of, paths, output, tile)).transpose()?;
        named.extend([("compensated", output), ("visible", visible)]);
        let target = prepared.target();
        let areas = prepared.lights.have_surfaces();
        let cells = bound.upload(gpu)?;
        let clusters = sights
            .map(|sights| Ok((gpu.storage::<u32>("clusters of points", points)?, sights.quads)))
            .transpose()?;
        let bind = |program| Stage::new(prepared, &program, &named);
        Ok(Self {
            bound: bound.least(),
            bounces: settings.bounces,
            paths,
            at_once: at_once as u32,
            seed: hash(seed ^ STREAM),
            vpls_within,
            queue: Queue::new(prepared, &named, slots)?,
            start: bind(programs::start())?,
            lights: next_event(prepared, &named, &|kind| programs::next_event(target, kind))?,
            vpls: match (sights, &vpls.clusters, &clusters) {
                (Some(sights), Some(of), Some((points, _))) => {
                    let column = |&at: &u32| sights.of_clusters[of.of_lights[at as usize] as usize];
                    let columns: Vec<u32> = order.iter().map(column).collect();
                    let columns = gpu.texture_of("column_of", &columns)?;
                    Stage::with_textures(
                        prepared,
                        &programs::vpls(target, true),
                        &[&[("cluster_of", points)], &named[..]].concat(),
                        &[
                            ("vpl_table", &table),
                            ("column_bits", sights.table),
                            ("column_of", &columns),
                        ],
                    )?
                }
                _ => Stage::with_textures(
                    prepared,
                    &programs::vpls(target, false),
                    &named,
                    &[("vpl_table", &table)],
                )?,
            },
            segment: Stage::with_textures(
                prepared,
                &programs::segment(target, settings.bounces, areas),
                &named,
                &[("bound_cells", &cells)],
            )?,
            sum: bind(programs::compensated(target))?,
            vertices,
            clusters,
            filter,
        })
    }

    /// Tells which clusters the points of a tile are in, a range of the frame's.
    ///
    /// # Errors
    /// The device fails.
    pub fn set_clusters(
        &self,
        prepared: &Prepared,
        clusters: &PointClusters,
        points: Range<usize>,
    ) -> Result<(), GpuError> {
        match &self.clusters {
            Some((buffer, _)) => prepared.gpu.write(buffer, &clusters.nearest(points)),
            None => Ok(()),
        }
    }

    /// Adds to what the visible points of a tile gather what the bound removes of it.
    ///
    /// # Errors
    /// The device fails.
    pub fn add(&self, prepared: &Prepared, tile: Tile) -> Result<Duration, GpuError> {
        let start = Instant::now();
        if let Some(filter) = &self.filter {
            filter.count(tile)?;
        }
        for lobe in 0..prepared.target().lobes() as u32 {
            for first in (0..self.paths).step_by(self.at_once as usize) {
                let paths = self.at_once.min(self.paths - first);
                self.trace(prepared, tile, tile.sample * self.paths + first, paths, lobe)?;
                let (points, share) = (tile.points(), 1.0 / self.paths as f32);
                let halves = if self.filter.is_some() { 1.0 } else { 0.0 };
                let params =
                    CompensatedParams { points, share, lobe, paths, first, halves, pad: [0; 2] };
                self.sum.run(prepared, &params, [tile.blocks, 1])?;
            }
        }
        if let Some(filter) = &self.filter {
            filter.combine(tile)?;
        }
        Ok(start.elapsed())
    }

    /// Some paths from each visible point to their ends, the first of them `number` in its pixel's
    /// sequence, by a lobe.
    fn trace(
        &self,
        prepared: &Prepared,
        tile: Tile,
        number: u32,
        paths: u32,
        lobe: u32,
    ) -> Result<(), GpuError> {
        prepared.gpu.clear(&[&self.vertices.radiance])?;
        let (points, seed) = (tile.points(), self.seed);
        let start = StartParams { points, first_block: tile.first_block, seed, paths };
        self.start.run(prepared, &start, [tile.blocks * paths, 1])?;
        let mut params = PathParams {
            paths: points * paths,
            first_sample: number,
            samples: paths,
            bound: self.bound,
            lobe,
            quads: self.clusters.as_ref().map_or(0, |(_, quads)| *quads),
            ..path_params(prepared)
        };
        params.paths = self.queue.survivors(prepared, &params)?;
        while params.paths > 0 {
            let groups = [params.paths.div_ceil(64), 1];
            if params.bounce > 0 {
                params = finding_light(prepared, params);
                self.gather(prepared, &params)?;
            }
            let last = self.bounces == Bounces::Finite(params.bounce);
            if last && !finds_light(&params) {
                break;
            }
            self.segment.run(prepared, &params, groups)?;
            if last {
                break;
            }
            params.paths = self.queue.survivors(prepared, &params)?;
            params.bounce += 1;
        }
        Ok(())
    }

    /// Light at the vertices of the queue: straight from its source, and of VPLs.
    fn gather(&self, prepared: &Prepared, params: &PathParams) -> Result<(), GpuError> {
        let groups = [params.paths.div_ceil(64), 1];
        for (stage, lights) in &self.lights {
            let params = PathParams { lights: *lights, ..*params };
            stage.run(prepared, &params, groups)?;
        }
        let most = match self.bounces {
            Bounces::Finite(most) => most.saturating_sub(params.bounce) as usize,
            Bounces::Unlimited => usize::MAX,
        };
        let most = most.min(self.vpls_within.len() - 1);
        let lights = self.vpls_within[most];
        if lights > 0 {
            self.vpls.run(prepared, &PathParams { lights, ..*params }, groups)?;
        }
        Ok(())
    }
}

/// VPLs in the order of their bounces, and how many there are of at most 0, 1, 2, … bounces.
fn by_bounces(vpls: &[Vpl]) -> (Vec<u32>, Vec<u32>) {
    let most = vpls.iter().map(|vpl| vpl.bounce).max().unwrap_or(0);
    let mut within = vec![0; most as usize + 1];
    for vpl in vpls {
        within[vpl.bounce as usize] += 1;
    }
    let mut sum = 0;
    for count in &mut within {
        sum += *count;
        *count = sum;
    }
    let mut order: Vec<u32> = (0..vpls.len() as u32).collect();
    order.sort_by_key(|&at| vpls[at as usize].bounce);
    (order, within)
}
