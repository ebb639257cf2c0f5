//! Error over run time as a static picture: an SVG that needs no other file, the same bytes for
//! the same results.

pub mod axis;
mod draw;
pub mod style;

pub use axis::Axis;
pub use style::Style;

use draw::{Anchor, Svg, plain};

use super::results::{Against, Curve, Fit, Metric, Reference, Row, SceneResults, Spread};

/// The size of the picture above the legend, and the box that the axes span.
const WIDTH: f64 = 760.0;
const LEFT: f64 = 72.0;
const RIGHT: f64 = 740.0;
const TOP: f64 = 58.0;
const BOTTOM: f64 = 430.0;
const LEGEND: f64 = 492.0;
const LINE: f64 = 21.0;

/// What is drawn, and where.
#[derive(Debug)]
struct Chart<'a> {
    results: &'a SceneResults,
    metric: Metric,
    against: Against,
    x: Axis,
    y: Axis,
}

/// A row that has the error.
#[derive(Debug, Clone, Copy)]
struct Point<'a> {
    row: &'a Row,
    seconds: Spread,
    error: Spread,
}

/// The plot of an error of all rows of a scene; nothing where no row has it.
pub fn svg(results: &SceneResults, metric: Metric, against: Against) -> Option<String> {
    let points: Vec<_> =
        results.rows.iter().filter_map(|row| Point::of(row, metric, against)).collect();
    if points.is_empty() {
        return None;
    }
    let x = Axis::around(points.iter().flat_map(|point| bar(point.seconds)), [LEFT, RIGHT]);
    let errors = || points.iter().flat_map(|point| bar(point.error));
    let noises: Vec<_> = noises(results, metric, against).map(|(_, noise)| noise).collect();
    let y = Axis::around(errors().chain(near(&noises, errors())), [BOTTOM, TOP]);
    Some(Chart { results, metric, against, x, y }.draw(&points))
}

impl<'a> Point<'a> {
    fn of(row: &'a Row, metric: Metric, against: Against) -> Option<Self> {
        let error = metric.of(against.of(row)?)?;
        let seconds = row.seconds;
        let drawn = error.mean.is_finite() && seconds.mean.is_finite() && seconds.mean > 0.0;
        drawn.then_some(Self { row, seconds, error })
    }
}

/// What a mean and its deviation take on an axis: a bar never reaches below half of its mean,
/// so that a bar to zero does not stretch the axis.
fn bar(spread: Spread) -> [f64; 3] {
    let Spread { mean, sd } = spread;
    let sd = sd.filter(|sd| sd.is_finite()).unwrap_or(0.0);
    [mean, mean + sd, (mean - sd).max(mean / 2.0)]
}

/// The noises that are worth room on the axis: those not far below all errors.
fn near(noises: &[f64], errors: impl Iterator<Item = f64>) -> impl Iterator<Item = f64> {
    let least = errors.filter(|error| *error > 0.0).fold(f64::INFINITY, f64::min);
    noises.iter().copied().filter(move |noise| *noise > least / 10.0)
}

/// References with the errors that their own noise gives.
fn noises(
    results: &SceneResults,
    metric: Metric,
    against: Against,
) -> impl Iterator<Item = (&Reference, f64)> {
    let total = against == Against::Total;
    let references = results.references.iter().filter(move |_| total);
    references
        .filter_map(move |reference| Some((reference, metric.noise(reference.noise.as_ref()?)?)))
        .filter(|(_, noise)| noise.is_finite() && *noise > 0.0)
}

