//! Camera rays: the visible points of a tile, and further rays at edges.

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
    visible: Stage,
    film: ToFilm<'a>,
}

/// How the radiance of a sample's visible points comes to the film.
#[derive(Debug)]
enum ToFilm<'a> {
    /// It is there.
    Direct,
    /// Through mirrors and glass.
    Resolved(Stage),
    /// By further camera rays.
    Antialiased(Box<Antialiasing<'a>>),
}

impl<'a> CameraRays<'a> {
    /// Binds what the settings need.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(setup: &FrameSetup<'a>, tile: &TileBuffers) -> Result<Self, GpuError> {
        let FrameSetup { prepared, camera, settings, seed, .. } = *setup;
        let target = prepared.target_of(settings);
        let named = tile.named(prepared);
        let bind = |program| Stage::with_textures(prepared, &program, &named, &tile.textures());
        let film = match settings.antialiases() {
            true => ToFilm::Antialiased(Box::new(Antialiasing::new(setup, tile)?)),
            false if target.features.specular() => ToFilm::Resolved(bind(resolve(target))?),
            false => ToFilm::Direct,
        };
        let params = CameraParams {
            edge_rays: settings.edge_samples.div_ceil(settings.samples),
            ..camera_params(prepared, camera, settings.samples, seed)
        };
        let visible = {
            let (lit, antialiased) = (settings.method.is_lit(), settings.antialiases());
            bind(visible_points(target, lit, antialiased))?
        };
        Ok(Self { prepared, params, visible, film })
    }

    /// Finds the visible points of a tile.
    ///
    /// # Errors
    /// The device fails.
    pub fn find_points(&self, tile: Tile) -> Result<Duration, GpuError> {
        let params = self.params_of(tile);
        let mut time = self.visible.run(self.prepared, &params, [tile.blocks, 1])?;
        if let ToFilm::Antialiased(antialiasing) = &self.film {
            time += antialiasing.choose_points(&params)?;
            let chosen = CameraParams { rays: 1, ..params };
            time += self.visible.run(self.prepared, &chosen, [tile.blocks, 1])?;
            time += antialiasing.link(&params)?;
        }
        Ok(time)
    }

    /// Traces again what rays beside those that find the visible points have met, when other tiles or
    /// samples have been looked at since.
    ///
    /// # Errors
    /// The device fails.
    pub fn find_again(&self, tile: Tile) -> Result<Duration, GpuError> {
        match &self.film {
            ToFilm::Antialiased(antialiasing) => antialiasing.trace(&self.params_of(tile)),
            ToFilm::Direct | ToFilm::Resolved(_) => Ok(Duration::ZERO),
        }
    }

    /// Brings the radiance of a sample to the film, with what further camera rays see; nothing if
    /// it is there already.
    ///
    /// # Errors
    /// The device fails.
    pub fn add_to_film(&self, tile: Tile) -> Result<Duration, GpuError> {
        match &self.film {
            ToFilm::Direct => Ok(Duration::ZERO),
            ToFilm::Resolved(stage) => stage.run(self.prepared, &(), [tile.blocks, 1]),
            ToFilm::Antialiased(antialiasing) => antialiasing.add_to_film(&self.params_of(tile)),
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
