//! Of many candidates some, by chance, each with a probability of its own.

/// Probabilities in proportion to the weights, none above 1, so that `count` of the candidates are
/// kept; all, if they are no more.
pub fn probabilities(weights: &[f64], count: usize) -> Vec<f64> {
    if weights.len() <= count {
        return vec![1.0; weights.len()];
    }
    let mut order: Vec<u32> = (0..weights.len() as u32).collect();
    order.sort_by(|&a, &b| weights[b as usize].total_cmp(&weights[a as usize]).then(a.cmp(&b)));
    // From the heaviest on, those are certain whose share of what is left would be one or more.
    let mut rest: f64 = order.iter().rev().map(|&i| weights[i as usize]).sum();
    let mut certain = 0;
    for &i in &order {
        let weight = weights[i as usize];
        if certain == count || weight * ((count - certain) as f64) < rest {
            break;
        }
        certain += 1;
        rest -= weight;
    }
    let share = (count - certain) as f64 / rest;
    let mut result = vec![1.0; weights.len()];
    for &i in &order[certain..] {
        result[i as usize] = (weights[i as usize] * share).min(1.0);
    }
    result
}

/// Systematic sampling: which of the candidates are kept, in an order along which they are spread as
/// evenly as their probabilities allow, by one random number.
pub fn systematic(probabilities: &[f64], order: &[u32], u: f64) -> Vec<u32> {
    let mut sum = u;
    let kept = |&&candidate: &&u32| {
        let before = sum.floor();
        sum += probabilities[candidate as usize];
        sum.floor() > before
    };
    order.iter().filter(kept).copied().collect()
}

/// The effective number of terms of a sum: the square of the sum over the sum of the squares (Kish,
/// "Survey Sampling", 1965).
pub fn effective_number(terms: impl Iterator<Item = f64> + Clone) -> f64 {
    let squares: f64 = terms.clone().map(|term| term * term).sum();
    if squares > 0.0 { terms.sum::<f64>().powi(2) / squares } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probabilities_are_in_proportion_and_come_to_the_number() {
        let weights: Vec<f64> =
            (0..1000).map(|i| f64::from(i % 10) + f64::from(i / 990) * 1e4 + 0.1).collect();
        for count in [1, 10, 100, 900] {
            let of = probabilities(&weights, count);
            let sum: f64 = of.iter().sum();
            assert!((sum - count as f64).abs() < 1e-9 * sum, "{sum}, not {count}");
            assert!(of.iter().all(|&p| p > 0.0 && p <= 1.0));
            // The same ratio for all that are not certain.
            let ratio = |i: usize| of[i] / weights[i];
            assert!(of[9] == 1.0 || (ratio(1) / ratio(9) - 1.0).abs() < 1e-12);
        }
        assert_eq!(probabilities(&weights, 1000), vec![1.0; 1000]);
    }

    /// Over all random numbers every candidate is kept as often as its probability says.
    #[test]
    fn candidates_are_kept_with_their_probability() {
        let weights: Vec<f64> = (0..200).map(|i| 1.0 + f64::from(i * 37 % 11)).collect();
        let of = probabilities(&weights, 50);
        let order: Vec<u32> = (0..200).rev().collect();
        let mut times = vec![0.0; 200];
        for i in 0..10_000 {
            let kept = systematic(&of, &order, (f64::from(i) + 0.5) / 10_000.0);
            assert!((49..=51).contains(&kept.len()), "{} are kept", kept.len());
            kept.iter().for_each(|&k| times[k as usize] += 1e-4);
        }
        for (p, times) in of.iter().zip(&times) {
            assert!((p - times).abs() < 2e-4, "{times}, not {p}");
        }
    }
}
