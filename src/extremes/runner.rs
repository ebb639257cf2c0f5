//! Cases rendered and judged.

use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use serde::{Deserialize, Serialize};

use super::cases::{Case, Cases, Expect, Like};
use super::checks::CHECKS;
use super::judge::{Seen, judge};
use super::staging::Staging;
use super::{Figure, Front, Scale};
use crate::error::Error;
use crate::gpu::{AdapterChoice, Gpu, GpuError};
use crate::image::Image;
use crate::render::{self, Prepared};
use crate::report::warnings;

/// Renders cases. Images are kept, as others may be compared with them, but for large ones; so is the
/// last scene.
#[derive(Debug)]
pub struct Runner<'a> {
    cases: &'a Cases,
    scale: Scale,
    front: Front,
    adapter: AdapterChoice,
    interrupt: Arc<AtomicBool>,
    prepared: Option<(Staging, Prepared)>,
    known: HashMap<Staging, Rendered>,
}

/// What came of a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// It is what it must be.
    Right,
    /// There is no image, as it must be.
    Refused,
    /// It is not.
    Wrong,
}

/// A figure of a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Judged {
    /// The row that the case belongs to.
    pub row: String,
    /// The case.
    pub case: String,
    /// What was measured.
    pub figure: Figure,
    /// What came of it.
    pub verdict: Verdict,
    /// Why there is no image, if there is none.
    pub refusal: Option<String>,
    /// Where the expectation comes from, and why the tolerance is what it is.
    pub reasons: String,
}

/// A frame, or why there is none.
type Outcome = Result<Rendered, Error>;

#[derive(Debug, Clone)]
struct Rendered {
    image: Image,
    method: &'static str,
    warnings: Vec<String>,
    /// Pixels that the renderer found not to be finite.
    nonfinite: u64,
}

impl<'a> Runner<'a> {
    /// Images of up to so many pixels are kept.
    const KEPT: usize = 1 << 20;

    /// Nothing is rendered yet.
    pub fn new(cases: &'a Cases, scale: Scale, front: Front, adapter: AdapterChoice) -> Self {
        let (prepared, known, interrupt) = (None, HashMap::new(), Arc::default());
        Self { cases, scale, front, adapter, interrupt, prepared, known }
    }

    /// The same, which ends once the flag is set.
    pub fn interrupted_by(mut self, flag: Arc<AtomicBool>) -> Self {
        self.interrupt = flag;
        self
    }

    /// Renders a case with all its methods, and judges it.
    ///
    /// # Errors
    /// There is no device, or the user interrupts. Whatever else goes wrong is a figure that does
    /// not hold.
    pub fn run(&mut self, case: &Case) -> Result<Vec<Judged>, Error> {
        match &case.check {
            Some(name) => self.check(case, name),
            None => self.images(case),
        }
    }

    fn open(&self) -> Result<Gpu, Error> {
        Ok(Gpu::open(&self.adapter)?.interrupted_by(self.interrupt.clone()))
    }

    fn check(&self, case: &Case, name: &str) -> Result<Vec<Judged>, Error> {
        let Some((_, check)) = CHECKS.iter().find(|(known, _)| *known == name) else {
            return Ok(vec![fault(case, "", format!("there is no check `{name}`"))]);
        };
        match check(&self.open()?, self.scale) {
            Ok(figures) if figures.is_empty() => {
                Ok(vec![fault(case, "", format!("the check `{name}` measured nothing"))])
            }
            Ok(figures) => Ok(figures.into_iter().map(|figure| judged(case, figure)).collect()),
            Err(error) => Ok(vec![fault(case, "", refusal(error)?)]),
        }
    }

    fn images(&mut self, case: &Case) -> Result<Vec<Judged>, Error> {
        let Some(expect) = &case.expect else {
            return Ok(vec![fault(case, "", "it has neither `check` nor `expect`".to_owned())]);
        };
        if case.methods.is_empty() {
            return Ok(vec![fault(case, "", "it has no methods".to_owned())]);
        }
        let mut images = Vec::new();
        for method in &case.methods {
            images.push(self.outcome(case, method, None)?);
        }
        let like = if let Expect::Like(like) = expect { Some(like) } else { None };
        let mut judged = Vec::new();
        for (method, outcome) in case.methods.iter().zip(images) {
            let other = match like {
                Some(like) => Some(self.outcome(case, method, Some(like))?),
                None => None,
            };
            judged.extend(judge_outcome(case, expect, method, outcome, other));
        }
        Ok(judged)
    }

    /// A frame, or why there is none. Only what ends everything is an error.
    fn outcome(
        &mut self,
        case: &Case,
        method: &str,
        like: Option<&Like>,
    ) -> Result<Outcome, Error> {
        let staging = match Staging::of(self.cases, case, method, self.scale, like) {
            Ok(staging) => staging,
            Err(what) => return Ok(Err(Error::Usage(format!("the case is at fault: {what}")))),
        };
        if let Some(known) = self.known.get(&staging) {
            return Ok(Ok(known.clone()));
        }
        match self.render(&staging) {
            Ok(rendered) => {
                if rendered.image.pixels.len() <= Self::KEPT {
                    self.known.insert(staging, rendered.clone());
                }
                Ok(Ok(rendered))
            }
            Err(Error::Gpu(error)) if ends_all(&error) => Err(error.into()),
            Err(error) => Ok(Err(error)),
        }
    }

