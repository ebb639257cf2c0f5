//! Which shader files make which kernel, and which kernels a scene needs.

pub mod path;

use std::sync::{Arc, Mutex, PoisonError};

use super::{Clamp, Direct, LightKind, Method, Prepared, Settings, Target};
use crate::gpu::module::{
    ALBEDO_PLAIN, ANTIALIAS, AREA_LIGHT, BITS, CAMERA, CHOOSE_LIGHT, COLLECT, COMBINE, DIRECT,
    DIRECT_EXACT, DIRECT_SAMPLED, DIRECTIONAL_LIGHT, DRAW_ONE, DRAW_RESAMPLED, EMIT, EMITTER_POINT,
    EMITTER_SURFACE, EXPAND, GATHER, HIT_POINT, INTERLEAVED, LIGHT_SAMPLE, LOBES_DIFFUSE,
    LOCAL_LIGHT, ONE_SURFACE, PACKET_RAYS, PACKET_SHAFT, PAIR_BOUNDED, PAIR_UNBOUNDED, PIXELS,
    POINT_LIGHT, RAY, REFLECT, REMOVED, ROW_CLUSTER, ROW_POINT, SAMPLING, SEEN_FUZZY, SEEN_HARD,
    SEPARATE, SHADE, SHADE_COOPERATIVE, SHOW_ALBEDO, SHOW_DEPTH, SHOW_NORMAL, SIGNATURE_NONE,
    SIGNATURE_PROBED, SPOT_LIGHT, TRAVERSE, TRAVERSE_PACKET, TYPES, VISIBILITY, VISIBILITY_PACKET,
    VISIBLE,
};
use crate::gpu::{CATALOGUE, Gpu, GpuError, Kernel, Module, Program};

/// How rays are traced that neighbours trace alike.
fn traverse(target: Target) -> &'static Module {
    if target.subgroups { &TRAVERSE_PACKET } else { &TRAVERSE }
}

/// Camera rays.
pub fn visible_points(target: Target) -> Program {
    Program { label: "visible points", modules: camera_rays(target, &[&VISIBLE]) }
}

/// More camera rays where pixels see edges.
pub fn antialias(target: Target) -> Program {
    let modules = camera_rays(target, &[&ONE_SURFACE, &ANTIALIAS]);
    Program { label: "antialiasing", modules }
}

fn camera_rays(target: Target, last: &[&'static Module]) -> Vec<&'static Module> {
    let first = [&TYPES, &SAMPLING, &PIXELS, &RAY, traverse(target), &CAMERA, &HIT_POINT];
    [&first[..], last].concat()
}

/// What a kernel needs to draw from the lights of a kind.
fn lights_of(kind: LightKind) -> Vec<&'static Module> {
    match kind {
        LightKind::Point => vec![&LIGHT_SAMPLE, &POINT_LIGHT, &LOCAL_LIGHT],
        LightKind::Spot => vec![&LIGHT_SAMPLE, &SPOT_LIGHT, &LOCAL_LIGHT],
        LightKind::Directional => vec![&LIGHT_SAMPLE, &DIRECTIONAL_LIGHT],
        LightKind::Area => vec![&LIGHT_SAMPLE, &CHOOSE_LIGHT, &AREA_LIGHT],
    }
}

/// Direct light from the lights of a kind. From many lights of some extent, those that give much
/// are sought out.
pub fn direct(target: Target, kind: LightKind, many: bool) -> Program {
    let mut modules = vec![&TYPES, &SAMPLING, &LOBES_DIFFUSE, &RAY, traverse(target), &DIRECT];
    modules.extend(lights_of(kind));
    match kind.is_exact() {
        true => modules.push(&DIRECT_EXACT),
        false => modules.extend([if many { &DRAW_RESAMPLED } else { &DRAW_ONE }, &DIRECT_SAMPLED]),
    }
    let label = match kind {
        LightKind::Point => "direct light, points",
        LightKind::Spot => "direct light, spots",
        LightKind::Directional => "direct light, directional",
        LightKind::Area => "direct light, areas",
    };
    Program { label, modules }
}

/// The program for direct light from the lights of a kind in a scene.
pub fn direct_for(prepared: &Prepared, kind: LightKind) -> Program {
    /// A lamp or two, of which all points see much the same.
    const FEW_LIGHTS: u32 = 16;
    direct(prepared.target(), kind, prepared.lights.count(kind) > FEW_LIGHTS)
}

/// How the shadow rays between points and VPLs are traced.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tracing {
    /// Each ray by itself, for adapters without subgroups.
    Single,
    /// Packets against boxes as a whole.
    Shaft,
    /// Packets against boxes ray by ray.
    Rays,
}

impl Tracing {
    /// Hierarchies of more nodes have boxes so small that a packet is best tested ray by ray.
    const SHAFT_NODES: usize = 1000;

