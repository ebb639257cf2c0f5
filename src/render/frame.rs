//! The steps of a frame in their order, tile by tile: a tile is a run of 8 × 8 pixel blocks, small
//! enough that no buffer meets an adapter's limits and no dispatch takes many seconds.

mod points;

use std::time::Instant;

use super::camera::{CameraRays, Emission, FrameSetup, Tile, TileBuffers, blank, develop};
use super::clusters::PointClusters;
use super::direct::DirectLight;
use super::gather::{Gather, Irradiance};
use super::indirect::IndirectLight;
use super::kernels::Emitter;
use super::result::{Phases, Progress, Tally};
use super::settings::{Direct, Method};
use super::visibility::LightSet;
use super::vpls::VplSet;
use crate::gpu::GpuError;
use crate::image::Image;
use crate::sampling::hash;
pub use points::ClusteredPoints;

/// The steps of a frame that go pixel by pixel, each with its stages and its buffers of one tile.
#[derive(Debug)]
pub struct Steps<'a> {
    setup: FrameSetup<'a>,
    buffers: TileBuffers,
    rays: CameraRays<'a>,
    emission: Emission<'a>,
    /// What points gather of direct light, then of indirect light; none in methods without light.
    irradiance: Option<Irradiance>,
    direct: DirectLight<'a>,
}

/// What gathers many lights, at each point by itself or with clusters of points.
#[derive(Debug)]
pub struct ManyLights<'a> {
    /// VPLs.
    indirect: Option<IndirectLight<'a>>,
    /// Light sources, where clusters share their visibility.
    direct: Vec<Gather<'a>>,
}

