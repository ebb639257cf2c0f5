//! A study under way: scene by scene, frame by frame; what the store holds is not measured again.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::decompose::{Frames, decomposed, has_parts};
use super::measure::Bench;
use super::reference::{self, Making};
use super::store::name_of;
use super::{
    Event, Found, FoundFrame, Measured, Plan, Reference, ReferencePlan, Store, Tell,
    name_of_program, options, unclustered,
};
use crate::error::Error;
use crate::gpu::{AdapterChoice, AdapterInfo, Gpu};
use crate::image::Image;
use crate::render::{Prepared, Settings};
use crate::scene::Scene;

/// A study under way.
#[derive(Debug)]
pub struct Study {
    pub(super) plan: Plan,
    /// What is kept on disk.
    pub store: Store,
    adapter: AdapterChoice,
    interrupt: Arc<AtomicBool>,
    /// The scenes begun so far.
    pub found: Vec<Found>,
    /// The adapter used.
    pub used: Option<AdapterInfo>,
}

impl Study {
    /// Nothing is measured yet beside what the store holds.
    pub fn new(
        plan: Plan,
        store: Store,
        adapter: AdapterChoice,
        interrupt: Arc<AtomicBool>,
    ) -> Self {
        Self { plan, store, adapter, interrupt, found: Vec::new(), used: None }
    }

    /// Measures all that is not in the store. What was found stays if an error ends it.
    ///
    /// # Errors
    /// A scene or reference cannot be read, the device fails, the disk is full, or the user
    /// interrupts.
    pub fn run(&mut self, tell: Tell<'_>) -> Result<(), Error> {
        for scene in self.plan.scenes.clone() {
            self.scene(&scene, tell)?;
        }
        Ok(())
    }

    fn scene(&mut self, name: &str, tell: Tell<'_>) -> Result<(), Error> {
        let scene = Scene::load(name)?;
        for warning in &scene.warnings {
            tell(Event::Warning(&warning.message));
        }
        let gpu = Gpu::open(&self.adapter)?.interrupted_by(self.interrupt.clone());
        let used = self.used.insert(gpu.info.clone());
        let mut camera = scene.camera;
        camera.size = self.plan.size.unwrap_or(camera.size);
        let exposure = scene.exposure;
        let prepared = Prepared::new(gpu, scene, &Settings::default())?;
        self.found.push(Found {
            scene: name.to_owned(),
            triangles: prepared.scene.triangles.len(),
            size: camera.size,
            exposure,
            references: Vec::new(),
            frames: Vec::new(),
        });
        let key = key(used, &prepared, camera.size);
        let bench = Bench::new(&prepared, camera, self.plan.frames);
        let mut work = Work { study: self, bench, key, tell };
        work.references(name, exposure)?;
        for index in 0..work.study.plan.seeds.len() {
            for settings in work.study.plan.frames_of_seed(index) {
                work.frame(&settings, index)?;
            }
        }
        work.decompositions()?;
        Ok(())
    }
}

/// Measuring a scene.
struct Work<'a> {
    study: &'a mut Study,
    bench: Bench<'a>,
    /// What tells the scene from others, and this program and machine from others.
    key: String,
    tell: Tell<'a>,
}

