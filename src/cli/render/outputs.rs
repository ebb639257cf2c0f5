//! Which images go to which files.

use std::path::{Path, PathBuf};
use std::time::Duration;

use super::aov::Aov;
use crate::denoise::Denoiser;
use crate::error::{Error, OutputError};
use crate::image::exr::{Metadata, Plane, Value};
use crate::image::{Destination, Format, Image, Staged, Tone, exr, png};
use crate::render::{Counts, Method};

/// An image in the making: the frame itself, or an AOV, and what it shows.
#[derive(Debug, Clone, Copy)]
pub struct Shown<'a> {
    /// What it shows.
    pub method: Method,
    /// Its data.
    pub image: &'a Image,
}

/// The files of a render, checked to be writable.
#[derive(Debug)]
pub struct Outputs {
    images: Vec<ImageFile>,
    /// Where the report goes.
    pub report: Option<Destination>,
}

#[derive(Debug)]
struct ImageFile {
    destination: Destination,
    format: Format,
    /// Where each AOV goes if it does not go into the file as a layer.
    beside: Vec<Destination>,
}

impl Outputs {
    /// Checks every output that will be written, AOVs' files included.
    ///
    /// # Errors
    /// One cannot be written, two are the same, or standard output gets more than one.
    pub fn check(names: &[PathBuf], aovs: &[Aov], report: Option<&PathBuf>) -> Result<Self, Error> {
        let images =
            names.iter().map(|name| ImageFile::check(name, aovs)).collect::<Result<_, _>>()?;
        let report = report.map(|name| Destination::check(name)).transpose()?;
        let outputs = Self { images, report };
        outputs.check_clashes()?;
        Ok(outputs)
    }

    /// Whether there are images of 8 bits, to which the exposure matters.
    pub fn has_png(&self) -> bool {
        self.images.iter().any(|file| file.format == Format::Png)
    }

    fn check_clashes(&self) -> Result<(), Error> {
        let images = self
            .images
            .iter()
            .flat_map(|file| std::iter::once(&file.destination).chain(&file.beside));
        let all: Vec<_> = images.chain(&self.report).collect();
        for (index, one) in all.iter().enumerate() {
            if all[..index].iter().any(|other| one.clashes_with(other)) {
                let name = one.name().display();
                return Err(Error::Usage(format!("{name}: two outputs go here; leave one out")));
            }
        }
        Ok(())
    }

    /// Encodes all images to temporary files.
    ///
    /// # Errors
    /// One cannot be encoded or written.
    pub fn stage(
        &self,
        main: Shown<'_>,
        aovs: &[(Aov, Image)],
        exposure: f32,
        metadata: &Metadata,
    ) -> Result<Vec<Staged>, OutputError> {
        let mut staged = Vec::new();
        for file in &self.images {
            match file.format {
                Format::Exr => {
                    let planes: Vec<_> =
                        std::iter::once(plane("", main))
                            .chain(aovs.iter().map(|(aov, image)| {
                                plane(aov.name(), shown(*aov, main.method, image))
                            }))
                            .collect();
                    staged.push(file.destination.stage(|out| exr::write(out, &planes, metadata))?);
                }
                Format::Png => {
                    let places = std::iter::once(&file.destination).chain(&file.beside);
                    let aovs = aovs.iter().map(|(aov, image)| shown(*aov, main.method, image));
                    for (place, shown) in places.zip(std::iter::once(main).chain(aovs)) {
                        let tone = tone(shown.method, exposure);
                        staged.push(place.stage(|out| png::write(out, shown.image, tone))?);
                    }
                }
            }
        }
        Ok(staged)
    }
}

impl ImageFile {
    fn check(name: &Path, aovs: &[Aov]) -> Result<Self, Error> {
        let destination = Destination::check(name)?;
        let format = destination.format()?;
        let mut beside = Vec::new();
        if format == Format::Png && !aovs.is_empty() {
            if !destination.is_file() {
                let name = name.display();
                let what = format!("{name}: --aov needs files; name the output .png or .exr");
                return Err(Error::Usage(what));
            }
            for aov in aovs {
                beside
                    .push(Destination::check(&name.with_extension(format!("{}.png", aov.name())))?);
            }
        }
        Ok(Self { destination, format, beside })
    }
}

/// An AOV in the making; a standard error is shown as what it is the error of.
fn shown(aov: Aov, main: Method, image: &Image) -> Shown<'_> {
    let method = match aov {
        Aov::Of(method) => method,
        Aov::StandardError => main,
    };
    Shown { method, image }
}

/// The channels of an image or AOV in an EXR file. The frame's own are R, G, B whatever it
/// shows, so that any reader finds them.
fn plane<'a>(layer: &'static str, shown: Shown<'a>) -> Plane<'a> {
    let channels = match shown.method {
        Method::Normal if !layer.is_empty() => "XYZ",
        Method::Depth if !layer.is_empty() => "Z",
        _ => "RGB",
    };
    Plane { layer, channels, image: shown.image }
}

/// How a method's data is shown in 8 bits. The exposure is for light alone.
fn tone(method: Method, exposure: f32) -> Tone {
    match method {
        Method::Albedo => Tone::Radiance { exposure: 0.0 },
        Method::Normal => Tone::Normal,
        Method::Depth => Tone::Depth,
        _ => Tone::Radiance { exposure },
    }
}

/// What an EXR file says of its making.
pub fn metadata(
    method: Method,
    seed: u32,
    counts: &Counts,
    adapter: &str,
    elapsed: Duration,
) -> Metadata {
    let mut metadata = vec![
        ("time", Value::Number(elapsed.as_secs_f64())),
        ("method", Value::Text(method.name().to_owned())),
        ("vpls", Value::Number(counts.vpls as f64)),
        ("seed", Value::Number(f64::from(seed))),
        ("clamp", counts.clamp.map_or(Value::Text("off".to_owned()), Value::Number)),
        ("adapter", Value::Text(adapter.to_owned())),
    ];
    let clusters = [("vplClusters", counts.vpl_clusters), ("pointClusters", counts.point_clusters)];
    for (name, count) in clusters {
        metadata.extend(count.map(|count| (name, Value::Number(count as f64))));
    }
    metadata
}

/// What an EXR file says of what took its noise.
pub fn denoised(denoiser: &Denoiser) -> (&'static str, Value) {
    ("denoiser", Value::Text(format!("Open Image Denoise {}", denoiser.version())))
}
