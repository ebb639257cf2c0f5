//! The bound on the geometry term: what it depends on, and what it takes.

use glam::{DVec3, Vec3, dvec3};

use super::builder::{SceneBuilder, room};
use super::measure::{
    absolute, at_most, difference, energy, frame, frame_of, frame_seeded, of, relative,
};
use crate::error::{Error, SceneError};
use crate::extremes::{Figure, Scale};
use crate::gpu::Gpu;
use crate::render::{Bounces, Clamp, Direct, Method, Prepared, Settings};
use crate::scene::{Bsdf, Scene};

/// Indirect light alone, one sample a pixel, by the pixel's own visibility.
fn indirect(method: Method, light_paths: u32) -> Settings {
    Settings {
        light_paths,
        direct: Direct::Off,
        edge_samples: 1,
        interleave: 1,
        candidates: 1,
        ..Settings::of(method)
    }
}

/// The default bound goes with 1/scale², so that neither the image nor the share that it takes
/// changes with the scene's scale.
pub fn scale_free(gpu: &Gpu, scale: Scale) -> Result<Vec<Figure>, Error> {
    let (size, paths) = if scale == Scale::Full { ([128, 96], 8000) } else { ([32, 24], 1000) };
    let mut figures = Vec::new();
    for method in [Method::Vpl, Method::Both] {
        let settings = indirect(method, paths);
        let tame = frame(gpu, room(1.0, size)?.scene()?, &settings)?;
        let bound = tame.counts.clamp.unwrap_or(f64::NAN);
        // Powers of two change no bit. Others round positions otherwise, to 6e-8 of the scene:
        // pixels at the edge of a shadow may gain or lose a VPL, so means are compared.
        for factor in [1024.0, 1.0 / 1024.0, 1e-6, 1e6] {
            let exact = factor == 1024.0 || factor == 1.0 / 1024.0;
            let other = frame(gpu, room(factor, size)?.scene()?, &settings)?;
            let scaled = other.counts.clamp.unwrap_or(f64::NAN) * factor * factor;
            let name = format!("scale {factor:e}");
            let within = if exact { 1e-12 } else { 1e-4 };
            figures.push(of(
                method,
                relative(format!("{name}: bound · scale²"), bound, scaled, within),
            ));
            let (share, was) = (other.counts.clamped_fraction, tame.counts.clamped_fraction);
            let within = if exact { 1e-12 } else { 1e-3 };
            figures
                .push(of(method, relative(format!("{name}: share clamped"), was, share, within)));
            if exact {
                let off = difference(&other, &tame);
                figures.push(of(method, at_most(format!("{name}: image"), off, 1e-6)));
            } else {
                let what = format!("{name}: energy of the image");
                figures.push(of(method, relative(what, energy(&tame), energy(&other), 1e-3)));
            }
        }
    }
    Ok(figures)
}

/// The more VPLs, the less the bound takes: by how much, and with which power of their number.
///
/// Walls that meet are where pairs are near each other. There the part of G above b comes from
/// within b^(-1/2) of the edge: both distances to it and that along it, a volume of b^(-3/2), times
/// G of the order of b. As b grows with the number of VPLs n, the share goes with n^(-1/2).
pub fn vanishes(gpu: &Gpu, scale: Scale) -> Result<Vec<Figure>, Error> {
    let full = scale == Scale::Full;
    let size = if full { [128, 96] } else { [64, 48] };
    let counts = if full { &[500, 2000, 8000, 32_000][..] } else { &[250, 1000, 4000][..] };
    // What is clamped are few pairs; the mean over so many sets of VPLs has less noise.
    let seeds = if full { 16 } else { 6 };
    let settings = |paths| indirect(Method::Vpl, paths);
    let prepared = Prepared::new(gpu.clone(), room(1.0, size)?.scene()?, &settings(1))?;
    let mut shares: Vec<(f64, f64)> = Vec::new();
    for &paths in counts {
        let (mut vpls, mut share) = (0.0, 0.0);
        for seed in 0..seeds {
            let counts = frame_seeded(&prepared, &settings(paths), seed)?.counts;
            vpls += counts.vpls as f64 / f64::from(seeds);
            share += counts.clamped_fraction / f64::from(seeds);
        }
        shares.push((vpls, share));
    }
    let mut figures = Vec::new();
    for pair in shares.windows(2) {
        let [(few, more), (many, less)] = [pair[0], pair[1]];
        let what = format!("from {few} to {many} VPLs the share falls, {more:.5} to {less:.5}");
        figures.push(of(Method::Vpl, absolute(what, 1.0, f64::from(less < more), 0.0)));
    }
    if let (Some(first), Some(last)) = (shares.first(), shares.last()) {
        let slope = (last.1 / first.1).ln() / (last.0 / first.0).ln();
        let what = "slope of the share over the number of VPLs, of their logarithms";
        // Of means whose deviation is some tenth.
        figures.push(of(Method::Vpl, absolute(what, -0.5, slope, 0.15)));
    }
    Ok(figures)
}

/// The report's share is what is missing from the image against that without a bound.
pub fn fraction(gpu: &Gpu, scale: Scale) -> Result<Vec<Figure>, Error> {
    let (size, paths) = if scale == Scale::Full { ([128, 96], 8000) } else { ([32, 24], 1000) };
    let mut figures = Vec::new();
    for (name, specular, shininess) in
        [("diffuse", 0.0, 1.0), ("Phong, n = 20", 0.4, 20.0), ("Phong, n = 1000", 0.4, 1000.0)]
    {
        let scene = grey_room(specular, shininess, size)?;
        for method in [Method::Vpl, Method::Both] {
            let settings = Settings { bounces: Bounces::Finite(2), ..indirect(method, paths) };
            let prepared = Prepared::new(gpu.clone(), scene.clone(), &settings)?;
            for clamp in [Clamp::Auto, Clamp::At(0.5)] {
                let bounded = frame_of(&prepared, &Settings { clamp, ..settings })?;
                let off = Settings { clamp: Clamp::Off, ..settings };
                let free = frame_of(&prepared, &off)?;
                let missing = 1.0 - energy(&bounded) / energy(&free);
                let reported = bounded.counts.clamped_fraction;
                let what = format!("{name}, {clamp:?}: share that the report says");
                // Sums of the same terms in f32: 1e-7 of the whole is a rounding.
                figures.push(of(method, absolute(what, missing, reported, 3e-7)));
            }
        }
    }
    Ok(figures)
}

/// Grey, as the share is of the mean of the channels.
fn grey_room(specular: f32, shininess: f32, size: [u32; 2]) -> Result<Scene, SceneError> {
    let mut builder = SceneBuilder::at(1.0, DVec3::ZERO);
    let wall = builder.material([0.5; 3], [0.0; 3])?;
    if specular > 0.0 {
        let bsdf = Bsdf::Phong { specular: Vec3::splat(specular), shininess };
        builder.draft.materials[wall as usize].bsdf = bsdf;
    }
    builder.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
    builder.cuboid(wall, dvec3(-0.3, 0.1, -1.0), dvec3(0.4, 0.7, 0.2), false);
    builder.point_light(dvec3(0.7, -0.6, 0.3), [0.5; 3]);
    builder.camera(dvec3(-0.9, -0.8, 0.1), dvec3(0.7, 0.65, -0.3), 60.0, size);
    builder.scene()
}
