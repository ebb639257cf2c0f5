//! Which shader files make which kernel, and which kernels a scene needs.

mod camera;
pub mod compensate;
mod gather;
mod light;
pub mod path;
mod surfaces;
mod tracing;

use std::sync::{Arc, Mutex, PoisonError};

use super::literals::Literals;
use super::{Clamp, Direct, LightKind, Method, Plan, Prepared, Settings, Target};
use crate::gpu::module::{
    FINISH, LITERAL_RAY, REFLECTANCE_ANY, REFLECTANCE_PLAIN, SHOW_ALBEDO, SHOW_DEPTH, SHOW_NORMAL,
    TRAVERSE, TRAVERSE_PACKET, TYPES,
};
use crate::gpu::{CATALOGUE, GpuError, Kernel, Module, Program, TriangleRecord};
pub use camera::{antialias, resolve, visible_points};
use camera::{camera_rays, follow, kept};
pub use gather::{
    Emitter, Sharing, collect, combine, expand, rays_at_once, reflect, removed, separate, shade,
    visibility, visibility_for,
};
pub use light::{background, direct, direct_for, emit, emitted};
use light::{has_kind, lights_of, sky};
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
    let mut programs = vec![visible_points(target, settings.method.is_lit())];
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
        let combined = settings.compensates() && settings.interleaves();
        programs.extend(bounded.then(|| removed(target, combined)));
        programs.extend(settings.shares_columns().then(expand));
        if settings.interleaves() {
            programs.extend([
                separate(),
                collect(target, settings.probes(), settings.compensates()),
                combine(target),
            ]);
        }
        if settings.compensates() {
            programs.extend(compensate::needed(plan, settings));
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
        programs.extend([false, true].map(|lit| visible_points(target, lit)));
        programs.extend([antialias(target), resolve(target)]);
        programs.extend([emit(target), reflect(target), combine(target)]);
        programs.extend([false, true].map(|given| removed(target, given)));
        for probed in [false, true] {
            programs.extend([false, true].map(|given| collect(target, probed, given)));
        }
        programs.extend(background(target));
        let shown = [Method::Normal, Method::Depth, Method::Albedo];
        programs.extend(shown.into_iter().filter_map(|method| show(target, method)));
        for kind in LightKind::ALL.into_iter().filter(|&kind| has_kind(target, kind)) {
            for near in [false, true] {
                programs.extend([false, true].map(|many| direct(target, kind, many, near)));
            }
        }
        let sharing = [Sharing::Cluster, Sharing::Fuzzy];
        programs.extend(sharing.map(|sharing| shade(target, false, sharing, Emitter::Point)));
        for bounded in [false, true] {
            let sharing = [Sharing::Own, Sharing::Cluster, Sharing::Fuzzy];
            let emitter = Emitter::Surface;
            programs.extend(sharing.map(|sharing| shade(target, bounded, sharing, emitter)));
        }
        programs.extend(path::all(target));
        programs.extend(compensate::all(target));
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
