//! Light from many lights (VPLs, or places on light sources): a bit for each row (a visible
//! point, or the representative of a cluster of them) and each light, then the sum over the
//! lights at every point.

use std::ops::Range;

use super::columns::ColumnBits;
use super::correct::Corrections;
use super::interleave::Subsets;
use crate::gpu::{ExpandParams, GpuError, ShadeParams, Texture, VisibilityParams};
use crate::render::camera::Tile;
use crate::render::clusters::PointClusters;
use crate::render::kernels;
use crate::render::prepared::Prepared;
use crate::render::result::Phases;
use crate::render::settings::Sharing;
use crate::render::stage::{Named, Stage};
use crate::render::visibility::{LightSet, Tracer};

/// Words of 32 VPLs in a chunk of the bit matrix: 8 MiB for a tile's points. Also fixes the
/// order of the sums, so it is no matter of tuning.
const CHUNK_WORDS: u32 = 32;
/// Words of the bit matrix in a longer chunk, at most: 64 MiB.
const MATRIX_WORDS: u32 = 1 << 24;

/// Words in a chunk of so many, for so many rows. A sum over many chunks grows with each of them,
/// and its rounding with it, which equal terms all round the same way: of a million VPLs in chunks
/// of 32 words it is off by 1.5e-5. With as many words in a chunk as there are chunks both sums
/// are short.
pub fn chunk_words(words: u32, rows: u32) -> u32 {
    words.isqrt().min(MATRIX_WORDS / rows.max(1)).max(CHUNK_WORDS)
}

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
    /// Corrects what was shared, if that is asked for.
    correct: Option<Stage>,
}

/// Gathers the light of a set of lights.
#[derive(Debug)]
pub struct Gather<'a> {
    prepared: &'a Prepared,
    lights: LightSet,
    rows: Rows,
    /// Traces the columns that VPLs share, if they do.
    columns: Option<ColumnBits>,
    /// One for each chunk of clusters' rows; one that is used again for points'.
    chunks: Vec<Chunk>,
    /// Words of each of them, at most.
    chunk_words: u32,
    tracer: Tracer<'a>,
    corrections: Option<Corrections>,
}

/// What clusters of points see of clusters of VPLs.
#[derive(Debug, Clone, Copy)]
pub struct Sights<'a> {
    /// The bits, as `shaders/visibility/expand.wgsl` reads them.
    pub table: &'a Texture,
    /// Rows, in fours.
    pub quads: u32,
    /// The place of the column of each cluster of VPLs.
    pub of_clusters: &'a [u32],
}

