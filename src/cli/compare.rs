//! `compare`: how far an image is from a reference.

mod limits;
mod map;
mod pictures;
mod table;

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;

use super::{console, parse};
use crate::error::{Error, ImageError, OutputError};
use crate::image::output::commit;
use crate::image::{Destination, Format, Image, Picture, read_picture};
use crate::metrics::{Comparison, away_from_bright};
use limits::Limits;
use map::{ErrorMap, MapKind};

/// The options of `compare`.
#[derive(Debug, Args)]
pub struct CompareArgs {
    /// What the image should be: EXR, HDR, or PNG, TIFF, JPEG and others, which are linearised
    reference: PathBuf,

    /// The image to judge
    image: PathBuf,

    /// Layer of EXR files to compare [default: R, G and B without a name, else Combined, else the
    /// only one]
    #[arg(long, value_name = "NAME")]
    layer: Option<String>,

    /// Print JSON
    #[arg(long)]
    json: bool,

    /// Exposure in stops at which FLIP looks at both
    #[arg(long, value_name = "EV", default_value = "0", value_parser = parse::exposure,
          allow_hyphen_values = true)]
    exposure: f32,

    /// Leave out pixels within 2 of any that is brighter than this: lights seen directly
    #[arg(long, value_name = "L", value_parser = parse::number, allow_hyphen_values = true)]
    mask_above: Option<f64>,

    /// The image in which --mask-above looks [default: the reference]
    #[arg(long, value_name = "FILE", requires = "mask_above")]
    mask_from: Option<PathBuf>,

    #[command(flatten)]
    limits: Limits,

    /// Error map to write, .png in false colours with their scale, .exr with the errors
    /// themselves; may be repeated
    #[arg(short, long = "output", value_name = "OUT")]
    outputs: Vec<PathBuf>,

    /// What the map shows: magnitude, signed (blue where too dark, red where too bright), flip
    #[arg(long, default_value = "magnitude", value_parser = MapKind::parse, requires = "outputs")]
    map: MapKind,

    /// The error at the end of the map's colours [default: what 99 % of pixels are within; 1
    /// for flip]
    #[arg(long, value_name = "X", value_parser = parse::scale, requires = "outputs",
          allow_hyphen_values = true)]
    map_scale: Option<f64>,
}

/// Compares, prints, writes the error map, and only then judges: that an image is over a limit
/// is a result, and its map shows where.
///
/// # Errors
/// An image cannot be read, they differ in size, an output cannot be written, or a limit is
/// exceeded.
pub fn run(args: &CompareArgs) -> Result<(), Error> {
    let outputs = args.check_outputs()?;
    let layer = args.layer.as_deref();
    let of_reference = read_picture(&args.reference, layer)?;
    let of_image = read_alike(&args.image, &of_reference.image, &args.reference, layer)?;
    pictures::tell([(&of_reference, &args.reference), (&of_image, &args.image)]);
    let layers = [of_reference.layer, of_image.layer];
    let [reference, image] = [of_reference.image, of_image.image];
    let keep = args.mask(&reference)?;
    let comparison = Comparison::of(&reference, &image, &keep, args.exposure).ok_or_else(|| {
        let file = args.mask_from.as_ref().unwrap_or(&args.reference).display();
        Error::Usage(format!("{file}: --mask-above leaves no pixel to compare; raise it"))
    })?;

    let map = (!outputs.is_empty())
        .then(|| ErrorMap::new(args.map, &reference, &image, &keep, &comparison, args.map_scale));
    let mut staged = Vec::new();
    if let Some(map) = &map {
        for (destination, format) in &outputs {
            staged.push(destination.stage(|out| map.write(out, *format))?);
        }
    }
    let text = table::text(&comparison, &layers, map.map(|map| map.scale), args.json);
    console::print(&text).map_err(|error| OutputError::Write {
        file: "standard output".into(),
        why: error.to_string(),
    })?;
    commit(staged)?;

    let broken = nonfinite(&comparison, [(&reference, &args.reference), (&image, &args.image)]);
    let mut faults = args.limits.exceeded(&comparison);
    match broken {
        Some(broken) if args.limits.any() => faults.insert(0, broken),
        Some(broken) => console::warning(&broken),
        None => {}
    }
    if faults.is_empty() { Ok(()) } else { Err(args.over_limit(&faults)) }
}

impl CompareArgs {
    /// The error maps to write, found to be writable and no input.
    fn check_outputs(&self) -> Result<Vec<(Destination, Format)>, Error> {
        let refuse = |name: &Path, what: &str| Error::Usage(format!("{}: {what}", name.display()));
        let inputs = [Some(&self.reference), Some(&self.image), self.mask_from.as_ref()];
        let inputs: Vec<_> =
            inputs.into_iter().flatten().filter_map(|input| fs::canonicalize(input).ok()).collect();
        let mut checked: Vec<(Destination, Format)> = Vec::new();
        for name in &self.outputs {
            let destination = Destination::check(name)?;
            if destination.is_stdout() {
                return Err(refuse(name, "standard output is for the metrics; name a file"));
            }
            if fs::canonicalize(name).is_ok_and(|path| inputs.contains(&path)) {
                return Err(refuse(name, "it is one of the images compared; name another file"));
            }
            if checked.iter().any(|(other, _)| destination.clashes_with(other)) {
                return Err(refuse(name, "two outputs go here; leave one out"));
            }
            let format = destination.format()?;
            checked.push((destination, format));
        }
        Ok(checked)
    }

    /// Whether each pixel is compared.
    fn mask(&self, reference: &Image) -> Result<Vec<bool>, ImageError> {
        let Some(level) = self.mask_above else { return Ok(vec![true; reference.pixels.len()]) };
        match &self.mask_from {
            None => Ok(away_from_bright(reference, level)),
            Some(file) => {
                let layer = self.layer.as_deref();
                let picture = read_alike(file, reference, &self.reference, layer)?;
                Ok(away_from_bright(&picture.image, level))
            }
        }
    }

    fn over_limit(&self, faults: &[String]) -> Error {
        let hint = if self.outputs.is_empty() { "; -o MAP.png shows where" } else { "" };
        Error::OverLimit(format!("{}: {}{hint}", self.image.display(), faults.join("; ")))
    }
}

/// Reads an image that must have the size of another.
fn read_alike(
    file: &Path,
    other: &Image,
    other_file: &Path,
    layer: Option<&str>,
) -> Result<Picture, ImageError> {
    let picture = read_picture(file, layer)?;
    let image = &picture.image;
    if [image.width, image.height] == [other.width, other.height] {
        return Ok(picture);
    }
    let what = format!(
        "it is {} x {} pixels, but {} is {} x {}; compare images of one size",
        image.width,
        image.height,
        other_file.display(),
        other.width,
        other.height
    );
    Err(ImageError::new(file, what))
}

/// What to say of pixels that are not finite, if there are any.
fn nonfinite(comparison: &Comparison, images: [(&Image, &PathBuf); 2]) -> Option<String> {
    let first = images.iter().find_map(|(image, file)| {
        image.first_nonfinite().map(|[x, y]| format!("({x}, {y}) of {}", file.display()))
    })?;
    let count = comparison.nonfinite;
    let pixels = if count == 1 { "pixel is" } else { "pixels are" };
    Some(format!("{count} {pixels} not finite, the first at {first}"))
}
