//! Lights on the device that points gather: VPLs, or places on the light sources.

use bytemuck::Zeroable;

use super::members::{Draws, Members};
use crate::gpu::{GlossyVplRecord, Gpu, GpuError, Texture, VplRecord};
use crate::render::clusters::VplClusters;
use crate::render::kernels::Emitter;
use crate::render::prepared::Prepared;
use crate::render::virtual_light::{GlossyLobe, VirtualLight, curve};
use crate::render::vpls::GeometryBound;

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
    pub bounded: bool,
    /// The clusters whose visibility they share, if they do.
    pub columns: Option<Columns>,
}

/// Clusters of VPLs that share visibility.
#[derive(Debug)]
pub struct Columns {
    /// Words of 32 of them.
    pub words: u32,
    /// What shadow rays are traced to.
    pub ends: ColumnEnds,
    /// The cluster of each VPL, filled up to whole words.
    pub of_vpls: Texture,
    /// The place of the column of each cluster.
    pub of_clusters: Vec<u32>,
}

/// What shadow rays to clusters of VPLs are traced to.
#[derive(Debug)]
pub enum ColumnEnds {
    /// One light for each cluster, filled up to whole words.
    Representatives(wgpu::Buffer),
    /// The member that a row draws.
    Members(Members),
}

/// Clusters of VPLs whose visibility those share.
#[derive(Debug, Clone, Copy)]
pub struct SharedColumns<'a> {
    /// The clusters.
    pub clusters: &'a VplClusters,
    /// How each row draws a member of each; none where their lights stand for them.
    pub draws: Option<Draws<'a>>,
}

/// Lights in their order, in a table.
///
/// # Errors
/// The device refuses.
pub fn table(
    prepared: &Prepared,
    lights: &[VirtualLight],
    bound: Option<&GeometryBound>,
) -> Result<Texture, GpuError> {
    fn of<T: bytemuck::Pod>(
        gpu: &Gpu,
        lights: &[VirtualLight],
        record: impl Fn(&VirtualLight) -> T,
    ) -> Result<Texture, GpuError> {
        gpu.texture_of("vpl_table", &lights.iter().map(record).collect::<Vec<_>>())
    }
    match prepared.features.phong {
        true => of(&prepared.gpu, lights, |light| glossy(light, 1.0, bound)),
        false => of(&prepared.gpu, lights, |light| diffuse(light, 1.0, bound)),
    }
}

impl LightSet {
    /// Uploads VPLs, dealt out to so many subsets; none if there are none.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &Prepared,
        lights: &[VirtualLight],
        columns: Option<SharedColumns<'_>>,
        bound: Option<&GeometryBound>,
        subsets: u32,
    ) -> Result<Option<Self>, GpuError> {
        if lights.is_empty() {
            return Ok(None);
        }
        let order = deal(&curve(lights), subsets as usize);
        let buffer = upload(prepared, "VPLs", lights, &order, subsets as f32, bound)?;
        let columns = columns.map(|of| Columns::new(prepared, of, lights, &order));
        let columns = columns.transpose()?;
        let words = (order.len() / 32) as u32 / subsets;
        let (count, emitter) = (lights.len() as u32, Emitter::Surface);
        Ok(Some(Self { emitter, count, words, subsets, buffer, bounded: bound.is_some(), columns }))
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
        SharedColumns { clusters, draws }: SharedColumns<'_>,
        lights: &[VirtualLight],
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
        // Of clusters of one there is nothing to draw.
        let ends = match draws.filter(|_| clusters.lights.len() < lights.len()) {
            Some(draws) => {
                let of_lights: Vec<u32> = (0..lights.len() as u32).map(of_vpl).collect();
                let columns = order.len();
                let members = Members::new(prepared, lights, draws, &of_lights, columns)?;
                ColumnEnds::Members(members)
            }
            None => {
                let lights = &clusters.lights;
                let buffer = upload(prepared, "VPL clusters", lights, &order, 1.0, None)?;
                ColumnEnds::Representatives(buffer)
            }
        };
        Ok(Self {
            words: (order.len() / 32) as u32,
            ends,
            of_vpls: prepared.gpu.texture_of("column_of", &of_vpls)?,
            of_clusters: column_of,
        })
    }
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
    bound: Option<&GeometryBound>,
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
        true => gpu.storage_of(label, &records(lights, order, |light| glossy(light, scale, bound))),
        false => {
            gpu.storage_of(label, &records(lights, order, |light| diffuse(light, scale, bound)))
        }
    }
}

fn diffuse(light: &VirtualLight, scale: f32, bound: Option<&GeometryBound>) -> VplRecord {
    let intensity = light.intensity * scale;
    VplRecord {
        position: light.position.to_array(),
        pad0: 0.0,
        normal: light.normal.to_array(),
        bound: bound.map_or(0.0, |bound| bound.at(light.position, light.normal)),
        intensity: intensity.to_array(),
        mean: intensity.element_sum() / 3.0,
    }
}

fn glossy(light: &VirtualLight, scale: f32, bound: Option<&GeometryBound>) -> GlossyVplRecord {
    let VplRecord { position, normal, intensity, mean, bound, .. } = diffuse(light, scale, bound);
    let plain = GlossyVplRecord { position, normal, intensity, mean, bound, ..Zeroable::zeroed() };
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
