//! Measurements summed up: a row for each setting, over its seeds.

use super::measure::Measured;
use super::page::Picture;
use super::parts::Decomposed;
use super::results::{Curve, Errors, Metric, Results, Row, SCHEMA, SceneResults, Spread};
use super::{
    Experiment, Found, FoundFrame, Plan, Reference, Run, Study, fit, options, thesis, unclustered,
};
use crate::gpu::AdapterInfo;
use crate::metrics::Comparison;
use crate::render::{Bounces, Counts, Settings};
use crate::report::{BounceLimit, FramePhases};

impl Study {
    /// What was found so far; `command` repeats it.
    pub fn results(&self, command: String) -> Results {
        let scenes: Vec<_> = self.found.iter().map(|found| scene(&self.plan, found)).collect();
        let claims = match scenes.first() {
            Some(first) if self.plan.name == thesis::NAME => thesis::claims(&first.rows),
            _ => Vec::new(),
        };
        let unknown = || AdapterInfo::default();
        Results {
            schema: SCHEMA,
            version: env!("CARGO_PKG_VERSION"),
            name: self.plan.name.clone(),
            command,
            adapter: self.used.clone().unwrap_or_else(unknown),
            threads: rayon::current_num_threads(),
            seeds: self.plan.seeds.clone(),
            planned: self.plan.planned(),
            finished: self.found.iter().map(|found| found.frames.len()).sum(),
            scenes,
            claims,
        }
    }

    /// The references, and of each row the picture of its first seed.
    pub fn pictures(&self, results: &Results) -> Vec<Picture> {
        let mut pictures: Vec<Picture> = Vec::new();
        for (found, scene) in self.found.iter().zip(&results.scenes) {
            for Reference { image, about, .. } in &found.references {
                pictures.push(Picture::encode(&about.id, &about.label, &found.scene, image));
            }
            for row in &scene.rows {
                let Some(id) = &row.image else { continue };
                let known = |picture: &Picture| picture.id == *id && picture.scene == found.scene;
                if pictures.iter().any(known) {
                    continue;
                }
                if let Some(image) = self.store.image(id) {
                    let label = format!("{}, {}", row.experiment, row.setting);
                    pictures.push(Picture::encode(id, &label, &found.scene, &image));
                }
            }
        }
        pictures
    }
}

fn scene(plan: &Plan, found: &Found) -> SceneResults {
    let [width, height] = found.size;
    let runs = plan.experiments.iter().flat_map(|e| e.runs.iter().map(move |run| (e, run)));
    let mut rows: Vec<_> = runs.filter_map(|(e, run)| row(plan, found, e, run)).collect();
    mark_pareto(&mut rows);
    let curve = |experiment: &Experiment| Curve {
        name: experiment.name.clone(),
        title: experiment.title.clone(),
        fits: Vec::new(),
    };
    let mut scene = SceneResults {
        scene: found.scene.clone(),
        width,
        height,
        triangles: found.triangles,
        exposure: found.exposure,
        mask_above: plan.mask_above,
        references: found.references.iter().map(|reference| reference.about.clone()).collect(),
        experiments: plan.experiments.iter().map(curve).collect(),
        rows,
    };
    let fits: Vec<_> = scene.experiments.iter().map(|curve| fit::of_curve(&scene, curve)).collect();
    for (curve, fits) in scene.experiments.iter_mut().zip(fits) {
        curve.fits = fits;
    }
    warn_of_noise(&mut scene);
    scene
}

/// A reference whose own noise makes more of the least error than this is too noisy.
const MOST_NOISE: f64 = 0.1;

/// Says of references that their own noise is much of what rows seem to be wrong.
fn warn_of_noise(scene: &mut SceneResults) {
    for reference in &mut scene.references {
        let Some(noise) = reference.noise else { continue };
        let own = scene.rows.iter().filter(|row| row.reference.as_ref() == Some(&reference.id));
        let errors = own.filter_map(|row| Some(row.total?.relmse.mean));
        let share = noise.relmse / errors.fold(f64::INFINITY, f64::min);
        if share > MOST_NOISE {
            reference.warnings.push(format!(
                "its own noise is {:.0} % of the least relMSE measured with it; more \
                 --reference-samples tell more",
                100.0 * share
            ));
        }
    }
}

