//! Results for people: for each scene a table an experiment, then what was fitted; then the
//! claims.

mod format;
mod parts;

use std::io::{self, Write};

use super::results::{Against, Curve, Metric, Results, Row, SceneResults};
use super::verdict::{Claim, Criterion};
use format::{NOTHING, count, factor, maybe, percent, plural, seconds, signed, small, spread};

/// A column: its heading, and a row's value.
type Column = (&'static str, fn(&Row) -> String);

/// The start of every table.
const SETTING: [Column; 2] =
    [("setting", |row| row.setting.clone()), ("VPLs", |row| row.vpls.to_string())];

/// What stands in tables of no clusters as well.
const COSTS: [Column; 4] = [
    ("shadow rays", |row| row.shadow_rays.to_string()),
    ("pT", |row| spread(row.preprocess, seconds)),
    ("rT", |row| spread(row.render, seconds)),
    ("tT", |row| spread(row.seconds, seconds)),
];

/// Beside what the thesis measured.
const PUBLISHED: [Column; 11] = [
    ("C", |row| count(row.point_clusters)),
    ("K_v", |row| count(row.vpl_clusters)),
    ("pT", |row| seconds(row.preprocess.mean)),
    ("rT", |row| seconds(row.render.mean)),
    ("tT", |row| seconds(row.seconds.mean)),
    ("thesis pT", |row| maybe(row.thesis.and_then(|thesis| thesis.preprocess), seconds)),
    ("thesis rT", |row| maybe(row.thesis.and_then(|thesis| thesis.render), seconds)),
    ("thesis tT", |row| maybe(row.thesis.map(|thesis| thesis.total), seconds)),
    ("thesis tT / ours", |row| {
        maybe(row.thesis.map(|thesis| thesis.total / row.seconds.mean), factor)
    }),
    ("over `vpl`", |row| maybe(row.speedup, factor)),
    ("thesis over `vpl`", |row| maybe(row.thesis.and_then(|thesis| thesis.speedup), factor)),
];

/// The total error.
const TOTAL: [Column; 6] = [
    ("relMSE", |row| maybe(row.total.map(|error| error.relmse), |value| spread(value, small))),
    ("tile nRMSE", |row| {
        maybe(row.total.and_then(|error| error.tile_nrmse), |value| spread(value, small))
    }),
    ("ꟻLIP", |row| maybe(row.total.map(|error| error.flip), |value| spread(value, small))),
    ("bias", |row| maybe(row.total.map(|error| error.bias.mean), signed)),
    ("1 / (MSE · s)", |row| maybe(row.efficiency, |value| format!("{value:.3e}"))),
    ("front", |row| if row.pareto.contains(&Metric::Relmse) { "●" } else { "" }.to_owned()),
];

/// The error of clustering.
const CLUSTERING: [Column; 2] = [
    ("clustering nRMSE", |row| maybe(row.clustering.map(|error| error.nrmse.mean), percent)),
    ("clustering bias", |row| maybe(row.clustering.map(|error| error.bias.mean), signed)),
];

/// Writes the results.
///
/// # Errors
/// The sink fails.
pub fn write(out: &mut (impl Write + ?Sized), results: &Results) -> io::Result<()> {
    head(out, results)?;
    for scene in &results.scenes {
        write_scene(out, scene)?;
    }
    if !results.claims.is_empty() {
        writeln!(out, "\n## Claims\n")?;
        writeln!(out, "| claim | verdict | number | confirms | remark |")?;
        writeln!(out, "| --- | --- | --- | --- | --- |")?;
        for claim in &results.claims {
            claim_row(out, claim)?;
        }
    }
    Ok(())
}

fn head(out: &mut (impl Write + ?Sized), results: &Results) -> io::Result<()> {
    let Results { version, name, command, adapter, threads, seeds, planned, finished, .. } =
        results;
    writeln!(out, "# Study: {name}\n\n    {command}\n")?;
    if finished < planned {
        writeln!(out, "**Interrupted: {finished} of {planned} frames are measured.**\n")?;
    }
    writeln!(
        out,
        "gpu-vpl {version}; {} ({}, {}), {threads} host threads; {} from {}.\n",
        adapter.name,
        adapter.backend,
        adapter.driver,
        plural(seeds.len(), "seed"),
        seeds.first().copied().unwrap_or_default(),
    )?;
    writeln!(
        out,
        "Means over the seeds, ± the standard deviation of one. Seconds by the wall clock, of warm \
         frames: pT generates VPLs and clusters, rT is visibility and shading, tT the whole frame \
         (visible points, direct light and read-back included). The total error is against the \
         reference, whose own noise is in it; the mean of tile nRMSE is the root of the mean of \
         squares. The error of clustering is against `vpl` with the same VPLs, clamp and \
         interleaving; \"over `vpl`\" is how many times faster tT is than that frame's. 1 / (MSE · s) \
         is without the reference's variance. Rows marked ● are on the front of relMSE over \
         seconds: none is both faster and better."
    )
}

fn write_scene(out: &mut (impl Write + ?Sized), scene: &SceneResults) -> io::Result<()> {
    let SceneResults { scene: name, width, height, triangles, .. } = scene;
    writeln!(out, "\n## {name}\n\n{width} × {height} pixels, {triangles} triangles.")?;
    if let Some(level) = scene.mask_above {
        writeln!(out, "Pixels within 2 of any above {level} in the reference are left out.")?;
    }
    for reference in &scene.references {
        write!(out, "\nReference: {}", reference.label)?;
        if let Some(noise) = reference.noise {
            let tiles = maybe(noise.tile_nrmse, small);
            let relmse = small(noise.relmse);
            write!(out, "; its own noise: relMSE {relmse}, tile nRMSE {tiles}")?;
        }
        writeln!(out)?;
        for warning in &reference.warnings {
            writeln!(out, "\n**Warning: {warning}.**")?;
        }
    }
    for curve in &scene.experiments {
        let rows: Vec<_> = scene.rows_of(curve).collect();
        if rows.is_empty() {
            continue;
        }
        writeln!(out, "\n### {}. {}\n", curve.name, curve.title)?;
        table(out, &columns(&rows), &rows)?;
        for line in fits(curve) {
            writeln!(out, "\n{line}")?;
        }
    }
    parts::write(out, scene)?;
    Ok(())
}

fn columns(rows: &[&Row]) -> Vec<Column> {
    let mut columns = SETTING.to_vec();
    match rows.iter().any(|row| row.thesis.is_some()) {
        true => columns.extend(PUBLISHED),
        false => columns.extend(COSTS),
    }
    if rows.iter().any(|row| row.clustering.is_some()) {
        columns.extend(CLUSTERING);
    }
    columns.extend(TOTAL);
    columns
}

/// What was fitted to the curve's total error, in words.
fn fits(curve: &Curve) -> impl Iterator<Item = String> {
    let shown = [Metric::Relmse, Metric::Rmse];
    let fits = curve.fits.iter();
    let fits = fits.filter(move |fit| shown.contains(&fit.metric) && fit.against == Against::Total);
    fits.map(|fit| {
        let floor = match fit.floor {
            Some(floor) => format!("above a floor of {}", small(floor)),
            None => "and no floor in sight".to_owned(),
        };
        format!("{} falls as seconds to the power of {:.2}, {floor}.", fit.metric.name(), fit.slope)
    })
}

fn table(out: &mut (impl Write + ?Sized), columns: &[Column], rows: &[&Row]) -> io::Result<()> {
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
