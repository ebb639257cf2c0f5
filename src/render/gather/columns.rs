//! The columns of the bit matrix that VPLs share: what rows see of clusters of VPLs.

use crate::gpu::{ExpandParams, GpuError, TableFormat, Texture};
use crate::render::kernels::{self, Emitter};
use crate::render::prepared::Prepared;
use crate::render::result::Phases;
use crate::render::stage::{Named, Stage};
use crate::render::visibility::{ColumnEnds, Columns, MemberRays, Tracer};

/// Traces the columns, and packs them into a table.
#[derive(Debug)]
pub struct ColumnBits {
    rays: ColumnRays,
    pack: Stage,
    /// What rows see of them, four rows a texel.
    pub table: Texture,
    /// Words of columns.
    words: u32,
}

/// What rays go to.
#[derive(Debug)]
enum ColumnRays {
    /// One light for each cluster.
    Representatives(Stage),
    /// Members that rows draw.
    Members(MemberRays),
}

impl ColumnBits {
    /// For so many rows; `buffers` have their points.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &Prepared,
        tracer: &Tracer<'_>,
        emitter: Emitter,
        columns: &Columns,
        buffers: &[Named<'_>],
        rows: u32,
    ) -> Result<Self, GpuError> {
        let words = columns.words;
        let gpu = &prepared.gpu;
        let bits = gpu.storage::<u32>("visibility bits", rows as usize * words as usize)?;
        let bits = ("bits", &bits);
        let rays = match &columns.ends {
            ColumnEnds::Representatives(lights) => {
                // The first buffer of a name counts.
                let buffers = [&[("vpls", lights), bits], buffers].concat();
                ColumnRays::Representatives(tracer.stage(emitter, &buffers)?)
            }
            ColumnEnds::Members(members) => {
                let buffers = [&[bits], buffers].concat();
                ColumnRays::Members(MemberRays::new(tracer, members, &buffers, rows, words)?)
            }
        };
        let texels = rows.div_ceil(4) as usize * words as usize;
        let table = gpu.table("visibility of clusters", texels, TableFormat::Quadruples)?;
        let packed = [("packed_columns", &table)];
        let pack = Stage::with_textures(prepared, &kernels::pack_columns(), &[bits], &packed)?;
        Ok(Self { rays, pack, table, words })
    }

    /// Traces them for so many rows. Returns the rays.
    ///
    /// # Errors
    /// The device fails.
    pub fn trace(
        &self,
        prepared: &Prepared,
        tracer: &Tracer<'_>,
        rows: u32,
        phases: &mut Phases,
        progress: &dyn Fn(f64),
    ) -> Result<u64, GpuError> {
        let words = self.words;
        let params = tracer.params(rows, 0, words);
        let rays = match &self.rays {
            ColumnRays::Representatives(stage) => {
                tracer.trace(stage, params, words, phases, progress)?
            }
            ColumnRays::Members(rays) => rays.trace(tracer, params, phases, progress)?,
        };
        let params = ExpandParams { rows, matrix_word: 0, words, pad: 0 };
        phases.visibility += self.pack.run(prepared, &params, [rows.div_ceil(4 * 64), words])?;
        Ok(rays)
    }
}
