//! A study made by hand: numbers and pixels are known.

use gpu_vpl::gpu::AdapterInfo;
use gpu_vpl::image::Image;
use gpu_vpl::report::{BounceLimit, FramePhases};
use gpu_vpl::study::page::Picture;
use gpu_vpl::study::parts::{Decomposed, Decomposition, Left, Part, Replaced};
use gpu_vpl::study::results::{
    Against, Curve, Errors, Fit, Metric, Noise, Reference, Results, Row, SCHEMA, SceneResults,
    Spread,
};

/// The name of the first scene, which tries to break out of the page.
pub const HOSTILE: &str = "</script><img src=x onerror=\"throw 1\">";

/// The size of pictures.
pub const SIZE: [u32; 2] = [64, 48];

/// Rows of the first scene, of which `UNJUDGED` have no total error.
pub const ROWS: usize = 13;
pub const UNJUDGED: usize = 1;

/// What sets the rows of the second scene apart: there are two, and no errors of clustering.
pub const PLAIN: &str = "builtin:plain";

pub fn spread(mean: f64, part: f64) -> Spread {
    Spread { mean, sd: (part > 0.0).then_some(part * mean.abs()) }
}

/// Errors of images that are this far off.
pub fn errors(relmse: f64) -> Errors {
    let root = relmse.sqrt();
    Errors {
        rmse: spread(0.4 * root, 0.1),
        mae: spread(0.2 * root, 0.1),
        bias: spread(-0.1 * root, 0.3),
        nrmse: spread(root, 0.1),
        relmse: spread(relmse, 0.2),
        tile_nrmse: Some(spread(0.3 * root, 0.1)),
        flip: spread(0.5 * root, 0.05),
        max_abs: spread(9.0 * root, 0.2),
        nonfinite: 0,
    }
}

/// A row of a curve, so many seconds long.
pub fn row(experiment: &str, setting: &str, seconds: f64, total: Option<f64>) -> Row {
    let vpls = (4000.0 * seconds) as u64;
    Row {
        experiment: experiment.to_owned(),
        setting: setting.to_owned(),
        method: "both",
        command: format!("gpu-vpl render --vpls {vpls} -o '{setting}.exr'"),
        light_paths: 2000,
        bounces: BounceLimit::Finite(2),
        samples: 1,
        wanted_point_clusters: Some(2600),
        wanted_vpl_clusters: None,
        options: "--interleave 4".to_owned(),
        seeds: 5,
        vpls,
        point_clusters: Some(2600),
        vpl_clusters: None,
        shadow_rays: 1000 * vpls,
        shading_terms: 2000 * vpls,
        clamp: Some(0.5),
        clamped_fraction: 0.01,
        seconds: spread(seconds, 0.03),
        preprocess: spread(0.1 * seconds, 0.05),
        render: spread(0.6 * seconds, 0.05),
        phases: FramePhases {
            visibility: 0.2 * seconds,
            shading: 0.4 * seconds,
            compensation: 0.0,
            ..Default::default()
        },
        speedup: Some(4.0),
        reference: Some("path".to_owned()),
        total: total.map(errors),
        clustering: Some(errors(1e-4 / seconds)),
        decomposition: None,
        efficiency: total.map(|error| 1.0 / (error * seconds)),
        pareto: Vec::new(),
        image: None,
        thesis: None,
    }
}

/// Direct light is half of the error, shared visibility makes up for a fifth of it.
fn taken_apart() -> Option<Decomposed> {
    let left = |relmse| Left { relmse, bias: -0.01 };
    let parts = [
        (Part::Direct, 0.005),
        (Part::Indirect, 0.004),
        (Part::Antialiasing, 0.009),
        (Part::Sharing, 0.012),
        (Part::Vpls, 0.004),
        (Part::All, 0.006),
    ];
    let replaced = |(part, relmse)| Replaced { part, left: left(relmse), noise: 1e-5 };
    let parts = parts.map(replaced).into();
    Decomposed::of(&[&Decomposition { whole: left(0.01), parts }], None)
}

/// A power law along seconds.
pub fn fit(slope: f64, floor: Option<f64>, law: impl Fn(f64) -> f64) -> Fit {
    let line = (0..=20).map(|step| 0.1 * 1.3_f64.powi(step)).map(|t| [t, law(t)]).collect();
    Fit { metric: Metric::Relmse, against: Against::Total, slope, floor, line }
}

pub fn curve(name: &str, title: &str, fits: Vec<Fit>) -> Curve {
    Curve { name: name.to_owned(), title: title.to_owned(), fits }
}

