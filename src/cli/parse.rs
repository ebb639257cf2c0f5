//! The values of options, and how a wrong one is told.

use crate::render::{Bounces, Clamp, Direct, Merge, Method, Representative, Settings};

pub fn method(text: &str) -> Result<Method, String> {
    if let Some(method) = Method::ALL.into_iter().find(|method| method.name() == text) {
        return Ok(method);
    }
    let known = Method::ALL.map(Method::name).join(", ");
    Err(format!("give one of {known}"))
}

pub fn bounces(text: &str) -> Result<Bounces, String> {
    if text == "unlimited" {
        return Ok(Bounces::Unlimited);
    }
    let count = text.parse().map_err(|_| "give a number of bounces, or unlimited".to_owned())?;
    Ok(Bounces::Finite(count))
}

pub fn direct(text: &str) -> Result<Direct, String> {
    match text {
        "per-pixel" => Ok(Direct::PerPixel),
        "clustered" => Ok(Direct::Clustered),
        "off" => Ok(Direct::Off),
        _ => Err("give per-pixel or off".to_owned()),
    }
}

pub fn representative(text: &str) -> Result<Representative, String> {
    match text {
        "mean" => Ok(Representative::Mean),
        "member" => Ok(Representative::Member),
        "drawn" => Ok(Representative::Drawn),
        _ => Err("give mean, member or drawn".to_owned()),
    }
}

pub fn merge(text: &str) -> Result<Merge, String> {
    match text {
        "light" => Ok(Merge::Light),
        "visibility" => Ok(Merge::Visibility),
        _ => Err("give light or visibility".to_owned()),
    }
}

/// The cosine of the normal gate.
pub fn normal_threshold(text: &str) -> Result<f32, String> {
    let value = text.parse::<f32>().ok().filter(|value| (-1.0..1.0).contains(value));
    value.ok_or_else(|| "give a cosine from -1 to below 1".to_owned())
}

pub fn clamp(text: &str) -> Result<Clamp, String> {
    match text {
        "auto" => Ok(Clamp::Auto),
        "off" => Ok(Clamp::Off),
        _ => match text.parse::<f64>() {
            Ok(bound) if bound.is_finite() && bound > 0.0 => Ok(Clamp::At(bound)),
            _ => Err("give a bound above 0 in 1/length², or auto, or off".to_owned()),
        },
    }
}

/// Width and height, as in 640x480.
pub fn size(text: &str) -> Result<[u32; 2], String> {
    let extent = |text: &str| text.parse().ok().filter(|extent| (1..=65536).contains(extent));
    text.split_once(['x', 'X'])
        .and_then(|(width, height)| Some([extent(width)?, extent(height)?]))
        .ok_or_else(|| "give WIDTHxHEIGHT, each from 1 to 65536, as in 640x480".to_owned())
}

pub fn exposure(text: &str) -> Result<f32, String> {
    let value = text.parse::<f32>().ok().filter(|value| value.is_finite());
    value.ok_or_else(|| "give a number of stops".to_owned())
}

/// An exposure in stops, or that it is to fit the image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Exposure {
    /// In stops.
    Stops(f32),
    /// So that nearly all of the image is seen.
    Auto,
}

/// A number of stops, or `auto`.
pub fn exposure_or_auto(text: &str) -> Result<Exposure, String> {
    match text {
        "auto" => Ok(Exposure::Auto),
        _ => exposure(text).map(Exposure::Stops).map_err(|what| what + ", or auto"),
    }
}

/// A finite number, as a level of radiance is.
pub fn number(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
    value.ok_or_else(|| "give a number".to_owned())
}

/// The most that an error may be.
pub fn limit(text: &str) -> Result<f64, String> {
    number(text).ok().filter(|value| *value >= 0.0).ok_or_else(|| "give a number from 0".to_owned())
}

/// The error at the end of a colour scale.
pub fn scale(text: &str) -> Result<f64, String> {
    number(text).ok().filter(|value| *value > 0.0).ok_or_else(|| "give a number above 0".to_owned())
}

/// A number of light samples; none is auto.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LightSamples(pub Option<u32>);

