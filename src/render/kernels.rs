//! Which shader files make which kernel, and which kernels a scene needs.

pub mod path;
mod tracing;

use std::sync::{Arc, Mutex, PoisonError};

use super::literals::meet;
use super::{Clamp, Direct, Method, Prepared, Settings};
use crate::gpu::module::{
    ANTIALIAS, AREA_LIGHT, BITS, CAMERA, CHOOSE_LIGHT, COLLECT, COMBINE, DIRECT, DIRECT_AREA,
    DIRECT_POINT, DRAW_ONE, DRAW_RESAMPLED, EMIT, EMITTER_POINT, EMITTER_SURFACE, EXPAND, GATHER,
    HIT_POINT, INTERLEAVED, ONE_SURFACE, PAIR_BOUNDED, PAIR_UNBOUNDED, PIXELS, POINT_LIGHT, RAY,
    REFLECT, REMOVED, ROW_CLUSTER, ROW_POINT, SAMPLING, SEEN_FUZZY, SEEN_HARD, SEPARATE, SHADE,
    SHADE_COOPERATIVE, SHOW_ALBEDO, SHOW_DEPTH, SHOW_NORMAL, SIGNATURE_NONE, SIGNATURE_PROBED,
    TYPES, VISIBLE,
};
use crate::gpu::{CATALOGUE, Gpu, GpuError, Kernel, Module, Program, TriangleRecord};
pub use tracing::{Purpose, Tracing, Traversal};

/// Camera rays.
pub fn visible_points(nearest: &Traversal) -> Program {
    let modules = [&TYPES, &SAMPLING, &PIXELS, &CAMERA, &HIT_POINT, &VISIBLE];
    nearest.link("visible points", &modules)
}

/// More camera rays where pixels see edges.
pub fn antialias(nearest: &Traversal) -> Program {
    let modules = [&TYPES, &SAMPLING, &PIXELS, &CAMERA, &HIT_POINT, &ONE_SURFACE, &ANTIALIAS];
    nearest.link("antialiasing", &modules)
}

/// Direct light from point lights.
pub fn direct_point(shadow: &Traversal) -> Program {
    let modules = [&TYPES, &DIRECT, &POINT_LIGHT, &DIRECT_POINT];
    shadow.link("direct light, points", &modules)
}

/// Direct light from emitting triangles: from many, those that give much are sought out.
pub fn direct_area(shadow: &Traversal, many: bool) -> Program {
    let draw = if many { &DRAW_RESAMPLED } else { &DRAW_ONE };
    let modules = [&TYPES, &SAMPLING, &DIRECT, &CHOOSE_LIGHT, &AREA_LIGHT, draw, &DIRECT_AREA];
    shadow.link("direct light, areas", &modules)
}

/// The program for direct light from the emitting triangles of a scene.
pub fn direct_area_for(prepared: &Prepared) -> Program {
    /// A lamp or two, of which all points see much the same.
    const FEW_LIGHTS: usize = 16;
    let many = prepared.lights.area.len() > FEW_LIGHTS;
    direct_area(&Traversal::of(prepared, Purpose::Shadow), many)
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
    fn module(self) -> &'static Module {
        match self {
            Self::Surface => &EMITTER_SURFACE,
            Self::Point => &EMITTER_POINT,
        }
    }
}

/// Shadow rays between points and lights.
pub fn visibility(tracing: &Tracing, emitter: Emitter) -> Program {
    tracing.link(&[&TYPES, &RAY, emitter.module(), &BITS])
}

/// The visibility program that suits a scene and its device.
pub fn visibility_for(prepared: &Prepared, emitter: Emitter) -> Program {
    visibility(&Tracing::of(prepared), emitter)
}

/// Visibility of VPLs from that of their clusters.
pub fn expand() -> Program {
    Program::new("expansion", vec![&EXPAND])
}

/// Interleaved sampling: points into the order of subsets.
pub fn separate() -> Program {
    let modules = vec![&TYPES, &PIXELS, &INTERLEAVED, &SEPARATE];
    Program::new("separation", modules)
}

/// Interleaved sampling: what points have gathered into rows of pixels, with signatures where
/// their visibility is probed.
pub fn collect(probed: bool) -> Program {
    let signature = if probed { &SIGNATURE_PROBED } else { &SIGNATURE_NONE };
    let modules = vec![&TYPES, &PIXELS, &INTERLEAVED, signature, &COLLECT];
    Program::new("collection", modules)
}

