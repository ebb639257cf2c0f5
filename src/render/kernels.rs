//! Which shader files make which kernel, and which kernels a scene needs.

pub mod path;
mod surfaces;
mod tracing;

use std::sync::{Arc, Mutex, PoisonError};

use super::literals::Literals;
use super::{Clamp, Direct, Features, LightKind, Method, Plan, Prepared, Settings, Sky, Target};
use crate::gpu::module::{
    ANTIALIAS, AREA_LIGHT, BACKGROUND, BITS, CAMERA, CHOOSE_LIGHT, COLLECT, COMBINE, CORNERS,
    DIRECT, DIRECT_EXACT, DIRECT_SAMPLED, DIRECTIONAL_LIGHT, DRAW_ONE, DRAW_RESAMPLED, EMIT,
    EMITTER_POINT, EMITTER_SURFACE, ENVIRONMENT_CELLS, ENVIRONMENT_CONSTANT, ENVIRONMENT_IMAGE,
    ENVIRONMENT_LIGHT_CONSTANT, ENVIRONMENT_LIGHT_IMAGE, EXPAND, FINISH, FOLLOW_NONE,
    FOLLOW_SPECULAR, GATHER, GATHERED_DIFFUSE, GATHERED_PHONG, GLASS, HEMISPHERE, HIT_POINT,
    INTERLEAVED, KEEP_THROUGHPUT, KEEP_THROUGHPUT_NONE, LIGHT_SAMPLE, LITERAL_RAY, LOBES_DIFFUSE,
    LOBES_PHONG, LOCAL_LIGHT, MIRROR, ONE_SURFACE, PAIR_BOUNDED, PAIR_DIFFUSE, PAIR_GLOSSY,
    PAIR_UNBOUNDED, PHONG, PIXELS, POINT_LIGHT, RAY, REFLECT, REFLECTANCE_ANY, REFLECTANCE_PLAIN,
    REMOVED, RESOLVE, ROW_CLUSTER, ROW_POINT, SAMPLING, SEEN_FUZZY, SEEN_HARD, SEPARATE, SHADE,
    SHADE_COOPERATIVE, SHADE_GLOSSY, SHAPE_TRIANGLE, SHOW_ALBEDO, SHOW_DEPTH, SHOW_NORMAL,
    SIGNATURE_NONE, SIGNATURE_PROBED, SPHERE_CONE, SPHERE_LIGHT, SPOT_LIGHT, THROUGHPUT_KEPT,
    THROUGHPUT_NONE, TRAVERSE, TRAVERSE_PACKET, TURN, TURN_EITHER, TURN_GLASS, TURN_MIRROR, TYPES,
    UNSEEN_BACKGROUND, UNSEEN_NONE, VIEW_KEPT, VIEW_NONE, VISIBLE, VPL_DIFFUSE, VPL_GLOSSY,
};
use crate::gpu::{CATALOGUE, GpuError, Kernel, Module, Program, TriangleRecord};
pub use tracing::Tracing;

pub use surfaces::shapes;

/// How rays are traced that neighbours trace alike.
fn traverse(target: Target) -> &'static Module {
    match target.subgroups {
        _ if target.literals => &LITERAL_RAY,
        true => &TRAVERSE_PACKET,
        false => &TRAVERSE,
    }
}

/// Camera rays.
pub fn visible_points(target: Target) -> Program {
    let keep = if target.features.specular() { &KEEP_THROUGHPUT } else { &KEEP_THROUGHPUT_NONE };
    let mut modules = camera_rays(target, &kept(target.features));
    modules.extend([view(target), keep, &VISIBLE]);
    Program::new("visible points", modules)
}

/// What is kept of points by the pass that finds them.
fn kept(features: Features) -> Vec<&'static Module> {
    [surfaces::kept(features), surfaces::keep(features)].concat()
}