pub fn reference(label: &str, warnings: &[&str]) -> Reference {
    Reference {
        id: "path".to_owned(),
        label: label.to_owned(),
        command: Some("gpu-vpl render --method path --samples 4096 -o path.exr".to_owned()),
        samples: Some(4096),
        seconds: Some(612.5),
        mean: 0.31,
        noise: Some(Noise { rmse: 0.006, nrmse: 0.019, relmse: 3e-4, tile_nrmse: Some(0.001) }),
        warnings: warnings.iter().map(|&warning| warning.to_owned()).collect(),
        image: Some("reference".to_owned()),
    }
}

pub fn scene(name: &str, experiments: Vec<Curve>, rows: Vec<Row>) -> SceneResults {
    SceneResults {
        scene: name.to_owned(),
        width: SIZE[0],
        height: SIZE[1],
        triangles: 38,
        exposure: 0.0,
        mask_above: None,
        references: vec![reference("path, 4096 samples, 2 bounces", &["<b>it is noisy</b>"])],
        experiments,
        rows,
    }
}

pub fn results(name: &str, scenes: Vec<SceneResults>) -> Results {
    let adapter = AdapterInfo {
        name: "llvmpipe".to_owned(),
        backend: "vulkan".to_owned(),
        driver: "Mesa".to_owned(),
        device_type: "cpu".to_owned(),
    };
    Results {
        schema: SCHEMA,
        version: "0.1.0",
        name: name.to_owned(),
        command: "gpu-vpl study -o study".to_owned(),
        adapter,
        threads: 2,
        seeds: vec![1, 2, 3, 4, 5],
        planned: 100,
        finished: 90,
        scenes,
        claims: Vec::new(),
    }
}

/// The first scene: three curves, thirteen rows, one of them without a total error, one with
/// an error of exactly 0.
fn hostile() -> SceneResults {
    let mut rows: Vec<_> = (0..5)
        .map(|step| 0.2 * f64::from(1 << step))
        .map(|t| row("A", &format!("{t} s"), t, Some(0.01 / t + 1e-3)))
        .collect();
    rows.extend((0..6).map(|step| {
        let t = 0.3 * f64::from(1 << step);
        row("B", &format!("B at {t}"), t, Some(0.021 / t))
    }));
    rows.push(row("C", "perfect", 12.0, Some(0.0)));
    rows.push(row("C", "unjudged", 1.0, None));
    rows[0].pareto = vec![Metric::Relmse, Metric::Rmse];
    rows[4].pareto = vec![Metric::Relmse];
    rows[1].image = Some("one".to_owned());
    rows[1].decomposition = taken_apart();
    rows[2].total = rows[2].total.map(|errors| Errors { tile_nrmse: None, ..errors });
    let fits = vec![fit(-1.0, Some(1e-3), |t| 0.01 / t + 1e-3)];
    let curves = vec![
        curve("A", "`both`: light paths", fits),
        curve("B", "`vpl`: light paths", vec![fit(-1.0, None, |t| 0.021 / t)]),
        curve("C", "<i>odd</i> ones", vec![]),
    ];
    scene(HOSTILE, curves, rows)
}

fn plain() -> SceneResults {
    let mut rows = vec![row("A", "slow", 2.0, Some(0.1)), row("A", "fast", 0.5, Some(0.3))];
    for row in &mut rows {
        row.clustering = None;
    }
    scene(PLAIN, vec![curve("A", "`vpl`", vec![])], rows)
}

/// The picture `one`: each quarter has its colour; values that 16 bits hold exactly.
pub fn one() -> Image {
    let pixel = |x: u32, y: u32| {
        let dim = if y < SIZE[1] / 2 { 1.0 } else { 0.5 };
        let rgb = if x < SIZE[0] / 2 { [0.5, 0.25, 0.125] } else { [0.25, 0.375, 0.0] };
        rgb.map(|value: f32| value * dim)
    };
    picture(pixel)
}

/// The picture `reference`: everywhere the same but for one pixel that is not finite.
pub fn other() -> Image {
    picture(|x, y| if [x, y] == [63, 47] { [f32::NAN, 0.0, 0.0] } else { [0.0625; 3] })
}

fn picture(pixel: impl Fn(u32, u32) -> [f32; 3]) -> Image {
    let [width, height] = SIZE;
    let pixels = (0..width * height).map(|index| pixel(index % width, index / width)).collect();
    Image { width, height, pixels }
}

/// Both scenes, and two pictures of each.
pub fn study() -> (Results, Vec<Picture>) {
    let (a, b) = (one(), other());
    let mut pictures = Vec::new();
    for scene in [HOSTILE, PLAIN] {
        pictures.push(Picture::encode("one", "A at 0.4 s", scene, &a));
        pictures.push(Picture::encode("reference", "reference", scene, &b));
    }
    (results("a <study>", vec![hostile(), plain()]), pictures)
}