impl Chart<'_> {
    fn draw(&self, points: &[Point]) -> String {
        let curves = &self.results.experiments;
        let mut svg = Svg::new([LEFT, TOP], [RIGHT, BOTTOM]);
        self.title(&mut svg);
        self.grid(&mut svg);
        self.noise(&mut svg);
        self.front(&mut svg, points);
        for (index, curve) in curves.iter().enumerate() {
            let of_curve = |point: &&Point| point.row.experiment == curve.name;
            let points: Vec<_> = points.iter().filter(of_curve).copied().collect();
            self.curve(&mut svg, curve, Style::of(index), &points);
        }
        let end = self.legend(&mut svg);
        svg.finish([WIDTH, end + 14.0], &self.alternative(points.len()))
    }

    /// What error over what.
    fn subject(&self) -> String {
        let against = match self.against {
            Against::Total => "total error",
            Against::Clustering => "error of clustering",
        };
        format!("{}, {against}", self.metric.name())
    }

    fn alternative(&self, points: usize) -> String {
        format!(
            "{}: {} over seconds of a warm frame, {points} measurements",
            self.results.scene,
            self.subject()
        )
    }

    fn title(&self, svg: &mut Svg) {
        let SceneResults { scene, width, height, .. } = self.results;
        svg.text([LEFT, 26.0], Anchor::Start, "font-size=\"16\" font-weight=\"600\"", scene);
        let size = format!("{width} × {height} pixels");
        svg.text([RIGHT, 26.0], Anchor::End, "fill=\"#666\"", &size);
        svg.text([LEFT, 46.0], Anchor::Start, "fill=\"#444\"", &self.subject());
        let middle = [f64::midpoint(LEFT, RIGHT), BOTTOM + 38.0];
        svg.text(middle, Anchor::Middle, "fill=\"#444\"", "seconds of a warm frame");
    }

    fn grid(&self, svg: &mut Svg) {
        for tick in self.x.ticks() {
            let x = self.x.at(tick.value);
            svg.line([x, TOP], [x, BOTTOM], grid_line(tick.label.is_some()));
            if let Some(label) = tick.label {
                svg.text([x, BOTTOM + 18.0], Anchor::Middle, "fill=\"#444\"", &label);
            }
        }
        for tick in self.y.ticks() {
            let y = self.y.at(tick.value);
            svg.line([LEFT, y], [RIGHT, y], grid_line(tick.label.is_some()));
            if let Some(label) = tick.label {
                svg.text([LEFT - 8.0, y + 4.0], Anchor::End, "fill=\"#444\"", &label);
            }
        }
        svg.line([LEFT, BOTTOM], [RIGHT, BOTTOM], "stroke=\"#444\"");
        svg.line([LEFT, TOP], [LEFT, BOTTOM], "stroke=\"#444\"");
    }

    /// Below the noise of a reference nothing can be told: it is hatched.
    fn noise(&self, svg: &mut Svg) {
        for (reference, noise) in noises(self.results, self.metric, self.against) {
            if self.y.range[0] > noise {
                continue;
            }
            let y = self.y.at(noise);
            svg.hatched([LEFT, y], [RIGHT, BOTTOM]);
            svg.line([LEFT, y], [RIGHT, y], "stroke=\"#888\" stroke-dasharray=\"1 3\"");
            let label = format!("noise of the reference: {}", short(&reference.label));
            let style = "fill=\"#666\" font-size=\"11\"";
            svg.text([LEFT + 8.0, y - 5.0], Anchor::Start, style, &label);
        }
    }

    /// Steps along the rows that no other is both faster and better than.
    fn front(&self, svg: &mut Svg, points: &[Point]) {
        let mut front: Vec<_> = points.iter().filter(|point| self.is_best(point)).collect();
        front.sort_by(|a, b| a.seconds.mean.total_cmp(&b.seconds.mean));
        let mut steps: Vec<[f64; 2]> = Vec::new();
        for point in front {
            let [x, y] = self.place(point);
            let above = steps.last().map_or(TOP, |last| last[1]);
            steps.extend([[x, above], [x, y]]);
        }
        if let Some(&[_, y]) = steps.last() {
            steps.push([RIGHT, y]);
            svg.path(&steps, "stroke=\"#222\" stroke-opacity=\".35\" stroke-width=\"1.25\"");
        }
    }

    fn curve(&self, svg: &mut Svg, curve: &Curve, style: Style, points: &[Point]) {
        let colour = style.light;
        svg.open(&format!("stroke=\"{colour}\" fill=\"{colour}\""));
        if let Some(fit) = self.fit(curve) {
            let noise = self.noise_of(curve);
            let place = |&[x, y]: &[f64; 2]| {
                let seen = self.metric.sum(y, noise);
                [self.x.beyond(x), self.y.beyond(seen)]
            };
            let line: Vec<_> = fit.line.iter().map(place).collect();
            svg.path(
                &line,
                "stroke-dasharray=\"5 4\" stroke-width=\"1.25\" clip-path=\"url(#inside)\"",
            );
        }
        let above = points.iter().filter(|point| self.y.range[0] <= point.error.mean);
        let mut line: Vec<_> = above.map(|point| self.place(point)).collect();
        line.sort_by(|a, b| a[0].total_cmp(&b[0]));
        svg.path(&line, "stroke-width=\"1.5\" stroke-opacity=\".55\"");
        for point in points {
            self.bars(svg, point);
        }
        for point in points {
            self.mark(svg, style, point);
        }
        svg.close();
    }

    fn mark(&self, svg: &mut Svg, style: Style, point: &Point) {
        let place = self.place(point);
        if self.is_best(point) {
            svg.ring(place);
        }
        let below = point.error.mean < self.y.range[0];
        svg.mark(place, style, below, &format!("{}: {}", point.row.experiment, point.row.setting));
    }

    fn bars(&self, svg: &mut Svg, point: &Point) {
        let [x, y] = self.place(point);
        if let Some([low, high]) = ends(point.seconds) {
            svg.line([self.x.at(low), y], [self.x.at(high), y], "class=\"bar\"");
        }
        if let Some([low, high]) = ends(point.error) {
            svg.line([x, self.y.at(low)], [x, self.y.at(high)], "class=\"bar\"");
        }
    }

    fn place(&self, point: &Point) -> [f64; 2] {
        [self.x.at(point.seconds.mean), self.y.at(point.error.mean)]
    }

    fn is_best(&self, point: &Point) -> bool {
        self.against == Against::Total && point.row.pareto.contains(&self.metric)
    }

    fn fit<'a>(&self, curve: &'a Curve) -> Option<&'a Fit> {
        curve.fits.iter().find(|fit| fit.metric == self.metric && fit.against == self.against)
    }

    /// The noise that is in a curve's errors.
    fn noise_of(&self, curve: &Curve) -> f64 {
        let of = |row| self.metric.noise(self.results.noise_of(row)?);
        let noise = self.results.rows_of(curve).find_map(of).filter(|noise| noise.is_finite());
        noise.filter(|_| self.against == Against::Total).unwrap_or(0.0)
    }

    /// Returns where it ends.
    fn legend(&self, svg: &mut Svg) -> f64 {
        let mut y = LEGEND;
        for (index, curve) in self.results.experiments.iter().enumerate() {
            let drawn = |row: &Row| Point::of(row, self.metric, self.against).is_some();
            if !self.results.rows_of(curve).any(drawn) {
                continue;
            }
            let style = Style::of(index);
            svg.open(&format!("stroke=\"{0}\" fill=\"{0}\"", style.light));
            svg.mark([LEFT + 6.0, y - 4.5], style, false, &curve.name);
            svg.close();
            let label = format!("{}. {}", plain(&curve.name), plain(&curve.title));
            svg.text([LEFT + 22.0, y], Anchor::Start, "fill=\"#222\"", &short(&label));
            if let Some(fit) = self.fit(curve) {
                svg.text([RIGHT, y], Anchor::End, "fill=\"#444\"", &described(fit));
            }
            y += LINE;
        }
        y += 4.0;
        svg.text([LEFT, y], Anchor::Start, "fill=\"#777\" font-size=\"11\"", &self.key());
        y
    }

    fn key(&self) -> String {
        let mut key = vec!["bars: ± one standard deviation"];
        if self.against == Against::Total {
            key.push("rings: no other row is both faster and better");
        }
        if self.results.experiments.iter().any(|curve| self.fit(curve).is_some()) {
            key.push("dashed: power law, and the reference's noise");
        }
        key.join(" · ")
    }
}

impl Metric {
    /// The error that two independent ones make together: squares add up, and relMSE is one.
    fn sum(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Relmse => a + b,
            _ => a.hypot(b),
        }
    }
}

/// The ends of an error bar, where there is one.
fn ends(Spread { mean, sd }: Spread) -> Option<[f64; 2]> {
    let sd = sd.filter(|sd| sd.is_finite() && *sd > 0.0)?;
    Some([mean - sd, mean + sd])
}

fn grid_line(labelled: bool) -> &'static str {
    if labelled { "stroke=\"#ddd\"" } else { "stroke=\"#f1f1f1\"" }
}

/// The slope and the floor in words.
fn described(fit: &Fit) -> String {
    let slope = format!("slope {:.2}", fit.slope).replace('-', "−");
    match fit.floor {
        Some(floor) => format!("{slope}, floor {}", draw::number(floor)),
        None => slope,
    }
}

/// A text cut where it would run into its neighbour.
fn short(text: &str) -> String {
    const LONGEST: usize = 68;
    let text = plain(text);
    if text.chars().count() <= LONGEST {
        return text;
    }
    text.chars().take(LONGEST - 1).chain(['…']).collect()
}

#[cfg(test)]
mod tests;
