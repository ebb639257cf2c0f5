//! The bound on the geometry term G, which grows without one as a VPL comes near.

use super::trace::{Vpl, density_bound};
use crate::render::settings::{Clamp, Settings};
use crate::scene::Scene;

/// The default bound where what it removes is given back, over the one where it is lost: light of
/// VPLs nearby, whose blotches a pixel shows, is left to paths, whose noise the pixels around take
/// off.
///
/// Measured: relMSE of the indirect light against a path tracer's, and nRMSE of tiles (%), Cornell
/// boxes lit from above and upwards, 512², B = 2, `both`, means of two or three seeds:
///
/// | light paths | bound | above | | upwards | |
/// | --- | --- | --- | --- | --- | --- |
/// | 2000 | 1/30 | .0020 | 4.2 | .0043 | 2.4 |
/// | | 1/60 | .0018 | 3.5 | .0042 | 2.1 |
/// | | 1/120 | .0020 | 3.0 | .0046 | 2.1 |
/// | 8000 | lost, 1 | .0040 | 4.5 | .0078 | 3.8 |
/// | | 1/32 | .0016 | 2.4 | .0039 | 2.0 |
/// | | 1/64 | .0014 | 2.0 | .0038 | 1.9 |
/// | | 1/127 | .0014 | 1.8 | .0038 | 1.7 |
/// | 32000 | 1/32 | .0012 | 1.6 | .0037 | 1.6 |
/// | | 1/64 | .0011 | 1.4 | .0035 | 1.5 |
/// | | 1/125 | .0011 | 1.3 | .0035 | 1.4 |
///
/// Where light stays lost that paths from the camera do not find, the bound is not lowered: no image
/// is darker for it.
const COMPENSATED: f32 = 1.0 / 64.0;

/// Bounds on G in normalised units that differ from no bound, and from no light, at any distance of
/// places in f32; shaders compute with their inverse and square.
const BOUNDS: [f64; 2] = [1e-18, 1e18];

/// The bound in normalised units; none when it is off or there are no VPLs.
pub fn of(scene: &Scene, settings: &Settings, vpls: &[Vpl]) -> Option<f32> {
    let scale = scene.units.scale;
    let given_back = settings.compensates() && !scene.has_hidden_caustics();
    match settings.clamp {
        _ if vpls.is_empty() => None,
        Clamp::Off => None,
        Clamp::At(bound) => Some((bound * scale * scale).clamp(BOUNDS[0], BOUNDS[1]) as f32),
        Clamp::Auto => density_bound(vpls, scene)
            .map(|bound| if given_back { bound * COMPENSATED } else { bound }),
    }
}
