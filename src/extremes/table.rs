//! What came of all cases, as a table for people, one for programs, and as JSON.

use std::io::{self, Write};

use serde_json::{Value, json};

use super::cases::Cases;
use super::runner::{Judged, Verdict};
use crate::gpu::AdapterInfo;
use crate::study::csv::field;

/// What was run, where, and what came of it.
#[derive(Debug, Clone)]
pub struct Report<'a> {
    /// The rows.
    pub cases: &'a Cases,
    /// The command that repeats it.
    pub command: String,
    /// The adapter, once it is known.
    pub adapter: Option<AdapterInfo>,
    /// All figures, in the order of the cases.
    pub judged: Vec<Judged>,
    /// How many cases were run, if not all.
    pub broken_off: Option<usize>,
}

impl Report<'_> {
    /// How many figures are not what they must be.
    pub fn wrong(&self) -> usize {
        self.judged.iter().filter(|judged| judged.verdict == Verdict::Wrong).count()
    }

    /// How many figures have this verdict.
    fn count(&self, verdict: Verdict) -> usize {
        self.judged.iter().filter(|judged| judged.verdict == verdict).count()
    }
}

fn name(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Right => "right",
        Verdict::Refused => "refused",
        Verdict::Wrong => "WRONG",
    }
}

/// Writes a table for each row, as Markdown.
///
/// # Errors
/// The sink fails.
pub fn markdown(out: &mut (impl Write + ?Sized), report: &Report<'_>) -> io::Result<()> {
    writeln!(out, "# The stiff and the extreme\n\n    {}\n", report.command)?;
    let version = env!("CARGO_PKG_VERSION");
    let adapter = report.adapter.as_ref().map_or("no adapter".to_owned(), |adapter| {
        format!("{} ({}, {})", adapter.name, adapter.backend, adapter.driver)
    });
    writeln!(
        out,
        "gpu-vpl {version}; {adapter}. {} figures: {} right, {} refused as they must be, {} wrong. \
         Errors are relative to what is expected, absolute where that is 0; a mean or a worst \
         pixel is that of the channel that is off most.",
        report.judged.len(),
        report.count(Verdict::Right),
        report.count(Verdict::Refused),
        report.wrong(),
    )?;
    if let Some(run) = report.broken_off {
        writeln!(out, "\nInterrupted: {run} of {} cases were run.", report.cases.cases.len())?;
    }
    summary(out, report)?;
    for row in &report.cases.rows {
        writeln!(out, "\n## {}\n\n{}. Treatment: {}.\n", row.about, row.wrong, row.treatment)?;
        writeln!(
            out,
            "| case | method | figure | expected | measured | error | within | verdict |"
        )?;
        writeln!(out, "| --- | --- | --- | ---: | ---: | ---: | ---: | --- |")?;
        let mut notes: Vec<String> = Vec::new();
        for judged in report.judged.iter().filter(|judged| judged.row == row.name) {
            writeln!(out, "| {} |", cells(judged).map(|cell| escaped(&cell)).join(" | "))?;
            let note = format!("{}: {}.", judged.case, judged.reasons);
            if !judged.reasons.is_empty() && !notes.contains(&note) {
                notes.push(note);
            }
        }
        for note in notes {
            writeln!(out, "\n{note}")?;
        }
    }
    Ok(())
}

/// A line for each row: how many figures it has, and which of them is the nearest to its limit.
fn summary(out: &mut (impl Write + ?Sized), report: &Report<'_>) -> io::Result<()> {
    writeln!(out, "\n| row | figures | nearest to its limit | error | within | verdict |")?;
    writeln!(out, "| --- | ---: | --- | ---: | ---: | --- |")?;
    for row in &report.cases.rows {
        let own: Vec<_> = report.judged.iter().filter(|judged| judged.row == row.name).collect();
        let Some(worst) = own.iter().copied().reduce(nearer_to_its_limit) else { continue };
        let (figure, case) = (&worst.figure, &worst.case);
        let method = if figure.method.is_empty() { "" } else { ", " };
        let what = escaped(&format!("{case}{method}{}: {}", figure.method, figure.what));
        let (error, within) = (short(figure.error), short(figure.within));
        let verdict = name(worst.verdict);
        writeln!(
            out,
            "| {} | {} | {what} | {error} | {within} | {verdict} |",
            row.name,
            own.len()
        )?;
    }
    Ok(())
}

/// Of two figures the wrong one, else that which uses more of what it may be off.
fn nearer_to_its_limit<'a>(one: &'a Judged, other: &'a Judged) -> &'a Judged {
    let used = |judged: &Judged| match (judged.verdict, judged.figure.within) {
        (Verdict::Wrong, _) => f64::INFINITY,
        (Verdict::Refused, _) => -1.0,
        (Verdict::Right, within) if within > 0.0 => judged.figure.error / within,
        (Verdict::Right, _) => 0.0,
    };
    if used(other) > used(one) { other } else { one }
}

