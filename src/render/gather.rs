//! Light from many lights (VPLs, or places on light sources): a bit for each row (a visible
//! point, or the representative of a cluster of them) and each light, then the sum over the
//! lights at every point.

use std::cell::Cell;
use std::ops::Range;
use std::time::{Duration, Instant};

use super::interleave::Subsets;
use super::kernels::{self, Sharing};
use super::light_set::LightSet;
use super::stages::{Named, Stage};
use super::visible::PointClusters;
use super::{Phases, Prepared};
use crate::gpu::{ExpandParams, GpuError, ShadeParams, VisibilityParams};
use crate::sampling::SURFACE_OFFSET;

/// Words of 32 VPLs in a chunk of the bit matrix: 8 MiB for a tile's points. Also fixes the
/// order of the sums, so it is no matter of tuning.
const CHUNK_WORDS: u32 = 32;
/// Shadow rays of a dispatch, at most, where they are fast and where they are slow.
const DISPATCH_RAYS: u32 = 1 << 23;
const DISPATCH_RAYS_LARGE: u32 = 1 << 21;
/// Scenes of more BVH nodes are slow.
const LARGE_SCENE_NODES: usize = 4096;
/// Shadow rays that an invocation traces in a dispatch at first: all of a word, or so many that
/// llvmpipe's bound on the rounds of loops is hardly ever met.
const RAYS_AT_ONCE: u32 = 32;
const RAYS_AT_ONCE_LARGE: u32 = 16;

/// Who has the rows of the bit matrix.
#[derive(Debug)]
enum Rows {
    /// Every point of the tile, traced sample by sample.
    Points,
    /// Clusters of the whole frame, traced once; and which of them the points of a tile are in.
    Clusters { count: u32, of_points: wgpu::Buffer, weights: Option<wgpu::Buffer> },
}

/// Words of a chunk of the bit matrix; they are of one subset of the VPLs.
#[derive(Debug, Clone, Copy)]
struct Run {
    subset: u32,
    first_word: u32,
    words: u32,
}

/// A chunk of the bit matrix, with what writes and reads it.
#[derive(Debug)]
struct Chunk {
    /// Traces its bits, or copies them from the columns.
    fill: Stage,
    shade: Stage,
    bits: wgpu::Buffer,
}

/// Gathers the light of a set of lights.
#[derive(Debug)]
pub struct Gather<'a> {
    prepared: &'a Prepared,
    lights: LightSet,
    rows: Rows,
    /// Traces the columns that VPLs share, if they do.
    columns: Option<Stage>,
    /// One for each chunk of clusters' rows; one that is used again for points'.
    chunks: Vec<Chunk>,
    counter: wgpu::Buffer,
    /// Shadow rays that an invocation traces in a dispatch; halved where a driver cuts their
    /// loops short.
    rays_at_once: Cell<u32>,
}

/// How many shadow rays a dispatch may trace without taking many seconds.
pub fn dispatch_rays(prepared: &Prepared) -> u32 {
    if is_large(prepared) { DISPATCH_RAYS_LARGE } else { DISPATCH_RAYS }
}

fn is_large(prepared: &Prepared) -> bool {
    prepared.bvh.nodes.len() > LARGE_SCENE_NODES
}

/// The chunks of the bit matrix, in order.
fn runs(lights: &LightSet) -> impl Iterator<Item = Run> + use<> {
    let (subsets, all) = (lights.subsets, lights.words);
    (0..subsets).flat_map(move |subset| {
        (0..all).step_by(CHUNK_WORDS as usize).map(move |word| {
            let words = CHUNK_WORDS.min(all - word);
            Run { subset, first_word: subset * all + word, words }
        })
    })
}