/// More camera rays where pixels see edges.
pub fn antialias(target: Target) -> Program {
    let unseen = match sky(target) {
        Some(sky) => [&sky[..], &[&UNSEEN_BACKGROUND]].concat(),
        None => vec![&UNSEEN_NONE],
    };
    let last = [&unseen[..], &[throughput(target), &ONE_SURFACE, &ANTIALIAS]].concat();
    let modules = camera_rays(target, &last);
    Program::new("antialiasing", modules)
}

fn camera_rays(target: Target, last: &[&'static Module]) -> Vec<&'static Module> {
    let (first, rays) = ([&TYPES, &SAMPLING, &PIXELS], surfaces::rays(target));
    [&first[..], &rays, &[&CAMERA], &follow(target), last].concat()
}

/// How rays go on at mirrors and glass, and what they see.
fn follow(target: Target) -> Vec<&'static Module> {
    // The other ways to trace rays load all triangles.
    let corners: &[&Module] = if target.literals { &[&CORNERS, &SHAPE_TRIANGLE] } else { &[] };
    let turns: &[&Module] = match (target.features.mirror, target.features.glass) {
        (false, false) => return [corners, &[&HIT_POINT, &FOLLOW_NONE]].concat(),
        (true, false) => &[&MIRROR, &TURN_MIRROR],
        (false, true) => &[&GLASS, &TURN_GLASS],
        (true, true) => &[&MIRROR, &GLASS, &TURN_EITHER],
    };
    [corners, &[&HIT_POINT, &FINISH, &TURN], turns, &[&FOLLOW_SPECULAR]].concat()
}

/// Whether a visible point keeps where it is seen from.
fn view(target: Target) -> &'static Module {
    if target.features.phong { &VIEW_KEPT } else { &VIEW_NONE }
}

/// What points gather.
fn gathered(target: Target) -> &'static Module {
    if target.features.phong { &GATHERED_PHONG } else { &GATHERED_DIFFUSE }
}

/// How points gather, and what they reflect of it.
fn lobes(target: Target) -> Vec<&'static Module> {
    match target.features.phong {
        true => vec![&GATHERED_PHONG, &VIEW_KEPT, &FINISH, &PHONG, &LOBES_PHONG],
        false => vec![&GATHERED_DIFFUSE, &LOBES_DIFFUSE],
    }
}

fn vpl(target: Target) -> &'static Module {
    if target.features.phong { &VPL_GLOSSY } else { &VPL_DIFFUSE }
}

/// What comes back of the radiance of visible points.
fn throughput(target: Target) -> &'static Module {
    if target.features.specular() { &THROUGHPUT_KEPT } else { &THROUGHPUT_NONE }
}

/// What a kernel needs to draw from the lights of a kind.
fn lights_of(target: Target, kind: LightKind) -> Vec<&'static Module> {
    match kind {
        LightKind::Point => vec![&LIGHT_SAMPLE, &POINT_LIGHT, &LOCAL_LIGHT],
        LightKind::Spot => vec![&LIGHT_SAMPLE, &SPOT_LIGHT, &LOCAL_LIGHT],
        LightKind::Directional => vec![&LIGHT_SAMPLE, &DIRECTIONAL_LIGHT],
        LightKind::Area => {
            let mut modules = surfaces::light_glow(target.features);
            modules.extend([&LIGHT_SAMPLE, &CHOOSE_LIGHT, &AREA_LIGHT]);
            modules
        }
        LightKind::Sphere => {
            vec![&LIGHT_SAMPLE, &CHOOSE_LIGHT, &HEMISPHERE, &SPHERE_CONE, &SPHERE_LIGHT]
        }
        LightKind::Environment => match target.features.sky {
            Sky::Image => vec![
                &LIGHT_SAMPLE,
                &ENVIRONMENT_IMAGE,
                &ENVIRONMENT_CELLS,
                &ENVIRONMENT_LIGHT_IMAGE,
            ],
            _ => {
                vec![&LIGHT_SAMPLE, &HEMISPHERE, &ENVIRONMENT_CONSTANT, &ENVIRONMENT_LIGHT_CONSTANT]
            }
        },
    }
}

