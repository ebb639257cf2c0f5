//! Which shader files make which kernel: a program is an ordered list of files, chosen by what a
//! device and a scene need. Nothing here knows a scene or a device itself.

mod antialiasing;
mod camera;
pub mod catalogue;
pub mod compensation;
mod direct;
mod filter;
mod gather;
mod lights;
pub mod literals;
mod materials;
pub mod path;
mod trace;
mod visibility;

use super::features::Target;
use super::lights::LightKind;
use super::settings::{Method, Sharing};
use crate::gpu::{Program, TriangleRecord};
pub use antialiasing::{
    antialias, first_rays, link_rays, rays_of_beam, replace_points, resolve_rays, unseen_surfaces,
};
pub use camera::{background, emit, resolve, show, visible_points};
pub use catalogue::{CATALOGUE, features_of, features_without};
pub use direct::{
    LightRays, direct_exact, direct_lobe_rays, direct_sampled, guide, guide_pilot, guide_unshadowed,
};
pub use filter::{FilterPrograms, Filtered};
pub use gather::{
    clamped_energy, correct, discontinuity_buffer, join_subsets, reflect, shade, split_subsets,
};
use lights::has_kind;
use literals::Literals;
pub use trace::{Tracing, shapes};
pub use visibility::{
    Emitter, draw_members, expand, pack_columns, rays_at_once, visibility, visibility_of_members,
};

/// Every program that some scene or setting links, for tests and tools.
pub fn all_programs() -> Vec<Program> {
    let mut programs = vec![expand(), pack_columns(), split_subsets(), guide()];
    programs.extend([unseen_surfaces(), replace_points()]);
    for target in Target::all() {
        programs.push(draw_members(target));
        // Literals are of triangles alone.
        let linked = |tracing: &Tracing| *tracing != Tracing::Literals || target.literals;
        for tracing in Tracing::ALL.into_iter().filter(linked) {
            let emitters = [Emitter::Surface, Emitter::Point];
            programs.extend(emitters.map(|emitter| visibility(target, tracing, emitter)));
            programs.push(visibility_of_members(target, tracing));
        }
        for [lit, antialiased] in [[false, false], [true, false], [true, true]] {
            programs.push(visible_points(target, lit, antialiased));
        }
        for emits in [false, true] {
            programs.extend([first_rays(target, emits), antialias(target, emits)]);
            programs.extend([link_rays(target, emits), resolve_rays(target, emits)]);
        }
        programs.extend([resolve(target), emit(target), reflect(target)]);
        programs.extend([false, true].map(|last| discontinuity_buffer(target, last)));
        programs.extend([false, true].map(|given| clamped_energy(target, given)));
        for probed in [false, true] {
            programs.extend([false, true].map(|given| join_subsets(target, probed, given)));
        }
        programs.extend(background(target));
        let shown = [Method::Normal, Method::Depth, Method::Albedo];
        programs.extend(shown.into_iter().filter_map(|method| show(target, method)));
        let kinds = LightKind::ALL.into_iter().filter(|&kind| has_kind(target, kind));
        let (exact, extended): (Vec<_>, Vec<_>) = kinds.partition(|kind| kind.is_exact());
        programs.extend(exact.into_iter().map(|kind| direct_exact(target, kind)));
        for filtered in [Filtered::Direct, Filtered::Compensation] {
            programs.extend(FilterPrograms::new(target, filtered).all());
        }
        // One kind, several side by side, and all; lights without extent are alike in samples.
        let extended = [&[LightKind::Point][..], &extended].concat();
        let some = (1..=extended.len()).flat_map(|count| extended.windows(count));
        for kinds in some {
            for near in [false, true] {
                for by in [LightRays::Even, LightRays::Guided, LightRays::Counted] {
                    programs.push(direct_sampled(target, kinds, near, by));
                    programs.extend(direct_lobe_rays(target, kinds, by));
                }
                programs.push(guide_unshadowed(target, kinds, near));
                programs.push(guide_pilot(target, kinds, near));
            }
        }
        let sharing = [Sharing::Cluster, Sharing::Fuzzy];
        programs.extend(sharing.map(|sharing| shade(target, false, sharing, Emitter::Point)));
        for bounded in [false, true] {
            let sharing = [Sharing::Own, Sharing::Cluster, Sharing::Fuzzy];
            let emitter = Emitter::Surface;
            programs.extend(sharing.map(|sharing| shade(target, bounded, sharing, emitter)));
            programs.extend(sharing.map(|sharing| correct(target, bounded, sharing)));
        }
        programs.extend(path::all(target));
        programs.extend(compensation::all(target));
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
