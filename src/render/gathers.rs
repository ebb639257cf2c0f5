//! What the tiles of a frame have in common: clusters of its visible points, and what gathers
//! its lights with them.

use std::time::Instant;

use bytemuck::Zeroable;

use super::film::Tiling;
use super::gather::Gather;
use super::interleave::Interleave;
use super::kernels::Emitter;
use super::light_set::LightSet;
use super::merge::VirtualLight;
use super::tile::TileRenderer;
use super::visibility::Probes;
use super::visible::PointClusters;
use super::{Counts, Direct, Phases, Progress};
use crate::gpu::{GpuError, PointRecord};
use crate::sampling::hash;

/// What gathers the light of a frame from sets of lights.
#[derive(Debug)]
pub struct Gathers<'a> {
    /// VPLs.
    pub indirect: Option<Gather<'a>>,
    /// Light sources, where clusters share their visibility.
    pub direct: Vec<Gather<'a>>,
}

impl Gathers<'_> {
    /// Traces the rows of the clusters, if there are any.
    ///
    /// # Errors
    /// The device fails.
    pub fn trace_clusters(
        &self,
        phases: &mut Phases,
        counts: &mut Counts,
        progress: Progress<'_>,
    ) -> Result<(), GpuError> {
        for direct in &self.direct {
            let mut own = Phases::default();
            direct.trace_clusters(&mut own, &|share| progress(share, "direct light"))?;
            phases.direct += own.render();
        }
        if let Some(indirect) = &self.indirect {
            let show = |share| progress(0.5 * share, "visibility");
            counts.shadow_rays += indirect.trace_clusters(phases, &show)?;
        }
        Ok(())
    }
}

/// The visible points of a whole frame in the order of samples and tiles, and their clusters.
#[derive(Debug)]
pub struct Clustered {
    /// How the image makes tiles.
    pub tiling: Tiling,
    /// What the camera rays have hit.
    pub records: Vec<PointRecord>,
    /// What else is known of them, in the order of `stages::Buffers::kept`.
    pub kept: Vec<Vec<[f32; 4]>>,
    /// Which of the probes they see, a bit each.
    pub signatures: Option<Vec<u32>>,
    /// Who is in which cluster.
    pub clusters: PointClusters,
}

impl Clustered {
    /// How many clusters there are.
    pub fn count(&self) -> u64 {
        self.clusters.representatives.len() as u64
    }
}

impl<'a> TileRenderer<'a> {
    /// Finds all visible points and clusters them. `probes` are lights to each of which every
    /// point traces a shadow ray. `None` if nothing is seen.
    ///
    /// # Errors
    /// The device fails.
    pub fn cluster(
        &self,
        probes: &[VirtualLight],
        phases: &mut Phases,
        counts: &mut Counts,
        progress: Progress<'_>,
    ) -> Result<Option<Clustered>, GpuError> {
        let gpu = &self.prepared.gpu;
        let buffers = &self.stages.buffers;
        let asked = match LightSet::new(self.prepared, probes, None, None, 1)? {
            Some(lights) => {
                let (named, points) = (buffers.named(self.prepared), self.tiling.most_points());
                Some(Probes::new(self.prepared, &lights, &named, points)?)
            }
            None => None,
        };
        let mut records = vec![PointRecord::zeroed(); self.tiling.all_points()];
        let mut kept = vec![vec![[0.0; 4]; records.len()]; buffers.kept.len()];
        let mut signatures = asked.as_ref().map(|_| vec![0; records.len()]);
        progress(0.0, "visible points");
        for tile in self.tiling.tiles() {
            phases.visible_points +=
                self.run(&self.stages.visible, &self.camera_params(tile), [tile.blocks, 1])?;
            let start = Instant::now();
            let read: Vec<PointRecord> = gpu.read(&buffers.points, tile.points() as usize)?;
            records[tile.of_frame()].copy_from_slice(&read);
            for ((_, buffer), kept) in buffers.kept.iter().zip(&mut kept) {
                let read: Vec<[f32; 4]> = gpu.read(buffer, tile.points() as usize)?;
                kept[tile.of_frame()].copy_from_slice(&read);
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
        let (clustering, seen) = (&self.settings.clustering, signatures.as_deref());
        let clusters = PointClusters::of(&records, seen, clustering, self.seed);
        phases.cluster_points += start.elapsed();
        let tiling = self.tiling;
        Ok(clusters.map(|clusters| Clustered { tiling, records, kept, signatures, clusters }))
    }

    /// What gathers direct light with clusters that have been found, if the settings ask for
    /// it.
    ///
    /// # Errors
    /// The device fails.
    pub fn gather_direct(&self, clustered: &Clustered) -> Result<Vec<Gather<'a>>, GpuError> {
        if self.settings.direct != Direct::Clustered || !self.settings.method.is_lit() {
            return Ok(Vec::new());
        }
        let lights = &self.prepared.lights;
        let places = lights.places(
            &self.prepared.scene,
            self.settings.shared_light_samples(),
            hash(self.seed),
        );
        let kinds = [(Emitter::Point, lights.points()), (Emitter::Surface, places)];
        let mut gathers = Vec::new();
        for (emitter, lights) in kinds {
            if let Some(lights) = LightSet::direct(self.prepared, emitter, &lights)? {
                let named = self.stages.buffers.named(self.prepared);
                let (clusters, points) = (Some(&clustered.clusters), self.tiling.most_points());
                gathers.push(Gather::new(self.prepared, lights, clusters, &named, points)?);
            }
        }
        Ok(gathers)
    }

    /// What gathers the VPLs: from each point by itself, or with clusters that have been
    /// found.
    ///
    /// # Errors
    /// The device fails.
    pub fn gather(
        &self,
        indirect: LightSet,
        clustered: Option<&Clustered>,
    ) -> Result<Gather<'a>, GpuError> {
        let mut named = Vec::new();
        // The first buffer of a name counts.
        named.extend(self.interleave.iter().flat_map(Interleave::named));
        named.extend(self.stages.buffers.named(self.prepared));
        let points = match &self.interleave {
            Some(interleave) => interleave.most_points(&self.tiling),
            None => self.tiling.most_points(),
        };
        let clusters = clustered.map(|clustered| &clustered.clusters);
        Gather::new(self.prepared, indirect, clusters, &named, points)
    }
}
