//! The clustered methods: against `vpl`, against each other, and what they must keep.

#![expect(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use crate::common::{Rng, difference, frame, gpu, room};
use glam::{DVec3, Vec3};
use gpu_vpl::gpu::Gpu;
use gpu_vpl::image::Image;
use gpu_vpl::render::{
    Bounces, Clustering, Direct, GlossyLobe, Merge, Method, Prepared, Representative, Settings,
    VirtualLight, VplClusters,
};

const CLUSTERED: [Method; 3] = [Method::Vplc, Method::Vpc, Method::Both];

fn prepared(gpu: Gpu) -> Prepared {
    let settings = Settings::default();
    Prepared::new(gpu, room(1.0, DVec3::ZERO, [40, 24]).scene(), &settings).unwrap()
}

fn settings(method: Method, clustering: Clustering) -> Settings {
    Settings {
        light_paths: 700,
        samples: 2,
        clustering,
        interleave: 1,
        candidates: 1,
        ..Settings::of(method)
    }
}

fn all_clusterings(points: u32, vpls: u32) -> Vec<Clustering> {
    let mut all = Vec::new();
    for merge in [Merge::Light, Merge::Visibility] {
        for fuzzy in [1, 3] {
            all.push(Clustering { points, vpls, merge, fuzzy, ..Clustering::default() });
        }
    }
    all
}

/// As many clusters as there are points and VPLs: every method is `vpl` by another way. Rows
/// and columns are in the order of a Morton curve, so no index is that of its point or VPL.
#[test]
fn clusters_of_one_give_the_image_of_all_vpls() {
    for gpu in [gpu().clone(), gpu().clone().without_subgroups()] {
        let prepared = prepared(gpu);
        let all = frame(&prepared, &settings(Method::Vpl, Clustering::default()));
        assert!(all.counts.vpls > 1024, "one chunk of the bit matrix is not enough to test");
        for method in CLUSTERED {
            for clustering in all_clusterings(1 << 20, 1 << 20) {
                let image = frame(&prepared, &settings(method, clustering)).image;
                let off = difference(&image.pixels, &all.image.pixels);
                assert!(off < 1e-5, "{method:?} {clustering:?}: off by {off:e}");
            }
        }
    }
}

/// Packets, and each ray by itself, trace the same rays to the members that rows draw.
#[test]
fn rows_draw_the_same_members_whatever_traces_rays() {
    let clustering = Clustering { points: 60, vpls: 40, ..Clustering::default() };
    let settings = settings(Method::Both, clustering);
    let [packets, single] = [gpu().clone(), gpu().clone().without_subgroups()]
        .map(|gpu| frame(&prepared(gpu), &settings));
    assert!(packets.counts.vpl_clusters.unwrap() * 8 < packets.counts.vpls, "nothing is drawn");
    assert_eq!(packets.counts.shadow_rays, single.counts.shadow_rays);
    let off = difference(&packets.image.pixels, &single.image.pixels);
    assert!(off < 1e-5, "off by {off:e}");
}

/// Fewer clusters trace fewer rays, and are near the image of all VPLs.
#[test]
fn few_clusters_are_near_the_image_of_all_vpls() {
    let prepared = prepared(gpu().clone());
    let all = frame(&prepared, &settings(Method::Vpl, Clustering::default()));
    let mean = |image: &Image| image.pixels.iter().flatten().map(|&c| f64::from(c)).sum::<f64>();
    for method in CLUSTERED {
        for clustering in all_clusterings(200, 200) {
            let some = frame(&prepared, &settings(method, clustering));
            let counts = some.counts;
            assert!(counts.shadow_rays < all.counts.shadow_rays / 3, "{method:?}");
            assert_eq!(counts.point_clusters.is_some(), method.clusters_points());
            assert_eq!(counts.vpl_clusters.is_some(), method.clusters_vpls());
            let off = mean(&some.image) / mean(&all.image) - 1.0;
            assert!(off.abs() < 0.03, "{method:?} {clustering:?}: mean off by {off:.4}");
            let same = difference(&some.image.pixels, &all.image.pixels) == 0.0;
            assert!(!same, "{method:?} {clustering:?} has not clustered anything");
        }
    }
}

