//! Which settings are refused: those that the command line refuses, so that the library does, too.

use std::fmt::Display;
use std::ops::RangeInclusive;

use super::{Clamp, Clustering, Direct, Method, Settings, SettingsError};

impl Settings {
    /// The most light paths.
    pub const MOST_LIGHT_PATHS: u32 = 1 << 24;
    /// The most shadow rays to area lights.
    pub const MOST_LIGHT_SAMPLES: u32 = 65536;
    /// The most camera rays in a pixel where surfaces meet.
    pub const MOST_EDGE_SAMPLES: u32 = 4096;

    /// Whether a frame can be rendered with them.
    ///
    /// # Errors
    /// A value is beyond its range, or two do not go together.
    pub fn check(&self) -> Result<(), SettingsError> {
        within("vpls", self.light_paths, 1..=Self::MOST_LIGHT_PATHS)?;
        within("samples", self.samples, 1..=u32::MAX)?;
        within("edge-samples", self.edge_samples, 1..=Self::MOST_EDGE_SAMPLES)?;
        within("vpl-candidates", self.candidates, 1..=Self::MOST_CANDIDATES)?;
        within("correct", self.correct, 0..=Self::MOST_CORRECTIONS)?;
        within("interleave", self.interleave, 1..=Self::MOST_INTERLEAVE)?;
        if let Some(count) = self.light_samples {
            within("light-samples", count, 1..=Self::MOST_LIGHT_SAMPLES)?;
        }
        if let Clamp::At(bound) = self.clamp
            && !(bound.is_finite() && bound > 0.0)
        {
            return refuse(format!("--clamp {bound} is not a finite bound above 0"));
        }
        self.clustering.check()?;
        if self.direct == Direct::Clustered && !self.method.clusters_points() {
            return refuse(
                "--direct clustered needs clusters of visible points; give --method vpc or both",
            );
        }
        if self.method == Method::Path && self.light_samples.is_some() {
            return refuse(
                "--light-samples: a path has one shadow ray a vertex; give more --samples",
            );
        }
        Ok(())
    }
}

impl Clustering {
    /// The most iterations of either K-means.
    pub const MOST_ITERATIONS: u32 = 1000;
    /// The longest stride.
    pub const MOST_STRIDE: u32 = 4096;

    fn check(&self) -> Result<(), SettingsError> {
        within("point-clusters", self.points, 1..=u32::MAX)?;
        within("vpl-clusters", self.vpls, 1..=u32::MAX)?;
        within("point-iterations", self.point_iterations, 1..=Self::MOST_ITERATIONS)?;
        within("vpl-iterations", self.vpl_iterations, 1..=Self::MOST_ITERATIONS)?;
        within("kmeans-stride", self.stride, 1..=Self::MOST_STRIDE)?;
        within("fuzzy", self.fuzzy, 1..=Self::MOST_FUZZY)?;
        within("probes", self.probes, 0..=Self::MOST_PROBES)?;
        let threshold = self.normal_threshold;
        match (-1.0..1.0).contains(&threshold) {
            true => Ok(()),
            false => {
                refuse(format!("--normal-threshold {threshold} is no cosine from -1 to below 1"))
            }
        }
    }
}

fn within<T: Display + PartialOrd>(
    option: &str,
    value: T,
    range: RangeInclusive<T>,
) -> Result<(), SettingsError> {
    match range.contains(&value) {
        true => Ok(()),
        false => refuse(format!(
            "--{option} {value} is not within {} and {}",
            range.start(),
            range.end()
        )),
    }
}

fn refuse(why: impl Into<String>) -> Result<(), SettingsError> {
    Err(SettingsError::new(why.into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_of_every_method_are_accepted() {
        for method in Method::ALL {
            assert_eq!(Settings::of(method).check(), Ok(()));
        }
    }

    #[test]
    fn each_setting_is_refused_by_the_name_of_its_option() {
        let plain = Settings::default();
        let with = |change: fn(&mut Clustering)| {
            let mut clustering = plain.clustering;
            change(&mut clustering);
            Settings { clustering, ..plain }
        };
        let path = Settings { light_samples: Some(4), ..Settings::of(Method::Path) };
        let clustered = Settings { direct: Direct::Clustered, ..Settings::of(Method::Vpl) };
        let wrong = [
            ("vpls 0", Settings { light_paths: 0, ..plain }),
            ("vpls 16777217", Settings { light_paths: (1 << 24) + 1, ..plain }),
            ("samples 0", Settings { samples: 0, ..plain }),
            ("edge-samples 0", Settings { edge_samples: 0, ..plain }),
            ("edge-samples 4097", Settings { edge_samples: 4097, ..plain }),
            ("correct 257", Settings { correct: 257, ..plain }),
            ("interleave 0", Settings { interleave: 0, ..plain }),
            ("interleave 9", Settings { interleave: 9, ..plain }),
            ("light-samples 0", Settings { light_samples: Some(0), ..plain }),
            ("light-samples 65537", Settings { light_samples: Some(65537), ..plain }),
            ("clamp 0", Settings { clamp: Clamp::At(0.0), ..plain }),
            ("clamp -1", Settings { clamp: Clamp::At(-1.0), ..plain }),
            ("clamp NaN", Settings { clamp: Clamp::At(f64::NAN), ..plain }),
            ("clamp inf", Settings { clamp: Clamp::At(f64::INFINITY), ..plain }),
            ("point-clusters 0", with(|c| c.points = 0)),
            ("vpl-clusters 0", with(|c| c.vpls = 0)),
            ("point-iterations 0", with(|c| c.point_iterations = 0)),
            ("vpl-iterations 1001", with(|c| c.vpl_iterations = 1001)),
            ("kmeans-stride 0", with(|c| c.stride = 0)),
            ("kmeans-stride 4097", with(|c| c.stride = 4097)),
            ("fuzzy 0", with(|c| c.fuzzy = 0)),
            ("fuzzy 5", with(|c| c.fuzzy = 5)),
            ("probes 9", with(|c| c.probes = 9)),
            ("normal-threshold 1", with(|c| c.normal_threshold = 1.0)),
            ("normal-threshold -1.5", with(|c| c.normal_threshold = -1.5)),
            ("normal-threshold NaN", with(|c| c.normal_threshold = f32::NAN)),
            ("light-samples: a path", path),
            ("direct clustered needs", clustered),
        ];
        for (start, settings) in wrong {
            let why = settings.check().map_err(|refusal| refusal.to_string()).unwrap_err();
            assert!(why.starts_with(&format!("--{start} ")), "{start}: {why}");
            assert!(!why.contains('\n'), "{why}");
        }
    }
}
