//! The light sources as tables to draw from, for direct light and for light paths.

mod area;
mod bounds;
mod delta;
mod directional;
mod environment;
mod far;
mod kind;
mod near;
mod point;
mod sphere;
mod start;
mod starts;
mod strata;
mod table;

use std::f64::consts::PI;

use glam::Vec3;

use super::settings::Settings;
use super::virtual_light::VirtualLight;
use crate::bvh::Bvh;
use crate::gpu::{
    AreaLightRecord, DeltaLightRecord, DirectionalLightRecord, Gpu, GpuError, PointLightRecord,
    SphereLightRecord, SpotLightRecord, Texture,
};
use crate::scene::Scene;

pub use bounds::Bounds;
pub use environment::EnvironmentLight;
pub use far::FarLight;
pub use kind::LightKind;
pub use start::Start;
pub use strata::LightStrata;
pub use table::Table;

/// Lights without extent that have a ray each, which leaves no noise; more join the choice among the
/// others. Guide and filter take as long as some 12 rays a pixel through a hierarchy, and as some 60
/// against literals.
const MOST_EXACT: u32 = 8;

/// All lights of a scene.
#[derive(Debug, Clone, Default)]
pub struct Lights {
    /// Emitting triangles.
    pub area: Table<AreaLightRecord>,
    /// The triangles that they are, by their indices in the scene.
    pub emitters: Vec<u32>,
    /// Emitting spheres.
    pub sphere: Table<SphereLightRecord>,
    /// Lights without extent that shine in all directions.
    pub point: Table<PointLightRecord>,
    /// Those that shine into a cone.
    pub spot: Table<SpotLightRecord>,
    /// Lights infinitely far away.
    pub directional: Table<DirectionalLightRecord>,
    /// Light from all directions, if it is not black.
    pub environment: Option<EnvironmentLight>,
    /// Where those shine.
    bounds: Bounds,
}

impl Lights {
    /// The lights of a scene.
    pub fn of(scene: &Scene) -> Self {
        let bounds = Bounds::of(scene);
        Self {
            area: area::triangles(scene),
            emitters: scene.emitters().collect(),
            sphere: sphere::spheres(scene),
            point: point::points(scene),
            spot: point::spots(scene),
            directional: directional::directional(scene, &bounds),
            environment: EnvironmentLight::of(scene, &bounds),
            bounds,
        }
    }

    /// Whether emitting triangles are near to surfaces that they shine on.
    pub fn any_near(&self, bvh: &Bvh) -> bool {
        near::any_near(bvh, &self.area.records)
    }

    /// How many lights of a kind there are.
    pub fn count(&self, kind: LightKind) -> u32 {
        let count = match kind {
            LightKind::Point => self.point.records.len(),
            LightKind::Spot => self.spot.records.len(),
            LightKind::Directional => self.directional.records.len(),
            LightKind::Area => self.area.records.len(),
            LightKind::Sphere => self.sphere.records.len(),
            LightKind::Environment => usize::from(self.environment.is_some()),
        };
        count as u32
    }

    /// How many lights of all kinds there are.
    pub fn all(&self) -> usize {
        LightKind::ALL.map(|kind| self.count(kind) as usize).iter().sum()
    }

    /// Flux of all lights of a kind, mean of the channels.
    pub fn power(&self, kind: LightKind) -> f64 {
        match kind {
            LightKind::Point => self.point.power,
            LightKind::Spot => self.spot.power,
            LightKind::Directional => self.directional.power,
            LightKind::Area => self.area.power,
            LightKind::Sphere => self.sphere.power,
            LightKind::Environment => self.environment.as_ref().map_or(0.0, |light| light.power),
        }
    }