    fn render(&mut self, staging: &Staging) -> Outcome {
        let asked = (self.front.options)(&staging.words)?;
        let known = self.prepared.take().filter(|(known, _)| known.files == staging.files);
        let (_, prepared) = match known {
            Some(known) => self.prepared.insert(known),
            None => {
                let scene = staging.scene()?;
                let prepared = Prepared::new(self.open()?, scene, &asked.settings)?;
                self.prepared.insert((staging.clone(), prepared))
            }
        };
        let mut camera = prepared.scene.camera;
        camera.size = asked.size.unwrap_or(camera.size);
        let frame = render::frame(prepared, &camera, &asked.settings, asked.seed, &|_, _| {})?;
        let scene = prepared.scene.warnings.iter().map(|warning| warning.message.clone());
        let warnings = scene.chain(warnings::of_frame(&frame, &asked.settings)).collect();
        Ok(Rendered {
            image: frame.image,
            method: asked.settings.method.name(),
            warnings,
            nonfinite: frame.counts.nonfinite_pixels,
        })
    }
}

/// Whether there is no point in going on.
fn ends_all(error: &GpuError) -> bool {
    error.is_missing_adapter() || matches!(error, GpuError::Interrupted)
}

/// An error as the reason of a figure, unless it ends all.
fn refusal(error: Error) -> Result<String, Error> {
    match error {
        Error::Gpu(error) if ends_all(&error) => Err(error.into()),
        error => Ok(error.to_string()),
    }
}

fn judge_outcome(
    case: &Case,
    expect: &Expect,
    method: &str,
    outcome: Outcome,
    other: Option<Outcome>,
) -> Vec<Judged> {
    let rendered = match (outcome, expect) {
        (Err(error), Expect::Refused(text)) => return vec![refused(case, &error, text)],
        (Err(error), _) => return vec![fault(case, method, error.to_string())],
        (Ok(rendered), _) => rendered,
    };
    let other = match other.transpose() {
        Ok(other) => other,
        Err(error) => return vec![fault(case, method, format!("the other image: {error}"))],
    };
    let seen = Seen { image: &rendered.image, method: rendered.method, region: case.region };
    let own = case.of.get(method).and_then(|own| own.within);
    let other = other.as_ref().map(|other| &other.image);
    let mut figures = judge(expect, own.unwrap_or(case.within), seen, other);
    if rendered.nonfinite > 0 {
        let what = "pixels that the renderer found not to be finite";
        figures.push(exact(rendered.method, what, 0.0, rendered.nonfinite as f64));
    }
    if let Some(text) = &case.warns {
        let told = rendered.warnings.iter().any(|warning| warning.contains(text));
        let what = format!("a warning of \"{text}\"");
        figures.push(exact(rendered.method, &what, 1.0, f64::from(u8::from(told))));
    }
    // A method's variants are told apart by what was measured.
    let variant = |mut figure: Figure| {
        if method != figure.method {
            figure.what = format!("{method}: {}", figure.what);
        }
        judged(case, figure)
    };
    figures.into_iter().map(variant).collect()
}

/// A figure that holds only if it is what it must be.
fn exact(method: &str, what: &str, expected: f64, measured: f64) -> Figure {
    let error = (measured - expected).abs();
    let (method, what) = (method.to_owned(), what.to_owned());
    Figure { method, what, expected, measured, error, within: 0.0 }
}

fn judged(case: &Case, figure: Figure) -> Judged {
    let verdict = if figure.holds() { Verdict::Right } else { Verdict::Wrong };
    let reasons = [&*case.from, &*case.because].into_iter().filter(|text| !text.is_empty());
    Judged {
        row: case.row.clone(),
        case: case.name.clone(),
        figure,
        verdict,
        refusal: None,
        reasons: reasons.collect::<Vec<_>>().join("; "),
    }
}

/// An error where one has to be: its exit code is that of a refused input, its text the one
/// expected.
fn refused(case: &Case, error: &Error, text: &str) -> Judged {
    let message = error.to_string();
    let mut figure = exact("", "exit code of the refusal", 2.0, f64::from(error.exit_code()));
    if !message.contains(text) || message.contains('\n') {
        figure.error = f64::INFINITY;
    }
    let mut judged = judged(case, figure);
    judged.refusal = Some(message);
    if judged.verdict == Verdict::Right {
        judged.verdict = Verdict::Refused;
    }
    judged
}

/// No image where there has to be one.
fn fault(case: &Case, method: &str, why: String) -> Judged {
    let what =
        if method.is_empty() { "a figure".to_owned() } else { format!("{method}: an image") };
    let mut judged = judged(case, exact("", &what, 1.0, 0.0));
    judged.refusal = Some(why);
    judged
}