impl<'a> Gather<'a> {
    /// For tiles of at most `points` points in a subset, each of which traces its own rays or,
    /// with `clusters`, shares those of its cluster's representative.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &'a Prepared,
        lights: LightSet,
        clusters: Option<&PointClusters>,
        tile: &[Named<'_>],
        points: u32,
    ) -> Result<Self, GpuError> {
        let gpu = &prepared.gpu;
        let counter = gpu.storage::<u32>("ray counter", 3)?;
        let mut common: Vec<Named<'_>> = tile.to_vec();
        common.extend([("vpls", &lights.buffer), ("counter", &counter)]);

        let sharing = match clusters {
            None => Sharing::Own,
            Some(clusters) if clusters.weights.is_none() => Sharing::Cluster,
            Some(_) => Sharing::Fuzzy,
        };
        let (subgroups, bounded) = (gpu.has_subgroups(), lights.bound.is_some());
        let shade = kernels::shade(subgroups, bounded, sharing, lights.emitter);
        let visibility = kernels::visibility_for(prepared, lights.emitter);
        let (rows, rows_count) = match clusters {
            None => (Rows::Points, points),
            Some(clusters) => {
                let (count, shared) = (clusters.representatives.len(), clusters.shared);
                let values = (lights.subsets * points) as usize * shared;
                let of_points = gpu.storage::<u32>("clusters of points", values)?;
                let weights =
                    clusters.weights.as_ref().map(|_| gpu.storage::<f32>("weights", values));
                let weights = weights.transpose()?;
                (Rows::Clusters { count: count as u32, of_points, weights }, count as u32)
            }
        };
        let representatives = clusters
            .map(|clusters| gpu.storage_of("representatives", &clusters.representatives))
            .transpose()?;
        // The first buffer of a name counts.
        let mut tracing: Vec<Named<'_>> = Vec::new();
        tracing.extend(representatives.as_ref().map(|points| ("points", points)));
        let mut shading = common.clone();
        if let Rows::Clusters { of_points, weights, .. } = &rows {
            shading.push(("cluster_of", of_points));
            shading.extend(weights.as_ref().map(|weights| ("weight_of", weights)));
        }

        let matrix = |words: u32| {
            gpu.storage::<u32>("visibility bits", rows_count as usize * words as usize)
        };
        let column_bits = match &lights.columns {
            Some(columns) => Some(matrix(columns.words)?),
            None => None,
        };
        let columns = match (&lights.columns, &column_bits) {
            (Some(columns), Some(bits)) => {
                let buffers = [("vpls", &columns.buffer), ("bits", bits)];
                let buffers = [&tracing[..], &buffers, &common].concat();
                Some(Stage::new(prepared, &visibility, &buffers)?)
            }
            _ => None,
        };
        let chunk = |words: u32| {
            let buffer = matrix(words)?;
            let bits = ("bits", &buffer);
            let fill = match (&lights.columns, &column_bits) {
                (Some(columns), Some(column_bits)) => {
                    let of_vpls = ("column_of", &columns.of_vpls);
                    let buffers = [bits, ("column_bits", column_bits), of_vpls];
                    Stage::new(prepared, &kernels::expand(), &buffers)?
                }
                _ => {
                    let buffers = [&tracing[..], &[bits], &common].concat();
                    Stage::new(prepared, &visibility, &buffers)?
                }
            };
            let shade = Stage::new(prepared, &shade, &[&[bits], &shading[..]].concat())?;
            Ok::<_, GpuError>(Chunk { fill, shade, bits: buffer })
        };
        let chunks = match clusters {
            None => vec![chunk(CHUNK_WORDS.min(lights.words))?],
            Some(_) => runs(&lights).map(|run| chunk(run.words)).collect::<Result<_, _>>()?,
        };
        let rays_at_once = if is_large(prepared) { RAYS_AT_ONCE_LARGE } else { RAYS_AT_ONCE };
        let rays_at_once = Cell::new(rays_at_once);
        Ok(Self { prepared, lights, rows, columns, chunks, counter, rays_at_once })
    }

