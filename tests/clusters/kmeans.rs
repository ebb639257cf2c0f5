//! K-means of points with normals: exact, complete and the same for any number of threads.

use std::time::Instant;

use glam::Vec3;
use gpu_vpl::cluster::{Clusters, Grid, Options, Points, fuzzy, kmeans};
use rayon::ThreadPoolBuilder;

use crate::common::Rng;
use crate::common::points::{Set, box_of_walls, cloud, everything, outlier, sheets, sphere};

const OPTIONS: Options =
    Options { clusters: 50, iterations: 4, normal_threshold: 0.9, stride: 1, seed: 1 };

fn nearest(
    centroids: &[(Vec3, Vec3)],
    position: Vec3,
    normal: Vec3,
    threshold: f32,
) -> Option<(u32, f32)> {
    let mut best = None;
    for (index, centroid) in centroids.iter().enumerate() {
        let distance = centroid.0.distance_squared(position);
        if normal.dot(centroid.1) > threshold && best.is_none_or(|(_, least)| distance < least) {
            best = Some((index as u32, distance));
        }
    }
    best
}

fn centroids(clustering: &Clusters) -> Vec<(Vec3, Vec3)> {
    clustering.clusters.iter().map(|cluster| (cluster.position, cluster.normal)).collect()
}

fn inertia(set: &Set, clustering: &Clusters) -> f64 {
    let distance = |(position, &cluster): (&Vec3, &u32)| {
        let mean = clustering.clusters[cluster as usize].position.as_dvec3();
        position.as_dvec3().distance_squared(mean)
    };
    set.positions.iter().zip(&clustering.assignment).map(distance).sum()
}

/// What holds of every clustering: no cluster is empty, all are of their members, the
/// representative is the member nearest to the mean, and everything is finite.
fn check(set: &Set, clustering: &Clusters) {
    let count = set.positions.len();
    assert_eq!(clustering.assignment.len(), count);
    let mut members = vec![Vec::new(); clustering.clusters.len()];
    for (point, &cluster) in clustering.assignment.iter().enumerate() {
        members[cluster as usize].push(point);
    }
    let largest = set.positions.iter().map(|p| f64::from(p.abs().max_element()));
    let scale = largest.fold(f64::MIN_POSITIVE, f64::max);
    for (cluster, members) in clustering.clusters.iter().zip(&members) {
        assert_eq!(cluster.members as usize, members.len());
        assert!(cluster.members > 0 && cluster.position.is_finite());
        assert!((cluster.normal.length() - 1.0).abs() < 1e-5, "{cluster:?}");
        assert!(members.contains(&(cluster.representative as usize)));
        let share = 1.0 / members.len() as f64;
        let mean = members.iter().map(|&p| set.positions[p].as_dvec3() * share);
        let mean: glam::DVec3 = mean.sum();
        assert!(mean.distance(cluster.position.as_dvec3()) < 1e-6 * scale);
        let normal: glam::DVec3 = members.iter().map(|&p| set.normals[p].as_dvec3() * share).sum();
        match normal.length() > 1e-5 {
            true => assert!(normal.normalize().distance(cluster.normal.as_dvec3()) < 1e-4),
            false => assert_eq!(cluster.normal, set.normals[cluster.representative as usize]),
        }
        let mean = cluster.position.as_dvec3();
        let distance = |p: usize| set.positions[p].as_dvec3().distance(mean);
        let least = members.iter().map(|&p| distance(p)).fold(f64::INFINITY, f64::min);
        assert!(distance(cluster.representative as usize) <= least + 1e-7 * scale);
    }
}

