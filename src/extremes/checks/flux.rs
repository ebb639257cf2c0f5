//! Where light paths carry flux, and what clusters of VPLs keep of it.

use std::f64::consts::PI;

use glam::{DVec3, dvec3};

use super::builder::SceneBuilder;
use super::measure::{at_most, none, relative};
use crate::bvh::Bvh;
use crate::error::{Error, SceneError};
use crate::extremes::{Figure, Scale};
use crate::gpu::Gpu;
use crate::metrics::largest;
use crate::render::{
    Bounces, Clustering, LightPaths, Lights, Merge, Representative, VirtualLight, Vpl, VplClusters,
};
use crate::scene::Scene;

fn trace(scene: &Scene, count: u32, bounces: u32) -> Vec<Vpl> {
    let (bvh, lights) = (Bvh::of(scene), Lights::of(scene));
    let bounces = Bounces::Finite(bounces);
    LightPaths { scene, bvh: &bvh, lights: &lights, count, bounces, seed: 1 }.trace()
}

/// A wall of a cube gives 0.1998 of its light to the opposite one, and 0.2000 to each other. Light
/// starts on the ceiling; the second bounce is from wherever it has come.
pub fn form_factors(_: &Gpu, scale: Scale) -> Result<Vec<Figure>, Error> {
    /// Closed form: Howell's catalogue, C-11, for a cube.
    const OPPOSITE: f64 = 0.199_825;
    let paths = if scale == Scale::Full { 1 << 20 } else { 1 << 16 };
    let mut builder = SceneBuilder::at(1.0, DVec3::ZERO);
    let wall = builder.material([1.0; 3], [0.0; 3])?;
    let lamp = builder.material([1.0; 3], [1.0; 3])?;
    builder.cuboid(wall, DVec3::ZERO, DVec3::ONE, true);
    for triangle in &mut builder.draft.triangles[10..12] {
        triangle.1 = lamp;
    }
    builder.camera(DVec3::splat(0.5), DVec3::Y, 60.0, [8, 8]);
    let vpls = trace(&builder.scene()?, paths, 2);
    let side = |vpl: &Vpl| vpl.normal.as_dvec3();
    // Evenly spread starts are far better than random ones, whose deviation is √(p (1 − p) / n).
    let within = (0.16 / f64::from(paths)).sqrt();
    let mut figures = vec![none(
        format!("{paths} paths of 2 bounces in a closed cube: VPLs that lack"),
        (2 * paths as usize).saturating_sub(vpls.len()),
    )];
    let walls = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    let mut row = 0.0;
    for wall in walls {
        let there = vpls.iter().step_by(2).filter(|vpl| side(vpl).dot(wall) > 0.9).count();
        let share = there as f64 / f64::from(paths);
        row += share;
        // The ceiling's normal points down; the floor's up.
        let expected = match wall {
            DVec3::Z => OPPOSITE,
            DVec3::NEG_Z => 0.0,
            _ => (1.0 - OPPOSITE) / 4.0,
        };
        let what = format!("share of the wall whose normal is {wall}");
        figures.push(super::measure::absolute(what, expected, share, within));
    }
    figures.push(relative("sum of the shares", 1.0, row, 1e-12));
    let across =
        vpls.chunks(2).filter(|path| path.len() == 2 && side(&path[0]).dot(side(&path[1])) < -0.9);
    let share = across.count() as f64 / f64::from(paths);
    figures.push(super::measure::absolute("second bounce: opposite", OPPOSITE, share, within));
    Ok(figures)
}

/// Incident flux at bounce b is ρ^(b−1) of what the lights send out; clusters of VPLs keep what
/// their members send on, channel by channel.
pub fn kept(_: &Gpu, scale: Scale) -> Result<Vec<Figure>, Error> {
    const BOUNCES: u32 = 6;
    let paths = if scale == Scale::Full { 100_000 } else { 10_000 };
    let albedo = [0.9, 0.5, 0.25];
    let vpls = trace(&closed_box(albedo, albedo)?, paths, BOUNCES);
    let mut figures = vec![none(
        format!("{paths} paths of {BOUNCES} bounces in a closed box: VPLs that lack"),
        ((paths * BOUNCES) as usize).saturating_sub(vpls.len()),
    )];
    let power = DVec3::splat(4.0 * PI * 0.7);
    for bounce in 0..BOUNCES as usize {
        let here = vpls.iter().skip(bounce).step_by(BOUNCES as usize);
        let arrived: DVec3 = here.map(|vpl| vpl.flux.as_dvec3()).sum();
        let expected = power * DVec3::from_array(albedo).powf(bounce as f64);
        // Each bounce multiplies a path's flux in f32: a rounding of 6e-8 each, and one for the
        // share of a path.
        let off = largest((arrived / expected - DVec3::ONE).abs().to_array());
        figures.push(at_most(format!("bounce {}: incident flux", bounce + 1), off, 1e-6));
    }
    let scene = closed_box(albedo, [0.02, 0.9, 1.0])?;
    let vpls = trace(&scene, paths / 4, BOUNCES);
    let lights: Vec<_> = vpls.iter().map(|vpl| vpl.light(&scene)).collect();
    let sum = |lights: &[VirtualLight]| -> DVec3 {
        lights.iter().map(|light| light.intensity.as_dvec3()).sum()
    };
    for merge in [Merge::Light, Merge::Visibility] {
        for representative in [Representative::Mean, Representative::Member] {
            for clusters in [1, 10, 300] {
                let options =
                    Clustering { vpls: clusters, merge, representative, ..Clustering::default() };
                let merged = VplClusters::of(&lights, &options, 1);
                // Sums in f64, each rounded once to f32.
                let off = sum(&merged.lights) / sum(&lights) - DVec3::ONE;
                let off = largest(off.abs().to_array());
                let what = format!(
                    "{} VPLs of two albedos in {} clusters, {merge:?}, {representative:?}: exitant flux",
                    lights.len(),
                    merged.lights.len()
                );
                figures.push(at_most(what, off, 1e-7));
            }
        }
    }
    Ok(figures)
}

/// With a point light in the middle; the floor has an albedo of its own.
fn closed_box(albedo: [f64; 3], floor: [f64; 3]) -> Result<Scene, SceneError> {
    let mut builder = SceneBuilder::at(1.0, DVec3::ZERO);
    let wall = builder.material(albedo, [0.0; 3])?;
    let floor = builder.material(floor, [0.0; 3])?;
    builder.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
    for triangle in &mut builder.draft.triangles[8..10] {
        triangle.1 = floor;
    }
    builder.point_light(DVec3::ZERO, [0.7; 3]);
    builder.camera(dvec3(0.0, -0.5, 0.0), DVec3::Y, 60.0, [8, 8]);
    builder.scene()
}
