//! The thesis's experiments, and its seconds.

mod names;

use super::claims;
use super::results::{Published, Row};
use super::verdict::Claim;
use super::{Experiment, Plan, ReferencePlan, Run};
use crate::render::{Bounces, Clustering, Merge, Method, Representative, Settings};
pub use names::{
    CLUSTERS, ITERATIONS, LINEAR, PATH, STRIDE, TABLE_BOTH, TABLE_VPC, TABLE_VPL, TABLE_VPLC,
};

/// The preset's name.
pub const NAME: &str = "thesis";

/// The scene that all of it is measured on.
const SCENE: &str = "builtin:cornell-point";

/// Width and height of the thesis's pictures.
const SIZE: [u32; 2] = [512, 512];

/// tT of the unclustered frame of 2000 paths and 2 bounces, which is the thesis's reference.
const REFERENCE_SECONDS: f64 = 183.1;

/// The thesis's study.
pub fn plan() -> Plan {
    Plan {
        name: NAME.to_owned(),
        scenes: vec![SCENE.to_owned()],
        size: Some(SIZE),
        seeds: vec![0],
        frames: 2,
        reference: ReferencePlan::Path { samples: 256 },
        clustering_seeds: usize::MAX,
        mask_above: None,
        decompose: None,
        experiments: experiments(),
    }
}

/// The tables first, then what the claims need beside them.
fn experiments() -> Vec<Experiment> {
    vec![vpl(), vplc(), vpc(), both(), linear(), iterations(), stride(), clusters(), path()]
}

/// What the rows say of the thesis's claims.
pub fn claims(rows: &[Row]) -> Vec<Claim> {
    claims::judge(rows)
}

fn vpl() -> Experiment {
    let seconds = |total| Published { preprocess: None, render: None, total, speedup: None };
    let run = |paths, bounces, thesis| Run {
        setting: format!("{paths} × {bounces}"),
        settings: unclustered(paths, bounces),
        thesis: Some(thesis),
    };
    Experiment {
        name: TABLE_VPL.to_owned(),
        title: "`vpl`: light paths × bounces".to_owned(),
        runs: vec![
            run(500, 2, seconds(45.7)),
            run(1000, 1, seconds(44.74)),
            run(1000, 2, seconds(90.61)),
            run(2000, 2, Published { preprocess: Some(0.008), ..seconds(REFERENCE_SECONDS) }),
        ],
    }
}

fn vplc() -> Experiment {
    let run = |(vpls, preprocess, render, total)| Run {
        setting: format!("K_v = {vpls}"),
        settings: vpl_clusters(vpls, Representative::Mean),
        thesis: Some(published(preprocess, render, total)),
    };
    Experiment {
        name: TABLE_VPLC.to_owned(),
        title: "`vplc`: 2000 × 2, VPL clusters, 2 iterations".to_owned(),
        runs: [
            (2000, 0.049, 91.649, 91.698),
            (1300, 0.042, 64.931, 64.973),
            (800, 0.024, 38.739, 38.763),
            (400, 0.017, 18.688, 18.705),
            (200, 0.012, 9.018, 9.03),
            (100, 0.008, 4.521, 4.529),
        ]
        .map(run)
        .into(),
    }
}

fn vpc() -> Experiment {
    let run = |(points, preprocess, render, total)| Run {
        setting: format!("C = {points}"),
        settings: point_clusters(Clustering { points, ..published_options() }),
        thesis: Some(published(preprocess, render, total)),
    };
    Experiment {
        name: TABLE_VPC.to_owned(),
        title: "`vpc`: 2000 × 2, point clusters, 4 iterations".to_owned(),
        runs: [
            (100, 1.937, 49.481, 51.418),
            (500, 9.559, 51.748, 61.307),
            (1250, 23.572, 49.542, 73.114),
            (2600, 49.992, 51.701, 101.693),
            (4000, 76.966, 53.661, 130.627),
            (8000, 157.899, 53.913, 211.812),
        ]
        .map(run)
        .into(),
    }
}

fn both() -> Experiment {
    let clustering = Clustering { points: 2600, vpls: 400, ..published_options() };
    Experiment {
        name: TABLE_BOTH.to_owned(),
        title: "`both`: 2000 × 2, clusters of both".to_owned(),
        runs: vec![Run {
            setting: "C = 2600, K_v = 400".to_owned(),
            settings: Settings { method: Method::Both, clustering, ..unclustered(2000, 2) },
            thesis: Some(published(48.934, 4.915, 53.849)),
        }],
    }
}