/// Direct light from the lights of a kind. From many lights of some extent, those that give much
/// are sought out.
pub fn direct(target: Target, kind: LightKind, many: bool) -> Program {
    let mut modules = vec![&TYPES, &SAMPLING];
    modules.extend(lobes(target));
    modules.extend(surfaces::rays(target));
    modules.push(&DIRECT);
    modules.extend(lights_of(target, kind));
    match kind.is_exact() {
        true => modules.push(&DIRECT_EXACT),
        false => modules.extend([if many { &DRAW_RESAMPLED } else { &DRAW_ONE }, &DIRECT_SAMPLED]),
    }
    let label = match kind {
        LightKind::Point => "direct light, points",
        LightKind::Spot => "direct light, spots",
        LightKind::Directional => "direct light, directional",
        LightKind::Area => "direct light, areas",
        LightKind::Sphere => "direct light, spheres",
        LightKind::Environment => "direct light, environment",
    };
    Program::new(label, modules)
}

/// The program for direct light from the lights of a kind in a scene.
pub fn direct_for(plan: &Plan, kind: LightKind) -> Program {
    /// A lamp or two, of which all points see much the same.
    const FEW_LIGHTS: u32 = 16;
    direct(plan.target(), kind, plan.lights.count(kind) > FEW_LIGHTS)
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
            LightKind::Spot
            | LightKind::Directional
            | LightKind::Sphere
            | LightKind::Environment => None,
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
pub fn visibility(target: Target, tracing: Tracing, emitter: Emitter) -> Program {
    let mut modules = vec![&TYPES, vpl(target)];
    modules.extend(match tracing {
        Tracing::Single => shapes(target.features),
        Tracing::Shaft | Tracing::Rays => surfaces::blockers(target.features),
        Tracing::Literals => vec![&RAY],
    });
    modules.extend([emitter.module(), &BITS]);
    modules.extend(tracing.modules());
    Program::new("visibility", modules)
}

/// The visibility program that suits a scene and its device.
pub fn visibility_for(plan: &Plan, emitter: Emitter) -> Program {
    visibility(plan.target(), Tracing::of(plan), emitter)
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
pub fn collect(target: Target, probed: bool) -> Program {
    let signature = if probed { &SIGNATURE_PROBED } else { &SIGNATURE_NONE };
    let modules = vec![&TYPES, gathered(target), &PIXELS, &INTERLEAVED, signature, &COLLECT];
    Program::new("collection", modules)
}

/// Interleaved sampling: what the pixels around have gathered.
pub fn combine(target: Target) -> Program {
    let modules = vec![&TYPES, gathered(target), &PIXELS, &INTERLEAVED, &ONE_SURFACE, &COMBINE];
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
pub fn shade(target: Target, bounded: bool, sharing: Sharing, emitter: Emitter) -> Program {
    let bound = if bounded { &PAIR_BOUNDED } else { &PAIR_UNBOUNDED };
    let mut modules = [&[&TYPES, vpl(target)][..], &lobes(target)].concat();
    modules.extend([bound, emitter.module(), &GATHER]);
    match sharing {
        Sharing::Own => modules.extend([&SEEN_HARD, &ROW_POINT]),
        Sharing::Cluster => modules.extend([&SEEN_HARD, &ROW_CLUSTER]),
        Sharing::Fuzzy => modules.push(&SEEN_FUZZY),
    }
    let glossy = target.features.phong;
    modules.push(if glossy { &PAIR_GLOSSY } else { &PAIR_DIFFUSE });
    modules.push(match target.subgroups {
        true if glossy => &SHADE_GLOSSY,
        true => &SHADE_COOPERATIVE,
        false => &SHADE,
    });
    Program::new("shading", modules)
}

/// Emission towards the camera.
pub fn emit(target: Target) -> Program {
    let modules = vec![&TYPES, &THROUGHPUT_NONE, surfaces::glow(target.features), &EMIT];
    Program::new("emission", modules)
}

/// Radiance of the environment towards the camera.
pub fn background(target: Target) -> Option<Program> {
    let sky = sky(target)?;
    let modules = [&[&TYPES][..], &sky, &[&THROUGHPUT_NONE, &BACKGROUND]].concat();
    Some(Program::new("background", modules))
}

/// What the camera sees emitted in a scene.
pub fn emitted(plan: &Plan) -> Vec<Program> {
    let areas = plan.lights.have_surfaces();
    areas.then(|| emit(plan.target())).into_iter().chain(background(plan.target())).collect()
}

/// The radiance of the environment, if there is one.
fn sky(target: Target) -> Option<Vec<&'static Module>> {
    match target.features.sky {
        Sky::None => None,
        Sky::Constant => Some(vec![&ENVIRONMENT_CONSTANT]),
        Sky::Image => Some(vec![&ENVIRONMENT_IMAGE]),
    }
}

/// What visible points have gathered to reflected radiance.
pub fn reflect(target: Target) -> Program {
    let albedo = surfaces::albedo(target.features);
    let modules = [&[&TYPES][..], &lobes(target), &[albedo, &REFLECT]].concat();
    Program::new("reflection", modules)
}

/// What the clamp removed.
pub fn removed(target: Target) -> Program {
    let albedo = surfaces::albedo(target.features);
    let modules = [&[&TYPES][..], &lobes(target), &[albedo, &REMOVED]].concat();
    Program::new("clamped energy", modules)
}

/// Radiance of visible points to the film, through mirrors and glass.
pub fn resolve(target: Target) -> Program {
    Program::new("throughput", vec![&TYPES, throughput(target), &RESOLVE])
}

/// The picture of a method without light; none for the others.
pub fn show(target: Target, method: Method) -> Option<Program> {
    let (label, module) = match method {
        Method::Normal => ("normals", &SHOW_NORMAL),
        Method::Depth => ("depth", &SHOW_DEPTH),
        Method::Albedo => ("albedo", &SHOW_ALBEDO),
        _ => return None,
    };
    let mut modules = vec![&TYPES];
    if method == Method::Albedo {
        modules.push(surfaces::albedo(target.features));
        match target.features.has_finishes() {
            true => modules.extend([&FINISH, &REFLECTANCE_ANY]),
            false => modules.push(&REFLECTANCE_PLAIN),
        }
    }
    modules.push(module);
    Some(Program::new(label, modules))
}

/// The programs that a scene and settings need: the one list of what is linked.
pub(super) fn needed(plan: &Plan, settings: &Settings) -> Vec<Program> {
    if settings.method == Method::Path {
        return path::needed(plan, settings);
    }
    let target = plan.target_of(settings);
    let mut programs = vec![visible_points(target)];
    programs.extend(show(plan.target(), settings.method));
    if !settings.method.is_lit() {
        return programs;
    }
    match settings.antialiases() {
        true => programs.push(antialias(target)),
        false => programs.extend(target.features.specular().then(|| resolve(target))),
    }
    programs.extend(emitted(plan));
    if settings.direct != Direct::Off {
        for kind in plan.kinds() {
            match Emitter::of(kind).filter(|_| settings.direct == Direct::Clustered) {
                Some(emitter) => {
                    let shade = shade(target, false, settings.sharing(), emitter);
                    programs.extend([visibility_for(plan, emitter), shade]);
                }
                None => programs.push(direct_for(plan, kind)),
            }
        }
        programs.push(reflect(target));
    }
    if settings.traces_light_paths() {
        let bounded = settings.clamp != Clamp::Off;
        programs.extend([
            visibility_for(plan, Emitter::Surface),
            shade(target, bounded, settings.sharing(), Emitter::Surface),
            reflect(target),
        ]);
        programs.extend(bounded.then(|| removed(target)));
        programs.extend(settings.shares_columns().then(expand));
        if settings.interleaves() {
            programs.extend([separate(), collect(target, settings.probes()), combine(target)]);
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
            self.get(prepared, program)?;
        }
        Ok(())
    }

    /// The kernel of a program, compiled at most once.
    pub(super) fn get(
        &self,
        prepared: &Prepared,
        program: Program,
    ) -> Result<Arc<Kernel>, GpuError> {
        let program = prepared.complete(program);
        let mut kernels = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, kernel)) = kernels.iter().find(|(known, _)| *known == program) {
            return Ok(kernel.clone());
        }
        let kernel = Arc::new(prepared.gpu.compile(&program)?);
        kernels.push((program, kernel.clone()));
        Ok(kernel)
    }

    /// Features that no module linked so far serves.
    pub(super) fn left_out(&self) -> Vec<&'static str> {
        let kernels = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        features_without(kernels.iter().map(|(program, _)| program))
    }
}

