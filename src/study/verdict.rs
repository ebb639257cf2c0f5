//! A claim and its verdict: a number, and the range in which it confirms.

use std::ops::RangeInclusive;

use serde::Serialize;

/// What became of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Every number lies in the range stated for it.
    Confirmed,
    /// One does not.
    Refuted,
    /// There is no number.
    NotMeasured,
}

impl Verdict {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::Refuted => "refuted",
            Self::NotMeasured => "not measured",
        }
    }
}

/// A claim and what the rows say of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Claim {
    /// What the thesis says.
    pub claim: &'static str,
    /// Decided by the criteria.
    pub verdict: Verdict,
    /// What decides: all of them have to hold.
    pub criteria: Vec<Criterion>,
    /// Further numbers, and what the criteria leave out.
    pub remark: String,
}

/// A number, and where it has to lie.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Criterion {
    /// What the number is.
    pub what: &'static str,
    /// The number.
    pub value: f64,
    /// The least that confirms; null if anything small does.
    pub least: Option<f64>,
    /// The most that confirms; null if anything large does.
    pub most: Option<f64>,
}

impl Criterion {
    pub(super) fn new(what: &'static str, value: f64, range: RangeInclusive<f64>) -> Self {
        let finite = |bound: &f64| Some(*bound).filter(|bound| bound.is_finite());
        Self { what, value, least: finite(range.start()), most: finite(range.end()) }
    }

    /// Whether the number lies where it has to; a NaN lies nowhere.
    pub fn holds(&self) -> bool {
        let least = self.least.unwrap_or(f64::NEG_INFINITY);
        let most = self.most.unwrap_or(f64::INFINITY);
        (least..=most).contains(&self.value)
    }
}