#[test]
fn the_grid_finds_what_brute_force_finds() {
    let mut random = Rng(7);
    for (name, set) in everything() {
        for count in [1, 2, 7, 100, 700] {
            let pick = |_| random.below(set.positions.len());
            let picks: Vec<usize> = (0..count).map(pick).collect();
            let mut centroids: Vec<_> =
                picks.iter().map(|&p| (set.positions[p], set.normals[p])).collect();
            // Means are off the surface.
            for pair in centroids.chunks_exact_mut(3) {
                pair[0].0 = (pair[0].0 + pair[1].0) / 2.0;
            }
            let grid = Grid::new(centroids.iter().copied());
            for threshold in [-2.0, -0.5, 0.0, 0.9, 0.999] {
                for (&position, &normal) in set.positions.iter().zip(&set.normals).step_by(7) {
                    let guesses = [random.below(count) as u32, u32::MAX];
                    let found = grid.nearest(position, normal, threshold, guesses);
                    let expected = nearest(&centroids, position, normal, threshold);
                    assert_eq!(found, expected, "{name}, {count}, {threshold}");
                }
            }
        }
    }
}

/// Without founding or empty clusters, an iteration starts from the clusters of the last.
#[test]
fn an_iteration_assigns_as_brute_force_does() {
    for (set, threshold) in [(box_of_walls(4000), 0.5), (sheets(4000), 0.0), (sphere(4000), 0.7)] {
        for iterations in 1..4 {
            let options = Options { iterations, normal_threshold: threshold, ..OPTIONS };
            let before = kmeans(&set.points(), &options);
            let after = kmeans(&set.points(), &Options { iterations: iterations + 1, ..options });
            assert_eq!(before.clusters.len(), after.clusters.len());
            assert_eq!(after.iterations, iterations + 1);
            let centroids = centroids(&before);
            for (point, &cluster) in after.assignment.iter().enumerate() {
                let (position, normal) = (set.positions[point], set.normals[point]);
                let (expected, _) = nearest(&centroids, position, normal, threshold).unwrap();
                assert_eq!(cluster, expected);
            }
        }
    }
}

#[test]
fn every_set_is_clustered_whatever_the_options() {
    for (name, set) in everything() {
        for (clusters, iterations) in [(1, 1), (1, 5), (3, 4), (50, 4), (400, 3), (5, 0)] {
            for normal_threshold in [-2.0, 0.0, 0.9, 0.999] {
                for stride in [1, 2, 4, 7] {
                    let options =
                        Options { clusters, iterations, normal_threshold, stride, seed: 3 };
                    let clustering = kmeans(&set.points(), &options);
                    check(&set, &clustering);
                    assert!(clustering.iterations <= iterations.max(1), "{name}");
                    if normal_threshold < -1.0 {
                        assert!(clustering.clusters.len() <= clusters as usize);
                    }
                }
            }
        }
    }
}

#[test]
fn points_that_none_accepts_found_clusters_that_accept_others() {
    // A start on one wall only: the other five found clusters, one each.
    let set = box_of_walls(4096);
    let one = Options { clusters: 1, iterations: 1, normal_threshold: 0.9, ..OPTIONS };
    let clustering = kmeans(&set.points(), &one);
    assert_eq!(clustering.clusters.len(), 6);
    check(&set, &clustering);
    for (normal, &cluster) in set.normals.iter().zip(&clustering.assignment) {
        assert!(normal.dot(clustering.clusters[cluster as usize].normal) > 0.999);
    }
    // Where the gate lets nothing through, every point is left alone.
    let closed = Options { normal_threshold: 1.0, ..one };
    assert_eq!(kmeans(&set.points(), &closed).clusters.len(), 4096);
}

#[test]
fn any_number_of_threads_gives_the_same() {
    for (name, set) in [("box", box_of_walls(30_000)), ("sphere", sphere(30_000))] {
        for stride in [1, 4] {
            let options = Options { clusters: 300, stride, ..OPTIONS };
            let run = |threads| {
                let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                pool.install(|| {
                    let clustering = kmeans(&set.points(), &options);
                    let fuzzy = fuzzy(&set.points(), &clustering, 4, 0.9);
                    (clustering, fuzzy)
                })
            };
            let one = run(1);
            for threads in [2, 3, 8] {
                assert!(run(threads) == one, "{name}, {threads} threads");
            }
        }
    }
}

