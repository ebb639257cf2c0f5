//! Rows as comma-separated values (RFC 4180), a header first.

use std::io::{self, Write};

use super::parts::{Decomposed, Part};
use super::results::{Errors, Results, Row, Spread};
use crate::report::BounceLimit;

/// A column: its name, and a row's value, empty where there is none.
type Column = (&'static str, fn(&Row) -> String);

/// Seconds are of warm frames, and the thesis's own begin with `thesis_`.
const COLUMNS: [Column; 38] = [
    ("experiment", |row| row.experiment.clone()),
    ("setting", |row| row.setting.clone()),
    ("method", |row| row.method.to_owned()),
    ("light_paths", |row| row.light_paths.to_string()),
    ("bounces", |row| match row.bounces {
        BounceLimit::Finite(bounces) => bounces.to_string(),
        BounceLimit::Named(name) => name.to_owned(),
    }),
    ("samples", |row| row.samples.to_string()),
    ("wanted_point_clusters", |row| maybe(row.wanted_point_clusters)),
    ("wanted_vpl_clusters", |row| maybe(row.wanted_vpl_clusters)),
    ("options", |row| row.options.clone()),
    ("seeds", |row| row.seeds.to_string()),
    ("vpls", |row| row.vpls.to_string()),
    ("point_clusters", |row| maybe(row.point_clusters)),
    ("vpl_clusters", |row| maybe(row.vpl_clusters)),
    ("shadow_rays", |row| row.shadow_rays.to_string()),
    ("shading_terms", |row| row.shading_terms.to_string()),
    ("clamp", |row| maybe(row.clamp)),
    ("clamped_fraction", |row| row.clamped_fraction.to_string()),
    ("seconds", |row| row.seconds.mean.to_string()),
    ("seconds_sd", |row| maybe(row.seconds.sd)),
    ("preprocess", |row| row.preprocess.mean.to_string()),
    ("render", |row| row.render.mean.to_string()),
    ("visible_points", |row| row.phases.visible_points.to_string()),
    ("direct", |row| row.phases.direct.to_string()),
    ("generate_vpls", |row| row.phases.vpls.to_string()),
    ("cluster_points", |row| row.phases.cluster_points.to_string()),
    ("cluster_vpls", |row| row.phases.cluster_vpls.to_string()),
    ("visibility", |row| row.phases.visibility.to_string()),
    ("shading", |row| row.phases.shading.to_string()),
    ("readback", |row| row.phases.readback.to_string()),
    ("speedup", |row| maybe(row.speedup)),
    ("efficiency", |row| maybe(row.efficiency)),
    ("reference", |row| row.reference.clone().unwrap_or_default()),
    ("pareto", |row| row.pareto.iter().map(|metric| metric.name()).collect::<Vec<_>>().join("; ")),
    ("thesis_preprocess", |row| maybe(row.thesis.and_then(|thesis| thesis.preprocess))),
    ("thesis_render", |row| maybe(row.thesis.and_then(|thesis| thesis.render))),
    ("thesis_total", |row| maybe(row.thesis.map(|thesis| thesis.total))),
    ("thesis_speedup", |row| maybe(row.thesis.and_then(|thesis| thesis.speedup))),
    ("command", |row| row.command.clone()),
];

/// An error's column, and its value: two columns each, with and without the standard deviation.
type ErrorColumn = (&'static str, fn(&Errors) -> Option<Spread>);

/// Twice: of the total error, and, with `clustering_` before them, of that of clustering.
const ERRORS: [ErrorColumn; 8] = [
    ("rmse", |errors| Some(errors.rmse)),
    ("mae", |errors| Some(errors.mae)),
    ("bias", |errors| Some(errors.bias)),
    ("nrmse", |errors| Some(errors.nrmse)),
    ("relmse", |errors| Some(errors.relmse)),
    ("tile_nrmse", |errors| errors.tile_nrmse),
    ("flip", |errors| Some(errors.flip)),
    ("max_abs", |errors| Some(errors.max_abs)),
];

/// Writes all rows of all scenes.
///
/// # Errors
/// The sink fails.
pub fn write(out: &mut (impl Write + ?Sized), results: &Results) -> io::Result<()> {
    let mut header = vec!["scene".to_owned()];
    header.extend(COLUMNS.map(|(name, _)| name.to_owned()));
    for prefix in ["", "clustering_"] {
        header.extend(
            ERRORS
                .iter()
                .flat_map(|(name, _)| [format!("{prefix}{name}"), format!("{prefix}{name}_sd")]),
        );
        header.push(format!("{prefix}nonfinite"));
    }
    let mut rows = results.scenes.iter().flat_map(|scene| &scene.rows);
    let decomposed = rows.any(|row| row.decomposition.is_some());
    if decomposed {
        header.extend(decomposition_columns());
    }
    writeln!(out, "{}", header.join(","))?;
    for scene in &results.scenes {
        for row in &scene.rows {
            let mut fields = vec![field(&scene.scene)];
            fields.extend(COLUMNS.map(|(_, value)| field(&value(row))));
            fields.extend(errors(row.total.as_ref()));
            fields.extend(errors(row.clustering.as_ref()));
            if decomposed {
                fields.extend(decomposition(row.decomposition.as_ref()));
            }
            writeln!(out, "{}", fields.join(","))?;
        }
    }
    Ok(())
}

fn errors(errors: Option<&Errors>) -> Vec<String> {
    let mut fields = Vec::new();
    for (_, value) in ERRORS {
        let spread = errors.and_then(value);
        fields.push(maybe(spread.map(|spread| spread.mean)));
        fields.push(maybe(spread.and_then(|spread| spread.sd)));
    }
    fields.push(maybe(errors.map(|errors| errors.nonfinite)));
    fields
}

/// Of the image, then of each part: the relMSE and bias left, and of how much noise of the
/// converged part that may be.
fn decomposition_columns() -> Vec<String> {
    let whole = ["seeds", "relmse", "bias", "reference_noise", "interaction"];
    let whole = whole.map(|name| format!("decomposed_{name}"));
    let of_part = |part: Part| {
        let name = part.name();
        [
            format!("without_{name}_relmse"),
            format!("without_{name}_bias"),
            format!("without_{name}_noise"),
        ]
    };
    whole.into_iter().chain(Part::ALL.into_iter().flat_map(of_part)).collect()
}

fn decomposition(decomposed: Option<&Decomposed>) -> Vec<String> {
    let own = |of: fn(&Decomposed) -> f64| maybe(decomposed.map(of));
    let mut fields = vec![
        maybe(decomposed.map(|own| own.seeds)),
        own(|own| own.relmse.mean),
        own(|own| own.bias.mean),
        maybe(decomposed.and_then(|own| own.reference_noise)),
        own(|own| own.interaction.mean),
    ];
    for part in Part::ALL {
        let left = decomposed.and_then(|own| own.part(part));
        fields.push(maybe(left.map(|left| left.relmse.mean)));
        fields.push(maybe(left.map(|left| left.bias.mean)));
        fields.push(maybe(left.map(|left| left.noise)));
    }
    fields
}

fn maybe(value: Option<impl ToString>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}

/// Quoted where it has to be.
pub(crate) fn field(text: &str) -> String {
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
