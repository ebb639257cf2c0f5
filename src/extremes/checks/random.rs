//! Random numbers by SplitMix64 (Steele, Lea and Flood, 2014), apart from those under test.

use glam::Vec3;

use crate::scene::Triangle;

/// A generator: its state, at first the seed.
#[derive(Debug, Clone)]
pub struct Rng(pub u64);

impl Rng {
    /// 32 random bits.
    pub fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 32) as u32
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f32 {
        (self.bits() >> 8) as f32 / (1 << 24) as f32
    }

    /// Uniform among the numbers below `n`, which is above 0.
    pub fn below(&mut self, n: usize) -> usize {
        self.bits() as usize % n
    }

    /// Uniform in the cube [-1, 1]³.
    pub fn cube(&mut self) -> Vec3 {
        Vec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }

    /// Uniform on the unit sphere.
    pub fn direction(&mut self) -> Vec3 {
        loop {
            let v = self.cube();
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }

    /// Uniform weights of a triangle's corners.
    pub fn weights(&mut self) -> [f32; 3] {
        let root = self.unit().sqrt();
        let c = root * self.unit();
        [1.0 - root, root - c, c]
    }

    /// A point on a triangle.
    pub fn on(&mut self, triangle: &Triangle) -> Vec3 {
        let ([a, b, c], [u, v, w]) = (triangle.vertices, self.weights());
        a * u + b * v + c * w
    }
}