    /// Traces the rows of the clusters, once a frame; nothing for points. Returns the rays.
    ///
    /// # Errors
    /// The device fails.
    pub fn trace_clusters(
        &self,
        phases: &mut Phases,
        progress: &dyn Fn(f64),
    ) -> Result<u64, GpuError> {
        let Rows::Clusters { count, .. } = self.rows else { return Ok(0) };
        let mut rays = self.trace_columns(count, phases, progress)?;
        for (chunk, run) in self.chunks.iter().zip(runs(&self.lights)) {
            rays += self.fill(chunk, self.visibility_params(count, run), run, phases, progress)?;
        }
        Ok(rays)
    }

    /// Tells which clusters the points of a tile are in: those of a range of the frame's
    /// points, or these in the order of subsets.
    ///
    /// # Errors
    /// The device fails.
    pub fn set_clusters(
        &self,
        clusters: &PointClusters,
        points: Range<usize>,
        subsets: Option<&Subsets>,
    ) -> Result<(), GpuError> {
        let Rows::Clusters { of_points, weights, .. } = &self.rows else { return Ok(()) };
        let (gpu, each) = (&self.prepared.gpu, clusters.shared);
        let range = points.start * each..points.end * each;
        let of_range = &clusters.of_points[range.clone()];
        match subsets {
            Some(subsets) => gpu.write(of_points, &subsets.separate(of_range, each))?,
            None => gpu.write(of_points, of_range)?,
        }
        let (Some(buffer), Some(weights)) = (weights, &clusters.weights) else { return Ok(()) };
        match subsets {
            Some(subsets) => gpu.write(buffer, &subsets.separate(&weights[range], each)),
            None => gpu.write(buffer, &weights[range]),
        }
    }

    /// Adds to the points of a tile, so many a subset, the irradiance of the VPLs of their
    /// subset. Returns the rays traced.
    ///
    /// # Errors
    /// The device fails.
    pub fn gather(
        &self,
        points: u32,
        phases: &mut Phases,
        progress: &dyn Fn(f64),
    ) -> Result<u64, GpuError> {
        let mut rays = match self.rows {
            Rows::Points => self.trace_columns(points, phases, progress)?,
            Rows::Clusters { .. } => 0,
        };
        for (index, run) in runs(&self.lights).enumerate() {
            let first_point = run.subset * points;
            let (chunk, rows) = match self.rows {
                Rows::Clusters { count, .. } => (&self.chunks[index], count),
                Rows::Points => (&self.chunks[0], points),
            };
            if matches!(self.rows, Rows::Points) {
                let params = self.visibility_params(rows, run);
                let params = VisibilityParams { first_point, ..params };
                rays += self.fill(chunk, params, run, phases, progress)?;
            }
            let params = ShadeParams {
                points,
                rows,
                matrix_word: run.first_word,
                words: run.words,
                bound: self.lights.bound.unwrap_or(0.0),
                first_point,
                pad: [0; 2],
            };
            let groups = [self.point_groups(points), 1];
            phases.shading += chunk.shade.run(self.prepared, &params, groups)?;
        }
        Ok(rays)
    }

    /// Which of the first 32 lights the points of a tile see, a bit each; and the rays traced.
    ///
    /// # Errors
    /// The device fails.
    pub fn first_word(
        &self,
        points: u32,
        phases: &mut Phases,
    ) -> Result<(Vec<u32>, u64), GpuError> {
        let run = Run { subset: 0, first_word: 0, words: 1 };
        let (chunk, params) = (&self.chunks[0], self.visibility_params(points, run));
        let params = VisibilityParams { vpls: self.lights.count, ..params };
        let rays = self.trace(&chunk.fill, params, 1, phases, &|_| {})?;
        let start = Instant::now();
        let bits = self.prepared.gpu.read(&chunk.bits, points as usize)?;
        phases.readback += start.elapsed();
        Ok((bits, rays))
    }

    /// Pairs of so many points with the VPLs that each gathers.
    pub fn terms(&self, points: u64) -> u64 {
        points * u64::from(self.lights.count) / u64::from(self.lights.subsets)
    }

