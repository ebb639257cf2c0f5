//! Rays by the lobes of glossy surfaces: of what a lobe reflects, light samples alone find a wide
//! light by chance, as rays of the lobe alone do a small one; so they share it.

use std::time::Duration;

use super::dispatches::rays_of_dispatch;
use crate::gpu::{DirectParams, GpuError};
use crate::render::camera::{FrameSetup, Tile};
use crate::render::lights::LightKind;
use crate::render::prepared::Prepared;
use crate::render::stage::{Named, Stage};
use crate::scene::{Bsdf, Camera};

/// Half the width of a lobe, in pixels, below which it shows edges that the filter does not see:
/// that looks at the 5 × 5 pixels around each.
const FILTERED_WIDTH: f32 = 2.5;

/// Rays from every visible point that has a lobe.
#[derive(Debug)]
pub struct LobeRays<'a> {
    prepared: &'a Prepared,
    stage: Stage,
    /// From what exponent on what they find is not combined over pixels.
    narrow: f32,
    /// Whether there are such lobes, and others.
    are_some: [bool; 2],
}

impl<'a> LobeRays<'a> {
    /// To lights of these kinds, by the buffers of a tile and light samples; none in scenes without
    /// lobes.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        setup: &FrameSetup<'a>,
        kinds: &[LightKind],
        named: &[Named<'_>],
    ) -> Result<Option<Self>, GpuError> {
        let FrameSetup { prepared, settings, camera, .. } = *setup;
        let Some(program) = prepared.direct_lobe_program(kinds, settings) else { return Ok(None) };
        let narrow = if settings.filters_direct() { narrow_exponent(camera) } else { f32::MAX };
        let exponents =
            prepared.scene.materials.iter().filter_map(|material| match material.bsdf {
                Bsdf::Phong { shininess, .. } => Some(shininess),
                _ => None,
            });
        let mut are_some = [false; 2];
        exponents.for_each(|exponent| are_some[usize::from(exponent < narrow)] = true);
        Ok(Some(Self { prepared, stage: Stage::new(prepared, &program, named)?, narrow, are_some }))
    }

    /// Adds what wide lobes find, which the filter combines with light samples.
    ///
    /// # Errors
    /// The device fails.
    pub fn gather_wide(&self, tile: Tile, params: DirectParams) -> Result<Duration, GpuError> {
        self.gather(tile, self.are_some[1], DirectParams { most_shininess: self.narrow, ..params })
    }

    /// Adds what narrow lobes find, after that.
    ///
    /// # Errors
    /// The device fails.
    pub fn gather_narrow(&self, tile: Tile, params: DirectParams) -> Result<Duration, GpuError> {
        let params = DirectParams {
            least_shininess: self.narrow,
            most_shininess: f32::MAX,
            // All are stratified together, as nothing asks for their difference.
            halves: 1,
            ..params
        };
        self.gather(tile, self.are_some[0], params)
    }

    fn gather(&self, tile: Tile, is: bool, params: DirectParams) -> Result<Duration, GpuError> {
        let dispatches = is.then(|| rays_of_dispatch(self.prepared, tile, params));
        let run = |params| self.stage.run(self.prepared, &params, [tile.blocks, 1]);
        dispatches.into_iter().flatten().map(run).sum()
    }
}

/// The exponent of a lobe cos^n that falls to 1/√e within so many pixels in the middle of the image.
fn narrow_exponent(camera: &Camera) -> f32 {
    let [across, down] = camera.half_tangents();
    let [width, height] = camera.size.map(|extent| extent as f32);
    let pixel = (2.0 * across / width).max(2.0 * down / height);
    (FILTERED_WIDTH * pixel).powi(-2)
}