/// Whether there are programs for a kind of lights: not for an environment, or spheres, that are not
/// there.
fn has_kind(target: Target, kind: LightKind) -> bool {
    match kind {
        LightKind::Environment => target.features.sky.shines(),
        LightKind::Sphere => target.features.sphere_lights,
        _ => true,
    }
}

/// Features that some module of the programs serves, in the order of the catalogue.
pub fn features_of<'a>(programs: impl Iterator<Item = &'a Program>) -> Vec<&'static str> {
    let served = |program: &'a Program| program.modules.iter().filter_map(|module| module.feature);
    let linked: Vec<_> = programs.flat_map(served).collect();
    features().into_iter().filter(|feature| linked.contains(feature)).collect()
}

/// Features that no module of the programs serves, in the order of the catalogue.
pub fn features_without<'a>(programs: impl Iterator<Item = &'a Program>) -> Vec<&'static str> {
    let linked = features_of(programs);
    features().into_iter().filter(|feature| !linked.contains(feature)).collect()
}

/// All features, each once, in the order of the catalogue.
fn features() -> Vec<&'static str> {
    let mut features = Vec::new();
    for feature in CATALOGUE.iter().filter_map(|module| module.feature) {
        if !features.contains(&feature) {
            features.push(feature);
        }
    }
    features
}

