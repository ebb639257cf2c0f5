//! Lights on the device that points gather: VPLs, or places on the light sources.

use bytemuck::Zeroable;
use glam::Vec3;

use crate::cluster::morton;
use crate::gpu::{GlossyVplRecord, GpuError, Texture, VplRecord};
use crate::render::clusters::VplClusters;
use crate::render::kernels::Emitter;
use crate::render::prepared::Prepared;
use crate::render::virtual_light::{GlossyLobe, VirtualLight};

/// Lights that points gather.
#[derive(Debug)]
pub struct LightSet {
    /// What they are.
    pub emitter: Emitter,
    /// How many there are.
    pub count: u32,
    /// Subset after subset, each filled up to whole words.
    pub buffer: wgpu::Buffer,
    /// Words of 32 in each subset.
    pub words: u32,
    /// How many subsets there are; a point gathers one.
    pub subsets: u32,
    /// The bound on G, in normalised units.
    pub bound: Option<f32>,
    /// The clusters whose visibility they share, if they do.
    pub columns: Option<Columns>,
}

/// Clusters of VPLs that share visibility.
#[derive(Debug)]
pub struct Columns {
    /// Words of 32 of them.
    pub words: u32,
    /// What shadow rays are traced to, filled up to whole words.
    pub buffer: wgpu::Buffer,
    /// The cluster of each VPL, filled up to whole words.
    pub of_vpls: Texture,
}

/// The name by which shaders know lights that points gather.
pub const VPL_BUFFER: &str = "vpls";

/// Uploads lights in their order.
///
/// # Errors
/// The device refuses.
pub fn table(prepared: &Prepared, lights: &[VirtualLight]) -> Result<wgpu::Buffer, GpuError> {
    let order: Vec<_> = (0..lights.len() as u32).map(Some).collect();
    upload(prepared, "VPLs by bounces", lights, &order, 1.0)
}

impl LightSet {
    /// Uploads VPLs, dealt out to so many subsets; none if there are none.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &Prepared,
        lights: &[VirtualLight],
        columns: Option<&VplClusters>,
        bound: Option<f32>,
        subsets: u32,
    ) -> Result<Option<Self>, GpuError> {
        if lights.is_empty() {
            return Ok(None);
        }
        let order = deal(&curve(lights), subsets as usize);
        let buffer = upload(prepared, "VPLs", lights, &order, subsets as f32)?;
        let columns =
            columns.map(|clusters| Columns::new(prepared, clusters, &order)).transpose()?;
        let words = (order.len() / 32) as u32 / subsets;
        let (count, emitter) = (lights.len() as u32, Emitter::Surface);
        Ok(Some(Self { emitter, count, words, subsets, buffer, bound, columns }))
    }

    /// Uploads lights for direct light; none if there are none.
    ///
    /// # Errors
    /// The device refuses.
    pub fn direct(
        prepared: &Prepared,
        emitter: Emitter,
        lights: &[VirtualLight],
    ) -> Result<Option<Self>, GpuError> {
        let set = Self::new(prepared, lights, None, None, 1)?;
        Ok(set.map(|set| Self { emitter, ..set }))
    }
}

impl Columns {
    fn new(
        prepared: &Prepared,
        clusters: &VplClusters,
        vpls: &[Option<u32>],
    ) -> Result<Self, GpuError> {
        let curve = curve(&clusters.lights);
        let order = deal(&curve, 1);
        let mut column_of = vec![0; curve.len()];
        for (column, &cluster) in (0..).zip(&curve) {
            column_of[cluster as usize] = column;
        }
        let of_vpl = |vpl: u32| column_of[clusters.of_lights[vpl as usize] as usize];
        let of_vpls: Vec<u32> = vpls.iter().map(|vpl| vpl.map_or(0, of_vpl)).collect();
        Ok(Self {
            words: (order.len() / 32) as u32,
            buffer: upload(prepared, "VPL clusters", &clusters.lights, &order, 1.0)?,
            of_vpls: prepared.gpu.texture_of("column_of", &of_vpls)?,
        })
    }
}