#[test]
fn enough_clusters_leave_every_distinct_point_alone() {
    let set = box_of_walls(1000);
    for clusters in [1000, 1001, u32::MAX] {
        let clustering = kmeans(&set.points(), &Options { clusters, ..OPTIONS });
        assert_eq!(clustering.assignment, (0..1000).collect::<Vec<_>>());
        for (index, cluster) in clustering.clusters.iter().enumerate() {
            assert_eq!(cluster.position, set.positions[index]);
            assert_eq!(cluster.normal, set.normals[index]);
            assert_eq!((cluster.representative, cluster.members), (index as u32, 1));
        }
    }
    // Twice each, and 0 of either sign.
    let mut twice = Set { positions: set.positions.repeat(2), normals: set.normals.repeat(2) };
    twice.positions[0] = Vec3::ZERO;
    twice.positions[1000] = -Vec3::ZERO;
    let clustering = kmeans(&twice.points(), &Options { clusters: 1000, ..OPTIONS });
    assert_eq!(clustering.clusters.len(), 1000);
    assert_eq!(clustering.assignment, (0..1000).chain(0..1000).collect::<Vec<_>>());
    check(&twice, &clustering);
}

#[test]
fn no_points_give_no_clusters() {
    let none = Points { positions: &[], normals: &[] };
    let clustering = kmeans(&none, &OPTIONS);
    assert_eq!(clustering, Clusters::default());
    assert_eq!(fuzzy(&none, &clustering, 4, 0.5), (vec![], vec![]));
}

#[test]
fn iterations_never_raise_the_error() {
    for (name, set) in everything() {
        let mut last = f64::INFINITY;
        for iterations in 1..12 {
            let options = Options { iterations, normal_threshold: -2.0, ..OPTIONS };
            let now = inertia(&set, &kmeans(&set.points(), &options));
            // That an empty cluster goes to the farthest point only lowers it.
            assert!(now <= last * (1.0 + 1e-6), "{name}: {last} → {now} in {iterations}");
            last = now;
        }
    }
}

#[test]
fn iterations_stop_when_nothing_moves() {
    let set = box_of_walls(500);
    for stride in [1, 2] {
        let options = Options { clusters: 5, iterations: 1000, stride, ..OPTIONS };
        let clustering = kmeans(&set.points(), &options);
        assert!(clustering.iterations < 100);
        if stride == 1 {
            let more = Options { iterations: clustering.iterations + 1, ..options };
            assert_eq!(kmeans(&set.points(), &more), clustering);
        }
    }
}

#[test]
fn empty_clusters_are_reseeded() {
    // Of 1000 points 950 are one: so are most of 20 starts, but not the clusters.
    let mut set = sphere(1000);
    for point in 0..950 {
        set.positions[point] = Vec3::ZERO;
    }
    let options = Options { clusters: 20, normal_threshold: -2.0, ..OPTIONS };
    assert!(kmeans(&set.points(), &Options { iterations: 1, ..options }).clusters.len() < 5);
    assert_eq!(kmeans(&set.points(), &options).clusters.len(), 20);
}

#[test]
fn fuzzy_weights_are_those_of_the_nearest() {
    for (name, set) in everything() {
        for threshold in [-2.0, 0.5, 0.95] {
            let options = Options { normal_threshold: threshold, ..OPTIONS };
            let clustering = kmeans(&set.points(), &options);
            for m in [1, 2, 4, 7] {
                let (clusters, weights) = fuzzy(&set.points(), &clustering, m as u32, threshold);
                assert_eq!(
                    (clusters.len(), weights.len()),
                    (set.positions.len() * m, clusters.len())
                );
                for point in (0..set.positions.len()).step_by(5) {
                    let range = point * m..(point + 1) * m;
                    let found = (&clusters[range.clone()], &weights[range]);
                    check_fuzzy(&set, &clustering, point, threshold, found, name);
                }
            }
        }
    }
}

