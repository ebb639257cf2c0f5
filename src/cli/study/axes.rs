//! Options of `render` with lists of values: every combination is a setting.

use std::collections::BTreeMap;

use clap::error::ErrorKind;
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches};

use crate::cli::parse;
use crate::cli::render::RenderArgs;
use crate::error::Error;
use crate::render::Settings;
use crate::study::{Experiment, Run, options};

/// Those that a setting is made of.
const NAMES: [&str; 22] = [
    "method",
    "vpls",
    "vpl-candidates",
    "bounces",
    "samples",
    "point-clusters",
    "vpl-clusters",
    "point-iterations",
    "vpl-iterations",
    "normal-threshold",
    "kmeans-stride",
    "fuzzy",
    "probes",
    "representative",
    "merge",
    "interleave",
    "direct",
    "light-samples",
    "clamp",
    "compensate",
    "correct",
    "edge-samples",
];

/// Names and values, in the order of [`NAMES`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Axes(Vec<(&'static str, Vec<String>)>);

impl Axes {
    /// Whether nothing was given.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The option that a key of a sweep file means.
    pub fn name(key: &str) -> Option<&'static str> {
        NAMES.into_iter().find(|name| name.replace('-', "_") == key)
    }

    /// From names and their values; or the first name that is no option of a setting.
    pub fn new(mut values: BTreeMap<&str, Vec<String>>) -> Result<Self, String> {
        let axes = NAMES.iter().filter_map(|name| Some((*name, values.remove(name)?))).collect();
        match values.into_keys().next() {
            Some(unknown) => Err(unknown.to_owned()),
            None => Ok(Self(axes)),
        }
    }

    /// An experiment for each method.
    ///
    /// # Errors
    /// A value is refused, as `render` would refuse it.
    pub fn experiments(&self) -> Result<Vec<Experiment>, Error> {
        let mut experiments: Vec<Experiment> = Vec::new();
        for run in self.runs()? {
            let name = run.settings.method.name();
            match experiments.iter_mut().find(|experiment| experiment.name == name) {
                Some(experiment) => experiment.runs.push(run),
                None => experiments.push(Experiment {
                    name: name.to_owned(),
                    title: format!("`--method {name}`"),
                    runs: vec![run],
                }),
            }
        }
        Ok(experiments)
    }

    /// All combinations, the last option fastest, each frame once.
    ///
    /// # Errors
    /// A value is refused, as `render` would refuse it.
    pub fn runs(&self) -> Result<Vec<Run>, Error> {
        let mut combinations = vec![Vec::new()];
        for (name, values) in &self.0 {
            let with = |start: &Vec<_>| {
                let with = |value: &String| [&start[..], &[(*name, value.clone())]].concat();
                values.iter().map(with).collect::<Vec<_>>()
            };
            combinations = combinations.iter().flat_map(with).collect();
        }
        let mut runs: Vec<Run> = Vec::new();
        for combination in combinations {
            let settings = settings(&combination)?;
            if !runs.iter().any(|known| options::same(&known.settings, &settings)) {
                runs.push(Run { setting: self.label(&combination), settings, thesis: None });
            }
        }
        Ok(runs)
    }

    /// What sets a combination apart: the options with more than one value, beside the method.
    fn label(&self, combination: &[(&'static str, String)]) -> String {
        let varies = |name: &str| {
            let values = self.0.iter().find(|axis| axis.0 == name).map_or(0, |axis| axis.1.len());
            values > 1 && name != "method"
        };
        let words = combination.iter().filter(|(name, _)| varies(name));
        let words: Vec<_> = words.map(|(name, value)| format!("--{name} {value}")).collect();
        if words.is_empty() { "as given".to_owned() } else { words.join(" ") }
    }
}

/// The settings that `render` makes of options.
fn settings(combination: &[(&str, String)]) -> Result<Settings, Error> {
    let options = combination.iter().map(|(name, value)| format!("--{name}={value}"));
    let args = render_args(options)?;
    match args.method.is_lit() {
        true => Ok(args.settings()),
        false => {
            let name = args.method.name();
            Err(Error::Usage(format!("study: --method {name} shows no light; there is no error")))
        }
    }
}

/// The arguments of `render` with these options, as it would check them.
///
/// # Errors
/// One is refused, as `render` would refuse it.
pub fn render_args(options: impl Iterator<Item = String>) -> Result<RenderArgs, Error> {
    // The output is required, and not looked at.
    let words = ["render".to_owned(), "--output=-".to_owned()].into_iter().chain(options);
    let refuse = |refusal: clap::Error| {
        Error::Usage(format!("study: {}", parse::one_clause(&refusal.to_string())))
    };
    let matches = command().try_get_matches_from(words).map_err(refuse)?;
    let args = RenderArgs::from_arg_matches(&matches).map_err(refuse)?;
    args.check()?;
    Ok(args)
}

fn command() -> Command {
    RenderArgs::augment_args(Command::new("render"))
}

impl Args for Axes {
    fn augment_args(into: Command) -> Command {
        let render = command();
        let own = render.get_arguments().filter_map(|arg| {
            let name = NAMES.into_iter().find(|name| arg.get_long() == Some(name))?;
            let values = arg.get_value_names().and_then(|names| names.first().cloned());
            let arg = Arg::new(name).long(name).help_heading("Options of render, lists are swept");
            Some(arg.value_name(format!("{},...", values.unwrap_or("VALUE".into()))))
        });
        let own = own.map(|arg| {
            arg.value_delimiter(',')
                .allow_hyphen_values(true)
                .value_parser(clap::value_parser!(String))
        });
        into.args(own.collect::<Vec<_>>())
    }

    fn augment_args_for_update(into: Command) -> Command {
        Self::augment_args(into)
    }
}

impl FromArgMatches for Axes {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let given = |name: &'static str| {
            let values = matches.get_many::<String>(name)?;
            Some((name, values.cloned().collect::<Vec<_>>()))
        };
        let axes: Vec<_> = NAMES.into_iter().filter_map(given).collect();
        match axes.iter().find(|(_, values)| values.iter().any(String::is_empty)) {
            None => Ok(Self(axes)),
            Some((name, _)) => {
                let what = format!("an empty value in the list of '--{name}'\n");
                Err(clap::Error::raw(ErrorKind::InvalidValue, what))
            }
        }
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::Method;

    fn axes(values: &[(&'static str, &[&str])]) -> Axes {
        let own = |list: &&[&str]| list.iter().map(|value| (*value).to_owned()).collect();
        Axes::new(values.iter().map(|(name, list)| (*name, own(list))).collect()).unwrap()
    }

    #[test]
    fn all_combinations_are_settings_each_once() {
        let axes = axes(&[("vpls", &["10", "20"]), ("method", &["vpl", "both", "path"])]);
        let experiments = axes.experiments().unwrap();
        let labels: Vec<_> = experiments
            .iter()
            .map(|e| (e.name.as_str(), e.runs.iter().map(|r| r.setting.as_str()).collect()))
            .collect();
        let both: Vec<_> = vec!["--vpls 10", "--vpls 20"];
        // The path tracer does not look at them.
        let expected = [("vpl", both.clone()), ("both", both.clone()), ("path", vec![both[0]])];
        assert_eq!(labels, expected);
        assert_eq!(experiments[1].runs[1].settings.light_paths, 20);
    }

    #[test]
    fn values_are_refused_as_render_refuses_them() {
        for (name, value) in [("vpls", "0"), ("method", "normal"), ("fuzzy", "9"), ("vpls", "x")] {
            let refusal = axes(&[(name, &[value])]).runs().unwrap_err().to_string();
            assert!(refusal.starts_with("study: "), "{refusal}");
        }
        assert_eq!(Axes::new([("size", vec![])].into()), Err("size".to_owned()));
    }

    #[test]
    fn commands_give_their_settings_back() {
        let varied = axes(&[
            ("vpls", &["77"]),
            ("method", &["both", "vpl", "vpc", "vplc", "direct"]),
            ("bounces", &["3", "unlimited"]),
            ("normal-threshold", &["0.7"]),
            ("clamp", &["off", "0.001"]),
            ("direct", &["off"]),
            ("light-samples", &["5"]),
            ("merge", &["light"]),
        ]);
        let path = axes(&[("method", &["path"]), ("samples", &["3"]), ("direct", &["off"])]);
        for run in [varied, path].iter().flat_map(|axes| axes.runs().unwrap()) {
            let text = options::changed(&run.settings);
            let words: Vec<_> = text.split_whitespace().collect();
            let pairs: Vec<_> =
                words.chunks(2).map(|pair| (&pair[0][2..], pair[1].to_owned())).collect();
            assert!(options::same(&settings(&pairs).unwrap(), &run.settings), "{text}");
        }
        assert_eq!(settings(&[("method", "vpl".to_owned())]).unwrap(), Settings::of(Method::Vpl));
    }
}
