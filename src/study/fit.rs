//! A power law with a floor, fitted to errors over seconds.

use super::results::{Against, Curve, Fit, Metric, Noise, SceneResults};

/// Points of a fitted curve.
const LINE_POINTS: usize = 32;
/// Rows that a fit needs, and that one with a floor needs.
const LEAST_ROWS: usize = 3;
const LEAST_ROWS_FOR_A_FLOOR: usize = 5;
/// Rows that are less apart in time, fastest to slowest, tell no slope.
const LEAST_RANGE: f64 = 1.5;
/// A floor has to leave so little of the squared residuals without one.
const FLOOR_GAINS: f64 = 0.5;

/// Power of the error that adds up: squares of errors do, and relMSE is one already.
fn power(metric: Metric) -> i32 {
    match metric {
        Metric::Relmse => 1,
        _ => 2,
    }
}

/// The fits of a curve in every metric and against all there is, to the means over seeds with
/// the reference's own variance subtracted.
pub fn of_curve(scene: &SceneResults, curve: &Curve) -> Vec<Fit> {
    let against = [Against::Total, Against::Clustering];
    let all = Metric::ALL.into_iter().flat_map(|metric| against.map(|a| (metric, a)));
    all.filter_map(|(metric, against)| of_metric(scene, curve, metric, against)).collect()
}

fn of_metric(scene: &SceneResults, curve: &Curve, metric: Metric, against: Against) -> Option<Fit> {
    let points: Vec<_> = scene
        .rows_of(curve)
        .filter_map(|row| {
            let error = metric.of(against.of(row)?)?.mean;
            let noise = match against {
                Against::Total => scene.noise_of(row).and_then(|noise| metric.noise(noise)),
                Against::Clustering => None,
            };
            let power = power(metric);
            let own = error.powi(power) - noise.unwrap_or(0.0).powi(power);
            (own > 0.0).then_some([row.seconds.mean, own])
        })
        .collect();
    let law = PowerLaw::fit(&points)?;
    let root = |value: f64| value.powf(1.0 / f64::from(power(metric)));
    let [first, last] = law.range;
    let step = (last / first).powf(1.0 / (LINE_POINTS - 1) as f64);
    let line = (0..LINE_POINTS as i32).map(|i| {
        let seconds = first * step.powi(i);
        [seconds, root(law.at(seconds))]
    });
    Some(Fit {
        metric,
        against,
        slope: law.slope / f64::from(power(metric)),
        floor: law.floor.map(root),
        line: line.collect(),
    })
}

/// y = floor + scale · xˢˡᵒᵖᵉ.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PowerLaw {
    slope: f64,
    scale: f64,
    floor: Option<f64>,
    /// The least and the largest x.
    range: [f64; 2],
}

impl PowerLaw {
    /// By least squares of the logarithms, over a range of floors below the least y.
    fn fit(points: &[[f64; 2]]) -> Option<Self> {
        let least = |at: usize| points.iter().map(|point| point[at]).fold(f64::INFINITY, f64::min);
        let range = [least(0), points.iter().map(|point| point[0]).fold(0.0, f64::max)];
        if points.len() < LEAST_ROWS || range[1] < LEAST_RANGE * range[0] {
            return None;
        }
        let above = |floor: f64| {
            let logs: Vec<_> = points.iter().map(|[x, y]| [x.ln(), (y - floor).ln()]).collect();
            let line = Line::fit(&logs)?;
            let scale = line.intercept.exp();
            let law = Self { slope: line.slope, scale, floor: Some(floor), range };
            Some((law.residual(points), law))
        };
        let (plain, mut best) = above(0.0)?;
        best.floor = None;
        if points.len() < LEAST_ROWS_FOR_A_FLOOR {
            return Some(best);
        }
        let mut residual = FLOOR_GAINS * plain;
        for share in 1..200 {
            let Some((with, law)) = above(least(1) * f64::from(share) / 200.0) else { continue };
            if with < residual && law.slope < 0.0 {
                (residual, best) = (with, law);
            }
        }
        Some(best)
    }