fn check_fuzzy(
    set: &Set,
    clustering: &Clusters,
    point: usize,
    threshold: f32,
    (clusters, weights): (&[u32], &[f32]),
    name: &str,
) {
    let (position, normal) = (set.positions[point], set.normals[point]);
    let own = clustering.assignment[point];
    let sum: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
    assert!((sum - 1.0).abs() < 1e-6 && weights.iter().all(|&weight| weight >= 0.0), "{name}");
    assert!(clusters.contains(&own));

    // In units of the farthest coordinate, as squares of huge ones are infinite.
    let scale = set.positions.iter().map(|p| f64::from(p.abs().max_element()));
    let scale = scale.fold(f64::MIN_POSITIVE, f64::max);
    let distance = |cluster: u32| {
        let mean = clustering.clusters[cluster as usize].position.as_dvec3() / scale;
        (position.as_dvec3() / scale).distance_squared(mean)
    };
    let accepts = |&c: &u32| normal.dot(clustering.clusters[c as usize].normal) > threshold;
    let mut near: Vec<u32> = (0..clustering.clusters.len() as u32).filter(accepts).collect();
    near.sort_by(|&a, &b| distance(a).total_cmp(&distance(b)));
    near.truncate(clusters.len());
    if !near.contains(&own) {
        near.truncate(clusters.len() - 1);
        near.push(own);
    }
    if weights[0] == 1.0 && near.iter().any(|&cluster| distance(cluster) < 1e-10) {
        return;
    }
    let shares: Vec<f64> = near.iter().map(|&cluster| 1.0 / distance(cluster)).collect();
    let sum: f64 = shares.iter().sum();
    let mut expected: Vec<f64> = shares.iter().map(|share| share / sum).collect();
    expected.sort_by(|a, b| b.total_cmp(a));
    for (&weight, expected) in weights.iter().zip(expected) {
        assert!((f64::from(weight) - expected).abs() < 2e-3, "{name}: {weight}, not {expected}");
    }
}

#[test]
fn a_point_on_a_mean_belongs_to_it_alone() {
    let set = box_of_walls(200);
    let clustering = kmeans(&set.points(), &Options { clusters: 200, ..OPTIONS });
    let (clusters, weights) = fuzzy(&set.points(), &clustering, 3, -2.0);
    for point in 0..200 {
        assert_eq!(clusters[3 * point], point as u32);
        assert_eq!(weights[3 * point..3 * point + 3], [1.0, 0.0, 0.0]);
    }
}

/// Prints times with `--nocapture`; they are not asserted.
#[test]
fn timing_of_a_large_set() {
    for (name, set) in [
        ("box", box_of_walls(512 * 512)),
        ("sphere", sphere(512 * 512)),
        ("outlier", outlier(512 * 512)),
        ("cloud", cloud(512 * 512)),
    ] {
        for (clusters, stride) in [(2600, 1), (8000, 1), (2600, 4), (8000, 4)] {
            let options = Options { clusters, stride, normal_threshold: 0.9, ..OPTIONS };
            let start = Instant::now();
            let clustering = kmeans(&set.points(), &options);
            let time = start.elapsed();
            let start = Instant::now();
            let members = fuzzy(&set.points(), &clustering, 4, 0.9);
            let fuzzy_time = start.elapsed();
            check(&set, &clustering);
            assert_eq!(members.0.len(), 4 * set.positions.len());
            eprintln!(
                "{name}, C = {clusters}, stride {stride}: {time:.0?}, fuzzy {fuzzy_time:.0?}, \
                 {} clusters, error {:.3e}",
                clustering.clusters.len(),
                (inertia(&set, &clustering) / set.positions.len() as f64).sqrt(),
            );
        }
    }
}
