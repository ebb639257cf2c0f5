//! Interleaved sampling (Keller and Heidrich, "Interleaved Sampling", 2001): a pixel gathers
//! one of s² subsets of the VPLs, by its place modulo s, and shares what it has gathered with
//! the pixels around it that see the same surface.

use std::time::Duration;

use rayon::prelude::*;

use crate::gpu::{GpuError, InterleaveParams, PointRecord, Program, TableFormat};
use crate::render::camera::{BLOCK, Tile, Tiling, pixel_of, point_of};
use crate::render::kernels;
use crate::render::prepared::Prepared;
use crate::render::settings::Settings;
use crate::render::stage::{Named, NamedTexture, Stage};

/// Which pixels of a tile gather which subset of the VPLs, and their order: subset after
/// subset, each as the image of its pixels alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Subsets {
    s: u32,
    width: u32,
    height: u32,
    subset_width: u32,
    points: u32,
    rotation: u32,
}

impl Subsets {
    /// Of a tile of whole rows of blocks.
    fn of(s: u32, across: u32, blocks: u32, sample: u32) -> Self {
        let [width, height] = [across, blocks / across].map(|blocks| 8 * blocks);
        let subset_width = width.div_ceil(s);
        let points = subset_width.div_ceil(8) * height.div_ceil(s).div_ceil(8) * BLOCK;
        // 11 is coprime to s² for every s up to 8: a pixel's samples go through all subsets.
        let rotation = sample.wrapping_mul(11) % (s * s);
        Self { s, width, height, subset_width, points, rotation }
    }

    /// Points of a subset, some of them perhaps of no pixel.
    pub fn points(&self) -> u32 {
        self.points
    }

    /// Values of the points of a tile, `each` a point, in the order of subsets.
    pub fn split<T: Copy + Default + Send + Sync>(&self, values: &[T], each: usize) -> Vec<T> {
        let mut split = vec![T::default(); (self.s * self.s * self.points) as usize * each];
        split.par_chunks_exact_mut(each).enumerate().for_each(|(place, split)| {
            if let Some(point) = self.point_at(place as u32) {
                let at = point as usize * each;
                split.copy_from_slice(&values[at..at + each]);
            }
        });
        split
    }

    /// The point at a place in the order of subsets; none for no pixel. The twin of
    /// `shaders/gather/split_subsets.wgsl`.
    fn point_at(&self, place: u32) -> Option<u32> {
        let subsets = self.s * self.s;
        let class = (place / self.points + subsets - self.rotation) % subsets;
        let [x, y] = pixel_of(place % self.points, 0, self.subset_width);
        let [x, y] = [self.s * x + class % self.s, self.s * y + class / self.s];
        (x < self.width && y < self.height).then(|| point_of([x, y], self.width))
    }

    fn params(&self) -> InterleaveParams {
        InterleaveParams {
            width: self.width,
            height: self.height,
            s: self.s,
            rotation: self.rotation,
            subset_width: self.subset_width,
            subset_points: self.points,
            points: self.s * self.s * self.points,
            axis: 0,
        }
    }
}

/// The stages of interleaved sampling: points into the order of subsets, and what they have
/// gathered back.
#[derive(Debug)]
pub struct Interleave {
    s: u32,
    across: u32,
    /// Points, and their irradiance, in the order of subsets.
    points: wgpu::Buffer,
    irradiance: wgpu::Buffer,
    /// Which probes each point of the tile sees.
    signatures: Option<wgpu::Buffer>,
    split: Stage,
    join: Stage,
    /// Along rows, then along columns.
    discontinuity_buffer: [Stage; 2],
}

