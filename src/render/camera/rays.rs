//! Camera rays: the visible points of a tile, and how their radiance comes to the film.

use std::time::Duration;

use super::antialiasing::Antialiasing;
use super::buffers::TileBuffers;
use super::setup::FrameSetup;
use super::tiling::Tile;
use crate::gpu::{CameraParams, GpuError};
use crate::render::kernels::{resolve, visible_points};
use crate::render::prepared::Prepared;
use crate::render::stage::Stage;
use crate::sampling::{SURFACE_OFFSET, hash};
use crate::scene::Camera;

/// The camera rays of a frame.
#[derive(Debug)]
pub struct CameraRays<'a> {
    prepared: &'a Prepared,
    /// What all tiles share.
    params: CameraParams,
    kind: Kind,
}

/// How visible points are found, and how their radiance comes to the film.
#[derive(Debug)]
enum Kind {
    /// A ray finds each. Radiance is on the film, unless mirrors and glass are to be minded.
    Single { visible: Stage, resolve: Option<Stage> },
    /// Several rays a pixel, and more at edges.
    Antialiased(Antialiasing),
}

impl<'a> CameraRays<'a> {
    /// Binds what the settings need.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(setup: &FrameSetup<'a>, tile: &TileBuffers) -> Result<Self, GpuError> {
        let FrameSetup { prepared, camera, settings, seed, .. } = *setup;
        let target = prepared.target_of(settings);
        let params = CameraParams {
            edge_rays: settings.edge_samples.div_ceil(settings.samples),
            ..camera_params(prepared, camera, settings.samples, seed)
        };
        let kind = if settings.antialiases() {
            Kind::Antialiased(Antialiasing::new(setup, tile)?)
        } else {
            let named = tile.named(prepared);
            let bind = |program| Stage::new(prepared, &program, &named);
            let resolved = target.features.specular() && settings.method.is_lit();
            Kind::Single {
                visible: bind(visible_points(target, settings.method.is_lit()))?,
                resolve: resolved.then(|| bind(resolve(target))).transpose()?,
            }
        };
        Ok(Self { prepared, params, kind })
    }

    /// Finds the visible points of a tile.
    ///
    /// # Errors
    /// The device fails.
    pub fn find_points(&self, tile: Tile) -> Result<Duration, GpuError> {
        let params = self.params_of(tile);
        match &self.kind {
            Kind::Single { visible, .. } => visible.run(self.prepared, &params, [tile.blocks, 1]),
            Kind::Antialiased(rays) => rays.find_points(self.prepared, &params),
        }
    }

    /// Brings the radiance of a sample to the film, with more camera rays at edges; nothing if
    /// it is there already.
    ///
    /// # Errors
    /// The device fails.
    pub fn add_to_film(&self, tile: Tile) -> Result<Duration, GpuError> {
        match &self.kind {
            Kind::Single { resolve: None, .. } => Ok(Duration::ZERO),
            Kind::Single { resolve: Some(stage), .. } => {
                stage.run(self.prepared, &(), [tile.blocks, 1])
            }
            Kind::Antialiased(rays) => rays.add_to_film(self.prepared, &self.params_of(tile)),
        }
    }

    fn params_of(&self, tile: Tile) -> CameraParams {
        CameraParams {
            first_block: tile.first_block,
            sample: tile.sample,
            blocks: tile.blocks,
            ..self.params
        }
    }
}

/// What camera rays of all tiles share.
pub fn camera_params(
    prepared: &Prepared,
    camera: &Camera,
    samples: u32,
    seed: u32,
) -> CameraParams {
    let [x, y] = camera.half_tangents();
    CameraParams {
        position: camera.position.to_array(),
        width: camera.size[0],
        forward: camera.forward.to_array(),
        height: camera.size[1],
        right: (camera.right * x).to_array(),
        up: (camera.up * y).to_array(),
        samples,
        seed: hash(seed ^ 0x68e3_1da4),
        nodes: prepared.bvh.nodes.len() as u32,
        offset: SURFACE_OFFSET,
        ..bytemuck::Zeroable::zeroed()
    }
}