fn linear() -> Experiment {
    let run = |paths| Run {
        setting: format!("{paths} × 2"),
        settings: unclustered(paths, 2),
        thesis: None,
    };
    Experiment {
        name: LINEAR.to_owned(),
        title: "`vpl`: time over the number of VPLs".to_owned(),
        runs: [250, 500, 1000, 2000].map(run).into(),
    }
}

fn iterations() -> Experiment {
    let run = |point_iterations| Run {
        setting: format!("iterations = {point_iterations}"),
        settings: point_clusters(Clustering { point_iterations, ..published_options() }),
        thesis: None,
    };
    Experiment {
        name: ITERATIONS.to_owned(),
        title: "`vpc`, C = 2600: iterations of K-means".to_owned(),
        runs: (1..=10).map(run).collect(),
    }
}

fn stride() -> Experiment {
    let run = |stride| Run {
        setting: format!("stride = {stride}"),
        settings: point_clusters(Clustering { stride, ..published_options() }),
        thesis: None,
    };
    Experiment {
        name: STRIDE.to_owned(),
        title: "`vpc`, C = 2600: all iterations but the last see one point in a stride".to_owned(),
        runs: [1, 2, 4, 8].map(run).into(),
    }
}

fn clusters() -> Experiment {
    let run = |(name, representative)| Run {
        setting: format!("K_v = 2000, {name}"),
        settings: vpl_clusters(2000, representative),
        thesis: None,
    };
    Experiment {
        name: CLUSTERS.to_owned(),
        title: "`vplc`, K_v = 2000: what stands for a cluster".to_owned(),
        runs: [("mean", Representative::Mean), ("member", Representative::Member)].map(run).into(),
    }
}

fn path() -> Experiment {
    let run = |samples| Run {
        setting: format!("{samples} samples"),
        settings: Settings { bounces: Bounces::Finite(2), samples, ..Settings::of(Method::Path) },
        thesis: None,
    };
    Experiment {
        name: PATH.to_owned(),
        title: "`path`: a path tracer of 2 bounces".to_owned(),
        runs: [1, 4, 16, 64].map(run).into(),
    }
}

/// The thesis's options: hard clusters, the mean stands for a cluster of VPLs, light is merged.
fn published_options() -> Clustering {
    Clustering {
        points: 2600,
        vpls: 400,
        point_iterations: 4,
        vpl_iterations: 2,
        normal_threshold: 0.9,
        stride: 1,
        fuzzy: 1,
        probes: 0,
        representative: Representative::Mean,
        merge: Merge::Light,
    }
}

fn unclustered(light_paths: u32, bounces: u32) -> Settings {
    Settings {
        light_paths,
        bounces: Bounces::Finite(bounces),
        // The thesis has one sample a pixel.
        edge_samples: 1,
        interleave: 1,
        candidates: 1,
        ..Settings::of(Method::Vpl)
    }
}

fn vpl_clusters(vpls: u32, representative: Representative) -> Settings {
    let clustering = Clustering { vpls, representative, ..published_options() };
    Settings { method: Method::Vplc, clustering, ..unclustered(2000, 2) }
}

fn point_clusters(clustering: Clustering) -> Settings {
    Settings { method: Method::Vpc, clustering, ..unclustered(2000, 2) }
}

fn published(preprocess: f64, render: f64, total: f64) -> Published {
    Published {
        preprocess: Some(preprocess),
        render: Some(render),
        total,
        speedup: Some(REFERENCE_SECONDS / total),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_published_second_is_there_and_adds_up() {
        let runs: Vec<_> = experiments().into_iter().flat_map(|e| e.runs).collect();
        let published: Vec<_> = runs.iter().filter_map(|run| run.thesis).collect();
        assert_eq!(published.len(), 4 + 6 + 6 + 1);
        for Published { preprocess, render, total, .. } in published {
            if let (Some(preprocess), Some(render)) = (preprocess, render) {
                assert!((preprocess + render - total).abs() < 1e-9, "{total}");
            }
        }
    }
}