impl Work<'_> {
    fn found(&mut self) -> Option<&mut Found> {
        self.study.found.last_mut()
    }

    fn references(&mut self, scene: &str, exposure: f32) -> Result<(), Error> {
        let mask_above = self.study.plan.mask_above;
        let making = Making { key: &self.key, scene, mask_above, exposure };
        for transport in self.study.plan.transports() {
            let (bench, store, tell) = (&mut self.bench, &mut self.study.store, self.tell);
            let mut reference = match &self.study.plan.reference {
                ReferencePlan::Path { samples } => {
                    reference::rendered(bench, store, making, transport, *samples, tell)?
                }
                ReferencePlan::File(file) => {
                    reference::given(bench, store, making, transport, file, tell)?
                }
            };
            if !reference.lens.keep.contains(&true) {
                let what = format!("{scene}: mask_above leaves no pixel to compare; raise it");
                return Err(Error::Usage(what));
            }
            for warning in &reference.about.warnings {
                tell(Event::Warning(warning));
            }
            let Some(found) = self.study.found.last_mut() else { continue };
            let id = format!("reference {}", found.references.len() + 1);
            reference.about.image = Some(id.clone());
            reference.about.id = id;
            found.references.push(reference);
        }
        Ok(())
    }

    /// Measures a frame with the seed of an index, or finds it measured.
    fn frame(&mut self, settings: &Settings, index: usize) -> Result<(), Error> {
        let seed = self.study.plan.seeds[index];
        let base = unclustered(settings).filter(|_| self.study.plan.clusters(index));
        let clusters = base.is_some();
        let identity = self.reference(settings).map(|reference| reference.identity.clone());
        let image_key = self.image_key(settings, seed);
        let key = format!(
            "{image_key} frames {} reference {identity:?} mask {:?} clustering {clusters}",
            self.bench.frames, self.study.plan.mask_above
        );
        let image = name_of(&image_key);
        let shown = index == 0 || self.is_base(settings, index);
        let kept =
            self.study.store.get(&key).filter(|_| !shown || self.study.store.has_image(&image));
        let was_kept = kept.is_some();
        let measured = match kept {
            Some(measured) => measured.clone(),
            None => {
                let (frame, times) = self.bench.frame(settings, seed)?;
                let base = base.map(|base| self.base_image(&base, seed)).transpose()?;
                let measured = self.compared(settings, &frame.image, base.as_ref());
                let measured = Measured { times, counts: frame.counts, ..measured };
                if shown {
                    self.study.store.put_image(&image, &frame.image)?;
                }
                self.study.store.put(&key, measured.clone())?;
                measured
            }
        };
        let tell = self.tell;
        if let Some(found) = self.found() {
            let (scene, measured_now) = (&found.scene, &measured);
            tell(Event::Frame { scene, settings, seed, measured: measured_now, kept: was_kept });
            found.frames.push(FoundFrame { settings: *settings, seed, measured, image });
        }
        Ok(())
    }

    fn reference(&self, settings: &Settings) -> Option<&Reference> {
        self.study.found.last()?.reference(settings)
    }

    /// The errors of an image against the reference, and against the one without clusters.
    fn compared(&self, settings: &Settings, image: &Image, base: Option<&Image>) -> Measured {
        let Some(reference) = self.reference(settings) else { return Measured::default() };
        let lens = &reference.lens;
        Measured {
            total: lens.compare(&reference.image, image),
            clustering: base.and_then(|base| lens.compare(base, image)),
            ..Measured::default()
        }
    }

    /// Whether others of this seed are compared with a frame.
    fn is_base(&self, settings: &Settings, index: usize) -> bool {
        let plan = &self.study.plan;
        plan.clusters(index)
            && plan
                .frames_of_seed(index)
                .iter()
                .any(|other| unclustered(other).is_some_and(|base| options::same(&base, settings)))
    }

    /// The image of a frame that was measured before.
    fn base_image(&mut self, base: &Settings, seed: u32) -> Result<Image, Error> {
        let name = name_of(&self.image_key(base, seed));
        match self.study.store.image(&name) {
            Some(image) => Ok(image),
            None => Ok(self.bench.frame(base, seed)?.0.image),
        }
    }

    fn image_key(&self, settings: &Settings, seed: u32) -> String {
        options::of_frame(&self.key, settings, seed)
    }

    /// Takes the errors of rows apart, as far as the plan says.
    fn decompositions(&mut self) -> Result<(), Error> {
        let plan = &self.study.plan;
        let Some(decompose) = plan.decompose else { return Ok(()) };
        let (seeds, rows) = (decompose.seeds.min(plan.seeds.len()), plan.rows());
        for index in 0..seeds {
            for settings in rows.iter().filter(|settings| has_parts(settings)) {
                self.decomposition(settings, index, decompose.light_samples)?;
            }
        }
        Ok(())
    }

    /// Takes the error of a frame with the seed of an index apart, or finds that done.
    fn decomposition(
        &mut self,
        settings: &Settings,
        index: usize,
        light_samples: u32,
    ) -> Result<(), Error> {
        let Self { study, bench, key, tell } = self;
        let Study { plan, store, found, .. } = &mut **study;
        let Some(found) = found.last_mut() else { return Ok(()) };
        let Some(reference) = found.reference(settings) else { return Ok(()) };
        let (seed, sharing) = (plan.seeds[index], plan.clusters(index));
        let mut frames = Frames::new(bench, store, [key, &found.scene], light_samples, *tell);
        let decomposition = decomposed(&mut frames, settings, seed, reference, sharing)?;
        let same = |frame: &&mut FoundFrame| {
            frame.seed == seed && options::same(&frame.settings, settings)
        };
        if let Some(frame) = found.frames.iter_mut().find(same) {
            frame.measured.decomposition = decomposition;
        }
        Ok(())
    }
}

/// What tells a scene from others, and this program and machine from others: all that figures
/// depend on.
fn key(adapter: &AdapterInfo, prepared: &Prepared, [width, height]: [u32; 2]) -> String {
    let scene = &prepared.scene;
    let mut hasher = DefaultHasher::new();
    name_of_program().hash(&mut hasher);
    bytemuck::cast_slice::<_, u8>(&prepared.bvh.triangles).hash(&mut hasher);
    let rest = (&scene.materials, &scene.point_lights, &scene.camera, scene.units, adapter);
    format!("{rest:?}").hash(&mut hasher);
    let threads = rayon::current_num_threads();
    format!("{} {:016x} {threads} {width}x{height}", scene.name, hasher.finish())
}
