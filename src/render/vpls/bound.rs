//! The bound on the geometry term G, which grows without one as a VPL comes near.

use super::density::{Cells, Density};
use super::trace::Vpl;
use std::f64::consts::PI;

use glam::Vec3;

use crate::gpu::{Gpu, GpuError, Texture};
use crate::render::materials::hit::Facet;
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
/// That was with one bound for all VPLs. By the local bound, of 8000 VPLs chosen among 64,000 (relMSE of
/// the image, and seconds of compensation, two seeds): a classroom 1/64 .0113, 2.0 s; 1/16 .0121, 1.1 s;
/// 1/4 .0137, 0.9 s; 1 .0173, 0.9 s. An office behind a door that is ajar .0307, 2.4 s; .0294, 1.3 s;
/// .0366, 0.7 s; .0445, 0.4 s. The Cornell box .0012, 0.6 s; .0012, 0.3 s; .0013, 0.25 s; .0016, 0.2 s.
///
/// Where light stays lost that paths from the camera do not find, the bound is not lowered: no image
/// is darker for it.
const COMPENSATED: f64 = 1.0 / 16.0;

/// No VPL alone gives more irradiance than this share of the mean exitance that it stands for.
///
/// The eighth was measured. Error of the indirect light (nRMSE, and of means of tiles; B = 2,
/// two seeds, with one bound for all VPLs, Cornell boxes lit from above and by a light that faces the ceiling) by the
/// factor in front of π / a:
///
/// | paths | | 1 | 1/2 | 1/4 | 1/8 | 1/16 |
/// | --- | --- | --- | --- | --- | --- | --- |
/// | 2000 | lit from above | .171 | .149 | .134 | .126 | .125 |
/// | | tiles | .092 | .089 | .086 | .086 | .090 |
/// | | energy clamped | .2 % | .4 % | .6 % | .9 % | 1.4 % |
/// | 2000 | lit upwards | .211 | .186 | .159 | .143 | .139 |
/// | | tiles | .090 | .087 | .082 | .078 | .078 |
/// | | energy clamped | .1 % | .2 % | .5 % | .8 % | 1.1 % |
/// | 8000 | lit from above | .119 | .104 | .097 | .093 | .093 |
/// | | tiles | .046 | .046 | .046 | .048 | .053 |
const SHARE: f64 = 1.0 / 8.0;
/// VPLs in the cell that a density is of, at least; in all, at least so many for each of six ways to face.
const NEIGHBOURS: usize = 8;
/// VPLs within less are at one place.
const LEAST_EXTENT: f32 = 1e-6;
/// Bounds on G in normalised units that differ from no bound, and from no light, at any distance of
/// places in f32; shaders compute with their inverse and square.
const BOUNDS: [f64; 2] = [1e-18, 1e18];

/// A bound on the geometry term for every place where light may be reflected.
#[derive(Debug)]
pub struct GeometryBound {
    cells: Cells,
}

impl GeometryBound {
    /// That of the settings; none when it is off or there are no VPLs.
    pub fn of(scene: &Scene, settings: &Settings, vpls: &[Vpl]) -> Option<Self> {
        let scale = scene.units.scale;
        let given_back = settings.compensates() && !scene.has_hidden_caustics();
        let mut cells = match settings.clamp {
            _ if vpls.is_empty() => return None,
            Clamp::Off => return None,
            Clamp::At(bound) => Cells::even(bound * scale * scale),
            Clamp::Auto => {
                let factor = PI * SHARE * if given_back { COMPENSATED } else { 1.0 };
                let mut cells = density(vpls, scene);
                cells.values.iter_mut().for_each(|value| *value *= factor);
                cells
            }
        };
        for value in &mut cells.values {
            *value = value.clamp(BOUNDS[0], BOUNDS[1]);
        }
        Some(Self { cells })
    }

    /// The bound on G, in normalised units, for light that a surface reflects.
    pub fn at(&self, position: Vec3, normal: Vec3) -> f32 {
        self.cells.at(Facet { position, normal }) as f32
    }

    /// The median over VPLs.
    pub fn median(&self, vpls: &[Vpl]) -> f32 {
        let mut all: Vec<f32> = vpls.iter().map(|vpl| self.at(vpl.position, vpl.normal)).collect();
        let middle = all.len() / 2;
        *all.select_nth_unstable_by(middle, f32::total_cmp).1
    }

    /// The least where light is reflected.
    pub fn least(&self) -> f32 {
        let reflects = self.cells.values.iter().copied().filter(|&bound| bound > BOUNDS[0]);
        reflects.fold(BOUNDS[1], f64::min) as f32
    }

    /// The table that the device reads.
    ///
    /// # Errors
    /// The device refuses.
    pub fn upload(&self, gpu: &Gpu) -> Result<Texture, GpuError> {
        gpu.texture_of("bound_cells", &self.cells.words())
    }
}

/// VPLs over area, everywhere: no VPL alone gives more irradiance than [`SHARE`] of the mean exitance
/// that it stands for, b = π / (8 a), with a the area of one VPL around a place. So the bound loosens
/// as VPLs are more, in every scene and everywhere in it, and is tight where they are few.
fn density(vpls: &[Vpl], scene: &Scene) -> Cells {
    let density = Density::of(vpls.iter().map(|vpl| (vpl.facet(), 1.0)));
    if vpls.len() >= 6 * NEIGHBOURS && density.extent().edge > LEAST_EXTENT {
        return density.cells(NEIGHBOURS);
    }
    // Few, or all at one place: they share the whole surface.
    let spheres = scene.spheres.iter().map(|sphere| 4.0 * f64::from(sphere.radius.powi(2)) * PI);
    let areas = scene.triangles.iter().map(|triangle| f64::from(triangle.area())).chain(spheres);
    Cells::even(vpls.len() as f64 / areas.sum::<f64>())
}
