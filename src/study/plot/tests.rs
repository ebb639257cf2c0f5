use super::*;
use crate::report::{BounceLimit, FramePhases};
use crate::study::results::{Errors, Noise};

fn spread(mean: f64, sd: f64) -> Spread {
    Spread { mean, sd: (sd > 0.0).then_some(sd) }
}

fn errors(mean: f64) -> Errors {
    let all = spread(mean, 0.2 * mean);
    Errors {
        rmse: all,
        mae: all,
        bias: spread(-mean, 0.0),
        nrmse: all,
        relmse: all,
        tile_nrmse: None,
        flip: all,
        max_abs: all,
        nonfinite: 0,
    }
}

fn row(experiment: &str, seconds: f64, error: Option<f64>) -> Row {
    Row {
        experiment: experiment.to_owned(),
        setting: format!("{seconds} s & <more>"),
        method: "both",
        command: String::new(),
        light_paths: 0,
        bounces: BounceLimit::Finite(2),
        samples: 1,
        wanted_point_clusters: None,
        wanted_vpl_clusters: None,
        options: String::new(),
        seeds: 1,
        vpls: 0,
        point_clusters: None,
        vpl_clusters: None,
        shadow_rays: 0,
        shading_terms: 0,
        clamp: None,
        clamped_fraction: 0.0,
        seconds: spread(seconds, 0.1 * seconds),
        preprocess: Spread::default(),
        render: Spread::default(),
        phases: FramePhases::default(),
        speedup: None,
        reference: None,
        total: error.map(errors),
        clustering: None,
        decomposition: None,
        efficiency: None,
        pareto: vec![Metric::Relmse],
        image: None,
        thesis: None,
    }
}

fn scene(rows: Vec<Row>) -> SceneResults {
    let fit = Fit {
        metric: Metric::Relmse,
        against: Against::Total,
        slope: -0.5,
        floor: None,
        line: vec![[1.0, 0.1], [2.0, 0.05]],
    };
    let curve =
        |name: &str, fits| Curve { name: name.to_owned(), title: "of `it`".to_owned(), fits };
    SceneResults {
        scene: "\"a\" <b> & 'c'".to_owned(),
        width: 4,
        height: 3,
        triangles: 0,
        exposure: 0.0,
        mask_above: None,
        references: vec![Reference {
            id: "r".to_owned(),
            label: "path".to_owned(),
            command: None,
            samples: None,
            seconds: None,
            mean: 1.0,
            noise: Some(Noise { rmse: 0.1, nrmse: 0.1, relmse: 0.01, tile_nrmse: None }),
            warnings: Vec::new(),
            image: None,
        }],
        experiments: vec![curve("A", vec![fit]), curve("B", vec![])],
        rows,
    }
}

fn drawn(rows: Vec<Row>, metric: Metric) -> String {
    svg(&scene(rows), metric, Against::Total).unwrap()
}

fn three() -> Vec<Row> {
    vec![row("A", 1.0, Some(0.1)), row("A", 2.0, Some(0.05)), row("B", 3.0, None)]
}

/// Marks that are points: those of the legend have the names of curves as titles.
fn points(svg: &str) -> usize {
    svg.matches("&lt;more&gt;</title>").count()
}

/// Every element is closed, in order; no attribute holds a bare `<`, no text a bare `&`.
fn assert_well_formed(svg: &str) {
    let mut open: Vec<&str> = Vec::new();
    for piece in svg.split('<').skip(1) {
        let (tag, text) = piece.split_once('>').expect("a tag ends before the next begins");
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        let name = tag.split([' ', '\n', '/']).find(|part| !part.is_empty()).unwrap();
        match (tag.strip_prefix('/'), tag.ends_with('/')) {
            (Some(name), _) => assert_eq!(open.pop(), Some(name)),
            (None, true) => {}
            (None, false) => open.push(name),
        }
        for entity in text.split('&').skip(1) {
            assert!(["amp;", "lt;", "gt;", "quot;", "#39;"].iter().any(|e| entity.starts_with(e)));
        }
    }
    assert_eq!(open, Vec::<&str>::new());
}

