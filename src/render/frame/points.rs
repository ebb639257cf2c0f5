//! The visible points of a whole frame on the host, and their clusters.

use std::time::Instant;

use bytemuck::Zeroable;

use crate::gpu::{GpuError, PointRecord};
use crate::render::camera::{CameraRays, FrameSetup, Tile, TileBuffers, Tiling};
use crate::render::clusters::PointClusters;
use crate::render::prepared::Prepared;
use crate::render::result::{Progress, Tally};
use crate::render::virtual_light::VirtualLight;
use crate::render::visibility::{LightSet, Probes};

/// The visible points of a whole frame in the order of samples and tiles, and their clusters.
#[derive(Debug)]
pub struct ClusteredPoints {
    /// How the image makes tiles.
    pub tiling: Tiling,
    /// What the camera rays have hit.
    pub records: Vec<PointRecord>,
    /// What else is known of them, in the order of [`TileBuffers::attributes`].
    attributes: Vec<Vec<[f32; 4]>>,
    /// Which of the probes they see, a bit each.
    pub signatures: Option<Vec<u32>>,
    /// Who is in which cluster.
    pub clusters: PointClusters,
}

impl ClusteredPoints {
    /// Finds all visible points and clusters them. `probes` are lights to each of which every
    /// point traces a shadow ray. `None` if nothing is seen.
    ///
    /// # Errors
    /// The device fails.
    pub fn find(
        setup: &FrameSetup<'_>,
        rays: &CameraRays<'_>,
        buffers: &TileBuffers,
        probes: &[VirtualLight],
        tally: &mut Tally,
        progress: Progress<'_>,
    ) -> Result<Option<Self>, GpuError> {
        let FrameSetup { prepared, settings, seed, tiling, .. } = *setup;
        let Tally { phases, counts } = tally;
        let gpu = &prepared.gpu;
        let asked = match LightSet::new(prepared, probes, None, None, 1)? {
            Some(lights) => {
                let (named, points) = (buffers.named(prepared), tiling.most_points());
                Some(Probes::new(prepared, &lights, &named, points)?)
            }
            None => None,
        };
        let mut records = vec![PointRecord::zeroed(); tiling.all_points()];
        let mut attributes = vec![vec![[0.0; 4]; records.len()]; buffers.attributes.len()];
        let mut signatures = asked.as_ref().map(|_| vec![0; records.len()]);
        progress(0.0, "visible points");
        for tile in tiling.tiles() {
            phases.visible_points += rays.find_points(tile)?;
            let start = Instant::now();
            let read: Vec<PointRecord> = gpu.read(&buffers.points, tile.points() as usize)?;
            records[tile.of_frame()].copy_from_slice(&read);
            for ((_, buffer), values) in buffers.attributes.iter().zip(&mut attributes) {
                let read: Vec<[f32; 4]> = gpu.read(buffer, tile.points() as usize)?;
                values[tile.of_frame()].copy_from_slice(&read);
            }
            phases.readback += start.elapsed();
            if let (Some(probes), Some(signatures)) = (&asked, &mut signatures) {
                let (bits, rays) = probes.seen(tile.points(), phases)?;
                signatures[tile.of_frame()].copy_from_slice(&bits);
                counts.shadow_rays += rays;
            }
        }
        progress(0.0, "clusters");
        let start = Instant::now();
        let seen = signatures.as_deref();
        let clusters = PointClusters::of(&records, seen, &settings.clustering, seed);
        phases.cluster_points += start.elapsed();
        Ok(clusters.map(|clusters| Self { tiling, records, attributes, signatures, clusters }))
    }

    /// Writes the points of a tile back to its buffers.
    ///
    /// # Errors
    /// The device fails.
    pub fn load(
        &self,
        prepared: &Prepared,
        buffers: &TileBuffers,
        tile: Tile,
    ) -> Result<(), GpuError> {
        let points = tile.of_frame();
        prepared.gpu.write(&buffers.points, &self.records[points.clone()])?;
        for ((_, buffer), values) in buffers.attributes.iter().zip(&self.attributes) {
            prepared.gpu.write(buffer, &values[points.clone()])?;
        }
        Ok(())
    }

    /// How many of the points hit a surface.
    pub fn hits(&self) -> u64 {
        let hit = |record: &&PointRecord| record.surface != PointRecord::NOTHING;
        self.records.iter().filter(hit).count() as u64
    }

    /// How many clusters there are.
    pub fn count(&self) -> u64 {
        self.clusters.representatives.len() as u64
    }
}