impl Interleave {
    /// For tiles of `tiling`; `tile` are their buffers, `combined` is what is written at last;
    /// `probed` is whether points have signatures.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &Prepared,
        tiling: &Tiling,
        tile: &[Named<'_>],
        combined: &wgpu::Buffer,
        settings: &Settings,
    ) -> Result<Self, GpuError> {
        let (gpu, target) = (&prepared.gpu, prepared.target());
        let (s, probed) = (settings.interleave, settings.probes());
        let lobes = target.lobes();
        let most = (s * s * most_points(s, tiling)) as usize;
        let points = gpu.storage::<PointRecord>("interleaved points", most)?;
        let irradiance = gpu.storage::<[f32; 4]>("interleaved irradiance", most * lobes)?;
        let pixels = tiling.most_points() as usize;
        let signatures = probed.then(|| gpu.storage::<u32>("signatures", pixels)).transpose()?;
        let table = |name, texels| gpu.table(name, texels, TableFormat::Quadruples);
        let surfaces = table("surfaces", pixels)?;
        let gathered = table("gathered irradiance", pixels * lobes)?;
        let half = table("half combined irradiance", pixels * lobes)?;
        let own = [("split_points", &points), ("irradiance", &irradiance)];
        // The first buffer of a name counts.
        let mut buffers = [&own[..], tile].concat();
        buffers.extend(signatures.as_ref().map(|signatures| ("signatures", signatures)));
        let bind = |program: &Program, buffers: &[Named<'_>], textures: &[NamedTexture<'_>]| {
            Stage::with_textures(prepared, program, buffers, textures)
        };
        let split = bind(&kernels::split_subsets(), &buffers, &[])?;
        let join = kernels::join_subsets(target, probed, settings.filters_compensation());
        let to_tables = [("packed_surfaces", &surfaces), ("stored_light", &gathered)];
        let join = bind(&join, &buffers, &to_tables)?;
        let combine = |light, last, buffers: &[Named<'_>], to: &[NamedTexture<'_>]| {
            let from = [("surface_table", &surfaces), ("light", light)];
            bind(&kernels::discontinuity_buffer(target, last), buffers, &[&from[..], to].concat())
        };
        let discontinuity_buffer = [
            combine(&gathered, false, &[], &[("stored_light", &half)])?,
            combine(&half, true, &[("irradiance", combined)], &[])?,
        ];
        let across = tiling.across();
        Ok(Self { s, across, points, irradiance, signatures, split, join, discontinuity_buffer })
    }

    /// Points of a subset of a tile, at most.
    pub fn most_points(&self, tiling: &Tiling) -> u32 {
        most_points(self.s, tiling)
    }

    /// Where VPLs are gathered: these buffers instead of the tile's.
    pub fn named(&self) -> [Named<'_>; 2] {
        [("points", &self.points), ("irradiance", &self.irradiance)]
    }

    /// Tells which probes the points of a tile see.
    ///
    /// # Errors
    /// The device fails.
    pub fn set_signatures(&self, prepared: &Prepared, seen: &[u32]) -> Result<(), GpuError> {
        match &self.signatures {
            Some(signatures) => prepared.gpu.write(signatures, seen),
            None => Ok(()),
        }
    }

    /// The subsets of a tile.
    pub fn subsets(&self, tile: Tile) -> Subsets {
        Subsets::of(self.s, self.across, tile.blocks, tile.sample)
    }

    /// Brings the visible points of a tile into the order of subsets, and clears what they have
    /// gathered.
    ///
    /// # Errors
    /// The device fails.
    pub fn split(&self, prepared: &Prepared, tile: Tile) -> Result<Duration, GpuError> {
        let params = self.subsets(tile).params();
        prepared.gpu.clear(&[&self.irradiance])?;
        self.split.run(prepared, &params, [params.points.div_ceil(BLOCK), 1])
    }

    /// Combines what the pixels around a pixel have gathered into its irradiance.
    ///
    /// # Errors
    /// The device fails.
    pub fn join(&self, prepared: &Prepared, tile: Tile) -> Result<Duration, GpuError> {
        let params = self.subsets(tile).params();
        let mut time = self.join.run(prepared, &params, [tile.blocks, 1])?;
        for (axis, stage) in (0..).zip(&self.discontinuity_buffer) {
            let params = InterleaveParams { axis, ..params };
            time += stage.run(prepared, &params, [tile.blocks, 1])?;
        }
        Ok(time)
    }
}

fn most_points(s: u32, tiling: &Tiling) -> u32 {
    Subsets::of(s, tiling.across(), tiling.most_points() / BLOCK, 0).points
}

#[cfg(test)]
mod tests {
    use bytemuck::Zeroable;

    use super::*;
    use crate::gpu::{AdapterChoice, Dispatch, Gpu};
    use crate::render::features::Target;

    #[test]
    fn every_point_is_in_one_subset() {
        for s in 1..=8 {
            for sample in 0..3 {
                let subsets = Subsets::of(s, 5, 15, sample);
                let points: Vec<u32> = (1..=15 * BLOCK).collect();
                let split = subsets.split(&points, 1);
                let mut found: Vec<u32> = split.iter().copied().filter(|&p| p > 0).collect();
                found.sort_unstable();
                assert_eq!(found, points, "s = {s}");
            }
        }
    }

