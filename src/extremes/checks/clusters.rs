//! K-means at its corners, fuzzy weights, and clusters of one.

use glam::Vec3;

use super::builder::room;
use super::measure::{GATHERING, absolute, at_most, devices, difference, frame_of, none, of};
use super::random::Rng;
use crate::cluster::{Clusters, Options, Points, fuzzy, kmeans};
use crate::error::Error;
use crate::extremes::{Figure, Scale};
use crate::gpu::Gpu;
use crate::metrics::largest;
use crate::render::{Clustering, Merge, Method, Prepared, Settings};

/// Points with normals.
type Set = (Vec<Vec3>, Vec<Vec3>);

fn sets(count: usize) -> Vec<(&'static str, Set)> {
    let mut random = Rng(7);
    let cloud: Vec<Vec3> = (0..count).map(|_| random.cube()).collect();
    let normals: Vec<Vec3> = (0..count).map(|_| random.direction()).collect();
    let opposed: Vec<Vec3> =
        (0..count).map(|i| if i % 2 == 0 { Vec3::X } else { Vec3::NEG_X }).collect();
    let clumps = cloud.iter().map(|p| p.signum() + 1e-6 * *p).collect();
    let up = vec![Vec3::Z; count];
    vec![
        ("a cloud", (cloud.clone(), normals.clone())),
        ("coincident points", (vec![Vec3::new(0.1, 0.7, -3.3); count], up.clone())),
        ("coincident points, all normals", (vec![Vec3::ONE; count], normals)),
        ("normals opposed", (cloud.clone(), opposed.clone())),
        ("normals opposed in one place", (vec![Vec3::ONE; count], opposed)),
        ("eight clumps", (clumps, up.clone())),
        ("tiny", (cloud.iter().map(|p| *p * 1e-30).collect(), up.clone())),
        ("huge", (cloud.iter().map(|p| *p * 1e30).collect(), up)),
    ]
}

fn options(clusters: u32) -> Options {
    Options { clusters, iterations: 5, normal_threshold: 0.9, stride: 1, seed: 1 }
}

/// Every point is in a cluster that accepts it, no cluster is empty or no number, whatever the
/// points and however many clusters; 0 are refused.
pub fn corners(_: &Gpu, scale: Scale) -> Result<Vec<Figure>, Error> {
    let count = if scale == Scale::Full { 100_000 } else { 2000 };
    let mut figures = Vec::new();
    for (name, (positions, normals)) in sets(count) {
        let points = Points { positions: &positions, normals: &normals };
        for clusters in [1, 2, 50, count as u32 - 1, count as u32, u32::MAX] {
            let found = kmeans(&points, &options(clusters));
            let what = format!("{name}, {count} points, k = {clusters}");
            figures.push(none(format!("{what}: faults"), faults(&points, &found)));
            if clusters as usize >= count {
                let apart = distinct(&points);
                let (many, all) = (found.clusters.len() as f64, apart as f64);
                figures.push(absolute(
                    format!("{what}: clusters of distinct points"),
                    all,
                    many,
                    0.0,
                ));
            }
        }
    }
    let plain = Clustering::default();
    for (option, clustering) in [
        ("--point-clusters", Clustering { points: 0, ..plain }),
        ("--vpl-clusters", Clustering { vpls: 0, ..plain }),
    ] {
        let told = Settings { clustering, ..Settings::default() }.check();
        let refused = told.is_err_and(|why| why.to_string().starts_with(option));
        figures.push(absolute(format!("{option} 0 is refused"), 1.0, f64::from(refused), 0.0));
    }
    Ok(figures)
}

/// Points that are in no cluster, clusters that are empty, that miscount their members, whose
/// representative is not one, or whose mean is no number.
fn faults(points: &Points, found: &Clusters) -> usize {
    let mut members = vec![0; found.clusters.len()];
    let mut faults = usize::from(found.assignment.len() != points.positions.len());
    for &cluster in &found.assignment {
        match members.get_mut(cluster as usize) {
            Some(count) => *count += 1,
            None => faults += 1,
        }
    }
    for (index, (cluster, count)) in found.clusters.iter().zip(&members).enumerate() {
        let own = found.assignment.get(cluster.representative as usize) == Some(&(index as u32));
        let number = cluster.position.is_finite() && (cluster.normal.length() - 1.0).abs() < 1e-4;
        faults += usize::from(*count == 0 || cluster.members != *count || !own || !number);
    }
    faults
}

