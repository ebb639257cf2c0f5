//! Rows as comma-separated values (RFC 4180), a header first.

use std::io::{self, Write};

use super::{Published, Row};
use crate::report::BounceLimit;

/// A column: its name, and a row's value, empty where there is none.
type Column = (&'static str, fn(&Row) -> String);

/// Seconds are of warm frames; `thesis_` ones the thesis's; errors against `vpl` with the same
/// VPLs and clamp.
const COLUMNS: [Column; 37] = [
    ("experiment", |row| row.experiment.to_owned()),
    ("setting", |row| row.setting.clone()),
    ("method", |row| row.method.to_owned()),
    ("light_paths", |row| row.light_paths.to_string()),
    ("bounces", |row| match row.bounces {
        BounceLimit::Finite(bounces) => bounces.to_string(),
        BounceLimit::Named(name) => name.to_owned(),
    }),
    ("wanted_point_clusters", |row| maybe(row.wanted_point_clusters)),
    ("wanted_vpl_clusters", |row| maybe(row.wanted_vpl_clusters)),
    ("options", |row| row.options.clone()),
    ("vpls", |row| row.vpls.to_string()),
    ("point_clusters", |row| maybe(row.point_clusters)),
    ("vpl_clusters", |row| maybe(row.vpl_clusters)),
    ("shadow_rays", |row| row.shadow_rays.to_string()),
    ("shading_terms", |row| row.shading_terms.to_string()),
    ("preprocess", |row| row.times.preprocess.to_string()),
    ("render", |row| row.times.render.to_string()),
    ("total", |row| row.times.seconds.to_string()),
    ("frames", |row| row.frames.to_string()),
    ("slowest_total", |row| row.slowest.to_string()),
    ("visible_points", |row| row.times.phases.visible_points.to_string()),
    ("direct", |row| row.times.phases.direct.to_string()),
    ("generate_vpls", |row| row.times.phases.vpls.to_string()),
    ("cluster_points", |row| row.times.phases.cluster_points.to_string()),
    ("cluster_vpls", |row| row.times.phases.cluster_vpls.to_string()),
    ("visibility", |row| row.times.phases.visibility.to_string()),
    ("shading", |row| row.times.phases.shading.to_string()),
    ("readback", |row| row.times.phases.readback.to_string()),
    ("speedup", |row| maybe(row.speedup)),
    ("thesis_preprocess", |row| thesis(row, |thesis| thesis.preprocess)),
    ("thesis_render", |row| thesis(row, |thesis| thesis.render)),
    ("thesis_total", |row| thesis(row, |thesis| Some(thesis.total))),
    ("thesis_speedup", |row| thesis(row, |thesis| thesis.speedup)),
    ("thesis_total_over_total", |row| thesis(row, |thesis| Some(thesis.total / row.times.seconds))),
    ("rmse", |row| maybe(row.error.map(|error| error.rmse))),
    ("nrmse", |row| maybe(row.error.map(|error| error.nrmse))),
    ("bias", |row| maybe(row.error.map(|error| error.bias))),
    ("relmse", |row| maybe(row.error.map(|error| error.relmse))),
    ("max_abs", |row| maybe(row.error.map(|error| error.max_abs))),
];

/// Writes all rows.
///
/// # Errors
/// The sink fails.
pub fn write(out: &mut (impl Write + ?Sized), rows: &[Row]) -> io::Result<()> {
    writeln!(out, "{}", COLUMNS.map(|(name, _)| name).join(","))?;
    for row in rows {
        writeln!(out, "{}", COLUMNS.map(|(_, value)| field(&value(row))).join(","))?;
    }
    Ok(())
}

fn maybe(value: Option<impl ToString>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}

fn thesis(row: &Row, value: impl Fn(&Published) -> Option<f64>) -> String {
    maybe(row.thesis.as_ref().and_then(value))
}

/// Quoted where it has to be.
fn field(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_is_quoted_where_it_has_to_be() {
        assert_eq!(field("K_v = 400"), "K_v = 400");
        assert_eq!(field("a, \"b\""), "\"a, \"\"b\"\"\"");
    }
}
