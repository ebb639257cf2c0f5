//! VPLs where they count: of many candidates those are gathered that the image needs most.

use super::importance::importance;
use super::select::{effective_number, probabilities, systematic};
use super::sights::Sight;
use super::starts::Starts;
use super::trace::{LightPaths, Vpl, divide};
use crate::render::plan::Plan;
use crate::render::settings::Settings;
use crate::render::virtual_light::{VirtualLight, curve};
use crate::sampling::hash;

/// Keeps the random number apart from those of light paths.
const STREAM: u32 = 0x6b65_6570;
/// Light paths over VPLs that are gathered, at most: where most paths leave nothing.
const MOST_PATHS: u32 = 64;
/// The share of the probability that goes by flux alone: what the camera's side has not come upon
/// is not brightened without limit.
const BY_FLUX: f64 = 0.05;

/// VPLs that are kept of more.
#[derive(Debug)]
pub struct Kept {
    /// The VPLs, by whose flux those are represented that are not kept.
    pub vpls: Vec<Vpl>,
    /// How many equal ones would leave as much to chance.
    pub effective: f64,
}

/// Traces light paths until they have left about as many candidates as the settings ask for; and how
/// many paths those are.
pub fn candidates(
    plan: &Plan,
    settings: &Settings,
    seed: u32,
    sights: &[Sight],
) -> (Vec<Vpl>, u32) {
    let seen: Vec<_> = sights.iter().map(|sight| sight.to).collect();
    let Plan { scene, bvh, lights, .. } = plan;
    let starts = Starts::learned(scene, bvh, lights, &seen, seed);
    let paths = LightPaths::of(plan, settings, seed);
    let first = settings.light_paths;
    let mut vpls = paths.trace_some(0..first, starts.as_ref());
    let wanted = u64::from(settings.candidates) * u64::from(first);
    let most = u64::from(first) * u64::from(MOST_PATHS.max(settings.candidates));
    let count = wanted * u64::from(first) / (vpls.len() as u64).max(1);
    let count = count.clamp(first.into(), most.min(u32::MAX.into())) as u32;
    vpls.extend(paths.trace_some(first..count, starts.as_ref()));
    divide(&mut vpls, count);
    (vpls, count)
}

/// Keeps as many of the candidates as the settings gather, with probabilities by what they add to the
/// image, and divides their flux by those: the mean over seeds is that of all candidates.
pub fn keep(
    plan: &Plan,
    settings: &Settings,
    seed: u32,
    sights: &[Sight],
    candidates: &[Vpl],
) -> Kept {
    let lights: Vec<_> = candidates.iter().map(|vpl| vpl.light(&plan.scene)).collect();
    let reflected: Vec<f64> = lights.iter().map(VirtualLight::mean_intensity).collect();
    let importance = importance(candidates, sights);
    let scores: Vec<f64> = reflected.iter().zip(&importance).map(|(flux, of)| flux * of).collect();
    let [by_score, by_flux] = [&scores, &reflected].map(|of| of.iter().sum::<f64>());
    let share = if by_score > 0.0 { BY_FLUX } else { 1.0 };
    let weight = |(score, flux): (&f64, &f64)| {
        let score = if share < 1.0 { (1.0 - share) * score / by_score } else { 0.0 };
        score + share * flux / by_flux.max(f64::MIN_POSITIVE)
    };
    let weights: Vec<f64> = scores.iter().zip(&reflected).map(weight).collect();
    let of = probabilities(&weights, settings.light_paths as usize);
    let u = f64::from(hash(seed ^ STREAM)) / 2f64.powi(32);
    let kept = systematic(&of, &curve(&lights), u);
    let given = kept.iter().map(|&i| weights[i as usize] / of[i as usize]);
    let effective = effective_number(given);
    let vpls = kept.iter().map(|&i| {
        let vpl = candidates[i as usize];
        Vpl { flux: vpl.flux / of[i as usize] as f32, ..vpl }
    });
    Kept { vpls: vpls.collect(), effective }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::settings::Method;
    use crate::render::vpls::sights::sights;
    use crate::scene::Scene;

    fn plan() -> (Plan, Settings, Vec<Sight>) {
        let scene = Scene::load("builtin:room").unwrap();
        let settings = Settings::of_vpls(Method::Both, 500);
        let camera = scene.camera;
        let plan = Plan::new(scene, &settings, false);
        let sights = sights(&plan, &camera, 1 << 14, 5);
        (plan, settings, sights)
    }

    /// What is kept of the same candidates gives, in the mean over seeds, the light of all of them:
    /// in all, and in each half of the room.
    #[test]
    fn the_mean_of_what_is_kept_is_all() {
        let (plan, settings, sights) = plan();
        let (all, _) = candidates(&plan, &settings, 3, &sights);
        let halves = |vpls: &[Vpl]| {
            let sum = |half: bool| {
                let of = vpls.iter().filter(|vpl| (vpl.position.x > 0.0) == half);
                of.map(|vpl| vpl.light(&plan.scene).mean_intensity()).sum::<f64>()
            };
            [sum(false), sum(true)]
        };
        let expected = halves(&all);
        const SEEDS: u32 = 32;
        let (mut mean, mut squares) = ([0.0; 2], [0.0; 2]);
        for seed in 0..SEEDS {
            let kept = keep(&plan, &settings, seed, &sights, &all);
            assert!((499..=501).contains(&kept.vpls.len()), "{}", kept.vpls.len());
            assert!(kept.effective > 50.0 && kept.effective <= 501.0, "{}", kept.effective);
            for (half, sum) in halves(&kept.vpls).into_iter().enumerate() {
                mean[half] += sum / f64::from(SEEDS);
                squares[half] += (sum / expected[half] - 1.0).powi(2) / f64::from(SEEDS);
            }
        }
        for half in 0..2 {
            let error = (squares[half] / f64::from(SEEDS)).sqrt();
            let off = mean[half] / expected[half] - 1.0;
            assert!(error < 0.02, "the standard error {error} tells nothing");
            assert!(off.abs() < 4.0 * error, "half {half} is off by {off}, not {error}");
        }
    }

    /// VPLs go to what is seen: those that light the image, not the many behind it.
    #[test]
    fn vpls_are_kept_where_the_image_needs_them() {
        let (plan, settings, sights) = plan();
        let (all, paths) = candidates(&plan, &settings, 1, &sights);
        assert!(all.len() >= 7 * 500 && paths > 500, "{} of {paths} paths", all.len());
        let kept = keep(&plan, &settings, 1, &sights, &all).vpls;
        let needed =
            |vpls: &[Vpl]| importance(vpls, &sights).iter().sum::<f64>() / vpls.len() as f64;
        let [kept, all] = [&kept, &all].map(|vpls| needed(vpls));
        assert!(kept > 1.2 * all, "importance {kept} of those kept, {all} of all");
    }
}
