//! The figures of a comparison as text or JSON.

use serde::Serialize;

use crate::metrics::{Comparison, Metrics};

#[derive(Serialize)]
struct Printed<'a> {
    #[serde(flatten)]
    comparison: &'a Comparison,
    #[serde(skip_serializing_if = "Option::is_none")]
    map_scale: Option<f64>,
    /// Of the reference and the image, where they have a name.
    #[serde(skip_serializing_if = "Option::is_none")]
    layers: Option<&'a [Option<String>; 2]>,
}

/// A name and a value a line, or a JSON object in which what is not finite is null. Of images that are
/// named layers of their files, the names come first.
pub fn text(
    comparison: &Comparison,
    layers: &[Option<String>; 2],
    map_scale: Option<f64>,
    json: bool,
) -> String {
    let named = layers.iter().any(Option::is_some).then_some(layers);
    if json {
        let printed = Printed { comparison, map_scale, layers: named };
        return serde_json::to_string_pretty(&printed).unwrap_or_default() + "\n";
    }
    let Comparison { metrics, flip, nonfinite, .. } = comparison;
    let Metrics { rmse, mae, bias, nrmse, relmse, tile_nrmse, max_abs } = *metrics;
    let figures = [
        ("rmse", Some(rmse)),
        ("mae", Some(mae)),
        ("bias", Some(bias)),
        ("nrmse", Some(nrmse)),
        ("relmse", Some(relmse)),
        ("tile_nrmse", tile_nrmse),
        ("flip", Some(*flip)),
        ("max_abs", Some(max_abs)),
    ];
    let rows = figures.map(|(name, value)| (name, value.map_or("-".to_owned(), short)));
    let nonfinite = ("nonfinite", nonfinite.to_string());
    let map_scale = map_scale.map(|scale| ("map_scale", short(scale)));
    let rows = rows.into_iter().chain([nonfinite]).chain(map_scale);
    let plain = |layer: &Option<String>| layer.clone().unwrap_or_else(|| "RGB".to_owned());
    let named = named
        .map(|[reference, image]| format!("layer {} against {}\n", plain(image), plain(reference)));
    let rows = rows.map(|(name, value)| format!("{name:<12}{value:>12}\n"));
    named.into_iter().chain(rows).collect()
}

/// Six digits where they show something, else an exponent.
fn short(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        0.001..100_000.0 => format!("{value:.6}"),
        _ => format!("{value:.4e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn comparison(nrmse: f64) -> Comparison {
        let metrics = Metrics { bias: -0.0125, nrmse, max_abs: 1e-9, ..Metrics::default() };
        Comparison { metrics, flip: 0.5, nonfinite: 3, flip_map: Vec::new() }
    }

    #[test]
    fn the_table_is_aligned() {
        let table = text(&comparison(0.25), &[None, None], Some(2.0), false);
        assert!(table.lines().all(|line| line.len() == 24), "{table}");
        for line in [
            "rmse                   0",
            "bias           -0.012500",
            "tile_nrmse             -",
            "max_abs        1.0000e-9",
            "nonfinite              3",
            "map_scale       2.000000",
        ] {
            assert!(table.contains(line), "{table}");
        }
    }

    #[test]
    fn what_is_not_finite_is_null() {
        let printed = text(&comparison(f64::INFINITY), &[None, None], None, true);
        let json: serde_json::Value = serde_json::from_str(&printed).unwrap();
        assert!(json["nrmse"].is_null() && json["tile_nrmse"].is_null());
        assert_eq!((json["flip"].as_f64(), json["nonfinite"].as_u64()), (Some(0.5), Some(3)));
        assert_eq!(json.as_object().unwrap().len(), 9);
    }
}
