//! The lights of a frame on the device.

use glam::Vec3;

use super::merge::{VirtualLight, VplClusters};
use crate::gpu::{Gpu, GpuError, VplRecord};

/// The VPLs that a frame gathers.
#[derive(Debug)]
pub struct Indirect {
    /// How many there are.
    pub count: u32,
    /// Filled up to whole words.
    pub buffer: wgpu::Buffer,
    /// The bound on G, in normalised units.
    pub bound: Option<f32>,
    /// The clusters whose visibility they share, if they do.
    pub columns: Option<Columns>,
}

/// Clusters of VPLs that share visibility.
#[derive(Debug)]
pub struct Columns {
    /// How many there are.
    pub count: u32,
    /// What shadow rays are traced to, filled up to whole words.
    pub buffer: wgpu::Buffer,
    /// The cluster of each VPL, filled up to whole words.
    pub of_vpls: wgpu::Buffer,
}

impl Indirect {
    /// Uploads lights; none if there are none.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        gpu: &Gpu,
        lights: &[VirtualLight],
        columns: Option<&VplClusters>,
        bound: Option<f32>,
    ) -> Result<Option<Self>, GpuError> {
        if lights.is_empty() {
            return Ok(None);
        }
        let order = curve(lights);
        let buffer = gpu.storage_of("VPLs", &records(lights, &order))?;
        let columns = columns.map(|clusters| Columns::new(gpu, clusters, &order)).transpose()?;
        Ok(Some(Self { count: lights.len() as u32, buffer, bound, columns }))
    }
}

impl Columns {
    fn new(gpu: &Gpu, clusters: &VplClusters, vpls: &[u32]) -> Result<Self, GpuError> {
        let order = curve(&clusters.lights);
        let mut column_of = vec![0; order.len()];
        for (column, &cluster) in (0..).zip(&order) {
            column_of[cluster as usize] = column;
        }
        let mut of_vpls: Vec<u32> =
            vpls.iter().map(|&vpl| column_of[clusters.of_lights[vpl as usize] as usize]).collect();
        of_vpls.resize(vpls.len().next_multiple_of(32), 0);
        Ok(Self {
            count: order.len() as u32,
            buffer: gpu.storage_of("VPL clusters", &records(&clusters.lights, &order))?,
            of_vpls: gpu.storage_of("clusters of VPLs", &of_vpls)?,
        })
    }
}

/// The order along a Morton curve, so that neighbours in a word are neighbours in space.
fn curve(lights: &[VirtualLight]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..lights.len() as u32).collect();
    order.sort_by_key(|&index| (morton(lights[index as usize].position), index));
    order
}

/// The lights in an order, filled up to whole words of 32 with lights of no intensity.
fn records(lights: &[VirtualLight], order: &[u32]) -> Vec<VplRecord> {
    let mut records: Vec<VplRecord> = order
        .iter()
        .map(|&index| {
            let light = &lights[index as usize];
            VplRecord {
                position: light.position.to_array(),
                pad0: 0.0,
                normal: light.normal.to_array(),
                pad1: 0.0,
                intensity: light.intensity.to_array(),
                mean: light.intensity.element_sum() / 3.0,
            }
        })
        .collect();
    records.resize(lights.len().next_multiple_of(32), bytemuck::Zeroable::zeroed());
    records
}

/// Interleaved bits of a position, 21 an axis; normalised coordinates lie within [-2, 2].
pub fn morton(position: Vec3) -> u64 {
    let spread = |x: f32| {
        let cell = ((f64::from(x) + 2.0) / 4.0 * f64::from(1 << 21)).clamp(0.0, 2_097_151.0);
        (0..21).fold(0u64, |sum, bit| sum | ((cell as u64 >> bit & 1) << (3 * bit)))
    };
    spread(position.x) | spread(position.y) << 1 | spread(position.z) << 2
}
