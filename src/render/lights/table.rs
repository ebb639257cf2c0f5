//! Lights of a kind, to be drawn in proportion to their power.

use glam::Vec3;

/// The mean of the channels, by which lights are weighed.
pub fn mean(rgb: Vec3) -> f64 {
    f64::from(rgb.element_sum()) / 3.0
}

/// The interval of probability of a light among its kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// The probability of all lights before it.
    pub before: f32,
    /// Its own.
    pub probability: f32,
}

/// Lights of a kind.
#[derive(Debug, Clone)]
pub struct Table<R> {
    /// A record each.
    pub records: Vec<R>,
    shares: Vec<Share>,
    /// Flux of all of them, mean of the channels.
    pub power: f64,
}

impl<R> Default for Table<R> {
    fn default() -> Self {
        Self { records: Vec::new(), shares: Vec::new(), power: 0.0 }
    }
}

impl<R> Table<R> {
    /// Makes a record of each light, with its share of the power.
    pub fn of<L>(lights: &[L], power: impl Fn(&L) -> f64, record: impl Fn(&L, Share) -> R) -> Self {
        let powers: Vec<f64> = lights.iter().map(power).collect();
        let shares = shares(&powers);
        let records = lights.iter().zip(&shares).map(|(light, share)| record(light, *share));
        Self { records: records.collect(), shares, power: powers.iter().sum() }
    }

    /// The light whose interval of probability holds `u`, its probability, and where in the
    /// interval; none if no light has any power.
    pub fn at(&self, u: f64) -> Option<(&R, f32, f32)> {
        let (at, probability, rest) = self.index_at(u)?;
        Some((&self.records[at], probability, rest))
    }

    /// The index of that light, and the same.
    pub fn index_at(&self, u: f64) -> Option<(usize, f32, f32)> {
        let next = self.shares.partition_point(|share| f64::from(share.before) <= u);
        let at = next.checked_sub(1)?;
        let Share { before, probability } = self.shares[at];
        let rest = (u - f64::from(before)) / f64::from(probability);
        (self.power > 0.0).then(|| (at, probability, unit(rest)))
    }
}

/// Rounding may leave the remainder a little outside of its interval.
fn unit(x: f64) -> f32 {
    (x as f32).clamp(0.0, 1.0 - f32::EPSILON)
}

/// Intervals in proportion to powers, of steps of 2⁻²⁴: so finely random numbers divide [0, 1), and
/// f32 holds every multiple there, so that each light is drawn with just its probability. All that
/// have any power have a step at least, if they are no more than 2²⁴.
pub fn shares(powers: &[f64]) -> Vec<Share> {
    const STEPS: f64 = 16_777_216.0;
    let lit = powers.iter().filter(|&&power| power > 0.0).count() as f64;
    let own = if lit < STEPS { 1.0 } else { 0.0 };
    let total: f64 = powers.iter().sum();
    let (mut count, mut sum, mut end) = (0.0, 0.0, 0.0);
    let share = |&power: &f64| {
        let before = end;
        if power > 0.0 {
            count += own;
            sum += power;
            end = count + (sum / total * (STEPS - own * lit)).round();
        }
        let [before, probability] = [before, end - before].map(|steps| (steps / STEPS) as f32);
        Share { before, probability }
    };
    powers.iter().map(share).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums to one, leaves no gap, leaves nobody out, and is near to what it should be.
    fn check(powers: &[f64], most: f64) {
        let shares = shares(powers);
        let total: f64 = powers.iter().sum();
        let mut end = 0.0;
        for (share, &power) in shares.iter().zip(powers) {
            assert_eq!(share.before, end);
            assert_eq!(share.probability > 0.0, power > 0.0);
            end = share.before + share.probability;
            // The sum is exact.
            assert_eq!(f64::from(end), f64::from(share.before) + f64::from(share.probability));
            let off = f64::from(share.probability) - power / total;
            assert!(off.abs() <= most * power / total + 2.0 / 16_777_216.0, "off by {off}");
        }
        assert_eq!(end, 1.0);
    }

    #[test]
    fn shares_are_exact_for_any_number_of_lights() {
        for count in [1, 2, 3, 1000, 10_000, 1_000_000] {
            let most = f64::from(count) / 16_777_216.0;
            check(&vec![0.3; count as usize], most);
            let uneven = |i: i32| 10f64.powi(i % 13 - 6) * f64::from(1 + i % 7);
            check(&(0..count).map(uneven).collect::<Vec<_>>(), most);
            check(&(0..count).map(|i| f64::from((i + 1) % 2)).collect::<Vec<_>>(), most);
        }
        check(&[1e-30, 1e30, 0.0, 1e-30, 0.0], 1e-6);
    }

    #[test]
    fn every_light_is_drawn_by_its_share() {
        let powers: Vec<f64> = (0..5000).map(|i| f64::from(i % 5)).collect();
        let table = Table::of(&powers, |&power| power, |_, share| share);
        let steps = 1 << 16;
        let mut drawn = vec![0; powers.len()];
        for i in 0..steps {
            let u = (f64::from(i) + 0.5) / f64::from(steps);
            let (share, probability, rest) = table.at(u).unwrap();
            assert_eq!(share.probability, probability);
            let place = f64::from(share.before) + f64::from(probability) * f64::from(rest);
            assert!((place - u).abs() < 1e-7);
            let at = table.records.iter().position(|other| other.before == share.before);
            drawn[at.unwrap()] += 1;
        }
        // Those without power have the interval's bounds of the next, and are not drawn.
        let lit = powers.iter().filter(|&&power| power > 0.0).count();
        assert!(drawn.iter().filter(|&&count| count > 0).count() >= lit - 1);
        assert!(Table::<Share>::default().at(0.5).is_none());
        assert!(Table::of(&[0.0], |&power| power, |_, share| share).at(0.5).is_none());
    }
}