#[test]
fn images_do_not_depend_on_the_number_of_threads() {
    for method in CLUSTERED {
        for clustering in all_clusterings(100, 50) {
            let images = [1, 2, 3].map(|threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let direct = match method.clusters_points() {
                    true => Direct::Clustered,
                    false => Direct::PerPixel,
                };
                let settings = Settings { interleave: 2, direct, ..settings(method, clustering) };
                pool.install(|| frame(&prepared(gpu().clone()), &settings).image.pixels)
            });
            assert!(images[0] == images[1] && images[1] == images[2], "{method:?} {clustering:?}");
        }
    }
}

/// As many clusters as points: shared visibility is that of each point by itself. Places on the
/// area light are the same for all points here, and each point's own there.
#[test]
fn direct_light_of_clusters_of_one_is_that_of_each_pixel() {
    let clustering = Clustering { points: 1 << 20, ..Clustering::default() };
    let settings = |direct, light_samples| Settings {
        bounces: Bounces::Finite(0),
        direct,
        light_samples: Some(light_samples),
        ..settings(Method::Vpc, clustering)
    };
    for gpu in [gpu().clone(), gpu().clone().without_subgroups()] {
        let prepared = prepared(gpu);
        let pixels = frame(&prepared, &settings(Direct::PerPixel, 512)).image;
        let shared = frame(&prepared, &settings(Direct::Clustered, 2048)).image;
        let (off, spread) = deviation(&shared, &pixels);
        assert!(off.abs() < 0.002 && spread < 0.02, "off by {off}, {spread}");
        let few = Clustering { points: 60, fuzzy: 3, ..Clustering::default() };
        let few = Settings { clustering: few, ..settings(Direct::Clustered, 64) };
        let (off, spread) = deviation(&frame(&prepared, &few).image, &pixels);
        assert!(off.abs() < 0.05 && spread > 0.01, "off by {off}, {spread}");
    }
}

/// Every pixel gathers a subset, and what its neighbours gathered makes up for the rest: every
/// method is near itself without interleaving, and nearer than a pixel by itself would be.
#[test]
fn interleaved_pixels_are_near_those_that_gather_all() {
    let prepared = prepared(gpu().clone());
    for method in [Method::Vpl, Method::Vplc, Method::Vpc, Method::Both] {
        for clustering in all_clusterings(100, 400) {
            let all = settings(method, clustering);
            let all_terms = frame(&prepared, &all).counts.shading_terms;
            let reference = frame(&prepared, &all).image;
            for interleave in [2, 3, 8] {
                let some = frame(&prepared, &Settings { interleave, ..all });
                let terms = some.counts.shading_terms * u64::from(interleave.pow(2));
                assert!(terms.abs_diff(all_terms) <= 100, "{method:?}: {terms}");
                let (off, spread) = deviation(&some.image, &reference);
                let name = format!("{method:?} {interleave} {clustering:?}: {off} {spread}");
                // Some surfaces are less than 8 pixels wide, and see few of the 64 subsets.
                let (most_off, most_spread) =
                    if interleave == 8 { (0.1, 0.2) } else { (0.02, 0.08) };
                assert!(off.abs() < most_off && spread < most_spread, "{name}");
            }
        }
    }
}

/// Relative: the mean of the difference, and its root mean square.
fn deviation(image: &Image, reference: &Image) -> (f64, f64) {
    let pairs = || {
        let values = |image: &'_ Image| image.pixels.clone().into_iter().flatten();
        values(image).zip(values(reference)).map(|(a, b)| (f64::from(a), f64::from(b)))
    };
    let count = pairs().count() as f64;
    let mean = pairs().map(|(_, b)| b).sum::<f64>() / count;
    let off = pairs().map(|(a, b)| a - b).sum::<f64>() / count;
    let square = pairs().map(|(a, b)| (a - b).powi(2)).sum::<f64>() / count;
    (off / mean, square.sqrt() / mean)
}

/// Points that see otherwise than their cluster get clusters of their own.
#[test]
fn probes_bring_clusters_nearer_to_all_vpls() {
    let prepared = prepared(gpu().clone());
    let all = frame(&prepared, &settings(Method::Vpl, Clustering::default())).image;
    for fuzzy in [1, 4] {
        let spread = |probes| {
            let clustering = Clustering { points: 60, fuzzy, probes, ..Clustering::default() };
            let image = frame(&prepared, &settings(Method::Vpc, clustering)).image;
            deviation(&image, &all).1
        };
        let (without, with) = (spread(0), spread(8));
        assert!(with < 0.9 * without, "fuzzy {fuzzy}: {with} against {without}");
    }
}

