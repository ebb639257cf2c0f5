//! The programs that frames of a scene run: the one list of what is linked for which settings.

use super::Plan;
use crate::gpu::Program;
use crate::render::kernels::{
    self, Emitter, FilterPrograms, Filtered, LightRays, antialias, background, clamped_energy,
    compensation, discontinuity_buffer, draw_members, emit, expand, first_rays, join_subsets,
    link_rays, pack_columns, path, reflect, replace_points, resolve, resolve_rays, shade, show,
    split_subsets, unseen_surfaces, visible_points,
};
use crate::render::lights::LightKind;
use crate::render::settings::{Bounces, Clamp, Direct, Method, Settings};

impl Plan {
    /// The programs that frames with these settings run.
    pub fn programs(&self, settings: &Settings) -> Vec<Program> {
        let needed = match settings.method {
            Method::Path => self.path_programs(settings),
            _ => self.vpl_programs(settings),
        };
        needed.into_iter().map(|program| self.complete(program)).collect()
    }

    /// Those of every method but [`Method::Path`].
    fn vpl_programs(&self, settings: &Settings) -> Vec<Program> {
        let target = self.target_of(settings);
        let mut programs =
            vec![visible_points(target, settings.method.is_lit(), settings.antialiases())];
        programs.extend(show(self.target(), settings.method));
        if !settings.method.is_lit() {
            return programs;
        }
        match settings.antialiases() {
            true => programs.extend(self.antialiasing_programs(settings)),
            false => {
                programs.extend(target.features.specular().then(|| resolve(target)));
                programs.extend(self.emission_programs());
            }
        }
        if settings.direct != Direct::Off {
            programs.extend(self.direct_programs(settings));
            programs.push(reflect(target));
        }
        if settings.traces_light_paths() {
            let bounded = settings.clamp != Clamp::Off;
            programs.extend([
                self.visibility_program(Emitter::Surface),
                shade(target, bounded, settings.sharing(), Emitter::Surface),
                reflect(target),
            ]);
            let combined = settings.filters_compensation();
            programs.extend(bounded.then(|| clamped_energy(target, combined)));
            if settings.corrects() {
                programs.push(kernels::correct(target, bounded, settings.sharing()));
            }
            if settings.shares_columns() {
                programs.extend([pack_columns(), expand()]);
            }
            if settings.draws_members() {
                programs.extend([draw_members(target), self.member_visibility_program()]);
            }
            if settings.interleaves() {
                programs.extend([
                    split_subsets(),
                    join_subsets(target, settings.probes(), combined),
                    discontinuity_buffer(target, false),
                    discontinuity_buffer(target, true),
                ]);
            }
            if settings.compensates() {
                programs.extend(self.compensation_programs(settings));
            }
        }
        programs
    }

    /// Those that antialias; their rays find emission and background, too.
    fn antialiasing_programs(&self, settings: &Settings) -> Vec<Program> {
        let (target, emits) = (self.target_of(settings), self.lights.have_surfaces());
        vec![
            first_rays(target, emits),
            unseen_surfaces(),
            replace_points(),
            link_rays(target, emits),
            resolve_rays(target, emits),
            antialias(target, emits),
        ]
    }

    /// Those of [`Method::Path`].
    fn path_programs(&self, settings: &Settings) -> Vec<Program> {
        let target = self.target();
        let mut programs = vec![path::camera(target), path::count(), path::compact(), path::sum()];
        programs.extend(self.path_emission_programs());
        if path::seeks_light(settings) {
            programs.extend(self.kinds().filter_map(|kind| path::next_event(target, kind)));
        }
        let segments = self.has_segments(settings);
        let segment = || path::segment(target, settings.bounces, self.lights.have_surfaces());
        programs.extend(segments.then(segment));
        programs
    }

    /// Those of bias compensation.
    fn compensation_programs(&self, settings: &Settings) -> Vec<Program> {
        let target = self.target();
        let mut programs = vec![compensation::start(), path::count(), path::compact()];
        programs.extend(self.kinds().filter_map(|kind| compensation::next_event(target, kind)));
        programs.extend([
            compensation::vpls(target, settings.shares_sights()),
            compensation::compensated(target),
        ]);
        let areas = self.lights.have_surfaces();
        programs.push(compensation::segment(target, settings.bounces, areas));
        if settings.filters_compensation() {
            programs.extend(self.filter_programs(Filtered::Compensation).all());
        }
        programs
    }

