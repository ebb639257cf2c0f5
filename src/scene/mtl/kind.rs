//! What kind of surface a material of MTL is.
//!
//! Writers do not agree on what makes a glass. Maya and DAZ Studio write `illum 4` for all they
//! have, Cinema 4D `illum 7`; MeshLab, OpenMVS and others write `Tr 1` for what is opaque, which by
//! the format would not be there at all. So none of these words is taken alone:
//!
//! - 0 < d < 1 is a glass, tinted by `Kd` as far as it is opaque;
//! - d of 0 is a glass if there is no colour to show, or if `illum` and `Ni` say so as well and
//!   `Kd` is grey; else it is opaque;
//! - `illum` 4, 6, 7 and 9 are a glass if `Tf` is neither 0 nor 1, or if `Kd` is black and without
//!   a map; but black with `Tf` and `Ni` of 1 is Maya's black paint;
//! - a map of the opacity has the last word: it cuts out.
//!
//! `illum` 0 and 1 have no highlight, whatever `Ks` is.

use glam::DVec3;

use super::faults::Faults;
use super::material::MtlMaterial;

/// Exponent from which on a highlight is a mirror's.
const MIRROR_SHININESS: f64 = 1000.0;

/// From this opacity on, a surface is opaque: writers round.
const OPAQUE: f64 = 0.99;

/// How light leaves a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    Diffuse,
    /// With this specular reflectance.
    Phong(DVec3),
    Mirror,
    /// This much of it is opaque, in [0, 1).
    Glass(f64),
}

impl MtlMaterial {
    /// The kind, by what the statements say together; what one of them says alone is named.
    pub(super) fn kind(&self, faults: &mut Faults) -> Kind {
        if let Some(opacity) = self.glass(faults) {
            return Kind::Glass(opacity);
        }
        if self.transmission.is_some_and(is_partial) {
            faults.changes.push("has a Tf, not shown by what is opaque".to_owned());
        }
        let specular = self.specular_reflectance(faults);
        let reflects = self.illum_is(&[3.0, 5.0]);
        let smooth = self.shininess >= MIRROR_SHININESS;
        if specular == DVec3::ZERO {
            Kind::Diffuse
        } else if reflects && (smooth || !self.has_colour()) {
            if self.diffuse.is_some_and(|diffuse| diffuse != DVec3::ZERO) {
                faults.changes.push("has a Kd, not shown by mirrors".to_owned());
            }
            Kind::Mirror
        } else if self.shininess <= 0.0 && self.has_colour() {
            // As wide as the whole sky, it would wash the colour out.
            let what = "has a Ks without an Ns above 0, a highlight of no shape; left out";
            faults.changes.push(what.to_owned());
            Kind::Diffuse
        } else {
            Kind::Phong(specular)
        }
    }

    /// How opaque it is, if it is a glass.
    fn glass(&self, faults: &mut Faults) -> Option<f64> {
        let opacity = self.opacity(faults);
        if self.opacity_map.is_some() {
            if opacity < OPAQUE {
                faults.notes.push(format!("has a map_d over an opacity of {opacity}, read as 1"));
            }
            return None;
        }
        let refracts = self.illum_is(&[4.0, 6.0, 7.0, 9.0]);
        let ior = self.refraction.unwrap_or(1.0);
        if opacity <= 0.0 {
            let agreed = refracts && ior > 1.0 && self.diffuse_map.is_none() && self.is_grey();
            if agreed || !self.has_colour() {
                return Some(0.0);
            }
            let what = "is clear by its d or Tr, but has a colour or a map_Kd; read as opaque";
            faults.notes.push(what.to_owned());
            return None;
        }
        if opacity < OPAQUE {
            return Some(opacity);
        }
        let painted = self.transmission == Some(DVec3::ONE) && self.refraction == Some(1.0);
        let clear = !self.has_colour() && !painted;
        let filters = self.transmission.is_some_and(is_partial);
        (refracts && (filters || clear)).then_some(0.0)
    }

    /// That of `d`, or what `Tr` leaves.
    fn opacity(&self, faults: &mut Faults) -> f64 {
        let of_tr = self.transparency.map(|transparency| 1.0 - transparency);
        let opacity = match (self.dissolve, of_tr) {
            (Some(d), Some(1.0)) if d <= 0.0 => {
                faults.notes.push("has a d of 0 beside a Tr of 0, read as opaque".to_owned());
                1.0
            }
            (Some(d), _) => d,
            (None, of_tr) => of_tr.unwrap_or(1.0),
        };
        opacity.clamp(0.0, 1.0)
    }

    /// `Ks`, where `illum` has a highlight. Blender writes its slider there, of which 1 means that 8 %
    /// are reflected.
    fn specular_reflectance(&self, faults: &mut Faults) -> DVec3 {
        /// What Blender's slider is multiplied by.
        const SLIDER: f64 = 0.08;
        let DVec3 { x, y, z } = self.specular;
        if self.specular == DVec3::ZERO {
            return DVec3::ZERO;
        }
        if self.illum_is(&[0.0, 1.0]) {
            faults.notes.push("has a Ks, of which its illum of 0 or 1 shows nothing".to_owned());
            return DVec3::ZERO;
        }
        let slider = self.is_blenders() && x == y && y == z && self.illum_is(&[2.0]);
        if slider && self.shininess > 0.0 {
            let percent = 100.0 * SLIDER * x;
            let what = format!("has Blender's Ks of {x}, which means {percent:.1} %");
            faults.notes.push(what);
            return SLIDER * self.specular;
        }
        self.specular
    }

    pub(super) fn illum_is(&self, any: &[f64]) -> bool {
        self.illumination.is_some_and(|illumination| any.contains(&illumination))
    }

    /// Whether its diffuse part is not black.
    pub(super) fn has_colour(&self) -> bool {
        self.diffuse_map.is_some() || self.diffuse.unwrap_or_default() != DVec3::ZERO
    }

    fn is_grey(&self) -> bool {
        let diffuse = self.diffuse.unwrap_or_default();
        diffuse.max_element() - diffuse.min_element() < 0.02
    }

    /// Whether Blender wrote it: the file says so, or its statements are in Blender's order, with the
    /// ambient of what is no metal.
    fn is_blenders(&self) -> bool {
        const ORDER: [&str; 8] = ["ns", "ka", "kd", "ks", "ke", "ni", "d", "illum"];
        self.says_blender || (self.order.starts_with(&ORDER) && self.ambient == Some(DVec3::ONE))
    }
}

/// Whether a `Tf` says something: some writers have 0 and others 1 for what is opaque.
pub(super) fn is_partial(transmission: DVec3) -> bool {
    transmission != DVec3::ZERO && transmission != DVec3::ONE
}