    fn of(prepared: &Prepared) -> Self {
        match prepared.gpu.has_subgroups() {
            false => Self::Single,
            true if prepared.bvh.nodes.len() <= Self::SHAFT_NODES => Self::Shaft,
            true => Self::Rays,
        }
    }
}

/// How many rays one invocation may trace in a dispatch, a power of two up to the 32 of a
/// word. Mesa's llvmpipe silently leaves all loops of an invocation after 65,535 rounds
/// together; so many are enough for that many rays even if each meets all boxes of a small
/// hierarchy, or many of a large one.
pub fn rays_at_once(nodes: usize) -> u32 {
    const ROUNDS: usize = 65_000;
    // A round for a node, and at a leaf, which half of the nodes are, one for each triangle, one
    // to leave them, and one for the way on.
    let rays = (ROUNDS / (4 * nodes.max(1))).clamp(4, 32);
    1 << rays.ilog2()
}

/// What the lights are that points gather.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Emitter {
    /// Places on surfaces: VPLs, or places on light sources.
    Surface,
    /// Point lights.
    Point,
}

impl Emitter {
    /// What the lights of a kind are gathered as, if they can be.
    pub fn of(kind: LightKind) -> Option<Self> {
        match kind {
            LightKind::Point => Some(Self::Point),
            LightKind::Area => Some(Self::Surface),
            LightKind::Spot | LightKind::Directional => None,
        }
    }

    fn module(self) -> &'static Module {
        match self {
            Self::Surface => &EMITTER_SURFACE,
            Self::Point => &EMITTER_POINT,
        }
    }
}

/// Shadow rays between points and lights.
pub fn visibility(_target: Target, tracing: Tracing, emitter: Emitter) -> Program {
    let mut modules = vec![&TYPES, &RAY, emitter.module(), &BITS];
    modules.extend(match tracing {
        Tracing::Single => [&TRAVERSE, &VISIBILITY],
        Tracing::Shaft => [&PACKET_SHAFT, &VISIBILITY_PACKET],
        Tracing::Rays => [&PACKET_RAYS, &VISIBILITY_PACKET],
    });
    Program { label: "visibility", modules }
}

/// The visibility program that suits a scene and its device.
pub fn visibility_for(prepared: &Prepared, emitter: Emitter) -> Program {
    visibility(prepared.target(), Tracing::of(prepared), emitter)
}

/// Visibility of VPLs from that of their clusters.
pub fn expand() -> Program {
    Program { label: "expansion", modules: vec![&EXPAND] }
}

/// Interleaved sampling: points into the order of subsets.
pub fn separate() -> Program {
    let modules = vec![&TYPES, &PIXELS, &INTERLEAVED, &SEPARATE];
    Program { label: "separation", modules }
}

/// Interleaved sampling: what points have gathered into rows of pixels, with signatures where
/// their visibility is probed.
pub fn collect(probed: bool) -> Program {
    let signature = if probed { &SIGNATURE_PROBED } else { &SIGNATURE_NONE };
    let modules = vec![&TYPES, &PIXELS, &INTERLEAVED, signature, &COLLECT];
    Program { label: "collection", modules }
}

/// Interleaved sampling: what the pixels around have gathered.
pub fn combine() -> Program {
    let modules = vec![&TYPES, &PIXELS, &INTERLEAVED, &ONE_SURFACE, &COMBINE];
    Program { label: "combination", modules }
}

/// Whose row of the bit matrix a point reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sharing {
    /// Its own.
    Own,
    /// That of its cluster.
    Cluster,
    /// Those of the nearest clusters, weighted.
    Fuzzy,
}

/// Shading of points by lights.
pub fn shade(target: Target, bounded: bool, sharing: Sharing, emitter: Emitter) -> Program {
    let bound = if bounded { &PAIR_BOUNDED } else { &PAIR_UNBOUNDED };
    let mut modules = vec![&TYPES, &LOBES_DIFFUSE, bound, emitter.module(), &GATHER];
    match sharing {
        Sharing::Own => modules.extend([&SEEN_HARD, &ROW_POINT]),
        Sharing::Cluster => modules.extend([&SEEN_HARD, &ROW_CLUSTER]),
        Sharing::Fuzzy => modules.push(&SEEN_FUZZY),
    }
    modules.push(if target.subgroups { &SHADE_COOPERATIVE } else { &SHADE });
    Program { label: "shading", modules }
}

/// Emission towards the camera.
pub fn emit() -> Program {
    Program { label: "emission", modules: vec![&TYPES, &EMIT] }
}

/// Irradiance to reflected radiance.
pub fn reflect() -> Program {
    Program { label: "reflection", modules: vec![&TYPES, &LOBES_DIFFUSE, &ALBEDO_PLAIN, &REFLECT] }
}

/// What the clamp removed.
pub fn removed() -> Program {
    Program { label: "clamped energy", modules: vec![&TYPES, &ALBEDO_PLAIN, &REMOVED] }
}