#[test]
fn there_is_a_point_for_each_row_with_the_error() {
    let svg = drawn(three(), Metric::Relmse);
    assert_eq!(points(&svg), 2);
    assert_eq!(svg.matches("<circle").count(), 2, "rings");
    assert_eq!(svg.matches("class=\"bar\"").count(), 4);
    assert!(svg.contains("slope −0.50</text>") && svg.contains("stroke-dasharray=\"5 4\""));
    assert!(svg.contains("noise of the reference: path"));
    assert!(!svg.contains("B. of it"), "a curve without points is not in the legend");
    assert_eq!(svg, drawn(three(), Metric::Relmse));
}

#[test]
fn the_fitted_line_has_the_noise_that_its_points_have() {
    let lines = |reference: Option<&str>| {
        let mut rows = vec![row("A", 1.0, Some(0.11)), row("A", 2.0, Some(0.06))];
        for row in &mut rows {
            row.reference = reference.map(str::to_owned);
        }
        let svg = drawn(rows, Metric::Relmse);
        let path = |style: &str| {
            let line = svg.lines().find(|line| line.contains(style)).unwrap();
            line.split('"').nth(1).unwrap().to_owned()
        };
        [path("stroke-dasharray=\"5 4\""), path("stroke-opacity=\".55\"")]
    };
    let [fitted, points] = lines(Some("r"));
    assert_eq!(fitted, points);
    let [fitted, points] = lines(None);
    assert_ne!(fitted, points);
}

#[test]
fn what_only_another_metric_has_is_left_out() {
    let svg = drawn(three(), Metric::Flip);
    assert_eq!((points(&svg), svg.matches("<circle").count()), (2, 0));
    assert!(!svg.contains("slope") && !svg.contains("noise of the reference"));
}

#[test]
fn there_is_no_plot_without_errors() {
    let rows = vec![row("A", 1.0, None), row("A", 0.0, Some(0.1)), row("A", 1.0, Some(f64::NAN))];
    assert_eq!(svg(&scene(rows), Metric::Relmse, Against::Total), None);
    assert_eq!(svg(&scene(three()), Metric::TileNrmse, Against::Total), None);
    assert_eq!(svg(&scene(three()), Metric::Relmse, Against::Clustering), None);
    assert_eq!(svg(&scene(vec![]), Metric::Relmse, Against::Total), None);
}

#[test]
fn it_is_well_formed_whatever_the_numbers_and_names() {
    assert_well_formed(&drawn(three(), Metric::Relmse));
    assert_well_formed(&drawn(vec![row("A", 1.0, Some(0.0))], Metric::Bias));
    let extreme = vec![row("A", 1e-9, Some(1e30)), row("B", 1e9, Some(1e-30))];
    let svg = drawn(extreme, Metric::Rmse);
    assert_well_formed(&svg);
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

#[test]
fn an_error_of_zero_lies_hollow_on_the_bottom_edge() {
    let svg = drawn(vec![row("A", 1.0, Some(0.1)), row("A", 2.0, Some(0.0))], Metric::Rmse);
    let hollow: Vec<_> = svg.lines().filter(|line| line.contains("mark hollow")).collect();
    assert_eq!(hollow.len(), 1);
    assert!(hollow[0].contains(&format!(" {BOTTOM:.2})")), "{hollow:?}");
}

#[test]
fn a_bias_below_zero_is_drawn_by_its_size() {
    let svg = drawn(vec![row("A", 1.0, Some(0.1))], Metric::Bias);
    assert_eq!((points(&svg), svg.matches("hollow\"").count()), (1, 0));
    assert!(svg.contains("|bias|"));
}

#[test]
fn long_texts_are_cut() {
    assert_eq!(short("as it is"), "as it is");
    let long = short(&"ü".repeat(200));
    assert_eq!(long.chars().count(), 68);
    assert!(long.ends_with('…'));
}

#[test]
fn numbers_have_two_digits_that_count() {
    let shown = [0.0, 0.001_234, 0.5, 12.3, 1234.5, 1e-7].map(draw::number);
    assert_eq!(shown, ["0", "0.0012", "0.50", "12", "1234", "1.0e-7"]);
}
