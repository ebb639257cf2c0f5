//! The plot of the page.

use gpu_vpl::study::plot;
use gpu_vpl::study::results::{Against, Metric};
use serde_json::json;

use super::browser::Browser;
use super::sample::{self, ROWS, UNJUDGED};
use super::{Check, WIDE, checks, look};

const POINTS: &str = "document.querySelectorAll('#plot .point').length";
const TITLE: &str = "document.querySelector('#y-title').textContent";
const TIP: &str = "document.querySelector('#tip').textContent";
const NO_TIP: &str = "document.querySelector('#tip').hidden";

#[test]
fn the_plot_shows_errors_over_seconds() {
    look(
        WIDE,
        checks![
            there_is_a_point_for_each_row_with_the_error,
            errors_lie_by_their_logarithm,
            it_has_its_signs,
            another_metric_or_scene_moves_the_points,
            pointing_at_a_mark_names_it,
            keys_go_from_mark_to_mark,
            a_chosen_point_is_chosen_everywhere,
            its_axes_are_those_of_the_static_plot,
            the_legend_switches_curves
        ],
    );
}

fn count(browser: &mut Browser, selector: &str) -> usize {
    browser.number(&format!("document.querySelectorAll({selector:?}).length")) as usize
}

/// Where a row's mark is drawn.
fn mark(browser: &mut Browser, row: usize) -> [f64; 2] {
    let transform =
        format!("document.querySelector('.point[data-row=\"{row}\"]').getAttribute('transform')");
    let text = browser.text(&transform);
    let inner = text.trim_start_matches("translate(").trim_end_matches(')');
    let (x, y) = inner.split_once(' ').expect("two coordinates");
    [x, y].map(|number| number.parse().expect("a number"))
}

fn there_is_a_point_for_each_row_with_the_error(browser: &mut Browser) {
    assert_eq!(browser.number(POINTS) as usize, ROWS - UNJUDGED);
    browser.set("#metric", "tile_nrmse");
    assert_eq!(browser.number(POINTS) as usize, ROWS - UNJUDGED - 1);
    browser.value("document.querySelector('[value=clustering]').click()");
    assert_eq!(browser.number(POINTS) as usize, ROWS);
    browser.set("#scene", "1");
    assert_eq!(browser.number(POINTS) as usize, 2, "a scene without errors of clustering");
    let disabled = "document.querySelector('[value=clustering]').disabled";
    assert_eq!(browser.value(disabled), json!(true));
}

fn errors_lie_by_their_logarithm(browser: &mut Browser) {
    // Of B errors halve while seconds double: the marks are on a line, evenly spaced.
    let places: Vec<_> = (5..11).map(|row| mark(browser, row)).collect();
    let steps: Vec<_> =
        places.windows(2).map(|two| [0, 1].map(|axis| two[1][axis] - two[0][axis])).collect();
    assert!(steps[0][0] > 1.0 && steps[0][1] > 1.0, "to the right and down: {steps:?}");
    for step in &steps {
        assert!((0..2).all(|axis| (step[axis] - steps[0][axis]).abs() < 0.01), "{steps:?}");
    }
    let bottom = browser.number("document.querySelector('#plot .frame').getBBox().y + document.querySelector('#plot .frame').getBBox().height");
    assert!((mark(browser, 11)[1] - bottom).abs() < 0.01, "an error of 0 is at the edge");
    assert_eq!(count(browser, ".point.hollow"), 1);
}

fn it_has_its_signs(browser: &mut Browser) {
    let signs = [".point .ring", "#plot .front", "#plot .fit", "#plot .noise-line"];
    assert_eq!(signs.map(|sign| count(browser, sign)), [2, 1, 2, 1]);
    let legend = browser.text("document.querySelector('[data-curve=A] .fitted').textContent");
    assert_eq!(legend, "slope −1.00, floor 0.0010");
    assert_eq!(count(browser, "#fits tbody tr"), 2);
    // The fit of B is of errors without the reference's noise: the line drawn lies above them
    // by that, 3e-4 of 0.0022 at the slowest.
    let last = browser.value(
        "(line => [...line.points].map(({x, y}) => [x, y]))(document.querySelectorAll('#plot .fit')[1])",
    );
    let [x, y] = mark(browser, 10);
    let line: Vec<[f64; 2]> = serde_json::from_value(last).expect("points");
    let passes = |two: &&[[f64; 2]]| two[0][0] <= x && x < two[1][0];
    let two = line.windows(2).find(passes).expect("the line passes the mark");
    let part = (x - two[0][0]) / (two[1][0] - two[0][0]);
    let over = y - (two[0][1] + part * (two[1][1] - two[0][1]));
    assert!(over > 5.0, "the line is above the mark: {over}");
    browser.set("#metric", "rmse");
    assert_eq!(signs.map(|sign| count(browser, sign)), [1, 1, 0, 1]);
    browser.value("document.querySelector('[value=clustering]').click()");
    assert_eq!(signs.map(|sign| count(browser, sign)), [0, 0, 0, 0]);
}

