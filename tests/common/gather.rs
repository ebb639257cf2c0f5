//! The visibility and the shading pass, run on records made by hand.

use gpu_vpl::bvh::Bvh;
use gpu_vpl::extremes::checks::gather::{self as shading, Matrix};
use gpu_vpl::extremes::checks::trace::World;
use gpu_vpl::gpu::{Bindings, Dispatch, Gpu, Kernel, PointRecord, VisibilityParams, VplRecord};
use gpu_vpl::render::Target;
use gpu_vpl::render::kernels::{Emitter, Tracing, rays_at_once, visibility};
use gpu_vpl::sampling::SURFACE_OFFSET;

use super::tracing::world_of_triangles;

/// Fills up to whole words with lights of no intensity, as the renderer does.
fn whole_words(vpls: &[VplRecord]) -> Vec<VplRecord> {
    let mut vpls = vpls.to_vec();
    vpls.resize(vpls.len().next_multiple_of(32), bytemuck::Zeroable::zeroed());
    vpls
}

fn workgroups(points: usize, four_a_lane: bool) -> u32 {
    points.div_ceil(if four_a_lane { 4 * 64 } else { 64 }) as u32
}

/// As the check's, with or without subgroups. `bits` has a word of 32 VPLs for every point, then
/// the next; they begin with the VPLs' word `matrix_word`.
pub fn irradiance(
    gpu: &Gpu,
    subgroups: bool,
    bound: Option<f32>,
    points: &[PointRecord],
    vpls: &[VplRecord],
    (bits, matrix_word): (&[u32], u32),
    before: [f32; 4],
) -> Vec<[f32; 4]> {
    let gpu = if subgroups { gpu.clone() } else { gpu.clone().without_subgroups() };
    shading::irradiance(&gpu, bound, points, vpls, Matrix { bits, matrix_word }, before).unwrap()
}

/// Who sees whom, and how many rays were traced. `slices` are the numbers of words that the
/// dispatches have, one after the other.
pub fn visible(
    gpu: &Gpu,
    tracing: Tracing,
    bvh: &Bvh,
    points: &[PointRecord],
    vpls: &[VplRecord],
    slices: &[u32],
) -> (Vec<u32>, u64) {
    let pass = VisibilityDispatch::new(gpu, tracing, bvh, points, vpls);
    pass.run(slices, rays_at_once(bvh.nodes.len())).expect("all loops come to their end")
}

/// As [`visible`], in one dispatch.
pub fn visible_in(
    world: &World,
    tracing: Tracing,
    points: &[PointRecord],
    vpls: &[VplRecord],
) -> (Vec<u32>, u64) {
    let pass = VisibilityDispatch::in_world(super::gpu(), tracing, world, points, vpls);
    let words = vpls.len().div_ceil(32) as u32;
    pass.run(&[words], rays_at_once(world.bvh.nodes.len())).expect("all loops come to their end")
}

/// The visibility pass with its buffers, ready to run.
pub struct VisibilityDispatch<'a> {
    gpu: &'a Gpu,
    tracing: Tracing,
    kernel: Kernel,
    bindings: Bindings,
    params: wgpu::Buffer,
    bits: wgpu::Buffer,
    counter: wgpu::Buffer,
    /// Points, VPLs and nodes.
    counts: [usize; 3],
}

impl<'a> VisibilityDispatch<'a> {
    pub fn new(
        gpu: &'a Gpu,
        tracing: Tracing,
        bvh: &Bvh,
        points: &[PointRecord],
        vpls: &[VplRecord],
    ) -> Self {
        Self::in_world(gpu, tracing, &world_of_triangles(bvh), points, vpls)
    }

    pub fn in_world(
        gpu: &'a Gpu,
        tracing: Tracing,
        world: &World,
        points: &[PointRecord],
        vpls: &[VplRecord],
    ) -> Self {
        let target = Target::of(tracing != Tracing::Single, world.features);
        let program = visibility(target, tracing, Emitter::Surface);
        let program = world.literals.iter().fold(program, |of, literals| literals.complete(of));
        let kernel = gpu.compile(&program).unwrap();
        let params = gpu.parameters::<VisibilityParams>("params").unwrap();
        // What a pass leaves alone stays as it is here.
        let words = vpls.len().div_ceil(32);
        let bits = gpu.storage_of("bits", &vec![u32::MAX; words * points.len()]).unwrap();
        let counter = gpu.storage::<u32>("counter", 3).unwrap();
        let points_buffer = gpu.storage_of("points", points).unwrap();
        let vpls_buffer = gpu.storage_of("vpls", &whole_words(vpls)).unwrap();
        let own = [
            ("params", &params),
            ("points", &points_buffer),
            ("vpls", &vpls_buffer),
            ("bits", &bits),
            ("counter", &counter),
        ];
        let buffers: Vec<_> = own.into_iter().chain(world.named()).collect();
        let textures: Vec<_> =
            world.textures.iter().map(|texture| (texture.name, texture)).collect();
        let bindings = gpu.bind_with(&kernel, &buffers, &textures).unwrap();
        let counts = [points.len(), vpls.len(), world.bvh.nodes.len()];
        Self { gpu, tracing, kernel, bindings, params, bits, counter, counts }
    }

    /// The bits and the number of rays, in dispatches of so many words and of `at_once` VPLs
    /// of each; nothing if the driver cut loops short.
    pub fn run(&self, slices: &[u32], at_once: u32) -> Option<(Vec<u32>, u64)> {
        let Self { gpu, kernel, bindings, counts: [points, vpls, nodes], .. } = self;
        let words = vpls.div_ceil(32);
        assert_eq!(slices.iter().sum::<u32>() as usize, words, "the slices are the whole");
        gpu.write(&self.counter, &[0u32; 3]).unwrap();
        let mut first_word = 0;
        for &slice in slices {
            for first in (0..32).step_by(at_once as usize) {
                let record = VisibilityParams {
                    rows: *points as u32,
                    vpls: *vpls as u32,
                    first_word,
                    matrix_word: 0,
                    offset: SURFACE_OFFSET,
                    nodes: *nodes as u32,
                    first,
                    count: at_once,
                    first_point: 0,
                    words: slice,
                    seed: 0,
                    pad: 0,
                };
                gpu.write(&self.params, &[record]).unwrap();
                let groups = workgroups(*points, self.tracing.points() == 4);
                gpu.run(&[Dispatch { kernel, bindings, workgroups: [groups, slice] }]).unwrap();
            }
            first_word += slice;
        }
        let count: Vec<u32> = gpu.read(&self.counter, 3).unwrap();
        let rays = u64::from(count[1]) << 32 | u64::from(count[0]);
        (count[2] == 0).then(|| (gpu.read(&self.bits, words * points).unwrap(), rays))
    }
}