fn distinct(points: &Points) -> usize {
    let bits = |v: &Vec3| v.to_array().map(|x| (x + 0.0).to_bits());
    let pairs = points.positions.iter().zip(points.normals);
    pairs.map(|(p, n)| (bits(p), bits(n))).collect::<std::collections::HashSet<_>>().len()
}

/// Weights are within 0 and 1 and sum to 1; a point on a mean belongs to it alone; where fewer
/// clusters accept a point than asked for, the rest has no weight.
pub fn weights(_: &Gpu, scale: Scale) -> Result<Vec<Figure>, Error> {
    let count = if scale == Scale::Full { 100_000 } else { 2000 };
    let mut figures = Vec::new();
    for (name, (positions, normals)) in sets(count) {
        let points = Points { positions: &positions, normals: &normals };
        // So many clusters that some are of one point, which is on their mean.
        for clusters in [1, 3, count as u32 / 2] {
            let found = kmeans(&points, &options(clusters));
            for m in 1..=Clustering::MOST_FUZZY {
                let (nearest, weights) = fuzzy(&points, &found, m, 0.9);
                let what = format!("{name}, k = {clusters}, m = {m}");
                let each = || nearest.chunks(m as usize).zip(weights.chunks(m as usize));
                let sum = |weights: &[f32]| weights.iter().map(|w| f64::from(*w)).sum::<f64>();
                // Four weights rounded to f32.
                let off = largest(each().map(|(_, w)| (sum(w) - 1.0).abs()));
                figures.push(at_most(format!("{what}: sum of weights"), off, 2e-7));
                let wrong = each().filter(|(_, w)| !w.iter().all(|w| (0.0..=1.0).contains(w)));
                figures.push(none(format!("{what}: weights beyond 0 and 1"), wrong.count()));
                let on = |(point, (nearest, weights)): &(usize, (&[u32], &[f32]))| {
                    let mean =
                        |c: &&u32| found.clusters[**c as usize].position == positions[*point];
                    nearest.iter().any(|c| mean(&c)) && !weights.contains(&1.0)
                };
                let shared = each().enumerate().filter(on).count();
                figures.push(none(format!("{what}: points on a mean that share"), shared));
            }
        }
    }
    Ok(figures)
}

/// As many clusters as points and VPLs: every method is `vpl` by another way. Rows and columns are
/// in the order of a Morton curve, so that no index is that of its point or VPL.
pub fn of_one(gpu: &Gpu, scale: Scale) -> Result<Vec<Figure>, Error> {
    let (size, light_paths) =
        if scale == Scale::Full { ([128, 96], 5000) } else { ([40, 24], 700) };
    let mut figures = Vec::new();
    for (kernel, gpu) in devices(gpu) {
        let settings = |method, fuzzy, merge| Settings {
            light_paths,
            samples: 2,
            interleave: 1,
            candidates: 1,
            clustering: Clustering {
                points: u32::MAX,
                vpls: u32::MAX,
                fuzzy,
                merge,
                ..Clustering::default()
            },
            ..Settings::of(method)
        };
        let all = settings(Method::Vpl, 1, Merge::Light);
        let prepared = Prepared::new(gpu, room(1.0, size)?.scene()?, &all)?;
        let reference = frame_of(&prepared, &all)?;
        for method in GATHERING {
            for merge in [Merge::Light, Merge::Visibility] {
                for fuzzy in [1, 4] {
                    let frame = frame_of(&prepared, &settings(method, fuzzy, merge))?;
                    let what = format!(
                        "{} VPLs, {kernel} kernels, {merge:?}, fuzzy {fuzzy}: image of vpl",
                        frame.counts.vpls
                    );
                    // Sums of the same terms: in another order where lights merge.
                    let off = difference(&frame, &reference);
                    figures.push(of(method, at_most(what, off, 1e-5)));
                }
            }
        }
    }
    Ok(figures)
}