    /// Points go into the order of subsets as on the host, and their values come back to the
    /// pixels that they are from, for every sample.
    #[test]
    fn what_the_device_splits_it_joins_again() {
        let gpu = Gpu::open(&AdapterChoice::Auto).unwrap();
        let split = gpu.compile(&kernels::split_subsets()).unwrap();
        let plain = Target::plain(true);
        let join = gpu.compile(&kernels::join_subsets(plain, false, false)).unwrap();
        let combine = gpu.compile(&kernels::discontinuity_buffer(plain, true)).unwrap();
        for (s, sample) in [(2, 0), (2, 1), (3, 1), (4, 3), (8, 5)] {
            let subsets = Subsets::of(s, 5, 15, sample);
            let params = subsets.params();
            let named =
                |surface| PointRecord { surface, normal: [0.0, 0.0, 1.0], ..PointRecord::zeroed() };
            let records: Vec<_> = (0..15 * BLOCK).map(named).collect();
            let params_buffer = gpu.parameters::<InterleaveParams>("params").unwrap();
            gpu.write(&params_buffer, &[params]).unwrap();
            let points = gpu.storage_of("points", &records).unwrap();
            let split_points =
                gpu.storage::<PointRecord>("split_points", params.points as usize).unwrap();
            let buffers =
                [("params", &params_buffer), ("points", &points), ("split_points", &split_points)];
            let bindings = gpu.bind(&split, &buffers).unwrap();
            let workgroups = [params.points.div_ceil(BLOCK), 1];
            gpu.run(&[Dispatch { kernel: &split, bindings: &bindings, workgroups }]).unwrap();
            let found: Vec<PointRecord> = gpu.read(&split_points, params.points as usize).unwrap();
            let surfaces: Vec<u32> = records.iter().map(|record| record.surface + 1).collect();
            let expected = subsets.split(&surfaces, 1);
            let found: Vec<u32> = found.iter().map(|r| r.surface.wrapping_add(1)).collect();
            assert_eq!(found, expected, "s = {s}, sample {sample}");

            let values: Vec<[f32; 4]> = found.iter().map(|&name| [name as f32; 4]).collect();
            let irradiance = gpu.storage_of("irradiance", &values).unwrap();
            let buffers = [&buffers[..2], &[("irradiance", &irradiance)]].concat();
            let table = |name| gpu.table(name, records.len(), TableFormat::Quadruples).unwrap();
            let [surfaces, gathered] = ["surfaces", "gathered"].map(table);
            let tables = [("packed_surfaces", &surfaces), ("stored_light", &gathered)];
            let bindings = gpu.bind_with(&join, &buffers, &tables).unwrap();
            gpu.run(&[Dispatch { kernel: &join, bindings: &bindings, workgroups: [15, 1] }])
                .unwrap();
            // With one subset, pixels are combined with none but themselves.
            gpu.write(&params_buffer, &[InterleaveParams { s: 1, ..params }]).unwrap();
            let combined = gpu.storage::<[f32; 4]>("combined", records.len()).unwrap();
            let buffers = [("params", &params_buffer), ("irradiance", &combined)];
            let tables = [("surface_table", &surfaces), ("light", &gathered)];
            let bindings = gpu.bind_with(&combine, &buffers, &tables).unwrap();
            gpu.run(&[Dispatch { kernel: &combine, bindings: &bindings, workgroups: [15, 1] }])
                .unwrap();
            let combined: Vec<[f32; 4]> = gpu.read(&combined, records.len()).unwrap();
            for (point, value) in combined.iter().enumerate() {
                assert_eq!(value[0], (point + 1) as f32, "s = {s}, sample {sample}");
            }
        }
    }

    #[test]
    fn neighbours_and_samples_gather_different_subsets() {
        let s = 3;
        let subset_of = |pixel: [u32; 2], sample: u32| {
            let subsets = Subsets::of(s, 5, 15, sample);
            let point = point_of(pixel, 40);
            let place = (0..9 * subsets.points).find(|&p| subsets.point_at(p) == Some(point));
            place.map(|place| place / subsets.points)
        };
        let mut around: Vec<_> = (0..9).map(|i| subset_of([7 + i % 3, 4 + i / 3], 0)).collect();
        around.sort_unstable();
        assert_eq!(around, (0..9).map(Some).collect::<Vec<_>>());
        let mut over_time: Vec<_> = (0..9).map(|sample| subset_of([7, 4], sample)).collect();
        over_time.sort_unstable();
        assert_eq!(over_time, around);
    }
}