/// The order along a Morton curve, so that neighbours in a word are neighbours in space; first
/// by the side that they face, as lights that face away from a point are skipped together.
fn curve(lights: &[VirtualLight]) -> Vec<u32> {
    let place = within(lights.iter().map(|light| light.position));
    let mut order: Vec<u32> = (0..lights.len() as u32).collect();
    order.sort_by_cached_key(|&index| {
        let VirtualLight { position, normal, .. } = lights[index as usize];
        let axis = normal.abs().max_position();
        (2 * axis + usize::from(normal[axis] < 0.0), morton(place(position)), index)
    });
    order
}

/// Positions within [-2, 2] by their places among all, so that the cells of the curve, which decide
/// what subsets lights are dealt to, fit the lights, and not the scene around them.
fn within(positions: impl Iterator<Item = Vec3> + Clone) -> impl Fn(Vec3) -> Vec3 {
    let low = positions.clone().fold(Vec3::INFINITY, Vec3::min);
    let high = positions.fold(Vec3::NEG_INFINITY, Vec3::max);
    let extent = (high - low).max_element().max(f32::MIN_POSITIVE);
    // Neither middles nor quarters are on borders of cells, where rounding decides.
    move |position| (position - low) / extent * 2.9 - 1.618_034
}

/// Deals an order out to subsets, so that each is spread along it, and fills each up to whole
/// words of 32.
fn deal(order: &[u32], subsets: usize) -> Vec<Option<u32>> {
    let each = order.len().div_ceil(subsets).next_multiple_of(32);
    let mut dealt = Vec::with_capacity(subsets * each);
    for first in 0..subsets {
        let subset = order.iter().skip(first).step_by(subsets);
        dealt.extend(subset.copied().map(Some));
        dealt.resize((first + 1) * each, None);
    }
    dealt
}

/// Uploads the lights in an order, `scale` times as bright; where it has none, one of no
/// intensity. Where no surface is glossy, records have no room for it.
fn upload(
    prepared: &Prepared,
    label: &str,
    lights: &[VirtualLight],
    order: &[Option<u32>],
    scale: f32,
) -> Result<wgpu::Buffer, GpuError> {
    fn records<T: bytemuck::Pod>(
        lights: &[VirtualLight],
        order: &[Option<u32>],
        record: impl Fn(&VirtualLight) -> T,
    ) -> Vec<T> {
        let of_index = |index: u32| record(&lights[index as usize]);
        order.iter().map(|index| index.map_or_else(T::zeroed, of_index)).collect()
    }
    let gpu = &prepared.gpu;
    match prepared.features.phong {
        true => gpu.storage_of(label, &records(lights, order, |light| glossy(light, scale))),
        false => gpu.storage_of(label, &records(lights, order, |light| diffuse(light, scale))),
    }
}

fn diffuse(light: &VirtualLight, scale: f32) -> VplRecord {
    let intensity = light.intensity * scale;
    VplRecord {
        position: light.position.to_array(),
        pad0: 0.0,
        normal: light.normal.to_array(),
        pad1: 0.0,
        intensity: intensity.to_array(),
        mean: intensity.element_sum() / 3.0,
    }
}

fn glossy(light: &VirtualLight, scale: f32) -> GlossyVplRecord {
    let VplRecord { position, normal, intensity, mean, .. } = diffuse(light, scale);
    let plain = GlossyVplRecord { position, normal, intensity, mean, ..Zeroable::zeroed() };
    let Some(GlossyLobe { specular, shininess, mirrored, .. }) = light.gloss else { return plain };
    let specular = specular * scale;
    GlossyVplRecord {
        shininess,
        peak: 0.5 * shininess + 1.0,
        specular: specular.to_array(),
        specular_mean: specular.element_sum() / 3.0,
        mirrored: mirrored.to_array(),
        ..plain
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_of_lights_does_not_depend_on_their_scale() {
        let at = |i: u32, scale: f32| {
            let [x, y, z] = [7, 11, 13].map(|prime| ((i * prime) % 31) as f32 / 15.0 - 1.0);
            VirtualLight::diffuse(scale * Vec3::new(x, y, z), Vec3::Z, Vec3::ONE)
        };
        let order = |scale| curve(&(0..200).map(|i| at(i, scale)).collect::<Vec<_>>());
        assert_eq!(order(1.0), order(0.53));
        assert_ne!(order(1.0), (0..200).collect::<Vec<_>>());
        // Lights in one place have no extent.
        assert_eq!(curve(&[at(3, 1.0), at(3, 1.0)]), [0, 1]);
    }
}
