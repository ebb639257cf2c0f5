//! The frames that take an error apart. With R the reference, I the image, D direct light of the
//! same visible points and shadow rays, G the indirect light of the same VPLs, all of one seed:
//!
//! ```text
//! I - R = (D - D_many)                               direct light, by its shadow rays
//!       + (D_many - D_pixel) + (G - G_pixel)         antialiasing: many camera samples a pixel
//!       - (light given back of many samples)         the bound on near VPLs
//!       + (I - I of `vpl`)                           shared visibility
//!       + (I - I without interleaving)               interleaving
//!       + the rest                                   too few VPLs
//! ```
//!
//! G is a frame without direct light and without interleaving, less its emission. Of `vpl` is
//! [`unclustered`]. Clusters are found anew among the visible points of all samples, so that
//! G_pixel shares otherwise, too.

use std::time::Instant;

use super::terms::{self, Estimate, FEWER};
use crate::error::Error;
use crate::image::Image;
use crate::render::{Clamp, Direct, Method, Settings};
use crate::study::measure::Bench;
use crate::study::parts::{Decomposition, Part};
use crate::study::plan::unclustered;
use crate::study::reference::Reference;
use crate::study::store::{Store, name_of};
use crate::study::{Event, Tell, options};

/// Camera samples of a pixel in which direct light is converged over it.
const FILM_SAMPLES: u32 = 64;
/// Camera samples of indirect light for each of the image's own, and the most.
const CAMERA_SAMPLES: u32 = 16;
/// The seed of what all seeds share, far from those of rows.
const FILM_SEED: u32 = 0x5eed_1000;

/// The frames of a scene.
pub struct Frames<'a, 'scene> {
    /// Renders the scene.
    pub bench: &'a Bench<'scene>,
    /// Keeps frames, so that what was broken off goes on.
    pub store: &'a mut Store,
    /// The scene's key in the store.
    pub key: &'a str,
    /// Its name.
    pub scene: &'a str,
    /// Told of every frame.
    pub tell: Tell<'a>,
    /// Shadow rays to lights, a pixel, of converged direct light.
    pub light_samples: u32,
    /// Names of frames rendered that no other settings need.
    rendered: Vec<String>,
}

