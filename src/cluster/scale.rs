//! Coordinates of any size, brought to where f32 is at ease.

use glam::Vec3;

/// A power of two that brings coordinates to where their squares neither overflow nor
/// vanish; 1 for all but extraordinary ones.
#[derive(Debug, Clone, Copy)]
pub struct Scale(pub f32);

impl Scale {
    pub fn of(positions: &[Vec3]) -> Self {
        let largest = positions.iter().map(|position| position.abs().max_element());
        let largest = largest.fold(0.0f32, f32::max);
        match largest {
            0.0 | 1e-6..1e9 => Self(1.0),
            _ => Self((-largest.log2().clamp(-126.0, 126.0).round()).exp2()),
        }
    }

    pub fn apply(self, positions: &[Vec3]) -> std::borrow::Cow<'_, [Vec3]> {
        match self.0 {
            1.0 => positions.into(),
            scale => positions.iter().map(|&position| position * scale).collect(),
        }
    }
}
