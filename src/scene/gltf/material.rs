//! Metal-roughness materials, as the nearest that can be rendered.
//!
//! With m the metalness, b the base colour and r the roughness:
//!
//! - transmission of more than one half is glass, tinted by b;
//! - m of one half and more with r < 0.05 is a mirror of b;
//! - no metal with r ≥ 0.6 is diffuse;
//! - all else is Phong, whose albedo is 0.96 (1 - m) b, its specular reflectance
//!   0.04 (1 - m) + m b, and its exponent 2 / α² - 2 with α = r². They never exceed 1 together.
//!
//! Textures vary albedo, emission and what is cut out. A mirror, a glass and a highlight have
//! one colour: the texture's mean. So have metalness and roughness. `BLEND` cuts out what is
//! less than half opaque, as `MASK` does.

use glam::DVec3;
use serde_json::Value;

use super::json::{self, TextureInfo};
use super::source::Source;
use super::texture::{self, Image, Layout};
use crate::scene::texture::{Part, decode::Means};
use crate::scene::{
    Bsdf, Draft, DraftMaterial, Origin, SceneError, Texels, Texture, Warning, normalise,
};

const STRENGTH: &str = "KHR_materials_emissive_strength";
const TRANSMISSION: &str = "KHR_materials_transmission";
const IOR: &str = "KHR_materials_ior";

/// Writers round colours to f32: this much above 1 is 1.
const ROUNDING: f64 = 1e-6;

/// What a dielectric mirrors head on.
const DIELECTRIC: f64 = 0.04;

/// A highlight of this roughness and more is as good as diffuse.
const ROUGH: f64 = 0.6;

/// A metal smoother than this is a mirror.
const SMOOTH: f64 = 0.05;

/// The largest exponent: what is smoother than r = 0.066 gets it.
const MOST_SHININESS: f64 = 1e5;

/// A material's name, or one made of its index.
pub fn name(source: &Source, index: usize) -> String {
    let name = source.document.materials.get(index).and_then(|material| material.name.clone());
    name.filter(|name| !name.is_empty()).unwrap_or_else(|| format!("material {index}"))
}

/// Adds a material and its textures, with one warning about what of it is not shown.
pub fn add(source: &Source, index: usize, draft: &mut Draft) -> Result<u32, SceneError> {
    let json = source.item(&source.document.materials, "material", index)?;
    let mut reader = Reader { source, json, name: name(source, index), draft, lost: Vec::new() };
    let material = reader.read()?;
    let Reader { name, draft, lost, .. } = reader;
    if !lost.is_empty() {
        let what = format!("material `{name}` has {}, not shown as it is", lost.join(", "));
        draft.warnings.push(Warning::changed(source.says(&what)));
    }
    draft.add_material(material)
}

struct Reader<'a> {
    source: &'a Source,
    json: &'a json::Material,
    name: String,
    draft: &'a mut Draft,
    /// What is not shown as it is.
    lost: Vec<String>,
}