    /// Traces the columns that VPLs share, if they do. Returns the rays.
    fn trace_columns(
        &self,
        rows: u32,
        phases: &mut Phases,
        progress: &dyn Fn(f64),
    ) -> Result<u64, GpuError> {
        let (Some(stage), Some(columns)) = (&self.columns, &self.lights.columns) else {
            return Ok(0);
        };
        let run = Run { subset: 0, first_word: 0, words: columns.words };
        self.trace(stage, self.visibility_params(rows, run), run.words, phases, progress)
    }

    /// Writes the bits of a chunk: traces them, or copies them from the columns.
    fn fill(
        &self,
        chunk: &Chunk,
        params: VisibilityParams,
        run: Run,
        phases: &mut Phases,
        progress: &dyn Fn(f64),
    ) -> Result<u64, GpuError> {
        if self.columns.is_none() {
            return self.trace(&chunk.fill, params, run.words, phases, progress);
        }
        let Run { first_word: matrix_word, words, .. } = run;
        let params = ExpandParams { rows: params.rows, matrix_word, words, pad: 0 };
        let groups = [params.rows.div_ceil(64), words];
        phases.visibility += chunk.fill.run(self.prepared, &params, groups)?;
        Ok(0)
    }

    fn visibility_params(&self, rows: u32, run: Run) -> VisibilityParams {
        VisibilityParams {
            rows,
            // What fills the last word up has no normal, and no ray is traced to it.
            vpls: 32 * (run.first_word + run.words),
            first_word: run.first_word,
            matrix_word: run.first_word,
            offset: SURFACE_OFFSET,
            nodes: self.prepared.bvh.nodes.len() as u32,
            first: 0,
            count: 32,
            first_point: 0,
            pad: [0; 3],
        }
    }

    /// Traces the shadow rays of so many words, in dispatches of a bounded number.
    fn trace(
        &self,
        visibility: &Stage,
        params: VisibilityParams,
        words: u32,
        phases: &mut Phases,
        progress: &dyn Fn(f64),
    ) -> Result<u64, GpuError> {
        let start = Instant::now();
        let slice = (dispatch_rays(self.prepared) / (32 * params.rows)).max(1);
        let mut rays = 0;
        for offset in (0..words).step_by(slice as usize) {
            let first_word = params.matrix_word + offset;
            let all = self.lights.words * self.lights.subsets;
            progress(f64::from(first_word) / f64::from(all));
            let groups = [self.point_groups(params.rows), slice.min(words - offset)];
            let params = VisibilityParams { first_word, ..params };
            rays += self.trace_words(visibility, params, groups)?;
        }
        phases.visibility += start.elapsed();
        Ok(rays)
    }

    /// Traces the shadow rays of some words, in as many dispatches as it takes for every loop
    /// to come to its end: some drivers bound the rounds of an invocation's loops. Returns how
    /// many rays there were.
    fn trace_words(
        &self,
        visibility: &Stage,
        params: VisibilityParams,
        groups: [u32; 2],
    ) -> Result<u64, GpuError> {
        let gpu = &self.prepared.gpu;
        loop {
            let count = self.rays_at_once.get();
            gpu.clear(&[&self.counter])?;
            for first in (0..32).step_by(count as usize) {
                let params = VisibilityParams { first, count, ..params };
                let _: Duration = visibility.run(self.prepared, &params, groups)?;
            }
            let counter: Vec<u32> = gpu.read(&self.counter, 3)?;
            match counter[..] {
                [low, high, 0] => return Ok(u64::from(high) << 32 | u64::from(low)),
                _ if count > 1 => self.rays_at_once.set(count / 2),
                _ => return Err(GpuError::LoopCut),
            }
        }
    }

    /// Workgroups for so many points: with subgroups a lane has four.
    fn point_groups(&self, points: u32) -> u32 {
        match self.prepared.gpu.has_subgroups() {
            true => points.div_ceil(4 * 64),
            false => points.div_ceil(64),
        }
    }
}