impl<'a> Steps<'a> {
    /// Binds what a frame needs; `gathers_vpls` is whether there are any to gather.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(setup: FrameSetup<'a>, gathers_vpls: bool) -> Result<Self, GpuError> {
        let buffers = TileBuffers::new(&setup)?;
        let lit = setup.settings.method.is_lit() && setup.settings.direct != Direct::Off;
        let irradiance =
            (lit || gathers_vpls).then(|| Irradiance::new(&setup, &buffers)).transpose()?;
        Ok(Self {
            rays: CameraRays::new(&setup, &buffers)?,
            emission: Emission::new(&setup, &buffers)?,
            direct: DirectLight::new(&setup, &buffers, irradiance.as_ref())?,
            irradiance,
            buffers,
            setup,
        })
    }

    /// Finds the visible points of the whole image and clusters them; none if nothing is seen.
    ///
    /// # Errors
    /// The device fails.
    pub fn cluster_points(
        &self,
        vpls: &VplSet,
        tally: &mut Tally,
        progress: Progress<'_>,
    ) -> Result<Option<ClusteredPoints>, GpuError> {
        let probes = vpls.probes(self.setup.settings);
        let (rays, buffers) = (&self.rays, &self.buffers);
        ClusteredPoints::find(&self.setup, rays, buffers, &probes, tally, progress)
    }

    /// What gathers many lights: from each point by itself, or with clusters that have been found.
    ///
    /// # Errors
    /// The device refuses.
    pub fn many_lights(
        &self,
        vpls: &VplSet,
        clustered: Option<&ClusteredPoints>,
    ) -> Result<ManyLights<'a>, GpuError> {
        let clusters = clustered.map(|clustered| &clustered.clusters);
        let Some(irradiance) = &self.irradiance else {
            return Ok(ManyLights { indirect: None, direct: Vec::new() });
        };
        let buffers = &self.buffers;
        Ok(ManyLights {
            indirect: IndirectLight::new(&self.setup, vpls, buffers, irradiance, clusters)?,
            direct: match clusters {
                Some(clusters) => self.shared_direct(irradiance, clusters)?,
                None => Vec::new(),
            },
        })
    }

    /// What gathers direct light with clusters of points, if the settings ask for it.
    fn shared_direct(
        &self,
        irradiance: &Irradiance,
        clusters: &PointClusters,
    ) -> Result<Vec<Gather<'a>>, GpuError> {
        let FrameSetup { prepared, settings, seed, tiling, .. } = self.setup;
        if settings.direct != Direct::Clustered || !settings.method.is_lit() {
            return Ok(Vec::new());
        }
        let samples = settings.shared_light_samples();
        let places = prepared.lights.places(&prepared.scene, samples, hash(seed));
        let kinds = [(Emitter::Point, prepared.lights.points()), (Emitter::Surface, places)];
        let mut named = self.buffers.named(prepared);
        named.push(irradiance.named());
        let mut gathers = Vec::new();
        for (emitter, lights) in kinds {
            if let Some(lights) = LightSet::direct(prepared, emitter, &lights)? {
                let points = tiling.most_points();
                gathers.push(Gather::new(prepared, lights, Some(clusters), &named, points, None)?);
            }
        }
        Ok(gathers)
    }

    /// Renders the image, tile by tile and sample by sample.
    ///
    /// # Errors
    /// The device fails.
    pub fn render(
        &self,
        lights: &ManyLights<'_>,
        clustered: Option<&ClusteredPoints>,
        tally: &mut Tally,
        progress: Progress<'_>,
    ) -> Result<Image, GpuError> {
        let FrameSetup { prepared, camera, settings, tiling, .. } = self.setup;
        let mut image = blank(camera.size)?;
        let unit = match settings.method {
            Method::Depth => prepared.scene.units.scale as f32,
            _ => 1.0,
        };
        let weight = unit / settings.samples as f32;
        // Radiance that is reflected, and that the clamp took.
        let mut energy = [0.0; 2];
        let tiles = tiling.tiles().count() as f64;
        for (index, tile) in tiling.tiles().enumerate() {
            if tile.sample == 0 {
                self.buffers.clear_film(prepared)?;
                lights.clear_energy()?;
            }
            match clustered {
                Some(clustered) => {
                    clustered.load(prepared, &self.buffers, tile)?;
                    lights.load(tile, clustered)?;
                    if tiles > 1.0 {
                        tally.phases.visible_points += self.rays.find_again(tile)?;
                    }
                }
                None => tally.phases.visible_points += self.rays.find_points(tile)?,
            }
            self.shade(tile, lights, tally, &|share, phase| {
                progress((index as f64 + share) / tiles, phase);
            })?;
            tally.phases.visible_points += self.rays.add_to_film(tile)?;
            if tile.sample + 1 < settings.samples {
                continue;
            }
            let start = Instant::now();
            let points = tile.points() as usize;
            let film: Vec<[f32; 4]> = prepared.gpu.read(&self.buffers.film, points)?;
            tally.counts.visible_points += develop(tile, &film, weight, &mut image);
            lights.add_energy(tile, &mut energy)?;
            tally.phases.readback += start.elapsed();
        }
        if let Some(clustered) = clustered {
            tally.counts.visible_points = clustered.hits();
        }
        let [reflected, removed] = energy;
        if removed > 0.0 {
            // With compensation, whose noise is taken off again, little more than 0 may be below it.
            tally.counts.clamped_fraction = removed / (f64::max(reflected, 0.0) + removed);
        }
        let finite = |pixel: &&[f32; 3]| !pixel.iter().all(|channel| channel.is_finite());
        tally.counts.nonfinite_pixels = image.pixels.iter().filter(finite).count() as u64;
        Ok(image)
    }

    /// One sample of every pixel of a tile, from its visible points on: emission, direct light,
    /// indirect light.
    fn shade(
        &self,
        tile: Tile,
        lights: &ManyLights<'_>,
        tally: &mut Tally,
        progress: Progress<'_>,
    ) -> Result<(), GpuError> {
        let prepared = self.setup.prepared;
        self.buffers.clear_radiance(prepared)?;
        tally.phases.shading += self.emission.add(tile)?;
        let Some(irradiance) = &self.irradiance else { return Ok(()) };
        if !self.direct.is_empty() {
            progress(0.0, "direct light");
            irradiance.clear(prepared)?;
            tally.phases.direct += self.direct.gather(tile)?;
            tally.phases.direct += irradiance.reflect(prepared, tile)?;
        }
        if !lights.direct.is_empty() {
            irradiance.clear(prepared)?;
            let mut own = Phases::default();
            for direct in &lights.direct {
                direct.gather(tile, tile.points(), &mut own, &|share| {
                    progress(share, "direct light")
                })?;
            }
            tally.phases.direct += own.render() + irradiance.reflect(prepared, tile)?;
        }
        if let Some(indirect) = &lights.indirect {
            indirect.gather(tile, irradiance, tally, progress)?;
            tally.phases.shading += irradiance.reflect(prepared, tile)?;
        }
        Ok(())
    }
}

impl ManyLights<'_> {
    /// Traces the rows of the clusters, if there are any.
    ///
    /// # Errors
    /// The device fails.
    pub fn trace_clusters(
        &self,
        tally: &mut Tally,
        progress: Progress<'_>,
    ) -> Result<(), GpuError> {
        for direct in &self.direct {
            let mut own = Phases::default();
            direct.trace_clusters(&mut own, &|share| progress(share, "direct light"))?;
            tally.phases.direct += own.render();
        }
        match &self.indirect {
            Some(indirect) => indirect.trace_clusters(tally, progress),
            None => Ok(()),
        }
    }

    /// Tells which clusters the points of a tile are in.
    fn load(&self, tile: Tile, clustered: &ClusteredPoints) -> Result<(), GpuError> {
        let (clusters, points) = (&clustered.clusters, tile.of_frame());
        for direct in &self.direct {
            direct.set_clusters(clusters, points.clone(), None)?;
        }
        match &self.indirect {
            Some(indirect) => {
                indirect.load(tile, clusters, points, clustered.signatures.as_deref())
            }
            None => Ok(()),
        }
    }

    fn clear_energy(&self) -> Result<(), GpuError> {
        self.indirect.as_ref().map_or(Ok(()), IndirectLight::clear_energy)
    }

    fn add_energy(&self, tile: Tile, sum: &mut [f64; 2]) -> Result<(), GpuError> {
        self.indirect.as_ref().map_or(Ok(()), |indirect| indirect.add_energy(tile, sum))
    }
}
