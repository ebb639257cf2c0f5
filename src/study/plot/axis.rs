//! A logarithmic axis: its range, where values lie on it, and its ticks.

/// A logarithmic axis from a low to a high value, drawn from one coordinate to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// The values at its ends, positive.
    pub range: [f64; 2],
    /// Where its ends are drawn.
    pub ends: [f64; 2],
}

/// A line of the grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// Where on the axis.
    pub value: f64,
    /// What is written beside it; nothing beside minor ones.
    pub label: Option<String>,
}

impl Axis {
    /// The narrowest range, high over low: wide enough for two labels.
    const NARROWEST: f64 = 8.0;

    /// Room beyond the outermost values, as a factor.
    const MARGIN: f64 = 1.25;

    /// An axis on which all these values lie, what is not positive or not finite left aside.
    pub fn around(values: impl Iterator<Item = f64>, ends: [f64; 2]) -> Self {
        let logarithms = values.filter(|value| value.is_normal() && *value > 0.0).map(f64::ln);
        let (low, high) = logarithms
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(value), high.max(value))
            });
        let (low, high) = if low <= high { (low, high) } else { (0.1_f64.ln(), 0.0) };
        let missing = (Self::NARROWEST.ln() - (high - low)).max(0.0) / 2.0;
        let margin = missing.max(Self::MARGIN.ln());
        Self { range: [(low - margin).exp(), (high + margin).exp()], ends }
    }

    /// Where a value is drawn; at the nearer end where it lies outside, zero included.
    pub fn at(&self, value: f64) -> f64 {
        let [from, to] = self.ends;
        self.beyond(value).clamp(from.min(to), from.max(to))
    }

    /// Where a value is drawn, be it outside: for lines that are clipped.
    pub fn beyond(&self, value: f64) -> f64 {
        let [low, high] = self.range.map(f64::ln);
        let part = (value.max(f64::MIN_POSITIVE).ln() - low) / (high - low);
        self.ends[0] + part * (self.ends[1] - self.ends[0])
    }

    /// Whether a value lies within.
    pub fn holds(&self, value: f64) -> bool {
        (self.range[0]..=self.range[1]).contains(&value)
    }

    /// Lines at 1 to 9 of every decade. Labels are at 1, 2 and 5 where there are at most two and
    /// a half decades, and else at powers of ten, never more than eight of them.
    pub fn ticks(&self) -> Vec<Tick> {
        let [low, high] = self.range.map(|value| value.log10().floor() as i32);
        let decades = (self.range[1] / self.range[0]).log10();
        let every = (decades / 8.0).ceil().max(1.0) as i32;
        let steps = (low..=high).flat_map(|decade| (1..10).map(move |digit| (decade, digit)));
        let ticks = steps.map(|(decade, digit)| {
            let fine = decades <= 2.5 && matches!(digit, 1 | 2 | 5);
            let labelled = fine || digit == 1 && decade.rem_euclid(every) == 0;
            let label = labelled.then(|| label(decade, digit));
            Tick { value: f64::from(digit) * 10_f64.powi(decade), label }
        });
        ticks.filter(|tick| self.holds(tick.value)).collect()
    }
}

/// digit · 10^decade, in plain decimals where those are short.
fn label(decade: i32, digit: u32) -> String {
    match decade {
        -4..0 => format!("0.{:0>1$}", digit, decade.unsigned_abs() as usize),
        0..5 => format!("{digit}{}", "0".repeat(decade as usize)),
        _ if digit == 1 => format!("10{}", superscript(decade)),
        _ => format!("{digit}·10{}", superscript(decade)),
    }
}

fn superscript(number: i32) -> String {
    let raised = |c| match c {
        '-' => '⁻',
        digit => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹']
            [digit.to_digit(10).unwrap_or(0) as usize],
    };
    number.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64) -> Vec<String> {
        let axis = Axis { range: [low, high], ends: [0.0, 1.0] };
        axis.ticks().into_iter().filter_map(|tick| tick.label).collect()
    }

    #[test]
    fn the_range_holds_all_values_that_can_be_drawn() {
        let values = [0.02, 3.0, 0.0, -1.0, f64::NAN, f64::INFINITY];
        let axis = Axis::around(values.into_iter(), [0.0, 100.0]);
        assert!(axis.holds(0.02) && axis.holds(3.0));
        assert!(!axis.holds(0.01) && !axis.holds(6.0));
        let wide = |values: &[f64]| {
            let axis = Axis::around(values.iter().copied(), [0.0, 1.0]);
            axis.range[1] / axis.range[0]
        };
        assert!((wide(&[0.7]) - Axis::NARROWEST).abs() < 1e-9);
        assert!(wide(&[]) > 2.0, "an axis without values is an axis");
    }

    #[test]
    fn values_lie_by_their_logarithm_and_never_outside() {
        let axis = Axis { range: [0.01, 100.0], ends: [400.0, 0.0] };
        assert_eq!([0.01, 100.0].map(|value| axis.at(value)), [400.0, 0.0]);
        assert!((axis.at(1.0) - 200.0).abs() < 1e-9);
        assert_eq!([0.0, -3.0, 1e9, f64::NAN].map(|v| axis.at(v)), [400.0, 400.0, 0.0, 400.0]);
    }

    #[test]
    fn labels_are_few_and_plain() {
        assert_eq!(labels(0.4, 3.0), ["0.5", "1", "2"]);
        assert_eq!(labels(0.0004, 0.03), ["0.0005", "0.001", "0.002", "0.005", "0.01", "0.02"]);
        assert_eq!(labels(0.09, 2000.0), ["0.1", "1", "10", "100", "1000"]);
        assert_eq!(labels(5e-9, 2e-5), ["10⁻⁸", "10⁻⁷", "10⁻⁶", "10⁻⁵"]);
        assert_eq!(labels(1.5e6, 6e6), ["2·10⁶", "5·10⁶"]);
        assert!((3..=8).contains(&labels(1e-30, 1e30).len()));
    }

    #[test]
    fn every_decade_has_its_nine_lines() {
        let axis = Axis { range: [0.5, 150.0], ends: [0.0, 1.0] };
        let ticks = axis.ticks();
        assert_eq!(ticks.len(), 5 + 9 + 9 + 1);
        assert!(ticks.is_sorted_by(|a, b| a.value < b.value));
    }
}
