//! What a material of MTL looks like, its [kind](super::kind) known.
//!
//! Of what light a glass lets on, `Tf` is the share where it is neither 0 nor 1; else it is that of
//! what is half transparent: 1 - d (1 - Kd). Files hold black or no `Ks` for glass that is clear.

use glam::DVec3;

use super::faults::Faults;
use super::kind::{Kind, is_partial};
use super::map::Map;
use super::material::MtlMaterial;
use super::omitted::{self, OMITTED};
use crate::scene::mesh::DEFAULT_ALBEDO;
use crate::scene::omission::Omission;
use crate::scene::texture::{Part, read_image};
use crate::scene::{Bsdf, Draft, DraftMaterial, Origin, SceneError, Warning, normalise};

/// The largest exponent that can be rendered.
const MOST_SHININESS: f64 = 1e6;

/// Index of refraction of what gives none, or none that can be.
const DEFAULT_REFRACTION: f64 = 1.5;

impl MtlMaterial {
    /// Adds the material and its textures, with one warning about what of it is not shown.
    pub fn add_to(&self, draft: &mut Draft) -> Result<u32, SceneError> {
        let mut faults = Faults::default();
        let kind = self.kind(&mut faults);
        let tint = match kind {
            Kind::Glass(opacity) => self.tint(opacity, draft, &mut faults),
            _ => DVec3::ONE,
        };
        let (albedo, bsdf) = self.reflection(kind, tint, &mut faults);
        let emission = self.emission.filter(|&e| self.emission_map.is_none() || e != DVec3::ZERO);
        let unlit = if self.emission_map.is_some() { DVec3::ONE } else { DVec3::ZERO };
        if self.emission == Some(DVec3::ZERO) && self.emission_map.is_some() {
            faults.notes.push("has a map_Ke over a Ke of 0, read as 1".to_owned());
        }
        let specular = bsdf.is_specular();
        if kind == Kind::Mirror && self.diffuse_map.is_some() {
            faults.changes.push("has a map_Kd, not shown by mirrors".to_owned());
        }
        self.name_omitted(&mut faults);
        let diffuse_map = self.diffuse_map.as_ref().filter(|_| !specular);
        let texture = diffuse_map.map(|map| self.texture(draft, map, Part::Color));
        if texture.is_some_and(|texture| draft.has_holes(texture)) && self.opacity_map.is_none() {
            let what = format!("has a map_Kd with alpha, {}", OMITTED[omitted::ALPHA].instead);
            faults.notes.push(what);
        }
        draft.warnings.extend(self.warning(faults));
        let material = DraftMaterial {
            name: self.name.clone(),
            albedo,
            texture,
            cutout: self.opacity_map.as_ref().map(|map| self.texture(draft, map, Part::Opacity)),
            bsdf,
            emission: emission.unwrap_or(unlit),
            emission_texture: self
                .emission_map
                .as_ref()
                .map(|map| self.texture(draft, map, Part::Color)),
            two_sided: false,
            origin: Origin::line(&self.file, self.line),
        };
        draft.add_material(material)
    }

    /// Names the statements that are not shown, a row of the list at a time.
    fn name_omitted(&self, faults: &mut Faults) {
        for (row, Omission { instead, changes_image, .. }) in OMITTED.iter().enumerate() {
            let of_row = self.omitted.iter().filter(|(of, _)| *of == row);
            let statements: Vec<&str> = of_row.map(|(_, statement)| statement.as_str()).collect();
            if !statements.is_empty() {
                let list = if *changes_image { &mut faults.changes } else { &mut faults.notes };
                list.push(format!("has {}, {instead}", statements.join(", ")));
            }
        }
    }

    /// That it is left out, if another of its name came before.
    pub fn as_second(&self) -> Option<Warning> {
        let what =
            format!("a second material `{}`, {}", self.name, OMITTED[omitted::SECOND].instead);
        self.again.then(|| Origin::line(&self.file, self.line).note(what))
    }

    /// Whether a map gives its colour.
    pub fn is_textured(&self) -> bool {
        self.diffuse_map.is_some()
    }

