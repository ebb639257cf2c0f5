//! How texels become the colour of a place, or of the part of a surface that a pixel sees.

/// How the colour of a place comes from the texels of a level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// It is that of the nearest.
    Nearest,
    /// It is interpolated between the four nearest.
    #[default]
    Linear,
}

/// How a texture is filtered: the `magFilter` and `minFilter` of glTF. Only what the camera sees,
/// be it through mirrors and glass, is ever minified.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Filter {
    /// Where a texel covers a pixel.
    pub magnified: Interpolation,
    /// Where a pixel covers texels.
    pub minified: Interpolation,
    /// Whether a pixel averages the texels that it covers, by mip levels; else it shows those in
    /// its middle.
    pub mipmaps: bool,
}

impl Default for Filter {
    fn default() -> Self {
        let linear = Interpolation::Linear;
        Self { magnified: linear, minified: linear, mipmaps: true }
    }
}