impl Reader<'_> {
    fn read(&mut self) -> Result<DraftMaterial, SceneError> {
        let json = self.json;
        self.note_unknown();
        let [r, g, b, alpha] = json.base_factor();
        let rounded = |x: f64| if x > 1.0 && x <= 1.0 + ROUNDING { 1.0 } else { x };
        let base = DVec3::new(r, g, b).map(rounded);
        let (albedo, bsdf) = self.surface(base)?;
        let emission = DVec3::from_array(json.emissive_factor.unwrap_or_default())
            * self.extension(STRENGTH, "emissiveStrength", 1.0)?;
        let base_texture = json.base_texture();
        let is_glass = matches!(bsdf, Bsdf::Glass { .. });
        Ok(DraftMaterial {
            name: self.name.clone(),
            albedo,
            texture: self.texture(base_texture.filter(|_| albedo != DVec3::ZERO))?,
            cutout: if is_glass { None } else { self.cutout(alpha)? },
            bsdf,
            emission,
            emission_texture: self
                .texture(json.emissive_texture.as_ref().filter(|_| emission != DVec3::ZERO))?,
            two_sided: json.double_sided,
            origin: Origin::file(&self.source.path),
        })
    }

    /// Albedo and bsdf.
    fn surface(&mut self, base: DVec3) -> Result<(DVec3, Bsdf), SceneError> {
        if !base.to_array().iter().all(|c| (0.0..=1.0).contains(c)) {
            // The draft refuses it by its name.
            return Ok((base, Bsdf::Diffuse));
        }
        let transmission = self.extension(TRANSMISSION, "transmissionFactor", 0.0)?;
        if transmission > 0.5 {
            let ior = self.extension(IOR, "ior", 1.5)? as f32;
            let specular = normalise::round(base * self.mean_base()?);
            return Ok((DVec3::ZERO, Bsdf::Glass { specular, ior }));
        }
        if transmission > 0.0 {
            self.lost.push("a little transmission".to_owned());
        }
        if self.json.extensions.unlit.is_some() {
            self.lost.push("KHR_materials_unlit, lit as any surface".to_owned());
            return Ok((base, Bsdf::Diffuse));
        }
        if let Some(glossy) = &self.json.extensions.specular_glossiness {
            return self.specular_glossiness(base, glossy);
        }
        let [metalness, roughness] = self.metalness_and_roughness()?;
        if metalness == 0.0 && roughness >= ROUGH {
            return Ok((base, Bsdf::Diffuse));
        }
        let metal = match metalness > 0.0 {
            true => base * self.mean_base()?,
            false => DVec3::ZERO,
        };
        if metalness >= 0.5 && roughness < SMOOTH {
            return Ok((DVec3::ZERO, Bsdf::Mirror { specular: normalise::round(metal) }));
        }
        let albedo = (1.0 - DIELECTRIC) * (1.0 - metalness) * base;
        let specular = DIELECTRIC * (1.0 - metalness) + metalness * metal;
        Ok((albedo, phong(specular, roughness)))
    }

    /// `KHR_materials_pbrSpecularGlossiness`: a diffuse part under what is mirrored, whose largest
    /// channel it loses.
    fn specular_glossiness(
        &mut self,
        diffuse: DVec3,
        glossy: &json::SpecularGlossiness,
    ) -> Result<(DVec3, Bsdf), SceneError> {
        let mut specular = DVec3::from_array(glossy.specular_factor.unwrap_or([1.0; 3]));
        let mut glossiness = glossy.glossiness_factor.unwrap_or(1.0);
        if let Some(info) = &glossy.specular_glossiness_texture {
            self.lost.push("a specularGlossinessTexture, of which the mean is used".to_owned());
            if let Some(means) = self.means(info, "1 is used")? {
                specular *= means.light;
                glossiness *= means.alpha;
            }
        }
        let specular = specular.clamp(DVec3::ZERO, DVec3::ONE);
        let roughness = 1.0 - glossiness.clamp(0.0, 1.0);
        let albedo = (1.0 - specular.max_element()) * diffuse;
        if specular.max_element() <= 2.0 * DIELECTRIC && roughness >= ROUGH {
            return Ok((diffuse, Bsdf::Diffuse));
        }
        self.lost.push("KHR_materials_pbrSpecularGlossiness, shown by the nearest".to_owned());
        if specular == DVec3::ZERO {
            return Ok((diffuse, Bsdf::Diffuse));
        }
        if albedo == DVec3::ZERO && roughness < SMOOTH {
            return Ok((DVec3::ZERO, Bsdf::Mirror { specular: normalise::round(specular) }));
        }
        Ok((albedo, phong(specular, roughness)))
    }

    fn metalness_and_roughness(&mut self) -> Result<[f64; 2], SceneError> {
        let pbr = &self.json.pbr_metallic_roughness;
        let factors = [pbr.metallic_factor, pbr.roughness_factor]
            .map(|factor| factor.unwrap_or(1.0).clamp(0.0, 1.0));
        let Some(info) = &pbr.metallic_roughness_texture else { return Ok(factors) };
        self.lost.push("a metallicRoughnessTexture, of which the mean is used".to_owned());
        let means = self.means(info, "1 is used")?;
        let [_, roughness, metalness] = means.map_or([1.0; 3], |means| means.data.to_array());
        Ok([factors[0] * metalness, factors[1] * roughness])
    }

    /// The mean of the base colour's texture.
    fn mean_base(&mut self) -> Result<DVec3, SceneError> {
        let Some(info) = self.json.base_texture() else { return Ok(DVec3::ONE) };
        self.lost.push("a texture on what it mirrors, of which the mean is used".to_owned());
        let means = self.means(info, "magenta is shown")?;
        Ok(means.map_or(DVec3::new(1.0, 0.0, 1.0), |means| means.light))
    }

    fn means(&mut self, info: &TextureInfo, instead: &str) -> Result<Option<Means>, SceneError> {
        let image = Image::of(self.source, info)?;
        let origin = Origin::file(&self.source.path);
        Ok(self.draft.image_means(&image.path, &origin, instead, || image.read()))
    }

    fn texture(&mut self, info: Option<&TextureInfo>) -> Result<Option<u32>, SceneError> {
        info.map(|info| self.add_texture(info, Part::Color)).transpose()
    }

    fn add_texture(&mut self, info: &TextureInfo, part: Part) -> Result<u32, SceneError> {
        let Some(layout) = Layout::of(self.json) else {
            return Err(self.source.fault(format!("material `{}` has no texture", self.name)));
        };
        let (texture, lost) = texture::add(self.source, info, &layout, part, self.draft)?;
        self.lost.extend(lost.map(str::to_owned));
        Ok(texture)
    }

    /// The texture whose alpha of one half is the cutoff. An alpha that is the same all over
    /// cuts out all or nothing.
    fn cutout(&mut self, alpha: f64) -> Result<Option<u32>, SceneError> {
        let cutoff = match self.json.alpha_mode.as_deref() {
            Some("MASK") => self.json.alpha_cutoff.unwrap_or(0.5),
            Some("BLEND") => 0.5,
            _ => return Ok(None),
        };
        // The least alpha of the texture, in 255ths, that with the factor reaches the cutoff.
        let least = match alpha > 0.0 {
            true => (255.0 * cutoff / alpha - ROUNDING).ceil(),
            false if cutoff > 0.0 => f64::INFINITY,
            false => 0.0,
        };
        let blends = self.json.alpha_mode.as_deref() == Some("BLEND");
        let base = self.json.base_texture();
        let varies = match base {
            None => false,
            Some(info) => {
                let texture = self.add_texture(info, Part::Color)?;
                let image = self.draft.textures[texture as usize].image;
                self.draft.images[image as usize].rgba.iter().any(|texel| texel[3] != 255)
            }
        };
        if blends && (varies || alpha < 1.0) {
            let what = "transparency, cut out where it is less than half opaque";
            self.lost.push(what.to_owned());
        }
        if least > 255.0 {
            return Ok(Some(self.nothing()));
        }
        match base.filter(|_| varies && least > 0.0) {
            Some(info) => self.add_texture(info, Part::AlphaFrom(least as u8)).map(Some),
            None => Ok(None),
        }
    }

    /// A texture that is cut out all over.
    fn nothing(&mut self) -> u32 {
        let name = self.source.says(&format!("material `{}`", self.name));
        let image = self.draft.add_image(Texels { name, size: [1, 1], rgba: vec![[0; 4]] });
        self.draft.add_texture(Texture::of(image))
    }

    /// A number of an extension.
    fn extension(&self, extension: &str, key: &str, default: f64) -> Result<f64, SceneError> {
        let value =
            self.json.extensions.others.get(extension).and_then(|extension| extension.get(key));
        value.map_or(Some(default), Value::as_f64).ok_or_else(|| {
            let name = &self.name;
            self.source.fault(format!("material `{name}`: {key} is no number; export it again"))
        })
    }

    /// Occlusion is nothing that is lost: light finds its own.
    fn note_unknown(&mut self) {
        if self.json.normal_texture.is_some() {
            self.lost.push("a normalTexture".to_owned());
        }
        let known = [STRENGTH, TRANSMISSION, IOR];
        let unknown =
            self.json.extensions.others.keys().filter(|name| !known.contains(&name.as_str()));
        self.lost.extend(unknown.cloned());
    }
}

/// A lobe as wide as the highlight of this roughness.
fn phong(specular: DVec3, roughness: f64) -> Bsdf {
    let alpha = (roughness * roughness).max(1e-6);
    let shininess = (2.0 / (alpha * alpha) - 2.0).clamp(0.0, MOST_SHININESS) as f32;
    Bsdf::Phong { specular: normalise::round(specular), shininess }
}
