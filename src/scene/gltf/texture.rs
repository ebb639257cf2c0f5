//! Textures: where their images are, how they wrap, and how materials lay them on the one set
//! of texture coordinates that a triangle keeps.

use std::borrow::Cow;
use std::path::PathBuf;

use glam::{DMat2, DVec2, Vec2};

use super::json::{Material, TextureInfo, TextureTransform};
use super::source::Source;
use crate::scene::names::Found;
use crate::scene::texture::{Filter, Interpolation, Part, read_image};
use crate::scene::{Draft, Origin, SceneError, Texture, Wrap};

/// Which coordinates a material's triangles keep, and what they are multiplied by before:
/// [`Texture`] cannot turn an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layout {
    /// The n of `TEXCOORD_n`.
    pub set: usize,
    turn: DMat2,
}

impl Layout {
    /// That of a material's base colour, or else of its emission; none if it has no texture.
    pub fn of(material: &Material) -> Option<Self> {
        let base = material.base_texture();
        let info = base.or(material.emissive_texture.as_ref())?;
        let transform = info.transform();
        let turn = linear(&transform);
        let turned = transform.rotation != 0.0 && turn.determinant().is_normal();
        Some(Self { set: info.set(), turn: if turned { turn } else { DMat2::IDENTITY } })
    }

    /// The coordinates that are kept for those of the file.
    pub fn place(&self, uv: DVec2) -> Vec2 {
        (self.turn * uv).as_vec2()
    }
}

impl TextureInfo {
    fn transform(&self) -> TextureTransform {
        self.extensions.transform.clone().unwrap_or_default()
    }

    /// The n of the `TEXCOORD_n` it is laid on.
    fn set(&self) -> usize {
        let of_transform = self.extensions.transform.as_ref().and_then(|t| t.tex_coord);
        of_transform.unwrap_or(self.tex_coord)
    }
}

/// Scale, then rotation: against the clock where v points down.
fn linear(transform: &TextureTransform) -> DMat2 {
    let (sin, cos) = transform.rotation.sin_cos();
    let [x, y] = transform.scale.unwrap_or([1.0; 2]);
    DMat2::from_cols(x * DVec2::new(cos, -sin), y * DVec2::new(sin, cos))
}

/// The image of a texture.
#[derive(Debug)]
pub struct Image<'a> {
    /// Its file, or the file and the part that hold it.
    pub path: PathBuf,
    /// That it is another file than is named, if it is.
    pub note: Option<String>,
    bytes: Bytes<'a>,
}

#[derive(Debug)]
enum Bytes<'a> {
    File,
    Data(&'a str),
    Held(&'a [u8]),
    /// None, for a reason.
    Not(String),
}

impl<'a> Image<'a> {
    /// Finds the image of a texture, without reading it.
    pub fn of(source: &'a Source, info: &TextureInfo) -> Result<Self, SceneError> {
        let document = &source.document;
        let texture = source.item(&document.textures, "texture", info.index)?;
        let part = |part: String| PathBuf::from(source.says(&part));
        let webp = texture.extensions.webp.as_ref().map(|of_webp| of_webp.source);
        let Some(index) = webp.or(texture.source) else {
            let path = part(format!("texture {}", info.index));
            let bytes = Bytes::Not("has no PNG or JPEG".to_owned());
            return Ok(Self { path, note: None, bytes });
        };
        let image = source.item(&document.images, "image", index)?;
        let path = part(format!("image {index}"));
        let bytes = match (&image.uri, image.buffer_view) {
            (Some(uri), _) => match uri.strip_prefix("data:") {
                Some(data) => Bytes::Data(data),
                None => match source.beside(uri) {
                    Ok(Found { path, note }) => {
                        return Ok(Self { path, note, bytes: Bytes::File });
                    }
                    Err(what) => Bytes::Not(format!("cannot be read: {what}")),
                },
            },
            (None, Some(view)) => Bytes::Held(source.view(view)?.0),
            (None, None) => Bytes::Not("has neither a URI nor a buffer view".to_owned()),
        };
        Ok(Self { path, note: None, bytes })
    }

    /// The bytes of its file.
    pub fn read(&self) -> Result<Cow<'a, [u8]>, String> {
        match &self.bytes {
            Bytes::File => read_image(&self.path),
            Bytes::Data(data) => Source::decode(data).map(Cow::Owned),
            Bytes::Held(bytes) => Ok(Cow::Borrowed(bytes)),
            Bytes::Not(what) => Err(what.clone()),
        }
    }
}

