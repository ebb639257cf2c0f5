//! The studies that have a name, and the one of a scene that nothing more is said of.

use super::{Experiment, Plan, ReferencePlan, Run};
use crate::render::{Method, Settings};

/// The name of the preset that takes a few minutes at most.
pub const QUICK: &str = "quick";

/// Every method that makes light, over the setting that trades its time for its error, in the
/// scene's size.
pub fn of_scenes(scenes: Vec<String>) -> Plan {
    Plan {
        name: "methods".to_owned(),
        scenes,
        size: None,
        seeds: (0..5).collect(),
        frames: 1,
        reference: ReferencePlan::Path { samples: 1024 },
        clustering_seeds: 1,
        mask_above: None,
        decompose: None,
        experiments: methods(),
    }
}

/// The same, small and of few seeds.
pub fn quick(scenes: Vec<String>) -> Plan {
    Plan {
        name: QUICK.to_owned(),
        size: Some([256, 256]),
        seeds: (0..3).collect(),
        ..of_scenes(match scenes.is_empty() {
            true => vec!["builtin:cornell".to_owned()],
            false => scenes,
        })
    }
}

fn methods() -> Vec<Experiment> {
    vec![
        over_paths("both", "clusters of visible points and of VPLs", Method::Both, &CLUSTERED),
        over_paths("vpc", "clusters of visible points", Method::Vpc, &CLUSTERED[..4]),
        over_paths("vplc", "clusters of VPLs", Method::Vplc, &EVERY_POINT),
        over_paths("vpl", "every point from every VPL", Method::Vpl, &EVERY_POINT),
        over_samples("path", "path tracing", &SAMPLES),
    ]
}

/// Light paths where clusters of points make them cheap, and where they do not.
const CLUSTERED: [u32; 5] = [125, 500, 2000, 8000, 32000];
const EVERY_POINT: [u32; 3] = [250, 500, 1000];
/// Samples of the path tracer.
const SAMPLES: [u32; 3] = [4, 16, 64];

fn over_paths(name: &str, what: &str, method: Method, counts: &[u32]) -> Experiment {
    let run = |&light_paths: &u32| Run {
        setting: format!("--vpls {light_paths}"),
        settings: Settings { light_paths, ..Settings::of(method) },
        thesis: None,
    };
    Experiment {
        name: name.to_owned(),
        title: what.to_owned(),
        runs: counts.iter().map(run).collect(),
    }
}

fn over_samples(name: &str, what: &str, counts: &[u32]) -> Experiment {
    let run = |&samples: &u32| Run {
        setting: format!("--samples {samples}"),
        settings: Settings { samples, ..Settings::of(Method::Path) },
        thesis: None,
    };
    Experiment {
        name: name.to_owned(),
        title: what.to_owned(),
        runs: counts.iter().map(run).collect(),
    }
}
