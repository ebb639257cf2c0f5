//! Settings as the options of `render`.

use crate::render::{Bounces, Clamp, Direct, Merge, Method, Representative, Settings};

/// The options that a method looks at, and their values.
fn values(settings: &Settings) -> Vec<(&'static str, String)> {
    let Settings { method, clustering, .. } = settings;
    let (points, vpls) = (method.clusters_points(), method.clusters_vpls());
    let gathers = settings.method.is_indirect();
    let number = |is: bool, value: u32| is.then(|| value.to_string());
    let word = |is: bool, value: &str| is.then(|| value.to_owned());
    let representative = match clustering.representative {
        Representative::Mean => "mean",
        Representative::Member => "member",
        Representative::Drawn => "drawn",
    };
    let merge = match clustering.merge {
        Merge::Light => "light",
        Merge::Visibility => "visibility",
    };
    let edges = method.is_lit() && *method != Method::Path;
    let filter = edges && settings.direct != Direct::Off && !settings.direct_filter;
    let threshold = (points || vpls).then(|| clustering.normal_threshold.to_string());
    [
        ("method", Some(method.name().to_owned())),
        ("vpls", number(method.traces_paths(), settings.light_paths)),
        ("vpl-candidates", number(gathers, settings.candidates)),
        ("bounces", (gathers || *method == Method::Path).then(|| bounces(settings.bounces))),
        ("samples", number(true, settings.samples)),
        ("point-clusters", number(points, clustering.points)),
        ("vpl-clusters", number(vpls, clustering.vpls)),
        ("point-iterations", number(points, clustering.point_iterations)),
        ("vpl-iterations", number(vpls, clustering.vpl_iterations)),
        ("normal-threshold", threshold),
        ("kmeans-stride", number(points, clustering.stride)),
        ("fuzzy", number(points, clustering.fuzzy)),
        ("probes", number(points, clustering.probes)),
        ("representative", word(vpls, representative)),
        ("merge", word(vpls, merge)),
        ("interleave", number(gathers, settings.interleave)),
        ("direct", word(method.is_lit(), direct(settings.direct))),
        ("light-samples", settings.light_samples.and_then(|count| number(method.is_lit(), count))),
        ("direct-filter", filter.then(|| "off".to_owned())),
        ("clamp", gathers.then(|| clamp(settings.clamp))),
        ("correct", number(settings.corrects(), settings.correct)),
        ("compensate", settings.compensates().then(String::new)),
        ("edge-samples", number(edges, settings.edge_samples)),
    ]
    .into_iter()
    .filter_map(|(name, value)| Some((name, value?)))
    .collect()
}

/// A number of bounces, as on the command line.
pub fn bounces(bounces: Bounces) -> String {
    match bounces {
        Bounces::Finite(count) => count.to_string(),
        Bounces::Unlimited => "unlimited".to_owned(),
    }
}

fn direct(direct: Direct) -> &'static str {
    match direct {
        Direct::PerPixel => "per-pixel",
        Direct::Clustered => "clustered",
        Direct::Off => "off",
    }
}

fn clamp(clamp: Clamp) -> String {
    match clamp {
        Clamp::Auto => "auto".to_owned(),
        Clamp::At(bound) => bound.to_string(),
        Clamp::Off => "off".to_owned(),
    }
}

/// Whether they give the same frame: they differ at most in what the method does not look at.
pub fn same(one: &Settings, other: &Settings) -> bool {
    values(one) == values(other)
}

/// All options that the method looks at.
pub fn all(settings: &Settings) -> String {
    joined(&values(settings))
}

/// What tells a frame from others, of a scene with this key.
pub fn of_frame(scene: &str, settings: &Settings, seed: u32) -> String {
    format!("{scene} seed {seed} {}", all(settings))
}

/// The options that trade time for error before all others, and those whose values are not the
/// defaults of the method.
pub fn changed(settings: &Settings) -> String {
    const ALWAYS: [&str; 3] = ["method", "vpls", "samples"];
    let defaults = values(&Settings::of_vpls(settings.method, settings.light_paths));
    let mut changed = values(settings);
    changed.retain(|value| ALWAYS.contains(&value.0) || !defaults.contains(value));
    joined(&changed)
}

fn joined(values: &[(&str, String)]) -> String {
    let option = |(name, value): &(&str, String)| match value.is_empty() {
        true => format!("--{name}"),
        false => format!("--{name} {value}"),
    };
    values.iter().map(option).collect::<Vec<_>>().join(" ")
}

/// The command that renders a frame.
pub fn command(scene: &str, settings: &Settings, [width, height]: [u32; 2], seed: u32) -> String {
    let method = settings.method.name();
    format!(
        "gpu-vpl render {} {} --size {width}x{height} --seed {seed} -o {method}.exr",
        quoted(scene),
        changed(settings)
    )
}

/// A word of a command, in quotes where a shell would take it apart.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./:,=+@%".contains(c);
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::Clustering;

    #[test]
    fn settings_that_a_method_ignores_make_no_new_frame() {
        let clustering = Clustering { points: 7, vpls: 9, ..Clustering::default() };
        let counts = |method| {
            let settings = Settings { clustering, ..Settings::of(method) };
            let changed = changed(&settings);
            (changed.contains("--point-clusters 7"), changed.contains("--vpl-clusters 9"))
        };
        assert_eq!(counts(Method::Vpl), (false, false));
        assert_eq!(counts(Method::Vpc), (true, false));
        assert_eq!(counts(Method::Vplc), (false, true));
        assert_eq!(counts(Method::Both), (true, true));
        let vpl = Settings::of(Method::Vpl);
        assert!(same(&vpl, &Settings { clustering, ..vpl }));
        assert!(!same(&vpl, &Settings { light_paths: 3, ..vpl }));
        let path = Settings::of(Method::Path);
        assert!(same(&path, &Settings { light_paths: 3, clustering, edge_samples: 4, ..path }));
        assert!(!same(&path, &Settings { samples: 3, ..path }));
    }

    #[test]
    fn options_are_those_that_count() {
        let text = |method| all(&Settings::of(method));
        assert!(!text(Method::Vpl).contains("--kmeans-stride"));
        assert!(text(Method::Vpc).contains("--kmeans-stride 4"));
        assert!(!text(Method::Vpc).contains("representative"));
        assert!(text(Method::Vplc).contains("--representative drawn --merge visibility"));
        assert!(!text(Method::Path).contains("vpls"));
    }

    #[test]
    fn a_command_holds_what_is_no_default() {
        let settings = Settings { light_paths: 500, ..Settings::of(Method::Vpl) };
        let command = command("my scene.toml", &settings, [64, 32], 3);
        let expected = "gpu-vpl render 'my scene.toml' --method vpl --vpls 500 \
                        --samples 1 --size 64x32 --seed 3 -o vpl.exr";
        assert_eq!(command, expected);
        assert_eq!(quoted("it's"), r"'it'\''s'");
    }
}