/// Adds a texture, and says what of it is lost.
pub fn add(
    source: &Source,
    info: &TextureInfo,
    layout: &Layout,
    part: Part,
    draft: &mut Draft,
) -> Result<(u32, Option<&'static str>), SceneError> {
    let image = Image::of(source, info)?;
    let (wrap, filter) = sampling(source, info)?;
    let transform = info.transform();
    let placed = linear(&transform) * layout.turn.inverse();
    let (scale, skew) =
        (DVec2::new(placed.x_axis.x, placed.y_axis.y), [placed.x_axis.y, placed.y_axis.x]);
    let origin = Origin::file(&source.path);
    let note = image.note.as_ref().map(|note| origin.note(note));
    draft.warnings.extend(note.filter(|note| !draft.warnings.contains(note)));
    let image = draft.image(&image.path, part, &origin, || image.read());
    let offset = DVec2::from_array(transform.offset);
    let (laid, offset) = (scale.as_vec2(), offset.as_vec2());
    let texture = Texture { image, wrap, filter, scale: laid, offset };
    let lost = if info.set() != layout.set {
        Some("textures on different coordinates, laid on those of the first")
    } else if skew.iter().any(|skew| skew.abs() > 1e-6 * scale.abs().max_element()) {
        Some("textures turned differently, laid on as the first")
    } else {
        None
    };
    Ok((draft.add_texture(texture), lost))
}

/// How a texture wraps, and how it is filtered.
fn sampling(source: &Source, info: &TextureInfo) -> Result<([Wrap; 2], Filter), SceneError> {
    let texture = source.item(&source.document.textures, "texture", info.index)?;
    let Some(index) = texture.sampler else { return Ok(Default::default()) };
    let sampler = source.item(&source.document.samplers, "sampler", index)?;
    let unknown = |does: &str, code: u32| {
        let what = format!("sampler {index} {does} in the unknown way {code}");
        source.fault(what + "; export it again")
    };
    let wrap = |code: Option<u32>| match code {
        None | Some(10497) => Ok(Wrap::Repeat),
        // Also what OpenGL had before, whose borders are seen by nobody.
        Some(33071 | 10496 | 33069) => Ok(Wrap::Clamp),
        Some(33648) => Ok(Wrap::Mirror),
        Some(code) => Err(unknown("wraps", code)),
    };
    let magnified = match sampler.mag_filter {
        // Also what only minifies.
        None | Some(9729 | 9985 | 9987) => Interpolation::Linear,
        Some(9728 | 9984 | 9986) => Interpolation::Nearest,
        Some(code) => return Err(unknown("magnifies", code)),
    };
    // Whether mip levels are blended or not: the mean of several lookups is taken, which is better.
    let (minified, mipmaps) = match sampler.min_filter {
        Some(9728) => (Interpolation::Nearest, false),
        Some(9729) => (Interpolation::Linear, false),
        Some(9984 | 9986) => (Interpolation::Nearest, true),
        None | Some(9985 | 9987) => (Interpolation::Linear, true),
        Some(code) => return Err(unknown("minifies", code)),
    };
    let filter = Filter { magnified, minified, mipmaps };
    Ok(([wrap(sampler.wrap_s)?, wrap(sampler.wrap_t)?], filter))
}
