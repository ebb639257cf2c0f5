//! What the user should know about a frame, and what `--strict` makes of it.

use crate::error::Error;
use crate::render::{Bounces, Frame, Method, Settings};
use crate::scene::{Scene, Warning};

/// What a warning is under `--strict`.
///
/// # Errors
/// It changes the image.
pub fn strict(warning: &Warning) -> Result<(), Error> {
    match warning.changes_image {
        true => Err(Error::Strict(format!("{} (an error under --strict)", warning.message))),
        false => Ok(()),
    }
}

/// What a frame is under `--strict`.
///
/// # Errors
/// It lacks something that the settings ask for, or has pixels that are not finite.
pub fn strictly(frame: &Frame, settings: &Settings) -> Result<(), Error> {
    of_frame(frame, settings)
        .try_for_each(|message| strict(&Warning { message, changes_image: true }))
}

/// What a frame lacks.
pub fn of_frame(frame: &Frame, settings: &Settings) -> impl Iterator<Item = String> {
    missing_vpls(frame, settings).into_iter().chain(nonfinite_pixels(frame))
}

/// What of the light that mirrors and glass turn onto surfaces the method does not find.
pub fn caustics(scene: &Scene, settings: &Settings) -> Option<Warning> {
    if !scene.has_specular() || settings.bounces == Bounces::Finite(0) {
        return None;
    }
    // Paths find a light by running into it.
    let points = scene.point_lights.len() + scene.directional_lights.len();
    let extended = scene.light_count() > points;
    let (name, method) = (&scene.name, settings.method.name());
    if settings.method.is_indirect() {
        let path = match extended {
            true => "--method path has it",
            false => "nor has --method path, as the lights have no extent",
        };
        let what = "light that reaches a surface only through mirror or glass (a caustic seen \
                    directly) is not in the image of method";
        let lost = match settings.compensates() && scene.has_hidden_caustics() {
            true => {
                "; and what the bound takes of light that mirror or glass have turned is not given \
                 back where its source has no extent"
            }
            false => "",
        };
        return Some(Warning::note(format!("{name}: {what} {method}; {path}{lost}")));
    }
    (settings.method == Method::Path && scene.has_hidden_caustics()).then(|| {
        let what = "light of point, spot and directional lights that reaches a surface only \
                    through mirror or glass (a caustic) cannot be found by paths from the camera; \
                    give the lights extent";
        Warning::note(format!("{name}: {what}"))
    })
}

fn missing_vpls(frame: &Frame, settings: &Settings) -> Option<String> {
    let wanted = settings.traces_light_paths();
    (wanted && frame.counts.vpls == 0).then(|| {
        "no light path left a VPL, so the image renders direct light alone: no light reaches a \
         surface, or what they reach is black, mirror or glass"
            .to_owned()
    })
}

/// The renderer's count, and where in the image the first of them is.
fn nonfinite_pixels(frame: &Frame) -> Option<String> {
    let first = frame.image.first_nonfinite();
    let count = frame.counts.nonfinite_pixels.max(u64::from(first.is_some()));
    let at = first.map_or(String::new(), |[x, y]| format!(", the first at column {x}, row {y}"));
    (count > 0).then(|| format!("{count} pixels are not finite{at}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::Image;
    use crate::render::{Counts, Phases};
    use crate::scene::{Bsdf, PointLight};

    fn frame(vpls: u64, pixel: f32) -> Frame {
        let image = Image { width: 2, height: 1, pixels: vec![[0.0; 3], [0.0, pixel, 0.0]] };
        let counts = Counts { vpls, ..Counts::default() };
        Frame {
            image,
            standard_error: None,
            counts,
            phases: Phases::default(),
            dispatches: Vec::new(),
        }
    }

    fn messages(frame: &Frame, settings: &Settings) -> Vec<String> {
        let messages: Vec<_> = of_frame(frame, settings).collect();
        assert_eq!(strictly(frame, settings).is_err(), !messages.is_empty());
        messages
    }

    #[test]
    fn a_frame_without_faults_is_not_warned_of() {
        assert_eq!(messages(&frame(1, 0.0), &Settings::default()), [""; 0]);
    }

    #[test]
    fn missing_vpls_are_told_where_they_are_wanted() {
        let settings = Settings::default();
        assert!(messages(&frame(0, 0.0), &settings)[0].contains("direct light alone"));
        let none_wanted = Settings { bounces: Bounces::Finite(0), ..settings };
        assert_eq!(messages(&frame(0, 0.0), &none_wanted), [""; 0]);
        let normals = Settings { method: Method::Normal, ..settings };
        assert_eq!(messages(&frame(0, 0.0), &normals), [""; 0]);
    }

    #[test]
    fn a_pixel_that_is_not_finite_is_located() {
        let messages = messages(&frame(1, f32::NAN), &Settings::default());
        assert_eq!(messages, ["1 pixels are not finite, the first at column 1, row 0"]);
    }

    fn told(scene: &Scene, method: Method) -> Option<String> {
        let warning = caustics(scene, &Settings::of(method))?;
        assert!(!warning.changes_image, "{}", warning.message);
        Some(warning.message)
    }

    #[test]
    fn caustics_that_a_method_does_not_find_are_told() {
        let vpls = [Method::Vpl, Method::Vplc, Method::Vpc, Method::Both];
        let mut scene = Scene::load("builtin:cornell").unwrap();
        assert!(vpls.iter().all(|method| told(&scene, *method).is_none()));

        scene.materials[0].bsdf = Bsdf::Mirror { specular: glam::Vec3::ONE };
        for method in vpls {
            let message = told(&scene, method).unwrap();
            let ends =
                format!("not in the image of method {}; --method path has it", method.name());
            assert!(message.starts_with("builtin:cornell: light"), "{message}");
            assert!(message.ends_with(&ends), "{message}");
        }
        assert!(told(&scene, Method::Path).is_none(), "paths run into the lamp");
        assert!(told(&scene, Method::Normal).is_none());
        let direct = Settings { bounces: Bounces::Finite(0), ..Settings::default() };
        assert!(caustics(&scene, &direct).is_none(), "no indirect light is asked for");

        let [position, intensity] = [glam::Vec3::ZERO, glam::Vec3::ONE];
        scene.point_lights.push(PointLight { position, intensity, cone: None });
        assert!(told(&scene, Method::Path).unwrap().contains("cannot be found by paths"));
        scene.materials.iter_mut().for_each(|material| material.emission = glam::Vec3::ZERO);
        assert!(told(&scene, Method::Both).unwrap().ends_with("have no extent"));
    }
}
