//! Images of 8 bits a channel.

use glam::{DVec3, Vec3, Vec4};

/// An image of 8 bits a channel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Texels {
    /// Where it came from.
    pub name: String,
    /// Width and height, both at least 1.
    pub size: [u32; 2],
    /// Rows from the top: red, green and blue in sRGB, and alpha.
    pub rgba: Vec<[u8; 4]>,
}

impl Texels {
    /// What stands for an image that cannot be read: visible magenta.
    pub fn magenta(name: impl Into<String>) -> Self {
        Self { name: name.into(), size: [1, 1], rgba: vec![[255, 0, 255, 255]] }
    }

    /// The mean of its colours in linear light.
    pub fn mean(&self) -> DVec3 {
        let table: Vec<f64> =
            (0..=u8::MAX).map(|value| f64::from(linear(f32::from(value) / 255.0))).collect();
        let light = |&[r, g, b, _]: &[u8; 4]| {
            DVec3::from_array([r, g, b].map(|value| table[usize::from(value)]))
        };
        self.rgba.iter().map(light).sum::<DVec3>() / self.rgba.len().max(1) as f64
    }

    /// A texel, its colour in linear light.
    pub(super) fn texel(&self, x: u32, y: u32) -> Vec4 {
        let texel = self.rgba[y as usize * self.size[0] as usize + x as usize];
        let [r, g, b, a] = texel.map(|value| f32::from(value) / 255.0);
        Vec3::new(linear(r), linear(g), linear(b)).extend(a)
    }
}

/// A channel of sRGB in linear light (IEC 61966-2-1).
pub(in crate::scene) fn linear(value: f32) -> f32 {
    match value {
        0.0..=0.04045 => value / 12.92,
        _ => libm::powf((value + 0.055) / 1.055, 2.4),
    }
}