/// Interleaved sampling: what the pixels around have gathered.
pub fn combine() -> Program {
    let modules = vec![&TYPES, &PIXELS, &INTERLEAVED, &ONE_SURFACE, &COMBINE];
    Program::new("combination", modules)
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
pub fn shade(subgroups: bool, bounded: bool, sharing: Sharing, emitter: Emitter) -> Program {
    let bound = if bounded { &PAIR_BOUNDED } else { &PAIR_UNBOUNDED };
    let mut modules = vec![&TYPES, bound, emitter.module(), &GATHER];
    match sharing {
        Sharing::Own => modules.extend([&SEEN_HARD, &ROW_POINT]),
        Sharing::Cluster => modules.extend([&SEEN_HARD, &ROW_CLUSTER]),
        Sharing::Fuzzy => modules.push(&SEEN_FUZZY),
    }
    modules.push(if subgroups { &SHADE_COOPERATIVE } else { &SHADE });
    Program::new("shading", modules)
}

/// Emission towards the camera.
pub fn emit() -> Program {
    Program::new("emission", vec![&TYPES, &EMIT])
}

/// Irradiance to reflected radiance.
pub fn reflect() -> Program {
    Program::new("reflection", vec![&TYPES, &REFLECT])
}

/// What the clamp removed.
pub fn removed() -> Program {
    Program::new("clamped energy", vec![&TYPES, &REMOVED])
}

/// The picture of a method without light; none for the others.
pub fn show(method: Method) -> Option<Program> {
    let (label, module) = match method {
        Method::Normal => ("normals", &SHOW_NORMAL),
        Method::Depth => ("depth", &SHOW_DEPTH),
        Method::Albedo => ("albedo", &SHOW_ALBEDO),
        _ => return None,
    };
    Some(Program::new(label, vec![&TYPES, module]))
}

/// The programs that a scene and settings need: the one list of what is linked.
fn needed(prepared: &Prepared, settings: &Settings) -> Vec<Program> {
    if settings.method == Method::Path {
        return path::needed(prepared, settings);
    }
    let subgroups = prepared.gpu.has_subgroups();
    let [nearest, shadow] =
        [Purpose::Nearest, Purpose::Shadow].map(|purpose| Traversal::of(prepared, purpose));
    let mut programs = vec![visible_points(&nearest)];
    programs.extend(show(settings.method));
    if !settings.method.is_lit() {
        return programs;
    }
    programs.extend(settings.antialiases().then(|| antialias(&nearest)));
    if prepared.area_lights.is_some() {
        programs.push(emit());
    }
    let points = prepared.point_lights.is_some();
    let areas = prepared.area_lights.is_some();
    match settings.direct {
        Direct::PerPixel => {
            programs.extend(points.then(|| direct_point(&shadow)));
            programs.extend(areas.then(|| direct_area_for(prepared)));
            programs.push(reflect());
        }
        Direct::Clustered => {
            let kinds = [(points, Emitter::Point), (areas, Emitter::Surface)];
            for (_, emitter) in kinds.into_iter().filter(|(are, _)| *are) {
                let shade = shade(subgroups, false, settings.sharing(), emitter);
                programs.extend([visibility_for(prepared, emitter), shade]);
            }
            programs.push(reflect());
        }
        Direct::Off => {}
    }
    if settings.traces_light_paths() {
        let bounded = settings.clamp != Clamp::Off;
        programs.extend([
            visibility_for(prepared, Emitter::Surface),
            shade(subgroups, bounded, settings.sharing(), Emitter::Surface),
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

/// A scene for which literals are written.
const EXAMPLE: TriangleRecord = TriangleRecord {
    a: [0.0; 3],
    material: 0,
    b: [1.0, 0.0, 0.0],
    index: 0,
    c: [0.0, 1.0, 0.0],
    pad: 0,
};

/// Every program that some scene or setting links, for tests and tools.
pub fn all_programs() -> Vec<Program> {
    let mut programs = vec![emit(), reflect(), removed(), expand()];
    programs.extend([separate(), collect(false), collect(true), combine()]);
    let generated: Arc<str> = meet(&[EXAMPLE]).into();
    for emitter in [Emitter::Surface, Emitter::Point] {
        let literals = Tracing::Literals(generated.clone());
        let tracing = [Tracing::Single, Tracing::Shaft, Tracing::Rays, literals];
        programs.extend(tracing.map(|tracing| visibility(&tracing, emitter)));
    }
    let traversals = [Traversal::Single, Traversal::Packets, Traversal::Literals(generated)];
    for traversal in &traversals {
        programs.extend([visible_points(traversal), antialias(traversal)]);
        programs.push(direct_point(traversal));
        programs.extend([false, true].map(|many| direct_area(traversal, many)));
    }
    programs.extend(path::all(&traversals));
    for subgroups in [false, true] {
        let sharing = [Sharing::Cluster, Sharing::Fuzzy];
        programs.extend(sharing.map(|sharing| shade(subgroups, false, sharing, Emitter::Point)));
        for bounded in [false, true] {
            let sharing = [Sharing::Own, Sharing::Cluster, Sharing::Fuzzy];
            let emitter = Emitter::Surface;
            programs.extend(sharing.map(|sharing| shade(subgroups, bounded, sharing, emitter)));
        }
    }
    programs.extend([Method::Normal, Method::Depth, Method::Albedo].into_iter().filter_map(show));
    programs
}
