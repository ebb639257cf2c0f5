//! Rays from the points of a tile in dispatches of a bounded length.

use crate::gpu::DirectParams;
use crate::render::camera::Tile;
use crate::render::kernels::rays_at_once;
use crate::render::prepared::Prepared;
use crate::render::visibility::dispatch_rays;

/// The parameters of a tile's dispatches, each of a bounded number of rays.
pub fn rays_of_dispatch(
    prepared: &Prepared,
    tile: Tile,
    params: DirectParams,
) -> impl Iterator<Item = DirectParams> {
    let most = rays_at_once(prepared.bvh.nodes.len());
    let slice = (dispatch_rays(prepared) / tile.points()).clamp(1, most);
    (0..params.most_rays).step_by(slice as usize).map(move |first| DirectParams {
        points: tile.points(),
        first,
        count: slice.min(params.most_rays - first),
        first_block: tile.first_block,
        sample: tile.sample,
        ..params
    })
}