    /// The kinds of which there are lights.
    pub fn kinds(&self) -> impl Iterator<Item = LightKind> + '_ {
        LightKind::ALL.into_iter().filter(|&kind| self.count(kind) > 0)
    }

    /// The lights of a kind without extent on the device; none of others.
    ///
    /// # Errors
    /// They do not fit.
    pub fn upload_exact(
        &self,
        gpu: &Gpu,
        kind: LightKind,
    ) -> Result<Option<wgpu::Buffer>, GpuError> {
        let table = match kind {
            LightKind::Point => gpu.storage_of("point lights", &self.point.records),
            LightKind::Spot => gpu.storage_of("spot lights", &self.spot.records),
            LightKind::Directional => {
                gpu.storage_of("directional lights", &self.directional.records)
            }
            LightKind::Area | LightKind::Sphere | LightKind::Environment => return Ok(None),
        };
        table.map(Some)
    }

    /// The lights of a kind of some extent on the device: their number in a texel, then the lights; the
    /// environment by its words. None of other kinds.
    ///
    /// # Errors
    /// They do not fit.
    pub fn upload_extended(&self, gpu: &Gpu, kind: LightKind) -> Result<Option<Texture>, GpuError> {
        let counted = |count: usize, lights: &[u8]| {
            [&(count as u32).to_ne_bytes()[..], &[0; 12], lights].concat()
        };
        let area = &self.area.records;
        let sphere = &self.sphere.records;
        let table = match kind {
            LightKind::Area => {
                gpu.texture_of("area_lights", &counted(area.len(), bytemuck::cast_slice(area)))
            }
            LightKind::Sphere => gpu
                .texture_of("sphere_lights", &counted(sphere.len(), bytemuck::cast_slice(sphere))),
            LightKind::Environment => {
                let words = self.environment.as_ref().map_or(Vec::new(), EnvironmentLight::words);
                gpu.texture_of("environment", &words)
            }
            LightKind::Point | LightKind::Spot | LightKind::Directional => return Ok(None),
        };
        table.map(Some)
    }

    /// The probability density, by area, of a place on an area light, over the mean of its radiance
    /// and the number of its sides; 0 without area lights.
    pub fn area_density(&self) -> f32 {
        if self.area.records.is_empty() { 0.0 } else { (PI / self.area.power) as f32 }
    }

    /// The probability of an emitting sphere over its mean radiance, its sides and its squared radius;
    /// 0 without emitting spheres.
    pub fn solid_density(&self) -> f32 {
        let power = self.sphere.power;
        if power > 0.0 { (4.0 * PI * PI / power) as f32 } else { 0.0 }
    }

    /// The densities with which light samples of these kinds are taken to be drawn, see
    /// `shaders/direct/params.wgsl`: of area lights, of emitting spheres and of the environment.
    pub fn densities(&self, kinds: &[LightKind]) -> [f32; 3] {
        let sky = |light: &EnvironmentLight| 1.0 / light.radiance_integral as f32;
        [
            (LightKind::Area, self.area_density()),
            (LightKind::Sphere, self.solid_density()),
            (LightKind::Environment, self.environment.as_ref().map_or(0.0, sky)),
        ]
        .map(|(kind, density)| if kinds.contains(&kind) { density } else { 0.0 })
    }

    /// Parts kinds into those whose lights have a ray each from every point, and those of which a few
    /// samples are drawn: lights of some extent, and all others if they are many.
    pub fn part(
        &self,
        kinds: impl Iterator<Item = LightKind>,
        settings: &Settings,
    ) -> [Vec<LightKind>; 2] {
        let (exact, mut sampled): (Vec<_>, Vec<_>) = kinds.partition(|kind| kind.is_exact());
        let count: u32 = exact.iter().map(|&kind| self.count(kind)).sum();
        if count <= MOST_EXACT || !settings.few_light_samples() {
            return [exact, sampled];
        }
        sampled.extend(exact);
        [vec![], sampled]
    }

    /// The lights without extent of these kinds, in the order of their strata.
    pub fn delta(&self, kinds: &[LightKind]) -> Vec<DeltaLightRecord> {
        let has = |kind| kinds.contains(&kind);
        let points = self.point.records.iter().filter(|_| has(LightKind::Point));
        let spots = self.spot.records.iter().filter(|_| has(LightKind::Spot));
        let far = self.directional.records.iter().filter(|_| has(LightKind::Directional));
        let mut lights: Vec<_> = points.map(delta::of_point).collect();
        lights.extend(spots.map(delta::of_spot));
        lights.extend(far.map(delta::of_directional));
        delta::order(&mut lights);
        lights
    }

    /// The strata of the lights of these kinds: many to be guided by, or one a kind.
    pub fn strata(&self, kinds: &[LightKind], guided: bool) -> LightStrata {
        let even = self.environment.as_ref().is_some_and(EnvironmentLight::is_even);
        if !guided {
            return LightStrata::plain(kinds, even);
        }
        let counts: Vec<_> = kinds.iter().map(|&kind| (kind, self.count(kind))).collect();
        LightStrata::of(&counts, even)
    }

    /// Whether any surface emits.
    pub fn have_surfaces(&self) -> bool {
        self.count(LightKind::Area) + self.count(LightKind::Sphere) > 0
    }

    /// `count` places on the area lights, as lights that together give the light of all.
    pub fn places(&self, scene: &Scene, count: u32, seed: u32) -> Vec<VirtualLight> {
        area::places(scene, &self.area, &self.emitters, count, seed)
    }

    /// The point lights, as lights without a surface.
    pub fn points(&self) -> Vec<VirtualLight> {
        let light = |light: &PointLightRecord| {
            let [position, intensity] = [light.position, light.intensity].map(Vec3::from_array);
            VirtualLight::diffuse(position, Vec3::ZERO, intensity)
        };
        self.point.records.iter().map(light).collect()
    }
}
