//! Indirect light: what the visible points of a tile gather of the VPLs, combined over pixels and
//! with what the bound took where the settings ask for that.

use std::ops::Range;

use super::camera::{FrameSetup, Tile, TileBuffers};
use super::clusters::PointClusters;
use super::compensation::Compensation;
use super::gather::{ClampedEnergy, Corrections, Gather, Interleave, Irradiance};
use super::prepared::Prepared;
use super::result::{Phases, Progress, Tally};
use super::settings::{Clamp, Settings};
use super::stage::Named;
use super::visibility::{Draws, LightSet, SharedColumns};
use super::vpls::{GeometryBound, VplSet};
use crate::gpu::GpuError;

/// Gathers the VPLs of a frame.
#[derive(Debug)]
pub struct IndirectLight<'a> {
    prepared: &'a Prepared,
    gather: Gather<'a>,
    /// Where pixels gather subsets of the VPLs.
    interleave: Option<Interleave>,
    /// Where the geometry term is bounded.
    clamped: Option<ClampedEnergy>,
    compensation: Option<Compensation<'a>>,
    /// What bias compensation adds, where pixels combine it; else it goes into the irradiance.
    compensated: Option<wgpu::Buffer>,
}

impl<'a> IndirectLight<'a> {
    /// Binds what the settings need: of each point by itself, or with clusters of points; none if
    /// there are no VPLs to gather.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        setup: &FrameSetup<'a>,
        vpls: &VplSet,
        tile: &TileBuffers,
        irradiance: &Irradiance,
        clusters: Option<&PointClusters>,
    ) -> Result<Option<Self>, GpuError> {
        let FrameSetup { prepared, settings, seed, tiling, .. } = *setup;
        let subsets = if settings.interleaves() { settings.interleave.pow(2) } else { 1 };
        let gathered = vpls.gathered(settings);
        let bound =
            settings.draws_members().then(|| draw_bound(prepared, settings, vpls)).flatten();
        let draws = bound.as_ref().map(|bound| Draws { seed, bound });
        let columns = vpls.clusters.as_ref().map(|clusters| SharedColumns { clusters, draws });
        let Some(lights) =
            LightSet::new(prepared, gathered, columns, vpls.bound.as_ref(), subsets)?
        else {
            return Ok(None);
        };
        let points = setup.most_points();
        let bound = vpls.bound.as_ref();
        let compensates = settings.compensates();

        let values = points * prepared.target().lobes();
        let compensated = (bound.is_some() && settings.filters_compensation())
            .then(|| prepared.gpu.storage::<[f32; 4]>("compensated irradiance", values))
            .transpose()?;
        let mut named = tile.named(prepared);
        named.push(irradiance.named());
        named.extend(compensated.as_ref().map(|buffer| ("compensated", buffer)));
        let interleave = settings
            .interleaves()
            .then(|| Interleave::new(prepared, &tiling, &named, &irradiance.buffer, settings))
            .transpose()?;
        let clamped = bound
            .map(|_| ClampedEnergy::new(prepared, &named, points, compensated.is_some()))
            .transpose()?;
        // The first buffer of a name counts.
        let subsets: Vec<Named<'_>> = interleave.iter().flat_map(Interleave::named).collect();
        let most = interleave.as_ref().map(|interleave| interleave.most_points(&tiling));
        let most = most.unwrap_or(tiling.most_points());
        let corrections =
            settings.corrects().then_some(Corrections { rays: settings.correct, seed });
        let gather = Gather::new(
            prepared,
            lights,
            clusters,
            &[&subsets[..], &named].concat(),
            most,
            corrections,
        )?;
        let compensation = match bound.filter(|_| compensates) {
            Some(bound) => {
                let output = compensated.as_ref().unwrap_or(&irradiance.buffer);
                let buffers = [&tile.points, output];
                let sights = gather.sights();
                Some(Compensation::new(setup, vpls, bound, sights, buffers, &named)?)
            }
            None => None,
        };
        Ok(Some(Self { prepared, gather, interleave, clamped, compensation, compensated }))
    }

    /// Traces the rows of the clusters, once a frame, if there are any.
    ///
    /// # Errors
    /// The device fails.
    pub fn trace_clusters(
        &self,
        tally: &mut Tally,
        progress: Progress<'_>,
    ) -> Result<(), GpuError> {
        let show = |share| progress(0.5 * share, "visibility");
        tally.counts.shadow_rays += self.gather.trace_clusters(&mut tally.phases, &show)?;
        Ok(())
    }

    /// Tells which clusters the points of a tile are in, a range of the frame's, and which of the
    /// probes those points see.
    ///
    /// # Errors
    /// The device fails.
    pub fn load(
        &self,
        tile: Tile,
        clusters: &PointClusters,
        points: Range<usize>,
        signatures: Option<&[u32]>,
    ) -> Result<(), GpuError> {
        if let (Some(interleave), Some(seen)) = (&self.interleave, signatures) {
            interleave.set_signatures(self.prepared, &seen[points.clone()])?;
        }
        if let Some(compensation) = &self.compensation {
            compensation.set_clusters(self.prepared, clusters, points.clone())?;
        }
        let subsets = self.interleave.as_ref().map(|interleave| interleave.subsets(tile));
        self.gather.set_clusters(clusters, points, subsets.as_ref())
    }

    /// Starts a tile anew.
    ///
    /// # Errors
    /// The device fails.
    pub fn clear_energy(&self) -> Result<(), GpuError> {
        self.clamped.as_ref().map_or(Ok(()), |clamped| clamped.clear(self.prepared))
    }

    /// Gathers the VPLs at the visible points of a tile.
    ///
    /// # Errors
    /// The device fails.
    pub fn gather(
        &self,
        tile: Tile,
        irradiance: &Irradiance,
        tally: &mut Tally,
        progress: Progress<'_>,
    ) -> Result<(), GpuError> {
        let prepared = self.prepared;
        let Tally { phases, counts } = tally;
        let show = |share| progress(share, "indirect light");
        match &self.interleave {
            Some(interleave) => {
                self.compensate(tile, phases, progress)?;
                phases.shading += interleave.split(prepared, tile)?;
                let points = interleave.subsets(tile).points();
                counts.shadow_rays += self.gather.gather(tile, points, phases, &show)?;
                phases.shading += interleave.join(prepared, tile)?;
            }
            None => {
                irradiance.clear(prepared)?;
                counts.shadow_rays += self.gather.gather(tile, tile.points(), phases, &show)?;
            }
        }
        if let Some(clamped) = &self.clamped {
            phases.shading += clamped.count(prepared, tile)?;
        }
        if self.interleave.is_none() {
            self.compensate(tile, phases, progress)?;
        }
        counts.shading_terms += self.gather.terms(u64::from(tile.points()));
        Ok(())
    }

    /// Adds the radiance that a tile reflects, and that the clamp took, over its pixels.
    ///
    /// # Errors
    /// The device fails.
    pub fn add_energy(&self, tile: Tile, sum: &mut [f64; 2]) -> Result<(), GpuError> {
        self.clamped.as_ref().map_or(Ok(()), |clamped| clamped.add_to(self.prepared, tile, sum))
    }

    /// What the bound on G took, to what the visible points of a tile gather.
    fn compensate(
        &self,
        tile: Tile,
        phases: &mut Phases,
        progress: Progress<'_>,
    ) -> Result<(), GpuError> {
        let Some(compensation) = &self.compensation else { return Ok(()) };
        progress(0.0, "compensation");
        if let Some(compensated) = &self.compensated {
            self.prepared.gpu.clear(&[compensated])?;
        }
        phases.compensation += compensation.add(self.prepared, tile)?;
        Ok(())
    }
}

/// The bound by which members of VPL clusters are drawn: the default one, so that visibility is the same
/// with and without a bound, and what the bound takes is the difference between the images.
fn draw_bound(prepared: &Prepared, settings: &Settings, vpls: &VplSet) -> Option<GeometryBound> {
    let plain = Settings { clamp: Clamp::Auto, compensate: false, ..*settings };
    GeometryBound::of(&prepared.scene, &plain, &vpls.vpls)
}