pub fn light_samples(text: &str) -> Result<LightSamples, String> {
    if text == "auto" {
        return Ok(LightSamples(None));
    }
    let most = Settings::MOST_LIGHT_SAMPLES;
    let count = text.parse().ok().filter(|count| (1..=most).contains(count));
    let count = count.ok_or_else(|| format!("give a number from 1 to {most}, or auto"))?;
    Ok(LightSamples(Some(count)))
}

/// Rays that correct shared visibility; off is none.
pub fn corrections(text: &str) -> Result<u32, String> {
    if text == "off" {
        return Ok(0);
    }
    let most = Settings::MOST_CORRECTIONS;
    let count = text.parse().ok().filter(|count| (1..=most).contains(count));
    count.ok_or_else(|| format!("give a number from 1 to {most}, or off"))
}

pub fn switch(text: &str) -> Result<bool, String> {
    match text {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err("give on or off".to_owned()),
    }
}

/// Whether bias is compensated; none is auto.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Compensate(pub Option<bool>);

pub fn compensate(text: &str) -> Result<Compensate, String> {
    match text {
        "auto" => Ok(Compensate(None)),
        "on" | "true" => Ok(Compensate(Some(true))),
        "off" | "false" => Ok(Compensate(Some(false))),
        _ => Err("give auto, on or off".to_owned()),
    }
}

/// Makes one line of clap's many: what is wrong, and its tips, without its usage.
pub fn one_clause(refusal: &str) -> String {
    let mut clause = String::new();
    for part in refusal.lines().map(str::trim).filter(|part| !part.is_empty()) {
        if part.starts_with("Usage: ") || part.starts_with("For more information") {
            break;
        }
        let (joint, part) = match part.strip_prefix("tip: ") {
            Some(tip) => ("; ", tip),
            None => (" ", part.strip_prefix("error: ").unwrap_or(part)),
        };
        clause.push_str(if clause.is_empty() { "" } else { joint });
        clause.push_str(part);
    }
    clause
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_two_positive_numbers() {
        assert_eq!(size("640x480"), Ok([640, 480]));
        assert_eq!(size("1X65536"), Ok([1, 65536]));
        let wrong = ["", "0", "640", "0x5", "5x0", "65537x1", "-1x5", "1x2x3", "x", "ax5", "1.5x2"];
        assert!(wrong.iter().all(|text| size(text).is_err()));
    }

    #[test]
    fn a_clamp_is_a_positive_bound_or_a_word() {
        assert_eq!(clamp("auto"), Ok(Clamp::Auto));
        assert_eq!(clamp("off"), Ok(Clamp::Off));
        assert_eq!(clamp("1e-4"), Ok(Clamp::At(1e-4)));
        assert!(["0", "-1", "inf", "nan", "", "on"].iter().all(|text| clamp(text).is_err()));
    }

    #[test]
    fn limits_and_scales_are_finite_and_not_negative() {
        assert_eq!((limit("0"), limit("1e-3")), (Ok(0.0), Ok(1e-3)));
        assert!(["-1", "nan", "inf", "", "x"].iter().all(|text| limit(text).is_err()));
        assert_eq!(scale("0.5"), Ok(0.5));
        assert!(["0", "-1", "nan", "inf"].iter().all(|text| scale(text).is_err()));
    }

    #[test]
    fn methods_go_by_their_names() {
        assert_eq!(method("vpl"), Ok(Method::Vpl));
        assert_eq!(method("path"), Ok(Method::Path));
        assert!(method("bogus").unwrap_err().contains("both, path, direct"));
        assert_eq!(direct("clustered"), Ok(Direct::Clustered));
    }

    #[test]
    fn bounces_are_counted_or_unlimited() {
        assert_eq!(bounces("0"), Ok(Bounces::Finite(0)));
        assert_eq!(bounces("unlimited"), Ok(Bounces::Unlimited));
        assert!(bounces("-1").is_err());
    }

    #[test]
    fn a_refusal_is_one_line() {
        let many = "error: invalid value 'x'\n  for this\n\n  tip: try y\n\n\
                    Usage: gpu-vpl render [OPTIONS] <A>\n\nFor more information, try '--help'.\n";
        assert_eq!(one_clause(many), "invalid value 'x' for this; try y");
    }
}
