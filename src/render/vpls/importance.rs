//! How much each VPL adds to the error of the image if it is left to chance, from what the camera's
//! side sees.
//!
//! VPLs kept with probabilities p give the image a variance, relative to its own light L, of about
//! Σ_j A_j / p_j with A_j = ∫ (Φ_j ρ_j G V / L)² over the visible points, least for so many VPLs where p_j is in
//! proportion to √A_j. Directions drawn by the cosine at visible points arrive with a density of G V / π
//! at what they see: sights that weigh G / L² are as dense on surfaces as A_j / (Φ_j ρ_j)² says.
//! Georgiev and Slusallek, "Simple and Robust Iterative Importance Sampling of Virtual Point Lights",
//! 2010, seek the same by shadow rays.

use rayon::prelude::*;

use super::density::Density;
use super::sights::Sight;
use super::trace::Vpl;

/// VPLs in the cell that irradiance is of, at least.
const PHOTONS: usize = 32;
/// Sights in a cell, at least. The densest of all cells counts: what is taken for important without
/// need costs little, what is overlooked becomes a bright speck.
const SIGHTS: usize = 2;
/// Light that is less than this share of the image's mean weighs as if it were so much, as relMSE has it.
const LEAST_LIGHT: f64 = 0.1;
/// Geometry terms count up to so many times their median: nearer VPLs are bounded.
const MOST_GEOMETRY: f32 = 100.0;

/// For every VPL a number in proportion to √A / (Φ ρ), all 0 if nothing is seen.
pub fn importance(vpls: &[Vpl], sights: &[Sight]) -> Vec<f64> {
    let light = irradiance(vpls, sights);
    let mean = light.iter().sum::<f64>() / sights.len().max(1) as f64;
    let most = MOST_GEOMETRY * median_geometry(sights);
    let weight = |sight: &Sight, light: f64| {
        let relative = 1.0 / (light + LEAST_LIGHT * mean).max(f64::MIN_POSITIVE);
        f64::from(sight.geometry().min(most)) * (relative * mean).powi(2)
    };
    let weighted = sights.iter().zip(&light);
    let seen = Density::of(weighted.map(|(sight, &light)| (sight.to, weight(sight, light))));
    vpls.par_iter().map(|vpl| seen.greatest(vpl.facet(), SIGHTS).sqrt()).collect()
}

fn median_geometry(sights: &[Sight]) -> f32 {
    let mut all: Vec<f32> = sights.iter().map(Sight::geometry).collect();
    let middle = all.len() / 2;
    if all.is_empty() { 0.0 } else { *all.select_nth_unstable_by(middle, f32::total_cmp).1 }
}

/// The irradiance at the visible points of sights, direct light included: VPLs are where light has
/// arrived, so that their flux over their area is its density (Jensen, "Global Illumination using
/// Photon Maps", 1996).
fn irradiance(vpls: &[Vpl], sights: &[Sight]) -> Vec<f64> {
    let flux = |vpl: &Vpl| f64::from(vpl.flux.element_sum()) / 3.0;
    let photons = Density::of(vpls.iter().map(|vpl| (vpl.facet(), flux(vpl))));
    sights.par_iter().map(|sight| photons.at(sight.from, PHOTONS)).collect()
}