fn cells(judged: &Judged) -> [String; 8] {
    let figure = &judged.figure;
    let verdict = match &judged.refusal {
        Some(why) => format!("{}: {why}", name(judged.verdict)),
        None => name(judged.verdict).to_owned(),
    };
    [
        judged.case.clone(),
        figure.method.clone(),
        figure.what.clone(),
        short(figure.expected),
        short(figure.measured),
        short(figure.error),
        short(figure.within),
        verdict,
    ]
}

fn escaped(cell: &str) -> String {
    cell.replace('|', "\\|")
}

/// Some digits that count, of numbers of all sizes.
fn short(value: f64) -> String {
    match value.abs() {
        size if size == 0.0 || !value.is_finite() => value.to_string(),
        size if (1e-3..1e6).contains(&size) => {
            let digits = (4.0 - size.log10().floor()).clamp(0.0, 8.0) as usize;
            let text = format!("{value:.digits$}");
            match text.contains('.') {
                true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
                false => text,
            }
        }
        _ => format!("{value:.3e}"),
    }
}

/// Writes a line for each figure.
///
/// # Errors
/// The sink fails.
pub fn csv(out: &mut (impl Write + ?Sized), report: &Report<'_>) -> io::Result<()> {
    writeln!(out, "row,case,method,figure,expected,measured,error,within,verdict,refusal")?;
    for judged in &report.judged {
        let figure = &judged.figure;
        let numbers = [figure.expected, figure.measured, figure.error, figure.within];
        let numbers = numbers.map(|number| number.to_string());
        let texts = [&*judged.row, &*judged.case, &*figure.method, &*figure.what];
        let refusal = judged.refusal.as_deref().unwrap_or_default();
        let fields = texts.into_iter().chain(numbers.iter().map(String::as_str));
        let fields: Vec<_> = fields.chain([name(judged.verdict), refusal]).map(field).collect();
        writeln!(out, "{}", fields.join(","))?;
    }
    Ok(())
}

/// Everything as JSON; what is not finite is null.
pub fn json(report: &Report<'_>) -> Value {
    let rows = report.cases.rows.iter().map(|row| {
        let (about, wrong, treatment) = (&row.about, &row.wrong, &row.treatment);
        json!({ "name": row.name, "about": about, "wrong": wrong, "treatment": treatment })
    });
    let figures = report.judged.iter().map(|judged| {
        let figure = &judged.figure;
        json!({
            "row": judged.row,
            "case": judged.case,
            "method": figure.method,
            "figure": figure.what,
            "expected": figure.expected,
            "measured": figure.measured,
            "error": figure.error,
            "within": figure.within,
            "verdict": name(judged.verdict),
            "refusal": judged.refusal,
            "reasons": judged.reasons,
        })
    });
    json!({
        "schema": 1,
        "version": env!("CARGO_PKG_VERSION"),
        "command": report.command,
        "adapter": report.adapter,
        "rows": rows.collect::<Vec<_>>(),
        "figures": figures.collect::<Vec<_>>(),
        "wrong": report.wrong(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extremes::Figure;

    #[test]
    fn numbers_of_all_sizes_are_short() {
        let shown = [0.0, 1.0, 1.111_111_1, 250.0, 1e-7, 1234567.0, f64::NAN].map(short);
        assert_eq!(shown, ["0", "1", "1.1111", "250", "1.000e-7", "1.235e6", "NaN"]);
    }

    #[test]
    fn all_three_tables_hold_every_figure() {
        let text = "[scenes]\n[[row]]\nname = \"r\"\nabout = \"R\"\nwrong = \"w\"\n\
                    treatment = \"t\"\n[[case]]\nname = \"c\"\nrow = \"r\"\n";
        let cases = Cases::parse(text).unwrap();
        let figure = |measured| Figure {
            method: "vpl".to_owned(),
            what: "a, b|c".to_owned(),
            expected: 1.0,
            measured,
            error: f64::abs(measured - 1.0),
            within: 0.5,
        };
        let judged = |measured, verdict| Judged {
            row: "r".to_owned(),
            case: "c".to_owned(),
            figure: figure(measured),
            verdict,
            refusal: None,
            reasons: String::new(),
        };
        let judged = vec![judged(1.0, Verdict::Right), judged(f64::NAN, Verdict::Wrong)];
        let report = Report {
            cases: &cases,
            command: "gpu-vpl".to_owned(),
            adapter: None,
            judged,
            broken_off: None,
        };
        let (mut md, mut lines) = (Vec::new(), Vec::new());
        markdown(&mut md, &report).unwrap();
        csv(&mut lines, &report).unwrap();
        let md = String::from_utf8(md).unwrap();
        assert!(md.contains("| c | vpl | a, b\\|c | 1 | 1 | 0 | 0.5 | right |"), "{md}");
        assert!(md.contains("| r | 2 | c, vpl: a, b\\|c | NaN | 0.5 | WRONG |"), "{md}");
        assert!(md.contains("2 figures: 1 right, 0 refused as they must be, 1 wrong."), "{md}");
        let lines = String::from_utf8(lines).unwrap();
        assert!(lines.ends_with("r,c,vpl,\"a, b|c\",1,NaN,NaN,0.5,WRONG,\n"), "{lines}");
        let json = json(&report);
        assert_eq!((&json["wrong"], &json["figures"][1]["measured"]), (&1.into(), &Value::Null));
    }
}