/// Lights of different colours merge to the sum of their light, channel by channel.
#[test]
fn merged_lights_keep_colour_and_energy() {
    let mut random = Rng(3);
    let lights: Vec<VirtualLight> = (0..2000)
        .map(|_| {
            let normal = [Vec3::X, Vec3::Y, Vec3::NEG_Z][random.below(3)];
            let intensity = Vec3::new(random.unit(), random.unit() * 0.1, random.unit() * 7.0);
            VirtualLight::diffuse(random.cube(), normal, intensity)
        })
        .collect();
    let sum = |lights: &[VirtualLight]| {
        lights.iter().map(|light| light.intensity.as_dvec3()).sum::<DVec3>()
    };
    for representative in [Representative::Mean, Representative::Member] {
        let clustering = Clustering { vpls: 60, representative, ..Clustering::default() };
        let clusters = VplClusters::of(&lights, &clustering, 1);
        assert!(clusters.lights.len() < 100);
        let off = (sum(&clusters.lights) / sum(&lights) - DVec3::ONE).abs().max_element();
        assert!(off < 1e-6, "{representative:?}: off by {off:e}");
        for (index, merged) in clusters.lights.iter().enumerate() {
            let members = || {
                let of = clusters.of_lights.iter().zip(&lights);
                of.filter(|(cluster, _)| **cluster as usize == index).map(|(_, light)| light)
            };
            let expected = members().map(|light| light.intensity.as_dvec3()).sum::<DVec3>();
            assert!((merged.intensity.as_dvec3() - expected).length() < 1e-5 * expected.length());
            assert!(members().all(|light| light.normal == members().next().unwrap().normal));
            if representative == Representative::Member {
                assert!(members().any(|light| light.position == merged.position));
            }
        }
    }
}

/// Glossy lights merge with those of their own material alone that mirror light the same way, and
/// keep the light of both parts.
#[test]
fn glossy_lights_merge_with_their_like() {
    let mut random = Rng(4);
    let ways = [Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8), Vec3::Z];
    let lights: Vec<VirtualLight> = (0..1500)
        .map(|_| {
            let specular = Vec3::new(random.unit(), random.unit(), random.unit());
            let mirrored = (ways[random.below(3)] + 0.1 * random.cube()).normalize();
            let material = random.below(3) as u32;
            let gloss =
                GlossyLobe { material, specular, shininess: 10.0 * material as f32, mirrored };
            let diffuse = VirtualLight::diffuse(random.cube(), Vec3::Z, 2.0 * specular);
            // The last material is diffuse.
            VirtualLight { gloss: (material < 2).then_some(gloss), ..diffuse }
        })
        .collect();
    let clustering = Clustering { vpls: 50, merge: Merge::Light, ..Clustering::default() };
    for representative in [Representative::Mean, Representative::Member] {
        let clustering = Clustering { representative, ..clustering };
        let clusters = VplClusters::of(&lights, &clustering, 1);
        assert!((50..300).contains(&clusters.lights.len()), "{}", clusters.lights.len());
        let mut split = 0;
        for (index, merged) in clusters.lights.iter().enumerate() {
            let of = clusters.of_lights.iter().zip(&lights);
            let members: Vec<_> =
                of.filter(|(cluster, _)| **cluster as usize == index).map(|(_, l)| l).collect();
            assert!(!members.is_empty(), "cluster {index} is of nobody");
            let material = |light: &VirtualLight| light.gloss.map(|gloss| gloss.material);
            assert!(members.iter().all(|light| material(light) == material(merged)));
            let Some(gloss) = merged.gloss else { continue };
            split += 1;
            let sum: DVec3 =
                members.iter().filter_map(|l| l.gloss).map(|g| g.specular.as_dvec3()).sum();
            assert!((gloss.specular.as_dvec3() - sum).length() < 1e-5 * sum.length());
            // A founder accepts its members, and stands for them or near them.
            let near = |light: &&VirtualLight| {
                light.gloss.is_some_and(|g| g.mirrored.dot(gloss.mirrored) > 0.8)
            };
            assert!(members.iter().all(near), "{representative:?}: {index}");
            assert!((gloss.mirrored.length() - 1.0).abs() < 1e-5);
        }
        assert!(split > 20);
    }
}