fn another_metric_or_scene_moves_the_points(browser: &mut Browser) {
    let relmse = mark(browser, 3);
    assert_eq!(browser.text(TITLE), "relMSE against the reference");
    browser.set("#metric", "bias");
    assert_eq!(browser.text(TITLE), "|bias| against the reference");
    let bias = mark(browser, 3);
    assert_eq!(count(browser, ".point.hollow"), 1, "a bias below 0 is drawn by its size");
    assert!((relmse[0] - bias[0]).abs() < 0.01 && (relmse[1] - bias[1]).abs() > 1.0);
    browser.set("#scene", "1");
    let labels =
        "[...document.querySelectorAll('.point')].map((point) => point.getAttribute('aria-label'))";
    let labels = browser.value(labels).to_string();
    assert!(labels.contains("slow") && labels.contains("fast"), "{labels}");
}

fn pointing_at_a_mark_names_it(browser: &mut Browser) {
    let place = browser.middle(".point[data-row='7'] .mark");
    browser.point(place.map(|coordinate| coordinate + 6.0));
    assert_eq!(browser.value(NO_TIP), json!(false));
    let tip = browser.text(TIP);
    let parts =
        ["B at 1.2", "1.20 ± 0.04", "0.0175 ± 0.0035", "--vpls 4800", "4\u{202f}800\u{202f}000"];
    assert!(parts.iter().all(|part| tip.contains(part)), "{tip}");
    browser.point([5.0, 5.0]);
    assert_eq!(browser.value(NO_TIP), json!(true));
}

fn keys_go_from_mark_to_mark(browser: &mut Browser) {
    assert_eq!(count(browser, ".point[tabindex='0']"), 1, "one stop for the tabulator");
    browser.value("document.querySelector('.point[tabindex=\"0\"]').focus()");
    assert!(browser.text(TIP).starts_with("0.2 s"));
    browser.key("ArrowRight");
    assert!(browser.text(TIP).starts_with("0.4 s"));
    browser.key("ArrowDown");
    assert!(browser.text(TIP).starts_with("B at"));
    browser.key("ArrowUp");
    browser.key("Enter");
    let chosen = "document.querySelector('#rows tr.chosen').dataset.row";
    assert_eq!(browser.text(chosen), "1");
}

fn a_chosen_point_is_chosen_everywhere(browser: &mut Browser) {
    browser.set("#picture-a", "1");
    let place = browser.middle(".point[data-row='1'] .mark");
    browser.click(place);
    assert_eq!(browser.text("document.querySelector('#rows tr.chosen').dataset.row"), "1");
    assert_eq!(browser.text("document.querySelector('#picture-a').value"), "0");
    assert_eq!(browser.text("document.querySelector('#picture-b').value"), "1");
    assert_eq!(count(browser, ".point.chosen[data-row='1']"), 1);
}

fn the_legend_switches_curves(browser: &mut Browser) {
    let before = mark(browser, 0);
    let place = browser.middle("[data-curve=B]");
    browser.click(place);
    assert_eq!(browser.number(POINTS) as usize, ROWS - UNJUDGED - 6);
    assert_eq!(mark(browser, 0), before, "the axes stay");
    browser.set("#scene", "1");
    browser.set("#scene", "0");
    assert_eq!(browser.number(POINTS) as usize, ROWS - UNJUDGED - 6);
    let place = browser.middle("[data-curve=B]");
    browser.click(place);
    assert_eq!(browser.number(POINTS) as usize, ROWS - UNJUDGED);
}

/// Both know the same rules of axes; this is what keeps them the same.
fn its_axes_are_those_of_the_static_plot(browser: &mut Browser) {
    let (results, _) = sample::study();
    for (metric, id) in [(Metric::Relmse, "relmse"), (Metric::Flip, "flip")] {
        browser.set("#metric", id);
        let still = plot::svg(&results.scenes[0], metric, Against::Total).expect("a plot");
        let labels = browser
            .value("[...document.querySelectorAll('.tick')].map((label) => label.textContent)");
        let labels = labels.as_array().expect("labels");
        let numbers = still
            .split("fill=\"#444\">")
            .filter(|text| text.starts_with(|c: char| c.is_ascii_digit()));
        assert_eq!(numbers.count(), labels.len(), "{labels:?}");
        for label in labels {
            let label = label.as_str().expect("a text");
            assert!(still.contains(&format!(">{label}</text>")), "{label}");
        }
        let lines = "document.querySelectorAll('#plot .grid').length";
        let grid = still.matches("#ddd\"/>").count() + still.matches("#f1f1f1\"/>").count();
        assert_eq!(browser.number(lines) as usize, grid);
    }
}

#[test]
fn the_sample_is_as_counted() {
    let (results, _) = sample::study();
    let rows = &results.scenes[0].rows;
    assert_eq!(rows.len(), ROWS);
    assert_eq!(rows.iter().filter(|row| row.total.is_none()).count(), UNJUDGED);
}
