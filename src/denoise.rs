//! Frames without the noise of light that is estimated pixel by pixel, by Intel's Open Image
//! Denoise (Áfra, 2019 ff., <https://www.openimagedenoise.org>), where its library is installed.
//!
//! It is trained on noise that neighbouring pixels do not share: that of paths and of direct light.
//! VPL light has none; its error is the same all over a surface, and combined over pixels, and
//! would be taken for texture. So the methods that gather VPLs have their direct light rendered,
//! denoised and added apart.

mod error;
mod library;
mod places;

use std::time::Instant;

pub use error::DenoiseError;
use library::{Device, Inputs};
pub use places::VARIABLE;

use crate::image::Image;
use crate::render::{self, Direct, Frame, Method, Prepared, Progress, RenderError, Settings};
use crate::scene::Camera;

/// Camera rays a pixel for albedo and normals, at most: more do not change them visibly.
const MOST_AUXILIARY_SAMPLES: u32 = 16;

/// From so many on, albedo and normals count as free of noise; the filter then follows them closely,
/// stairs at the edges of one sample a pixel included. Measured with paths, relMSE without and with:
/// classroom, 1 sample .0265 and .0298, 4 samples .0088 and .0082; a hall with 13 lamps, 1 sample
/// .0117 and .0141, 4 samples .0052 and .0048, 16 samples .0029 and .0024.
const CLEAN_AUXILIARY_SAMPLES: u32 = 4;

/// Open Image Denoise on the CPU: the same bytes for the same frame, whatever the threads.
#[derive(Debug)]
pub struct Denoiser {
    device: Device,
    version: String,
}

/// What a frame is rendered from.
#[derive(Clone, Copy)]
struct View<'a> {
    prepared: &'a Prepared,
    camera: &'a Camera,
    seed: u32,
    progress: Progress<'a>,
}

impl View<'_> {
    fn frame(&self, settings: &Settings) -> Result<Frame, RenderError> {
        render::frame(self.prepared, self.camera, settings, self.seed, self.progress)
    }
}

/// Refuses settings with which nothing may be denoised.
///
/// # Errors
/// The method shows no light, its light is all shared by clusters, or there is none.
pub fn check(settings: &Settings) -> Result<(), DenoiseError> {
    let refuse = |why: &str| Err(DenoiseError::Refused(why.to_owned()));
    let Settings { method, direct, .. } = *settings;
    match method {
        Method::Path => Ok(()),
        Method::Direct | Method::Vpl | Method::Vplc | Method::Vpc | Method::Both => match direct {
            Direct::PerPixel => Ok(()),
            Direct::Clustered => {
                refuse("takes no light that clusters share; give --direct per-pixel")
            }
            Direct::Off => refuse("takes direct light or paths; give --method path"),
        },
        _ => refuse("takes light; give --method path, direct, vpl, vplc, vpc or both"),
    }
}

impl Denoiser {
    /// Loads the library, from where [`VARIABLE`] says or from the system's places, for so many
    /// threads.
    ///
    /// # Errors
    /// There is none, or it cannot be used on this machine.
    pub fn open(threads: usize) -> Result<Self, DenoiseError> {
        let device = Device::open(threads)?;
        let version = device.version();
        Ok(Self { device, version })
    }

    /// The library's version, such as 2.5.1.
    pub fn version(&self) -> &str {
        &self.version
    }

    /// Renders a frame as [`render::frame`] does, and denoises what may be of it. There is no
    /// standard error, as that of a denoised pixel is not known.
    ///
    /// # Errors
    /// The settings are refused, there or by [`check`]; the device or the library fails.
    pub fn frame(
        &self,
        prepared: &Prepared,
        camera: &Camera,
        settings: &Settings,
        seed: u32,
        progress: Progress<'_>,
    ) -> Result<Frame, DenoiseError> {
        check(settings)?;
        let view = View { prepared, camera, seed, progress };
        let mut frame = match settings.method.is_indirect() {
            true => self.beside_vpls(&view, settings)?,
            false => {
                // It takes noise that is combined already for texture.
                let mut frame = view.frame(&Settings { direct_filter: false, ..*settings })?;
                let start = Instant::now();
                frame.image = self.denoise(&view, settings, &frame.image)?;
                frame.phases.denoise += start.elapsed();
                frame
            }
        };
        frame.standard_error = None;
        Ok(frame)
    }

    /// VPL light as it is, and direct light denoised.
    fn beside_vpls(&self, view: &View<'_>, settings: &Settings) -> Result<Frame, DenoiseError> {
        // It takes noise that is combined already for texture.
        let noisy = Settings { method: Method::Direct, direct_filter: false, ..*settings };
        let direct = view.frame(&noisy)?;
        let mut frame = view.frame(&Settings { direct: Direct::Off, ..*settings })?;
        let start = Instant::now();
        // Both show what is emitted towards the camera.
        let twice = Settings { method: Method::Direct, direct: Direct::Off, ..*settings };
        let emission = view.frame(&twice)?;
        let denoised = self.denoise(view, settings, &direct.image)?;
        let parts = denoised.pixels.iter().zip(&emission.image.pixels);
        for (pixel, (direct, emission)) in frame.image.pixels.iter_mut().zip(parts) {
            *pixel = std::array::from_fn(|i| pixel[i] + (direct[i] - emission[i]));
        }
        frame.phases = frame.phases.plus(&direct.phases);
        frame.phases.denoise += start.elapsed();
        frame.counts.nonfinite_pixels = frame.image.nonfinite();
        Ok(frame)
    }

    /// Denoises an image. A pixel that is not finite stays what it is, and is none to the others.
    fn denoise(
        &self,
        view: &View<'_>,
        settings: &Settings,
        noisy: &Image,
    ) -> Result<Image, DenoiseError> {
        let samples = settings.samples.min(MOST_AUXILIARY_SAMPLES);
        let auxiliary = |method| {
            let settings = Settings { method, samples, direct: Direct::default(), ..*settings };
            view.frame(&settings).map(|frame| frame.image)
        };
        let (albedo, normal) = (auxiliary(Method::Albedo)?, auxiliary(Method::Normal)?);
        (view.progress)(1.0, "denoising");
        let is_finite = |pixel: &[f32; 3]| pixel.iter().all(|channel| channel.is_finite());
        let finite = |pixel: &[f32; 3]| if is_finite(pixel) { *pixel } else { [0.0; 3] };
        let color: Vec<_> = noisy.pixels.iter().map(finite).collect();
        let mut pixels = self.device.denoise(&Inputs {
            size: [noisy.width as usize, noisy.height as usize],
            color: &color,
            albedo: &albedo.pixels,
            normal: &normal.pixels,
            clean: samples >= CLEAN_AUXILIARY_SAMPLES,
        })?;
        for (pixel, noisy) in pixels.iter_mut().zip(&noisy.pixels) {
            if !is_finite(noisy) {
                *pixel = *noisy;
            }
        }
        Ok(Image { pixels, ..*noisy })
    }
}
