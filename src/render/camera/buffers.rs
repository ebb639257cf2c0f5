//! The buffers of a tile that all steps share: what its camera rays see, and the film.

use super::attributes::{Attribute, attributes};
use super::setup::FrameSetup;
use crate::gpu::{GpuError, PointRecord, TableFormat, Texture};
use crate::render::prepared::Prepared;
use crate::render::stage::{Named, NamedTexture};

/// The buffers of a tile.
#[derive(Debug)]
pub struct TileBuffers {
    /// Radiance, summed over the samples; in w how many of them hit something.
    pub film: wgpu::Buffer,
    /// Visible points of one sample.
    pub points: wgpu::Buffer,
    /// What else is known of them.
    pub attributes: Vec<Attribute>,
    /// Radiance of the visible points of a sample, where pixels are antialiased, or mirrors or glass
    /// may be in the way.
    pub radiance: Option<wgpu::Buffer>,
    /// Where pixels are antialiased, which of the first rays finds a point in place of another.
    pub point_rays: Option<wgpu::Buffer>,
    /// And the surfaces of their visible points.
    pub pixel_surfaces: Option<Texture>,
}

impl TileBuffers {
    /// For the tiles of a frame.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(setup: &FrameSetup<'_>) -> Result<Self, GpuError> {
        let FrameSetup { prepared, settings, .. } = *setup;
        let (gpu, features) = (&prepared.gpu, prepared.target_of(settings).features);
        let points = setup.most_points();
        let colours = |label: &str| gpu.storage::<[f32; 4]>(label, points);
        let point_rays = || gpu.storage::<u32>("rays of points", points);
        let pixel_surfaces = || gpu.table("surfaces of pixels", points, TableFormat::Quadruples);
        let antialiases = settings.antialiases();
        let by_point = antialiases || features.specular();
        Ok(Self {
            film: colours("film")?,
            points: gpu.storage::<PointRecord>("visible points", points)?,
            attributes: attributes(gpu, features, points)?,
            point_rays: antialiases.then(point_rays).transpose()?,
            pixel_surfaces: antialiases.then(pixel_surfaces).transpose()?,
            radiance: by_point.then(|| colours("radiance")).transpose()?,
        })
    }

    /// These and the scene's, by name.
    pub fn named<'a>(&'a self, prepared: &'a Prepared) -> Vec<Named<'a>> {
        let mut named = vec![("points", &self.points), ("film", &self.film)];
        named.extend(self.attributes.iter().map(|(name, buffer)| (*name, buffer)));
        named.extend(self.radiance.as_ref().map(|buffer| ("radiance", buffer)));
        named.extend(self.point_rays.as_ref().map(|buffer| ("point_rays", buffer)));
        named.extend(prepared.named());
        named
    }

    /// Tables in textures, by name: one that reads them, and one that writes them.
    pub fn textures(&self) -> Vec<NamedTexture<'_>> {
        let names = ["pixel_surfaces", "packed_pixel_surfaces"];
        let surfaces = self.pixel_surfaces.iter();
        surfaces.flat_map(|table| names.map(|name| (name, table))).collect()
    }

    /// The same as [`TileBuffers::named`] for stages that add to the radiance of visible points: that is the film, unless it
    /// has a buffer of its own.
    pub fn named_by_point<'a>(&'a self, prepared: &'a Prepared) -> Vec<Named<'a>> {
        // The first buffer of a name counts.
        let radiance = self.radiance.as_ref().map(|radiance| ("film", radiance));
        radiance.into_iter().chain(self.named(prepared)).collect()
    }

    /// Empties the film, before the first sample of a tile.
    ///
    /// # Errors
    /// The device fails.
    pub fn clear_film(&self, prepared: &Prepared) -> Result<(), GpuError> {
        prepared.gpu.clear(&[&self.film])
    }

    /// Forgets the radiance of the last sample.
    ///
    /// # Errors
    /// The device fails.
    pub fn clear_radiance(&self, prepared: &Prepared) -> Result<(), GpuError> {
        match &self.radiance {
            Some(radiance) => prepared.gpu.clear(&[radiance]),
            None => Ok(()),
        }
    }
}