/// The picture of a method without light; none for the others.
pub fn show(method: Method) -> Option<Program> {
    let (label, module) = match method {
        Method::Normal => ("normals", &SHOW_NORMAL),
        Method::Depth => ("depth", &SHOW_DEPTH),
        Method::Albedo => ("albedo", &SHOW_ALBEDO),
        _ => return None,
    };
    let mut modules = vec![&TYPES];
    modules.extend((method == Method::Albedo).then_some(&ALBEDO_PLAIN));
    modules.push(module);
    Some(Program { label, modules })
}

/// The programs that a scene and settings need: the one list of what is linked.
fn needed(prepared: &Prepared, settings: &Settings) -> Vec<Program> {
    if settings.method == Method::Path {
        return path::needed(prepared, settings);
    }
    let target = prepared.target();
    let mut programs = vec![visible_points(target)];
    programs.extend(show(settings.method));
    if !settings.method.is_lit() {
        return programs;
    }
    programs.extend(settings.antialiases().then(|| antialias(target)));
    if prepared.lights.count(LightKind::Area) > 0 {
        programs.push(emit());
    }
    let kinds = || prepared.lights.kinds();
    if settings.direct != Direct::Off {
        for kind in kinds() {
            match Emitter::of(kind).filter(|_| settings.direct == Direct::Clustered) {
                Some(emitter) => {
                    let shade = shade(target, false, settings.sharing(), emitter);
                    programs.extend([visibility_for(prepared, emitter), shade]);
                }
                None => programs.push(direct_for(prepared, kind)),
            }
        }
        programs.push(reflect());
    }
    if settings.traces_light_paths() {
        let bounded = settings.clamp != Clamp::Off;
        programs.extend([
            visibility_for(prepared, Emitter::Surface),
            shade(target, bounded, settings.sharing(), Emitter::Surface),
            reflect(),
        ]);
        programs.extend(bounded.then(removed));
        programs.extend(settings.shares_columns().then(expand));
        if settings.interleaves() {
            programs.extend([separate(), collect(settings.probes()), combine()]);
        }
    }
    programs
}

/// The kernels compiled so far.
#[derive(Debug, Default)]
pub struct Kernels(Mutex<Vec<(Program, Arc<Kernel>)>>);

impl Kernels {
    /// Compiles what a scene and settings need.
    pub(super) fn prepare(&self, prepared: &Prepared, settings: &Settings) -> Result<(), GpuError> {
        for program in needed(prepared, settings) {
            self.get(&prepared.gpu, &program)?;
        }
        Ok(())
    }

    /// The kernel of a program, compiled at most once.
    pub(super) fn get(&self, gpu: &Gpu, program: &Program) -> Result<Arc<Kernel>, GpuError> {
        let mut kernels = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, kernel)) = kernels.iter().find(|(known, _)| known == program) {
            return Ok(kernel.clone());
        }
        let kernel = Arc::new(gpu.compile(program)?);
        kernels.push((program.clone(), kernel.clone()));
        Ok(kernel)
    }

    /// Features that no module linked so far serves.
    pub(super) fn left_out(&self) -> Vec<&'static str> {
        let kernels = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let linked: Vec<_> = kernels
            .iter()
            .flat_map(|(_, kernel)| kernel.modules.iter().filter_map(|module| module.feature))
            .collect();
        let mut left_out = Vec::new();
        for feature in CATALOGUE.iter().filter_map(|module| module.feature) {
            if !linked.contains(&feature) && !left_out.contains(&feature) {
                left_out.push(feature);
            }
        }
        left_out
    }
}

/// Every program that some scene or setting links, for tests and tools.
pub fn all_programs() -> Vec<Program> {
    let mut programs = vec![emit(), reflect(), removed(), expand()];
    programs.extend([separate(), collect(false), collect(true), combine()]);
    for target in Target::all() {
        for emitter in [Emitter::Surface, Emitter::Point] {
            let tracing = [Tracing::Single, Tracing::Shaft, Tracing::Rays];
            programs.extend(tracing.map(|tracing| visibility(target, tracing, emitter)));
        }
        programs.extend([visible_points(target), antialias(target)]);
        for kind in LightKind::ALL {
            programs.extend([false, true].map(|many| direct(target, kind, many)));
        }
        let sharing = [Sharing::Cluster, Sharing::Fuzzy];
        programs.extend(sharing.map(|sharing| shade(target, false, sharing, Emitter::Point)));
        for bounded in [false, true] {
            let sharing = [Sharing::Own, Sharing::Cluster, Sharing::Fuzzy];
            let emitter = Emitter::Surface;
            programs.extend(sharing.map(|sharing| shade(target, bounded, sharing, emitter)));
        }
        programs.extend(path::all(target));
    }
    programs.extend([Method::Normal, Method::Depth, Method::Albedo].into_iter().filter_map(show));
    programs.extend(path::common());
    let mut distinct: Vec<Program> = Vec::new();
    for program in programs {
        if !distinct.contains(&program) {
            distinct.push(program);
        }
    }
    distinct
}
