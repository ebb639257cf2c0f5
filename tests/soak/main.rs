//! Random scenes in random settings, for as long as asked: nothing panics, hangs, leaks, or makes
//! a pixel that is no number.
//!
//! `SOAK_SECONDS` says how long; a few seconds otherwise. Scenes have numbers, from `SOAK_FROM`,
//! or 0. `SOAK_SEED` replays the one of that number.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

#[path = "../common/mod.rs"]
mod common;
mod random;
mod scenes;
mod settings;
mod watch;

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::time::{Duration, Instant};

use common::{Rng, open_gpu};
use gpu_vpl::gpu::Gpu;
use gpu_vpl::render::{self, Frame, Method, Prepared, Settings};
use gpu_vpl::scene::Scene;
use random::percent;
use watch::{Memory, Watchdog};

const SHORT: u64 = 4;
/// Frames of a scene.
const FRAMES: usize = 4;
/// Scenes after which a run is long enough for its memory to tell.
const LONG: usize = 100;
/// What the floor of the memory may grow by in a run of any length. Shared pipelines, arenas of
/// the allocator for threads that start late and the driver's caches settle well within; a frame's
/// buffers are megabytes, so that losing one in a hundred scenes is found within the hour.
const GROWTH: u64 = 128 << 20;

fn number(name: &str) -> Option<u64> {
    let text = std::env::var(name).ok()?;
    Some(text.parse().unwrap_or_else(|_| panic!("{name} is no number: {text}")))
}

#[derive(Debug, Default)]
struct Tally {
    scenes: usize,
    refused: usize,
    /// Frames, their time, and that of the slowest, by what they show.
    frames: BTreeMap<String, (u64, Duration, Duration)>,
    /// The slowest of all, and what tells how to replay it.
    slowest: (Duration, String),
}

impl Tally {
    fn add(&mut self, what: String, time: Duration, doing: String) {
        if time > self.slowest.0 {
            self.slowest = (time, doing);
        }
        let (count, sum, most) = self.frames.entry(what).or_default();
        *count += 1;
        *sum += time;
        *most = time.max(*most);
    }

    fn print(&self, since: Instant) {
        let count: u64 = self.frames.values().map(|(count, ..)| count).sum();
        let (scenes, refused) = (self.scenes, self.refused);
        eprintln!(
            "{scenes} scenes and {refused} refused, {count} frames in {:.0} s",
            since.elapsed().as_secs_f64()
        );
        for (what, (count, sum, most)) in &self.frames {
            let mean = sum.as_secs_f64() / *count as f64;
            eprintln!(
                "{what:>20} {count:>7} frames, {mean:.3} s each, {:.2} s at most",
                most.as_secs_f64()
            );
        }
        eprintln!("the slowest: {}", self.slowest.1);
    }
}

/// Devices that scenes share one after the other.
#[derive(Debug, Default)]
struct Devices {
    with_subgroups: Option<Gpu>,
    without: Option<Gpu>,
}

impl Devices {
    /// That of a scene: most share one, every few open their own.
    fn take(&mut self, number: u64) -> Gpu {
        let own = number % 8 == 7;
        match Self::plain(number) {
            true => self
                .without
                .take()
                .filter(|_| !own)
                .unwrap_or_else(|| open_gpu().without_subgroups()),
            false => self.with_subgroups.take().filter(|_| !own).unwrap_or_else(open_gpu),
        }
    }

    fn give_back(&mut self, number: u64, gpu: Gpu) {
        *if Self::plain(number) { &mut self.without } else { &mut self.with_subgroups } = Some(gpu);
    }

    /// Whether a scene is rendered as on an adapter without subgroups.
    fn plain(number: u64) -> bool {
        number % 3 == 2
    }
}

#[test]
fn random_scenes_render() {
    let replayed = number("SOAK_SEED");
    let seconds = number("SOAK_SECONDS").unwrap_or(SHORT);
    let first = replayed.or(number("SOAK_FROM")).unwrap_or(0);
    let start = Instant::now();
    let watchdog = Watchdog::start();
    let (mut tally, mut devices, mut memory) =
        (Tally::default(), Devices::default(), Memory::default());
    for number in first.. {
        let run = || render_scene(number, &mut devices, &mut tally, &watchdog);
        if let Err(panic) = catch_unwind(AssertUnwindSafe(run)) {
            eprintln!("replay with SOAK_SEED={number}: {}", watchdog.doing());
            resume_unwind(panic);
        }
        memory.note();
        if replayed.is_some() || start.elapsed() >= Duration::from_secs(seconds) {
            break;
        }
    }
    watchdog.done();
    tally.print(start);
    eprintln!("{}", memory.summary());
    assert!(tally.refused <= tally.scenes / 4 + 1, "most of what is drawn should be scenes");
    if tally.scenes >= LONG {
        assert!(memory.growth() <= GROWTH, "{}", memory.summary());
    }
}