impl<'a, 'scene> Frames<'a, 'scene> {
    /// Nothing is rendered yet.
    pub fn new(
        bench: &'a Bench<'scene>,
        store: &'a mut Store,
        [key, scene]: [&'a str; 2],
        light_samples: u32,
        tell: Tell<'a>,
    ) -> Self {
        Self { bench, store, key, scene, tell, light_samples, rendered: Vec::new() }
    }

    /// Renders what is not kept, and takes the error of an image apart; `sharing` asks for exact
    /// visibility, too. None if there is no pixel to compare.
    ///
    /// # Errors
    /// The device fails, the disk is full, or the user interrupts.
    pub fn decomposition(
        &mut self,
        settings: &Settings,
        seed: u32,
        reference: &Reference,
        sharing: bool,
    ) -> Result<Option<Decomposition>, Error> {
        let image = self.frame(settings, seed)?;
        let own = self.frame(&direct(settings), seed)?;
        let many = self.many_light_samples(settings, seed)?;
        let mut film = many.minus(&self.film(settings)?);
        let mut terms = Vec::new();
        if settings.direct != Direct::Off {
            terms.push((Part::Direct, own.minus(&many)));
        }
        let indirect = settings.traces_light_paths();
        if indirect {
            let whole = whole(settings);
            let own = self.indirect(&whole, settings.samples, seed)?;
            let many = self.over_pixel(camera_samples(settings), |this, samples| {
                this.indirect(&whole, samples, seed)
            })?;
            film = film.plus(1.0, &own.minus(&many));
            if settings.clamp != Clamp::Off {
                terms.push((Part::Clamp, self.clamp(settings, &many, seed)?));
            }
        }
        terms.push((Part::Antialiasing, film));
        if let Some(base) = unclustered(settings).filter(|_| sharing && indirect) {
            terms.push((Part::Sharing, image.minus(&self.frame(&base, seed)?)));
        }
        if settings.interleaves() && indirect {
            let whole = Settings { interleave: 1, ..*settings };
            terms.push((Part::Interleaving, image.minus(&self.frame(&whole, seed)?)));
        }
        Ok(terms::decomposition(&reference.image, &reference.lens.keep, &image, terms, indirect))
    }

    /// Forgets the frames rendered here that no other settings need.
    pub fn forget(&mut self) {
        for name in self.rendered.drain(..) {
            self.store.remove_image(&name);
        }
    }

    /// Direct light at the image's own visible points, by many shadow rays.
    fn many_light_samples(&mut self, settings: &Settings, seed: u32) -> Result<Estimate, Error> {
        let direct = direct(settings);
        if direct.direct == Direct::Off {
            return self.frame(&direct, seed);
        }
        let least = FEWER * settings.light_samples_per_point();
        let rays = self.light_samples.div_ceil(settings.samples).max(least);
        let rays = rays.min(Settings::MOST_LIGHT_SAMPLES);
        let with =
            |rays: u32| Settings { light_samples: Some(rays), direct_filter: false, ..direct };
        let few = self.frame(&with(rays / FEWER), seed)?;
        Ok(Estimate::converged(self.frame(&with(rays), seed)?, &few))
    }

    /// Direct light converged over the pixel, whatever the image's samples are.
    fn film(&mut self, settings: &Settings) -> Result<Estimate, Error> {
        let light = Settings { direct: direct(settings).direct, ..Settings::of(Method::Direct) };
        let light_samples = match light.direct {
            Direct::Off => None,
            _ => Some(self.light_samples.div_ceil(FILM_SAMPLES)),
        };
        self.over_pixel(FILM_SAMPLES, |this, samples| {
            this.frame(
                &Settings { samples, light_samples, direct_filter: false, ..light },
                FILM_SEED,
            )
        })
    }

    /// What the image has too little on account of the bound: light given back by itself, if it is,
    /// less light given back from many camera samples. `many` is indirect light of these, bounded.
    fn clamp(
        &mut self,
        settings: &Settings,
        many: &Estimate,
        seed: u32,
    ) -> Result<Estimate, Error> {
        let given = Settings { compensate: true, ..whole(settings) };
        let all = self.over_pixel(camera_samples(settings), |this, samples| {
            this.indirect(&given, samples, seed)
        })?;
        // Noise of camera samples is the same in both, and not in their difference.
        let missing = many.minus(&all);
        if !settings.compensates() {
            return Ok(missing);
        }
        let bounded = Settings { compensate: false, ..*settings };
        let bounded = self.indirect(&bounded, settings.samples, seed)?;
        let own = self.indirect(settings, settings.samples, seed)?.minus(&bounded);
        Ok(own.plus(1.0, &missing))
    }

    /// Indirect light alone: a frame without direct light, less its emission.
    fn indirect(
        &mut self,
        settings: &Settings,
        samples: u32,
        seed: u32,
    ) -> Result<Estimate, Error> {
        // Shadow rays to lights have no part in it, nor in the names of its frames.
        let alone = Settings { direct: Direct::Off, samples, light_samples: None, ..*settings };
        let emission = self.frame(&Settings { method: Method::Direct, ..alone }, seed)?;
        Ok(self.frame(&alone, seed)?.minus(&emission))
    }

    /// From many camera samples, and from a quarter of them.
    fn over_pixel(
        &mut self,
        samples: u32,
        mut frame: impl FnMut(&mut Self, u32) -> Result<Estimate, Error>,
    ) -> Result<Estimate, Error> {
        let few = frame(self, (samples / FEWER).max(1))?;
        Ok(Estimate::converged(frame(self, samples)?, &few))
    }

    /// A frame, from the store if it is there.
    fn frame(&mut self, settings: &Settings, seed: u32) -> Result<Estimate, Error> {
        Ok(Estimate::exact(&self.image(settings, seed)?))
    }

    fn image(&mut self, settings: &Settings, seed: u32) -> Result<Image, Error> {
        let name = name_of(&options::of_frame(self.key, settings, seed));
        if let Some(image) = self.store.image(&name) {
            return Ok(image);
        }
        let start = Instant::now();
        let image = self.bench.image(settings, seed)?;
        self.store.put_image(&name, &image)?;
        if settings.method != Method::Direct {
            self.rendered.push(name);
        }
        let seconds = start.elapsed().as_secs_f64();
        (self.tell)(Event::Part { scene: self.scene, settings, seed, seconds });
        Ok(image)
    }
}

/// Direct light alone, from the same visible points by the same shadow rays; from every point where
/// clusters share it, which is an error of sharing.
fn direct(settings: &Settings) -> Settings {
    let direct = match settings.direct {
        Direct::Off => Direct::Off,
        Direct::PerPixel | Direct::Clustered => Direct::PerPixel,
    };
    Settings { method: Method::Direct, direct, ..*settings }
}

/// All VPLs at every pixel, bounded: light that is the same for all samples of a pixel.
fn whole(settings: &Settings) -> Settings {
    Settings { interleave: 1, compensate: false, ..*settings }
}

/// So many camera samples that antialiasing is converged, as indirect light is dear.
fn camera_samples(settings: &Settings) -> u32 {
    settings.samples.max(settings.samples.saturating_mul(CAMERA_SAMPLES).min(FILM_SAMPLES))
}