/// None before the first of its seeds is measured.
fn row(plan: &Plan, found: &Found, experiment: &Experiment, run: &Run) -> Option<Row> {
    let settings = &run.settings;
    let (method, clustering) = (settings.method, &settings.clustering);
    let frames = found.frames_of(settings);
    let first = frames.first()?;
    let Counts { vpls, point_clusters, vpl_clusters, shadow_rays, shading_terms, .. } =
        first.measured.counts;
    let of = |value: fn(&Measured) -> f64| {
        let values: Vec<_> = frames.iter().map(|frame| value(&frame.measured)).collect();
        Spread::of(&values)
    };
    let seconds = of(|measured| measured.times.seconds);
    let comparisons = |of: fn(&Measured) -> Option<&Comparison>| -> Vec<_> {
        frames.iter().filter_map(|frame| of(&frame.measured)).collect()
    };
    let total = Errors::of(&comparisons(|measured| measured.total.as_ref()));
    let reference = found.reference(settings);
    let noise = reference.and_then(|reference| reference.about.noise).map_or(0.0, |n| n.rmse);
    let efficiency = total
        .map(|total| total.rmse.mean.powi(2) - noise * noise)
        .filter(|mse| *mse > 0.0)
        .map(|mse| 1.0 / (mse * seconds.mean));
    Some(Row {
        experiment: experiment.name.clone(),
        setting: run.setting.clone(),
        method: method.name(),
        command: options::command(&found.scene, settings, found.size, plan.seeds[0]),
        light_paths: if method.traces_paths() { settings.light_paths } else { 0 },
        bounces: match settings.bounces {
            Bounces::Finite(bounces) => BounceLimit::Finite(bounces),
            Bounces::Unlimited => BounceLimit::Named("unlimited"),
        },
        samples: settings.samples,
        wanted_point_clusters: method.clusters_points().then_some(clustering.points),
        wanted_vpl_clusters: method.clusters_vpls().then_some(clustering.vpls),
        options: options::all(settings),
        seeds: frames.len(),
        vpls,
        point_clusters,
        vpl_clusters,
        shadow_rays,
        shading_terms,
        clamp: first.measured.counts.clamp,
        clamped_fraction: first.measured.counts.clamped_fraction,
        seconds,
        preprocess: of(|measured| measured.times.preprocess),
        render: of(|measured| measured.times.render),
        phases: mean_phases(&frames),
        speedup: speedup(found, settings, seconds.mean),
        reference: reference.map(|reference| reference.about.id.clone()),
        total,
        clustering: Errors::of(&comparisons(|measured| measured.clustering.as_ref())),
        decomposition: Decomposed::of(
            &frames.iter().filter_map(|f| f.measured.decomposition.as_ref()).collect::<Vec<_>>(),
            reference.and_then(|reference| Some(reference.about.noise?.relmse)),
        ),
        efficiency,
        pareto: Vec::new(),
        image: Some(first.image.clone()),
        thesis: run.thesis,
    })
}

impl Found {
    /// The frames of some settings, in the order of seeds.
    fn frames_of(&self, settings: &Settings) -> Vec<&FoundFrame> {
        let same = |frame: &&FoundFrame| options::same(&frame.settings, settings);
        self.frames.iter().filter(same).collect()
    }
}

/// How many times slower the frame without clusters is.
fn speedup(found: &Found, settings: &Settings, seconds: f64) -> Option<f64> {
    let frames = found.frames_of(&unclustered(settings)?);
    let base: Vec<_> = frames.iter().map(|frame| frame.measured.times.seconds).collect();
    (!base.is_empty()).then(|| Spread::of(&base).mean / seconds)
}

fn mean_phases(frames: &[&FoundFrame]) -> FramePhases {
    let mean = |of: fn(&FramePhases) -> f64| {
        let sum: f64 = frames.iter().map(|frame| of(&frame.measured.times.phases)).sum();
        sum / frames.len() as f64
    };
    FramePhases {
        visible_points: mean(|phases| phases.visible_points),
        direct: mean(|phases| phases.direct),
        vpls: mean(|phases| phases.vpls),
        cluster_points: mean(|phases| phases.cluster_points),
        cluster_vpls: mean(|phases| phases.cluster_vpls),
        visibility: mean(|phases| phases.visibility),
        shading: mean(|phases| phases.shading),
        compensation: mean(|phases| phases.compensation),
        readback: mean(|phases| phases.readback),
        denoise: mean(|phases| phases.denoise),
    }
}

/// Marks the rows that no other one of the same reference is both faster and better than.
fn mark_pareto(rows: &mut [Row]) {
    for metric in Metric::ALL {
        let points: Vec<_> = rows
            .iter()
            .map(|row| {
                let error = row.total.as_ref().and_then(|errors| metric.of(errors));
                (row.reference.clone(), row.seconds.mean, error.map(|error| error.mean))
            })
            .collect();
        for (index, (reference, seconds, error)) in points.iter().enumerate() {
            let Some(error) = error else { continue };
            let beaten = points.iter().any(|(other, faster, better)| {
                let Some(better) = better else { return false };
                let strictly = faster < seconds || better < error;
                other == reference && faster <= seconds && better <= error && strictly
            });
            if !beaten && error.is_finite() {
                rows[index].pareto.push(metric);
            }
        }
    }
}

impl Errors {
    /// Over seeds; none without any.
    fn of(comparisons: &[&Comparison]) -> Option<Self> {
        if comparisons.is_empty() {
            return None;
        }
        let values = |of: fn(&Comparison) -> f64| -> Vec<_> {
            comparisons.iter().map(|comparison| of(comparison)).collect()
        };
        let tiles: Vec<_> = comparisons.iter().filter_map(|c| c.metrics.tile_nrmse).collect();
        Some(Self {
            rmse: Spread::of_roots(&values(|c| c.metrics.rmse)),
            mae: Spread::of(&values(|c| c.metrics.mae)),
            bias: Spread::of(&values(|c| c.metrics.bias)),
            nrmse: Spread::of_roots(&values(|c| c.metrics.nrmse)),
            relmse: Spread::of(&values(|c| c.metrics.relmse)),
            tile_nrmse: (!tiles.is_empty()).then(|| Spread::of_roots(&tiles)),
            flip: Spread::of(&values(|c| c.flip)),
            max_abs: Spread::of(&values(|c| c.metrics.max_abs)),
            nonfinite: comparisons.iter().map(|c| c.nonfinite).sum(),
        })
    }
}
