//! Light of the real lights, from each visible point of a tile.

mod dispatches;
mod exact;
mod guide;
mod lobes;
mod sampled;

use std::time::Duration;

use super::camera::{FrameSetup, Tile, TileBuffers};
use super::gather::Irradiance;
use super::lights::LightKind;
use super::settings::{Direct, Settings};
use crate::gpu::GpuError;
use exact::ExactLight;
use sampled::SampledLight;

/// Shadow rays from every visible point to the lights.
#[derive(Debug)]
pub struct DirectLight<'a> {
    /// To those without extent, of each kind.
    exact: Vec<ExactLight<'a>>,
    /// To all others.
    sampled: Option<SampledLight<'a>>,
}

impl<'a> DirectLight<'a> {
    /// Binds what the settings need: nothing without direct light.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        setup: &FrameSetup<'a>,
        tile: &TileBuffers,
        irradiance: Option<&Irradiance>,
    ) -> Result<Self, GpuError> {
        let FrameSetup { prepared, settings, .. } = *setup;
        let Some(irradiance) = irradiance else { return Ok(Self { exact: vec![], sampled: None }) };
        let mut named = tile.named_by_point(prepared);
        named.push(irradiance.named());
        // Whatever is linked, rays go to lights that are there.
        let kinds = prepared.lights.kinds().filter(|&kind| is_per_pixel(settings, kind));
        let [exact, sampled] = prepared.lights.part(kinds, settings);
        let exact = exact.into_iter().map(|kind| ExactLight::new(setup, kind, &named));
        Ok(Self {
            exact: exact.collect::<Result<_, _>>()?,
            sampled: match sampled.is_empty() {
                true => None,
                false => Some(SampledLight::new(setup, &sampled, irradiance.named(), &named)?),
            },
        })
    }

    /// Whether there is none to gather.
    pub fn is_empty(&self) -> bool {
        self.exact.is_empty() && self.sampled.is_none()
    }

    /// Adds it to the irradiance of the visible points of a tile, in dispatches of a bounded number
    /// of shadow rays.
    ///
    /// # Errors
    /// The device fails.
    pub fn gather(&self, tile: Tile) -> Result<Duration, GpuError> {
        let mut time = Duration::ZERO;
        if let Some(sampled) = &self.sampled {
            time += sampled.gather(tile)?;
        }
        for exact in &self.exact {
            time += exact.gather(tile)?;
        }
        Ok(time)
    }
}

/// Whether every visible point has its own shadow rays to the lights of a kind. Clusters share the
/// visibility of lights that have places; the others are exact.
fn is_per_pixel(settings: &Settings, kind: LightKind) -> bool {
    match settings.direct {
        _ if !settings.method.is_lit() => false,
        Direct::PerPixel => true,
        Direct::Clustered => !kind.has_places(),
        Direct::Off => false,
    }
}
