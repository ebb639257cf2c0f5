//! The pipeline: what is prepared once, and the steps of a frame in their order.

mod camera;
mod clusters;
mod compensation;
mod direct;
mod features;
mod filter;
mod frame;
mod gather;
mod indirect;
pub mod kernels;
mod lights;
pub mod materials;
mod path;
mod picture;
mod plan;
pub mod prepared;
mod result;
mod settings;
mod stage;
mod virtual_light;
mod visibility;
mod vpls;

use crate::scene::Camera;

pub use clusters::VplClusters;
pub use features::{Features, Sky, Target};
pub use gather::chunk_words;
pub use kernels::all_programs;
pub use lights::{LightKind, Lights};
pub use plan::Plan;
pub use prepared::Prepared;
pub use result::{Counts, Frame, Phases, Progress, RenderError};
pub use settings::{
    Bounces, Clamp, Clustering, Direct, Merge, Method, Representative, Settings, SettingsError,
    Sharing,
};
pub use virtual_light::{GlossyLobe, VirtualLight};
pub use vpls::{LightPaths, Starts, Vpl, light_paths};

use camera::FrameSetup;
use frame::{ClusteredPoints, Steps};
use path::PathTracer;
use result::Tally;
use vpls::VplSet;

/// Renders one frame of a prepared scene.
///
/// # Errors
/// The settings are beyond their ranges or do not go together; the device fails or runs out of
/// memory.
pub fn frame(
    prepared: &Prepared,
    camera: &Camera,
    settings: &Settings,
    seed: u32,
    progress: Progress<'_>,
) -> Result<Frame, RenderError> {
    settings.check()?;
    if settings.method == Method::Path {
        return Ok(PathTracer::new(prepared, camera, settings, seed)?.render(progress)?);
    }
    let mut tally = Tally::default();

    // On the host: light paths, and clusters of the VPLs that they leave.
    progress(0.0, "light paths");
    let vpls = VplSet::trace(prepared, camera, settings, seed, &mut tally);

    // On the device: the steps, each with its stages and its buffers of a tile.
    let gathers_vpls = !vpls.gathered(settings).is_empty();
    let setup = FrameSetup::new(prepared, camera, settings, seed);
    let steps = Steps::new(setup, gathers_vpls)?;

    // Clusters are of the points of the whole image, and their shadow rays are traced once for it.
    let shared = gathers_vpls || settings.direct == Direct::Clustered;
    let shown = settings.method == Method::PointClusters;
    let clustered = match settings.method.clusters_points() && (shared || shown) {
        true => steps.cluster_points(&vpls, &mut tally, progress)?,
        false => None,
    };
    tally.counts.point_clusters = clustered.as_ref().map(ClusteredPoints::count);
    let lights = steps.many_lights(&vpls, clustered.as_ref())?;
    lights.trace_clusters(&mut tally, progress)?;

    // Tile by tile: visible points, emission, direct light, indirect light, film.
    let mut image = steps.render(&lights, clustered.as_ref(), &mut tally, progress)?;

    match (settings.method, &clustered) {
        (Method::PointClusters, Some(clustered)) => picture::point_clusters(clustered, &mut image),
        (Method::VplMap, _) => picture::lights(prepared, camera, &vpls.lights, 1.0, &mut image),
        (Method::VplClustersMap, _) => {
            picture::lights(prepared, camera, &vpls.lights, 3.5, &mut image);
        }
        _ => {}
    }
    let dispatches = prepared.gpu.take_dispatch_times()?;
    let Tally { phases, counts } = tally;
    Ok(Frame { image, standard_error: None, counts, phases, dispatches })
}
