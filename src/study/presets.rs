//! The studies that have a name, and the one of a scene that nothing more is said of.

use super::{Experiment, Plan, ReferencePlan, Run, options};
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
    let paths = |method, counts: &[u32]| {
        let settings = |&light_paths: &u32| Settings { light_paths, ..Settings::of(method) };
        counts.iter().map(settings).collect()
    };
    let samples = |samples| Settings { samples, ..Settings::of(Method::Path) };
    vec![
        curve("both", "clusters of visible points and of VPLs", paths(Method::Both, &BOTH)),
        curve("vpc", "clusters of visible points", paths(Method::Vpc, &ONE)),
        curve("vplc", "clusters of VPLs", paths(Method::Vplc, &ONE)),
        curve("vpl", "every point from every VPL", paths(Method::Vpl, &ONE)),
        curve("path", "path tracing", [4, 16, 64, 256].map(samples).into()),
    ]
}

/// Light paths where clusters make them cheap, and where they do not.
const BOTH: [u32; 4] = [500, 2000, 8000, 32000];
const ONE: [u32; 3] = [250, 500, 1000];

fn curve(name: &str, title: &str, settings: Vec<Settings>) -> Experiment {
    let run = |settings| Run { setting: label(&settings), settings, thesis: None };
    Experiment {
        name: name.to_owned(),
        title: format!("`{name}`: {title}"),
        runs: settings.into_iter().map(run).collect(),
    }
}

/// The options beside the method that are no defaults.
fn label(settings: &Settings) -> String {
    let changed = options::changed(settings);
    let label = changed.split_once(" --").map(|(_, rest)| format!("--{rest}"));
    label.unwrap_or_else(|| "defaults".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_what_differs_from_the_defaults() {
        let plan = quick(Vec::new());
        let labels = |index: usize| -> Vec<_> {
            plan.experiments[index].runs.iter().map(|run| run.setting.as_str()).collect()
        };
        assert_eq!(labels(0), ["--vpls 500", "--vpls 2000", "defaults", "--vpls 32000"]);
        assert_eq!(labels(3), ["--vpls 250", "--vpls 500", "--vpls 1000"]);
    }
}
