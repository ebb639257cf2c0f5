//! The passes of a frame, tile by tile: a tile is a run of 8 × 8 pixel blocks, small enough
//! that no buffer meets an adapter's limits and no dispatch takes many seconds.

use std::time::{Duration, Instant};

use super::compensate::Compensation;
use super::film::{Tile, Tiling, blank, develop};
use super::gathers::{Clustered, Gathers};
use super::interleave::Interleave;
use super::light_set::LightSet;
use super::stages::{Stage, Stages};
use super::vpl::Vpl;
use super::{Counts, Method, Phases, Prepared, Progress, Settings};
use crate::gpu::{GpuError, PointRecord};
use crate::image::Image;
use crate::scene::Camera;

/// Renders the tiles of one frame.
#[derive(Debug)]
pub struct TileRenderer<'a> {
    pub(super) prepared: &'a Prepared,
    pub(super) camera: &'a Camera,
    pub(super) settings: &'a Settings,
    pub(super) seed: u32,
    pub(super) tiling: Tiling,
    pub(super) stages: Stages,
    /// Where pixels gather subsets of the VPLs.
    pub(super) interleave: Option<Interleave>,
    /// Where what the bound on G removes is given back.
    compensation: Option<Compensation>,
}

impl<'a> TileRenderer<'a> {
    /// Binds what the frame needs.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &'a Prepared,
        camera: &'a Camera,
        settings: &'a Settings,
        seed: u32,
        indirect: Option<&LightSet>,
    ) -> Result<Self, GpuError> {
        let clamps = indirect.is_some_and(|indirect| indirect.bound.is_some());
        let tiling = tiling(camera, settings);
        let points = tiling.most_points() as usize;
        let stages = Stages::new(prepared, points, settings, indirect.is_some(), clamps)?;
        let interleave = match (&stages.buffers.irradiance, indirect) {
            (Some(combined), Some(_)) if settings.interleaves() => {
                let named = stages.buffers.named(prepared);
                Some(Interleave::new(prepared, &tiling, &named, combined, settings)?)
            }
            _ => None,
        };
        let compensation = None;
        Ok(Self { prepared, camera, settings, seed, tiling, stages, interleave, compensation })
    }

    /// Gives back what this bound on G removes of the light of VPLs.
    ///
    /// # Errors
    /// The device refuses.
    pub fn give_back(&mut self, vpls: &[Vpl], bound: f32) -> Result<(), GpuError> {
        let (buffers, points) = (&self.stages.buffers, self.tiling.most_points() as usize);
        self.compensation = Some(Compensation::new(
            self.prepared,
            self.settings,
            self.seed,
            vpls,
            bound,
            buffers,
            points,
        )?);
        Ok(())
    }

    /// Renders all tiles.
    ///
    /// # Errors
    /// The device fails.
    pub fn render(
        &self,
        gathers: &Gathers<'_>,
        clustered: Option<&Clustered>,
        phases: &mut Phases,
        counts: &mut Counts,
        progress: Progress<'_>,
    ) -> Result<Image, GpuError> {
        let mut image = blank(self.camera.size)?;
        let unit = match self.settings.method {
            Method::Depth => self.prepared.scene.units.scale as f32,
            _ => 1.0,
        };
        let weight = unit / self.settings.samples as f32;
        // Radiance that is reflected, and that the clamp removed.
        let mut energy = [0.0; 2];
        let buffers = &self.stages.buffers;
        let gpu = &self.prepared.gpu;
        let tiles = self.tiling.tiles().count() as f64;
        for (index, tile) in self.tiling.tiles().enumerate() {
            if tile.sample == 0 {
                gpu.clear(&[&buffers.film])?;
                gpu.clear(&buffers.energy.iter().collect::<Vec<_>>())?;
            }
            match clustered {
                Some(clustered) => self.load(tile, clustered, gathers)?,
                None => {
                    phases.visible_points += self.run(
                        &self.stages.visible,
                        &self.camera_params(tile),
                        [tile.blocks, 1],
                    )?;
                }
            }
            self.sample(tile, gathers, phases, counts, &|share, phase| {
                progress((index as f64 + share) / tiles, phase);
            })?;
            phases.visible_points += self.antialias(tile)?;
            if tile.sample + 1 < self.settings.samples {
                continue;
            }
            let start = Instant::now();
            let film: Vec<[f32; 4]> = gpu.read(&buffers.film, tile.points() as usize)?;
            counts.visible_points += develop(tile, &film, weight, &mut image);
            self.add_energy(tile, &mut energy)?;
            phases.readback += start.elapsed();
        }
        if let Some(clustered) = clustered {
            let hit = |record: &&PointRecord| record.surface != PointRecord::NOTHING;
            counts.visible_points = clustered.records.iter().filter(hit).count() as u64;
        }
        let [reflected, removed] = energy;
        if removed > 0.0 {
            // With compensation, whose noise is taken off again, little more than 0 may be below it.
            counts.clamped_fraction = removed / (f64::max(reflected, 0.0) + removed);
        }
        let finite = |pixel: &&[f32; 3]| !pixel.iter().all(|channel| channel.is_finite());
        counts.nonfinite_pixels = image.pixels.iter().filter(finite).count() as u64;
        Ok(image)
    }

    /// Loads the visible points of a tile, and the clusters that they belong to.
    fn load(
        &self,
        tile: Tile,
        clustered: &Clustered,
        gathers: &Gathers<'_>,
    ) -> Result<(), GpuError> {
        let (buffers, gpu) = (&self.stages.buffers, &self.prepared.gpu);
        let run = tile.of_frame();
        gpu.write(&buffers.points, &clustered.records[run.clone()])?;
        for ((_, buffer), kept) in buffers.kept.iter().zip(&clustered.kept) {
            gpu.write(buffer, &kept[run.clone()])?;
        }
        if let (Some(interleave), Some(seen)) = (&self.interleave, &clustered.signatures) {
            interleave.set_signatures(self.prepared, &seen[run.clone()])?;
        }
        for direct in &gathers.direct {
            direct.set_clusters(&clustered.clusters, run.clone(), None)?;
        }
        if let Some(indirect) = &gathers.indirect {
            let subsets = self.interleave.as_ref().map(|interleave| interleave.subsets(tile));
            indirect.set_clusters(&clustered.clusters, run, subsets.as_ref())?;
        }
        Ok(())
    }

    /// Adds the radiance that a tile reflects, and that the clamp removed, over its pixels.
    fn add_energy(&self, tile: Tile, sum: &mut [f64; 2]) -> Result<(), GpuError> {
        let Some(energy) = &self.stages.buffers.energy else { return Ok(()) };
        let of_points: Vec<[f32; 2]> = self.prepared.gpu.read(energy, tile.points() as usize)?;
        for of_point in &of_points[tile.own()] {
            for (sum, value) in sum.iter_mut().zip(of_point) {
                *sum += f64::from(*value);
            }
        }
        Ok(())
    }

    /// One sample of every pixel of a tile, from its visible points on: emission, direct light,
    /// indirect light.
    fn sample(
        &self,
        tile: Tile,
        gathers: &Gathers<'_>,
        phases: &mut Phases,
        counts: &mut Counts,
        progress: Progress<'_>,
    ) -> Result<(), GpuError> {
        let groups = [tile.blocks, 1];
        self.prepared.gpu.clear(&self.stages.buffers.radiance.iter().collect::<Vec<_>>())?;
        for stage in self.stages.show.iter().chain(&self.stages.emit) {
            phases.shading += self.run(stage, &(), groups)?;
        }
        if !self.stages.direct.is_empty() {
            progress(0.0, "direct light");
            self.clear_irradiance()?;
            phases.direct += self.direct(tile)?;
            phases.direct += self.reflect(groups)?;
        }
        if !gathers.direct.is_empty() {
            self.clear_irradiance()?;
            let mut own = Phases::default();
            for direct in &gathers.direct {
                direct.gather(tile.points(), &mut own, &|share| progress(share, "direct light"))?;
            }
            phases.direct += own.render() + self.reflect(groups)?;
        }
        if let Some(gather) = &gathers.indirect {
            let show = |share| progress(share, "indirect light");
            match &self.interleave {
                Some(interleave) => {
                    self.compensate(tile, phases, progress)?;
                    phases.shading += interleave.separate(self.prepared, tile)?;
                    let points = interleave.subsets(tile).points();
                    counts.shadow_rays += gather.gather(points, phases, &show)?;
                    phases.shading += interleave.combine(self.prepared, tile)?;
                }
                None => {
                    self.clear_irradiance()?;
                    counts.shadow_rays += gather.gather(tile.points(), phases, &show)?;
                }
            }
            if let Some(stage) = &self.stages.removed {
                phases.shading += self.run(stage, &(), groups)?;
            }
            if self.interleave.is_none() {
                self.compensate(tile, phases, progress)?;
            }
            counts.shading_terms += gather.terms(u64::from(tile.points()));
            phases.shading += self.reflect(groups)?;
        }
        Ok(())
    }

    /// What the bound on G removes, to what the visible points of a tile gather.
    fn compensate(
        &self,
        tile: Tile,
        phases: &mut Phases,
        progress: Progress<'_>,
    ) -> Result<(), GpuError> {
        if let Some(compensation) = &self.compensation {
            progress(0.0, "compensation");
            let buffers = &self.stages.buffers;
            phases.compensation += compensation.give_back(self.prepared, buffers, tile)?;
        }
        Ok(())
    }

    fn reflect(&self, groups: [u32; 2]) -> Result<Duration, GpuError> {
        self.stages
            .reflect
            .as_ref()
            .map_or(Ok(Duration::ZERO), |stage| self.run(stage, &(), groups))
    }

    fn clear_irradiance(&self) -> Result<(), GpuError> {
        self.prepared.gpu.clear(&self.stages.buffers.irradiance.iter().collect::<Vec<_>>())
    }

    pub(super) fn run<P: bytemuck::Pod>(
        &self,
        stage: &Stage,
        params: &P,
        workgroups: [u32; 2],
    ) -> Result<Duration, GpuError> {
        stage.run(self.prepared, params, workgroups)
    }
}

/// Tiles as large as what they hold a point allows: much, if every point has a row of the bit
/// matrix. Interleaving and antialiasing need the pixels around, and so rows.
fn tiling(camera: &Camera, settings: &Settings) -> Tiling {
    let own_rows = settings.method.is_indirect() && !settings.method.clusters_points();
    let blocks = if own_rows && !settings.interleaves() { 4096 } else { 16_384 };
    match settings.interleaves() || settings.antialiases() {
        true => Tiling::of_rows(camera, blocks, settings.samples),
        false => Tiling::of_runs(camera, blocks, settings.samples),
    }
}