    /// Those of direct light.
    fn direct_programs(&self, settings: &Settings) -> Vec<Program> {
        let target = self.target_of(settings);
        let shared = |kind| Emitter::of(kind).filter(|_| settings.direct == Direct::Clustered);
        let mut programs = Vec::new();
        for emitter in self.kinds().filter_map(shared) {
            let shade = shade(target, false, settings.sharing(), emitter);
            programs.extend([self.visibility_program(emitter), shade]);
        }
        let kinds = self.kinds().filter(|&kind| shared(kind).is_none());
        let [exact, sampled] = self.lights.part(kinds, settings);
        programs.extend(exact.into_iter().map(|kind| self.direct_exact_program(kind)));
        if !sampled.is_empty() {
            programs.push(self.direct_sampled_program(&sampled, settings));
            programs.extend(self.direct_lobe_program(&sampled, settings));
            if settings.few_light_samples() {
                programs.extend(self.direct_guide_programs(&sampled));
            }
            if settings.filters_direct() {
                programs.extend(self.filter_programs(Filtered::Direct).all());
            }
        }
        programs
    }

    /// Direct light from the lights of a kind without extent.
    pub fn direct_exact_program(&self, kind: LightKind) -> Program {
        kernels::direct_exact(self.target(), kind)
    }

    /// Direct light from the lights of kinds that have some: samples.
    pub fn direct_sampled_program(&self, kinds: &[LightKind], settings: &Settings) -> Program {
        kernels::direct_sampled(self.target(), kinds, self.near_lights, light_rays(settings))
    }

    /// What guides them: unshadowed light, pilot rays, and the guide.
    pub fn direct_guide_programs(&self, kinds: &[LightKind]) -> [Program; 3] {
        let (target, near) = (self.target(), self.near_lights);
        [
            kernels::guide_unshadowed(target, kinds, near),
            kernels::guide_pilot(target, kinds, near),
            kernels::guide(),
        ]
    }

    /// What rays by the lobes of glossy surfaces find of the lights of kinds that have some extent.
    pub fn direct_lobe_program(&self, kinds: &[LightKind], settings: &Settings) -> Option<Program> {
        kernels::direct_lobe_rays(self.target(), kinds, light_rays(settings))
    }

    /// What filters light over pixels.
    pub fn filter_programs(&self, filtered: Filtered) -> FilterPrograms {
        FilterPrograms::new(self.target(), filtered)
    }

    /// Shadow rays between points and lights.
    pub fn visibility_program(&self, emitter: Emitter) -> Program {
        kernels::visibility(self.target(), self.tracing(), emitter)
    }

    /// Shadow rays between points and members of VPL clusters.
    pub fn member_visibility_program(&self) -> Program {
        kernels::visibility_of_members(self.target(), self.tracing())
    }

    /// What the camera sees emitted.
    pub fn emission_programs(&self) -> Vec<Program> {
        let (target, areas) = (self.target(), self.lights.have_surfaces());
        areas.then(|| emit(target)).into_iter().chain(background(target)).collect()
    }

    /// What paths see that is emitted towards the camera.
    pub fn path_emission_programs(&self) -> Vec<Program> {
        let (target, areas) = (self.target(), self.lights.have_surfaces());
        areas.then(|| path::emit(target)).into_iter().chain(path::background(target)).collect()
    }

    /// Whether paths go beyond the visible point: to bounce, or to happen upon lights.
    pub fn has_segments(&self, settings: &Settings) -> bool {
        let happens = self.lights.have_surfaces() || self.features.sky.shines();
        settings.bounces != Bounces::Finite(0) || (happens && settings.direct != Direct::Off)
    }
}

/// How light samples are drawn with these settings.
fn light_rays(settings: &Settings) -> LightRays {
    match settings.few_light_samples() {
        false => LightRays::Even,
        true if settings.counts_light_samples() => LightRays::Counted,
        true => LightRays::Guided,
    }
}