/// The chunks of the bit matrix, in order.
fn runs(lights: &LightSet, chunk_words: u32) -> impl Iterator<Item = Run> + use<> {
    let (subsets, all) = (lights.subsets, lights.words);
    (0..subsets).flat_map(move |subset| {
        (0..all).step_by(chunk_words as usize).map(move |word| {
            let words = chunk_words.min(all - word);
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
        corrections: Option<Corrections>,
    ) -> Result<Self, GpuError> {
        let gpu = &prepared.gpu;
        let tracer = Tracer::new(prepared, lights.words * lights.subsets)?;
        let mut common: Vec<Named<'_>> = tile.to_vec();
        common.push(("vpls", &lights.buffer));

        let sharing = match clusters {
            None => Sharing::Own,
            Some(clusters) if clusters.weights.is_none() => Sharing::Cluster,
            Some(_) => Sharing::Fuzzy,
        };
        let (target, bounded) = (prepared.target(), lights.bounded);
        let shade = kernels::shade(target, bounded, sharing, lights.emitter);
        let correct = kernels::correct(target, bounded, sharing);
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
        let columns = lights.columns.as_ref().map(|columns| {
            let buffers = [&tracing[..], &common].concat();
            ColumnBits::new(prepared, &tracer, lights.emitter, columns, &buffers, rows_count)
        });
        let columns = columns.transpose()?;
        let chunk = |words: u32| {
            let bits = matrix(words)?;
            let bits = ("bits", &bits);
            let fill = match (&lights.columns, &columns) {
                (Some(of), Some(columns)) => {
                    let textures = [("column_bits", &columns.table), ("column_of", &of.of_vpls)];
                    Stage::with_textures(prepared, &kernels::expand(), &[bits], &textures)?
                }
                _ => {
                    let buffers = [&tracing[..], &[bits], &common].concat();
                    tracer.stage(lights.emitter, &buffers)?
                }
            };
            let named = [&[bits], &shading[..]].concat();
            let shade = Stage::new(prepared, &shade, &named)?;
            let correct =
                corrections.map(|_| Stage::new(prepared, &correct, &named)).transpose()?;
            Ok::<_, GpuError>(Chunk { fill, shade, correct })
        };
        let chunk_words = chunk_words(lights.words, rows_count);
        let chunks = match clusters {
            None => vec![chunk(chunk_words.min(lights.words))?],
            Some(_) => {
                runs(&lights, chunk_words).map(|run| chunk(run.words)).collect::<Result<_, _>>()?
            }
        };
        Ok(Self { prepared, lights, rows, columns, chunks, chunk_words, tracer, corrections })
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
        for (chunk, run) in self.chunks.iter().zip(runs(&self.lights, self.chunk_words)) {
            rays += self.fill(
                chunk,
                self.tracer.params(count, run.first_word, run.words),
                run,
                phases,
                progress,
            )?;
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
            Some(subsets) => gpu.write(of_points, &subsets.split(of_range, each))?,
            None => gpu.write(of_points, of_range)?,
        }
        let (Some(buffer), Some(weights)) = (weights, &clusters.weights) else { return Ok(()) };
        match subsets {
            Some(subsets) => gpu.write(buffer, &subsets.split(&weights[range], each)),
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
        tile: Tile,
        points: u32,
        phases: &mut Phases,
        progress: &dyn Fn(f64),
    ) -> Result<u64, GpuError> {
        let mut rays = match self.rows {
            Rows::Points => self.trace_columns(points, phases, progress)?,
            Rows::Clusters { .. } => 0,
        };
        for (index, run) in runs(&self.lights, self.chunk_words).enumerate() {
            let first_point = run.subset * points;
            let (chunk, rows) = match self.rows {
                Rows::Clusters { count, .. } => (&self.chunks[index], count),
                Rows::Points => (&self.chunks[0], points),
            };
            if matches!(self.rows, Rows::Points) {
                let params = self.tracer.params(rows, run.first_word, run.words);
                let params = VisibilityParams { first_point, ..params };
                rays += self.fill(chunk, params, run, phases, progress)?;
            }
            let params = ShadeParams {
                points,
                rows,
                matrix_word: run.first_word,
                words: run.words,
                first_point,
                pad: [0; 3],
            };
            // With subgroups an invocation has four points.
            let lane = if self.prepared.gpu.has_subgroups() { 4 } else { 1 };
            let groups = [points.div_ceil(64 * lane), 1];
            phases.shading += chunk.shade.run(self.prepared, &params, groups)?;
            if let (Some(correct), Some(corrections)) = (&chunk.correct, self.corrections) {
                let chunk = run.first_word % self.lights.words / self.chunk_words;
                let chunks = self.lights.words.div_ceil(self.chunk_words);
                let params = corrections.params(self.prepared, tile, &params, [chunk, chunks]);
                let groups = [points.div_ceil(64), 1];
                phases.visibility += correct.run(self.prepared, &params, groups)?;
                let counts = if chunk == 0 { corrections.rays } else { 0 };
                rays += u64::from(points) * u64::from(counts);
            }
        }
        Ok(rays)
    }

    /// What clusters of points share of the visibility of clusters of VPLs, if both do; traced by
    /// [`Gather::trace_clusters`].
    pub fn sights(&self) -> Option<Sights<'_>> {
        let (Some(columns), Some(stages)) = (&self.lights.columns, &self.columns) else {
            return None;
        };
        let Rows::Clusters { count, .. } = self.rows else { return None };
        let quads = count.div_ceil(4);
        Some(Sights { table: &stages.table, quads, of_clusters: &columns.of_clusters })
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
        let Some(columns) = &self.columns else { return Ok(0) };
        columns.trace(self.prepared, &self.tracer, rows, phases, progress)
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
            return self.tracer.trace(&chunk.fill, params, run.words, phases, progress);
        }
        let Run { first_word: matrix_word, words, .. } = run;
        let params = ExpandParams { rows: params.rows, matrix_word, words, pad: 0 };
        // An invocation has four rows.
        let groups = [params.rows.div_ceil(4 * 64), words];
        phases.visibility += chunk.fill.run(self.prepared, &params, groups)?;
        Ok(0)
    }
}
