//! Members of VPL clusters on the device: rows draw of each cluster the one that they trace a ray to.

use std::cell::Cell;

use super::trace::{Slices, Tracer, words_at_once};
use crate::gpu::{GpuError, TableFormat, Texture, VisibilityParams};
use crate::render::kernels;
use crate::render::prepared::Prepared;
use crate::render::result::Phases;
use crate::render::stage::{Named, Stage};
use crate::render::virtual_light::{VirtualLight, curve};
use crate::render::vpls::GeometryBound;
use crate::sampling::hash;

/// How rows draw members of clusters.
#[derive(Debug, Clone, Copy)]
pub struct Draws<'a> {
    /// Tells draws apart.
    pub seed: u32,
    /// Bounds the geometry terms that they go by.
    pub bound: &'a GeometryBound,
}

/// The members of clusters, cluster after cluster.
#[derive(Debug)]
pub struct Members {
    /// The first of each cluster, and how many.
    ranges: Texture,
    /// Places, and what tells how much each gives.
    table: Texture,
    /// Tells draws apart.
    seed: u32,
}

/// Words of clusters in a dispatch, at most: it has eight rows of workgroups for each.
const MOST_WORDS: u32 = 4096;
/// Keeps draws apart from what else the seed is for.
const STREAM: u32 = 0x6d65_6d62;

/// Position, weight; normal, bound. As in `member_diffuse.wgsl`.
type Diffuse = [[f32; 4]; 2];
/// The same, and the lobe's direction, shininess; its weight, its peak. As in `member_glossy.wgsl`.
type Glossy = [[f32; 4]; 4];

impl Members {
    /// Uploads lights, each in one of so many clusters.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &Prepared,
        lights: &[VirtualLight],
        Draws { seed, bound }: Draws<'_>,
        of_lights: &[u32],
        clusters: usize,
    ) -> Result<Self, GpuError> {
        let mut order = curve(lights);
        order.sort_by_key(|&light| of_lights[light as usize]);
        let mut ranges = vec![[0u32; 4]; clusters];
        for (at, &light) in (0..).zip(&order) {
            let range = &mut ranges[of_lights[light as usize] as usize];
            if range[1] == 0 {
                range[0] = at;
            }
            range[1] += 1;
        }
        let brightest = lights.iter().map(VirtualLight::mean_intensity).fold(0.0, f64::max);
        let scale = if brightest > 0.0 { brightest.recip() } else { 0.0 };
        let each = order.iter().map(|&light| &lights[light as usize]);
        let gpu = &prepared.gpu;
        let table = match prepared.features.phong {
            true => each.map(|light| glossy(light, scale, bound)).collect::<Vec<Glossy>>().concat(),
            false => each.map(|light| diffuse(light, scale, bound)).collect::<Vec<_>>().concat(),
        };
        Ok(Self {
            ranges: gpu.texture_of("member_ranges", &ranges)?,
            table: gpu.texture_of("member_table", &table)?,
            seed: hash(seed ^ STREAM),
        })
    }
}

/// Draws members, and traces the rays to them.
#[derive(Debug)]
pub struct MemberRays {
    draw: Stage,
    trace: Stage,
    /// Words of clusters in a dispatch.
    words: u32,
    /// As of [`Tracer`]; a packet has all of a word.
    rays_at_once: Cell<u32>,
    seed: u32,
}

impl MemberRays {
    /// For so many rows, and words of clusters; `buffers` have the points and the bits.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        tracer: &Tracer<'_>,
        members: &Members,
        buffers: &[Named<'_>],
        rows: u32,
        words: u32,
    ) -> Result<Self, GpuError> {
        let prepared = tracer.prepared;
        let words = words_at_once(prepared, rows).min(words).min(MOST_WORDS);
        let texels = 8 * words as usize * rows as usize;
        let table = prepared.gpu.table("drawn members", texels, TableFormat::Quadruples)?;
        let Members { ranges, table: places, seed } = members;
        let places = ("member_table", places);
        let draw = kernels::draw_members(prepared.target());
        let textures = [("member_ranges", ranges), places, ("drawn_table", &table)];
        let draw = Stage::with_textures(prepared, &draw, buffers, &textures)?;
        let trace = prepared.member_visibility_program();
        let buffers = [buffers, &[("counter", &tracer.counter)]].concat();
        let textures = [places, ("drawn_members", &table)];
        let trace = Stage::with_textures(prepared, &trace, &buffers, &textures)?;
        let rays_at_once = Cell::new(32);
        Ok(Self { draw, trace, words, rays_at_once, seed: *seed })
    }

    /// Traces the shadow rays of so many words of clusters. Returns how many there were.
    ///
    /// # Errors
    /// The device fails.
    pub fn trace(
        &self,
        tracer: &Tracer<'_>,
        params: VisibilityParams,
        phases: &mut Phases,
        progress: &dyn Fn(f64),
    ) -> Result<u64, GpuError> {
        let prepared = tracer.prepared;
        let tracing = prepared.tracing();
        // An invocation draws for four rows and four clusters.
        let draw = |params: &VisibilityParams| {
            let groups = [params.rows.div_ceil(4 * 64), 8 * params.words];
            self.draw.run(prepared, params, groups).map(|_| ())
        };
        let slices = Slices {
            words: self.words,
            groups: &|rows, words| tracing.groups_of_members(rows, words),
            rays_at_once: &self.rays_at_once,
            before: &draw,
        };
        let params = VisibilityParams { seed: self.seed, ..params };
        tracer.trace_slices(&self.trace, params, &slices, phases, progress)
    }
}

fn diffuse(light: &VirtualLight, scale: f64, bound: &GeometryBound) -> Diffuse {
    let bound = bound.at(light.position, light.normal);
    [(light.position, weight(light.intensity, scale)), (light.normal, bound)]
        .map(|(place, last)| place.extend(last).to_array())
}

fn glossy(light: &VirtualLight, scale: f64, bound: &GeometryBound) -> Glossy {
    let [place, side] = diffuse(light, scale, bound);
    let Some(lobe) = light.gloss else { return [place, side, [0.0; 4], [0.0; 4]] };
    let peak = 0.5 * lobe.shininess + 1.0;
    let strength = [weight(lobe.specular, scale), peak, 0.0, 0.0];
    [place, side, lobe.mirrored.extend(lobe.shininess).to_array(), strength]
}

/// The mean of the channels of an intensity, times so much.
fn weight(intensity: glam::Vec3, scale: f64) -> f32 {
    (f64::from(intensity.element_sum()) / 3.0 * scale) as f32
}
