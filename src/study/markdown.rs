//! Results for people: a table an experiment, then the claims.

use std::io::{self, Write};

use super::claims::Criterion;
use super::{Claim, Experiment, Results, Row};

/// A column: its heading, and a row's value.
type Column = (&'static str, fn(&Row) -> String);

const NOTHING: &str = "–";

/// Beside what the thesis measured.
const PUBLISHED: [Column; 14] = [
    ("setting", |row| row.setting.clone()),
    ("VPLs", |row| row.vpls.to_string()),
    ("C", |row| count(row.point_clusters)),
    ("K_v", |row| count(row.vpl_clusters)),
    ("pT", |row| seconds(row.times.preprocess)),
    ("rT", |row| seconds(row.times.render)),
    ("tT", |row| seconds(row.times.seconds)),
    ("thesis pT", |row| maybe(row.thesis.and_then(|thesis| thesis.preprocess), seconds)),
    ("thesis rT", |row| maybe(row.thesis.and_then(|thesis| thesis.render), seconds)),
    ("thesis tT", |row| maybe(row.thesis.map(|thesis| thesis.total), seconds)),
    ("thesis tT / ours", |row| {
        maybe(row.thesis.map(|thesis| thesis.total / row.times.seconds), factor)
    }),
    ("over `vpl`", |row| maybe(row.speedup, factor)),
    ("thesis over `vpl`", |row| maybe(row.thesis.and_then(|thesis| thesis.speedup), factor)),
    ("nRMSE", |row| maybe(row.error.map(|error| error.nrmse), percent)),
];

/// What the thesis has no seconds for.
const PHASES: [Column; 9] = [
    ("setting", |row| row.setting.clone()),
    ("VPLs", |row| row.vpls.to_string()),
    ("K-means of points", |row| seconds(row.times.phases.cluster_points)),
    ("K-means of VPLs", |row| seconds(row.times.phases.cluster_vpls)),
    ("visibility", |row| seconds(row.times.phases.visibility)),
    ("shading", |row| seconds(row.times.phases.shading)),
    ("rT", |row| seconds(row.times.render)),
    ("tT", |row| seconds(row.times.seconds)),
    ("nRMSE", |row| maybe(row.error.map(|error| error.nrmse), percent)),
];

/// The end of every table.
const ERRORS: [Column; 2] = [
    ("relMSE", |row| maybe(row.error.map(|error| error.relmse), |value| format!("{value:.2e}"))),
    ("bias", |row| {
        maybe(row.error.map(|error| error.bias), |value| format!("{:.3} %", 100.0 * value))
    }),
];

/// Writes the results of these experiments.
///
/// # Errors
/// The sink fails.
pub fn write(
    out: &mut (impl Write + ?Sized),
    experiments: &[Experiment],
    results: &Results,
) -> io::Result<()> {
    head(out, results)?;
    for experiment in experiments {
        let rows = || results.rows.iter().filter(|row| row.experiment == experiment.name);
        writeln!(out, "\n## {}. {}\n", experiment.name, experiment.title)?;
        let published = rows().any(|row| row.thesis.is_some());
        let columns = if published { &PUBLISHED[..] } else { &PHASES[..] };
        table(out, &[columns, &ERRORS].concat(), rows())?;
    }
    writeln!(out, "\n## Claims\n")?;
    writeln!(out, "| claim | verdict | number | confirms | remark |")?;
    writeln!(out, "| --- | --- | --- | --- | --- |")?;
    for claim in &results.claims {
        claim_row(out, claim)?;
    }
    Ok(())
}

fn head(out: &mut (impl Write + ?Sized), results: &Results) -> io::Result<()> {
    let Results { version, preset, scene, adapter, threads, seed, width, height, .. } = results;
    writeln!(out, "# Study: {preset}\n")?;
    writeln!(
        out,
        "gpu-vpl {version}, {scene}, {width} × {height}, {} sample a pixel, seed {seed}; \
         {} ({}, {}), {threads} host threads.\n",
        results.samples, adapter.name, adapter.backend, adapter.driver
    )?;
    writeln!(
        out,
        "Seconds by the wall clock, of one warm frame, of `vpl` the faster of two: pT generates VPLs and clusters, rT \
         is visibility and shading, tT here the whole frame (visible points, direct light and \
         read-back included; the thesis's is pT + rT, on a machine it does not name). \"Over \
         `vpl`\" is how many times faster tT is than without clustering, on the same machine. \
         Settings that stand in several tables were measured once. Paths end by Russian \
         roulette, so paths × bounces is the most VPLs there can be. The errors of clustering \
         are those of the whole image, direct light included, against `vpl` with the same VPLs \
         and the same clamp; direct light is computed at each pixel, where the thesis shares \
         its visibility in a cluster as well."
    )
}

fn table<'a>(
    out: &mut (impl Write + ?Sized),
    columns: &[Column],
    rows: impl Iterator<Item = &'a Row>,
) -> io::Result<()> {
    let names: Vec<_> = columns.iter().map(|column| column.0).collect();
    writeln!(out, "| {} |", names.join(" | "))?;
    writeln!(out, "| ---{} |", " | ---:".repeat(columns.len() - 1))?;
    for row in rows {
        let values: Vec<_> = columns.iter().map(|column| (column.1)(row)).collect();
        writeln!(out, "| {} |", values.join(" | "))?;
    }
    Ok(())
}

fn claim_row(out: &mut (impl Write + ?Sized), claim: &Claim) -> io::Result<()> {
    let joined = |show: fn(&Criterion) -> String| {
        let all: Vec<_> = claim.criteria.iter().map(show).collect();
        if all.is_empty() { NOTHING.to_owned() } else { all.join("; ") }
    };
    let numbers = joined(|criterion| format!("{}: {:.3}", criterion.what, criterion.value));
    let ranges = joined(|criterion| match (criterion.least, criterion.most) {
        (Some(least), Some(most)) if least > 0.0 => format!("{least} to {most}"),
        (_, Some(most)) => format!("≤ {most}"),
        (Some(least), None) => format!("≥ {least}"),
        (None, None) => "any".to_owned(),
    });
    let verdict = claim.verdict.name();
    writeln!(out, "| {} | **{verdict}** | {numbers} | {ranges} | {} |", claim.claim, claim.remark)
}

fn maybe(value: Option<f64>, show: fn(f64) -> String) -> String {
    value.map_or(NOTHING.to_owned(), show)
}

fn count(value: Option<u64>) -> String {
    value.map_or(NOTHING.to_owned(), |value| value.to_string())
}

fn seconds(value: f64) -> String {
    format!("{value:.3}")
}

fn factor(value: f64) -> String {
    format!("{value:.2}×")
}

fn percent(value: f64) -> String {
    format!("{:.2} %", 100.0 * value)
}