/// What a long run has found, and was mended: a lamp that is seen edge-on from a point near its plane
/// weighed as the rounding of two cosines over one another.
#[test]
fn a_scene_that_was_not_finite_is() {
    let watchdog = Watchdog::start();
    let (mut tally, mut devices) = (Tally::default(), Devices::default());
    render_scene(24_583, &mut devices, &mut tally, &watchdog);
    watchdog.done();
    assert_eq!(tally.refused, 0, "what is refused shows nothing");
}

fn render_scene(number: u64, devices: &mut Devices, tally: &mut Tally, watchdog: &Watchdog) {
    let mut rng = Rng(number);
    watchdog.now(format!("scene {number} is made"));
    let scene = match scenes::scene(&mut rng) {
        Ok(scene) => scene,
        Err(error) => {
            assert!(!error.to_string().contains('\n'), "a refusal is one line: {error}");
            tally.refused += 1;
            return;
        }
    };
    tally.scenes += 1;
    // All methods, in turn from scene to scene.
    let at = |frame: usize| (5 * number as usize + frame) % Method::ALL.len();
    let everything = percent(&mut rng, 5);
    let mut prepared = None;
    for frame in 0..FRAMES {
        let of_scene = prepared.as_ref().map_or(&scene, |prepared: &Prepared| &prepared.scene);
        let camera = settings::camera(&mut rng, &of_scene.camera);
        let (pixels, scale) = (camera.size[0] * camera.size[1], of_scene.units.scale);
        let method = Method::ALL[at(frame)];
        let settings = settings::settings(&mut rng, method, pixels, scale);
        let settings = Settings { link_everything: everything, ..settings };
        let seed = rng.bits();
        watchdog.now(format!("scene {number}, {:?} px, seed {seed}, {settings:?}", camera.size));
        let on = prepared.get_or_insert_with(|| prepare(number, devices, &scene, &settings));
        let start = Instant::now();
        let render = || render::frame(on, &camera, &settings, seed, &|_, _| {}).unwrap();
        let frame = render();
        check(&frame, method);
        tally.add(shown(&settings), start.elapsed(), watchdog.doing());
        if percent(&mut rng, 10) {
            assert!(same_bytes(&frame, &render()), "the same frame twice has other bytes");
        }
    }
    if let Some(prepared) = prepared {
        devices.give_back(number, prepared.gpu);
    }
}

fn prepare(number: u64, devices: &mut Devices, scene: &Scene, settings: &Settings) -> Prepared {
    Prepared::new(devices.take(number), scene.clone(), settings).unwrap()
}

/// The method, and in how many clusters a point is.
fn shown(settings: &Settings) -> String {
    let (name, fuzzy) = (settings.method.name(), settings.clustering.fuzzy);
    match settings.method.clusters_points() && settings.method.is_indirect() {
        true => format!("{name}, fuzzy {fuzzy}"),
        false => name.to_owned(),
    }
}

/// All values are numbers, and possible ones.
fn check(frame: &Frame, method: Method) {
    assert_eq!(frame.image.first_nonfinite(), None, "not finite");
    assert_eq!(frame.counts.nonfinite_pixels, 0, "counted as not finite");
    let values = || frame.image.pixels.as_flattened().iter().copied();
    let least = if method == Method::Normal { -1.0 } else { 0.0 };
    // Normals are of unit length and reflectances of 1 to rounding, which sums of samples add up.
    let most = match method {
        Method::Normal | Method::Albedo => 1.0 + 1e-5,
        _ => f32::MAX,
    };
    for value in values() {
        assert!(
            value >= least - if least < 0.0 { 1e-5 } else { 0.0 },
            "{value} is less than {least}"
        );
        assert!(value <= most, "{value} is more than {most}");
    }
    let clamped = frame.counts.clamped_fraction;
    assert!((0.0..=1.0).contains(&clamped), "a share of {clamped} was clamped");
    if let Some(error) = &frame.standard_error {
        assert_eq!(error.first_nonfinite(), None, "an error that is not finite");
    }
}

fn same_bytes(one: &Frame, two: &Frame) -> bool {
    let bits = |frame: &Frame| -> Vec<u32> {
        frame.image.pixels.as_flattened().iter().map(|value| value.to_bits()).collect()
    };
    bits(one) == bits(two)
}