    fn at(&self, x: f64) -> f64 {
        self.floor.unwrap_or(0.0) + self.scale * x.powf(self.slope)
    }

    fn residual(&self, points: &[[f64; 2]]) -> f64 {
        points.iter().map(|[x, y]| (y / self.at(*x)).ln().powi(2)).sum()
    }
}

/// A straight line fitted to points by least squares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Rise of y over x.
    pub slope: f64,
    /// y at x = 0.
    pub intercept: f64,
    /// The share of the variance that the line explains.
    pub r2: f64,
}

impl Line {
    /// The line with the least sum of squared residuals; none without two different abscissae.
    pub fn fit(points: &[[f64; 2]]) -> Option<Self> {
        let count = points.len() as f64;
        let mean = |at: usize| points.iter().map(|point| point[at]).sum::<f64>() / count;
        let (mean_x, mean_y) = (mean(0), mean(1));
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for [x, y] in points {
            let (x, y) = (x - mean_x, y - mean_y);
            xx += x * x;
            xy += x * y;
            yy += y * y;
        }
        let slope = xy / xx;
        let r2 = if yy == 0.0 { 1.0 } else { xy * xy / (xx * yy) };
        (xx > 0.0).then_some(Self { slope, intercept: mean_y - slope * mean_x, r2 })
    }
}

impl Metric {
    /// The error that a reference's noise makes, where it is known.
    pub(super) fn noise(self, noise: &Noise) -> Option<f64> {
        match self {
            Self::Rmse => Some(noise.rmse),
            Self::Nrmse => Some(noise.nrmse),
            Self::Relmse => Some(noise.relmse),
            Self::TileNrmse => noise.tile_nrmse,
            Self::Mae | Self::Bias | Self::Flip | Self::MaxAbs => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_fitted() {
        let line = Line::fit(&[[0.0, 1.0], [1.0, 3.0], [2.0, 5.0]]).unwrap();
        assert_eq!(line, Line { slope: 2.0, intercept: 1.0, r2: 1.0 });
        let bent = Line::fit(&[[0.0, 0.0], [1.0, 1.0], [2.0, 4.0], [3.0, 9.0]]).unwrap();
        assert!((bent.slope - 3.0).abs() < 1e-12 && (bent.r2 - 45.0 / 49.0).abs() < 1e-12);
        assert_eq!(Line::fit(&[[1.0, 1.0], [1.0, 2.0]]), None);
        assert_eq!(Line::fit(&[]), None);
    }

    #[test]
    fn a_power_law_is_found_again_with_its_floor() {
        let points = |floor: f64| -> Vec<[f64; 2]> {
            (0..6)
                .map(|i| [f64::from(1 << i), floor + 0.3 * f64::from(1 << i).powf(-1.1)])
                .collect()
        };
        let plain = PowerLaw::fit(&points(0.0)).unwrap();
        assert!((plain.slope + 1.1).abs() < 1e-9 && plain.floor.is_none());
        let floored = PowerLaw::fit(&points(0.01)).unwrap();
        assert!((floored.slope + 1.1).abs() < 0.05, "{floored:?}");
        assert!((floored.floor.unwrap() / 0.01 - 1.0).abs() < 0.1, "{floored:?}");
    }

    #[test]
    fn few_rows_tell_no_slope_and_fewer_no_floor() {
        let point = |x: f64| [x, 0.1 + 1.0 / x];
        assert_eq!(PowerLaw::fit(&[point(1.0), point(2.0)]), None);
        assert_eq!(PowerLaw::fit(&[point(1.0), point(1.1), point(1.2)]), None);
        assert_eq!(PowerLaw::fit(&[1.0, 2.0, 4.0].map(point)).unwrap().floor, None);
        assert!(PowerLaw::fit(&[1.0, 2.0, 4.0, 8.0, 16.0].map(point)).unwrap().floor.is_some());
    }
}