/// Every program that some scene or setting links, for tests and tools.
pub fn all_programs() -> Vec<Program> {
    let mut programs = vec![expand(), separate()];
    for target in Target::all() {
        for emitter in [Emitter::Surface, Emitter::Point] {
            // Literals are of triangles alone.
            let linked = |tracing: &Tracing| *tracing != Tracing::Literals || target.literals;
            let tracing = Tracing::ALL.into_iter().filter(linked);
            programs.extend(tracing.map(|tracing| visibility(target, tracing, emitter)));
        }
        programs.extend([visible_points(target), antialias(target), resolve(target)]);
        programs.extend([emit(target), reflect(target), removed(target), combine(target)]);
        programs.extend([false, true].map(|probed| collect(target, probed)));
        programs.extend(background(target));
        let shown = [Method::Normal, Method::Depth, Method::Albedo];
        programs.extend(shown.into_iter().filter_map(|method| show(target, method)));
        for kind in LightKind::ALL.into_iter().filter(|&kind| has_kind(target, kind)) {
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
    programs.extend(path::common());
    let example =
        TriangleRecord { b: [1.0, 0.0, 0.0], c: [0.0, 1.0, 0.0], ..bytemuck::Zeroable::zeroed() };
    let literals = Literals::of_triangles(&[example], &[], true);
    let complete = |program| literals.iter().fold(program, |of, literals| literals.complete(of));
    let mut distinct: Vec<Program> = Vec::new();
    for program in programs.into_iter().map(complete) {
        if !distinct.contains(&program) {
            distinct.push(program);
        }
    }
    distinct
}