    /// What of the light a glass lets on; a colour that has no part in it is named.
    fn tint(&self, opacity: f64, draft: &mut Draft, faults: &mut Faults) -> DVec3 {
        if let Some(tint) = self.transmission.filter(|&tint| is_partial(tint)) {
            if self.has_colour() {
                faults.changes.push("has a Kd or map_Kd, not shown by a glass of a Tf".to_owned());
            }
            return tint;
        }
        if !self.has_colour() {
            return DVec3::ONE;
        }
        if opacity <= 0.0 {
            faults.notes.push("has a Kd, not shown by clear glass".to_owned());
            return DVec3::ONE;
        }
        let mean = match &self.diffuse_map {
            None => DVec3::ONE,
            Some(map) => {
                let what = "has a map_Kd on what is half transparent, of which the mean is used";
                faults.changes.push(what.to_owned());
                let path = map.path(&self.file, self.encoding, &mut draft.warnings);
                let origin = Origin::line(&self.file, map.line);
                let means = draft.image_means(&path, &origin, "1 is used", || read_image(&path));
                means.map_or(DVec3::ONE, |means| means.light)
            }
        };
        let colour = (self.albedo() * mean).clamp(DVec3::ZERO, DVec3::ONE);
        DVec3::ONE - opacity * (DVec3::ONE - colour)
    }

    /// Albedo and BSDF, made to reflect no more than they receive.
    fn reflection(&self, kind: Kind, tint: DVec3, faults: &mut Faults) -> (DVec3, Bsdf) {
        let mut within = |what: &str, sum: DVec3| {
            let most = sum.max_element();
            if most <= 1.0 {
                return 1.0;
            }
            faults
                .changes
                .push(format!("reflects more than it receives ({what} = {most:.4}), scaled to 1"));
            most
        };
        // Division may round up.
        let scaled =
            |value: DVec3, by: f64| if by > 1.0 { (value / by).min(DVec3::ONE) } else { value };
        match kind {
            Kind::Mirror => {
                let by = within("Ks", self.specular);
                let specular = normalise::round(scaled(self.specular, by));
                (DVec3::ZERO, Bsdf::Mirror { specular })
            }
            Kind::Glass(_) => {
                let by = within("Tf", tint);
                let specular = normalise::round(scaled(tint, by));
                let given = self.refraction.unwrap_or(DEFAULT_REFRACTION);
                let possible = (0.1..=10.0).contains(&given);
                if !possible {
                    faults.changes.push(format!("has an impossible Ni of {given}, 1.5 is used"));
                }
                let ior = if possible { given } else { DEFAULT_REFRACTION } as f32;
                (DVec3::ZERO, Bsdf::Glass { specular, ior })
            }
            Kind::Phong(specular) => {
                let by = within("Kd + Ks", self.albedo() + specular);
                let specular = normalise::round(scaled(specular, by));
                let shininess = self.shininess.clamp(0.0, MOST_SHININESS) as f32;
                let albedo = scaled(self.albedo(), by);
                self.note_albedo(faults);
                (albedo, Bsdf::Phong { specular, shininess })
            }
            Kind::Diffuse => {
                let by = within("Kd", self.albedo());
                let albedo = scaled(self.albedo(), by);
                self.note_albedo(faults);
                (albedo, Bsdf::Diffuse)
            }
        }
    }

    /// A colour of 0 would make its map of no use.
    fn albedo(&self) -> DVec3 {
        let emits = self.emission.is_some() || self.emission_map.is_some();
        match self.diffuse {
            Some(DVec3::ZERO) | None if self.diffuse_map.is_some() => DVec3::ONE,
            Some(diffuse) => diffuse,
            None if emits => DVec3::ZERO,
            None => DEFAULT_ALBEDO,
        }
    }

    fn note_albedo(&self, faults: &mut Faults) {
        let emits = self.emission.is_some() || self.emission_map.is_some();
        match (self.diffuse, &self.diffuse_map) {
            (Some(DVec3::ZERO), Some(_)) => {
                faults.notes.push("has a map_Kd over a Kd of 0, read as 1".to_owned());
            }
            (None, None) if !emits => faults.notes.push("has no Kd, 0.8 is used".to_owned()),
            _ => {}
        }
    }

    /// The texture of a map; what of its options is not shown is a warning.
    fn texture(&self, draft: &mut Draft, map: &Map, part: Part) -> u32 {
        let origin = Origin::line(&self.file, map.line);
        if !map.ignored.is_empty() {
            let (keyword, options) = (&map.keyword, map.ignored.join(", "));
            let what = format!("{keyword} has {options}, not supported; left out");
            draft.warnings.push(origin.changed(what));
        }
        let path = map.path(&self.file, self.encoding, &mut draft.warnings);
        let image = draft.image(&path, part, &origin, || read_image(&path));
        draft.add_texture(map.texture(image))
    }

    fn warning(&self, Faults { changes, notes }: Faults) -> Option<Warning> {
        let changes_image = !changes.is_empty();
        let faults = [changes, notes].concat();
        let message = || {
            let Self { file, line, name, .. } = self;
            format!("{}:{line}: material `{name}` {}", file.display(), faults.join("; "))
        };
        (!faults.is_empty()).then(|| Warning { changes_image, ..Warning::note(message()) })
    }
}
