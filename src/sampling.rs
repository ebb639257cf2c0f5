//! Randomised quasi-Monte Carlo: Owen-scrambled Sobol points, and the maps from the unit cube
//! to directions and triangles.
//!
//! Transcendental functions come from libm, so that every machine draws the same paths.

use glam::Vec3;

/// Points that one block of the underlying sequence holds.
const BLOCK: u32 = 1 << 16;
/// Dimensions that it holds.
const DIMENSIONS: u32 = 256;

/// Distance by which rays are kept off surfaces, in normalised units, in which the scene's largest
/// half-extent is 1: some 32 times the rounding of a position or of a plane there.
pub const SURFACE_OFFSET: f32 = 1.0 / 262_144.0;

/// A seeded sequence of points in [0, 1)^∞ (Burley, "Practical Hash-based Owen Scrambling",
/// JCGT 2020).
#[derive(Debug, Clone, Copy)]
pub struct Sequence {
    seed: u32,
}

impl Sequence {
    /// The sequence of a seed.
    pub fn new(seed: u32) -> Self {
        Self { seed }
    }

    /// Coordinate `dimension` of point `index`. Blocks of 2^16 points and of 256 dimensions
    /// are scrambled independently of each other.
    pub fn sample(&self, index: u32, dimension: u32) -> f32 {
        let block = hash((index / BLOCK) ^ hash(dimension / DIMENSIONS));
        let seed = hash(self.seed ^ block);
        sobol_burley::sample(index % BLOCK, dimension % DIMENSIONS, seed)
    }
}

/// A bijection that mixes all bits (Wellons' lowbias32).
pub fn hash(x: u32) -> u32 {
    let mut h = x ^ (x >> 16);
    h = h.wrapping_mul(0x7feb_352d);
    h ^= h >> 15;
    h = h.wrapping_mul(0x846c_a68b);
    h ^ (h >> 16)
}

/// A direction uniform on the sphere; pdf 1 / 4π.
pub fn uniform_sphere(u: [f32; 2]) -> Vec3 {
    let z = 1.0 - 2.0 * u[0];
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = turn(u[1]);
    Vec3::new(r * cos, r * sin, z)
}

/// A direction about `normal` (of unit length); pdf cos θ / π.
pub fn cosine_hemisphere(normal: Vec3, u: [f32; 2]) -> Vec3 {
    (uniform_disk(normal, u) + normal * (1.0 - u[0]).max(0.0).sqrt()).normalize()
}

/// A place on the disc of radius 1 about the origin, across `normal` (of unit length); pdf 1 / π.
pub fn uniform_disk(normal: Vec3, u: [f32; 2]) -> Vec3 {
    let (sin, cos) = turn(u[1]);
    let r = u[0].sqrt();
    let [x, y] = frame(normal);
    x * (r * cos) + y * (r * sin)
}

/// The random numbers with which [`uniform_disk`] gives a place, from its part across `normal`; places
/// off the disc are moved to its rim.
pub fn on_disk(normal: Vec3, place: Vec3) -> [f32; 2] {
    let [x, y] = frame(normal).map(|axis| axis.dot(place));
    // The largest number below 1 is as far as random numbers go.
    let most = 1.0 - 0.5 * f32::EPSILON;
    let turned = libm::atan2f(y, x) / std::f32::consts::TAU;
    [(x * x + y * y).min(most), (if turned < 0.0 { turned + 1.0 } else { turned }).min(most)]
}

/// A direction within a cone about `axis` (of unit length), 1 minus the cosine of whose angle is
/// `width`; pdf 1 / (2π width).
pub fn uniform_cone(axis: Vec3, width: f32, u: [f32; 2]) -> Vec3 {
    let fall = u[0] * width;
    let r = (fall * (2.0 - fall)).max(0.0).sqrt();
    let (sin, cos) = turn(u[1]);
    let [x, y] = frame(axis);
    (x * (r * cos) + y * (r * sin) + axis * (1.0 - fall)).normalize()
}

/// The unit vector at an angle of this cosine to a unit `axis`, turned about it by the fraction
/// `turned` of a full turn.
pub fn about(axis: Vec3, cosine: f32, turned: f32) -> Vec3 {
    let r = (1.0 - cosine * cosine).max(0.0).sqrt();
    let (sin, cos) = turn(turned);
    let [x, y] = frame(axis);
    (x * (r * cos) + y * (r * sin) + axis * cosine).normalize()
}

/// Two unit vectors across a unit axis and each other: Duff et al., "Building an Orthonormal
/// Basis, Revisited", JCGT 2017.
fn frame(axis: Vec3) -> [Vec3; 2] {
    let sign = 1.0f32.copysign(axis.z);
    let a = -1.0 / (sign + axis.z);
    let b = axis.x * axis.y * a;
    [
        Vec3::new(1.0 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x),
        Vec3::new(b, sign + axis.y * axis.y * a, -axis.y),
    ]
}

/// Weights of a triangle's second and third corner, uniform over its area.
pub fn uniform_triangle(u: [f32; 2]) -> [f32; 2] {
    let root = u[0].sqrt();
    [root * (1.0 - u[1]), root * u[1]]
}

/// Sine and cosine of the fraction `u` of a full turn.
fn turn(u: f32) -> (f32, f32) {
    libm::sincosf(std::f32::consts::TAU * u)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sequence_goes_on_beyond_its_blocks() {
        let sequence = Sequence::new(7);
        for dimension in [0, 5, 255, 256, 1000] {
            let n = 3 * BLOCK / 2;
            let mean = (0..n).map(|i| f64::from(sequence.sample(i, dimension))).sum::<f64>()
                / f64::from(n);
            assert!((mean - 0.5).abs() < 1e-4, "dimension {dimension}: mean {mean}");
        }
        let copies = (0..BLOCK).filter(|&i| sequence.sample(i, 0) == sequence.sample(i + BLOCK, 0));
        assert!(copies.count() < 16, "the second block repeats the first");
    }

    #[test]
    fn directions_have_their_moments() {
        let sequence = Sequence::new(1);
        let normal = Vec3::new(0.36, -0.48, -0.8);
        let n = 4096u16;
        let (mut sphere, mut cosine, mut cone, mut disk) = (Vec3::ZERO, 0.0, 0.0, 0.0);
        for i in 0..u32::from(n) {
            let u = [sequence.sample(i, 0), sequence.sample(i, 1)];
            sphere += uniform_sphere(u) / f32::from(n);
            let w = cosine_hemisphere(normal, u);
            assert!((w.length() - 1.0).abs() < 1e-5 && w.dot(normal) > -1e-6);
            cosine += w.dot(normal) / f32::from(n);
            let w = uniform_cone(normal, 0.3, u);
            assert!((w.length() - 1.0).abs() < 1e-5 && w.dot(normal) > 0.7 - 1e-6);
            cone += w.dot(normal) / f32::from(n);
            let p = uniform_disk(normal, u);
            assert!(p.length() <= 1.0 + 1e-5 && p.dot(normal).abs() < 1e-6);
            disk += p.length() / f32::from(n);
        }
        assert!(sphere.length() < 1e-3, "mean direction {sphere}");
        assert!((cosine - 2.0 / 3.0).abs() < 1e-3, "mean cosine {cosine}");
        assert!((cone - 0.85).abs() < 1e-3, "mean cosine in a cone {cone}");
        assert!((disk - 2.0 / 3.0).abs() < 1e-3, "mean radius in a disk {disk}");
    }

    #[test]
    fn places_on_a_disk_are_found_again() {
        let sequence = Sequence::new(3);
        for i in 0..4096 {
            let [u, v, a, b] = [0, 1, 2, 3].map(|d| sequence.sample(i, d));
            let normal = uniform_sphere([a, b]);
            // What is along the normal is left out.
            let place = uniform_disk(normal, [u, v]) + 3.0 * v * normal;
            let [again_u, again_v] = on_disk(normal, place);
            let turned = (again_v - v).abs();
            assert!((again_u - u).abs() < 1e-5, "{u}: {again_u}");
            assert!(turned.min(1.0 - turned) * u.sqrt() < 1e-5, "{v}: {again_v}");
        }
        assert!(on_disk(Vec3::Z, Vec3::new(2.0, 0.0, 5.0))[0] < 1.0);
        assert!(on_disk(Vec3::Z, Vec3::new(0.5, -1e-9, 0.0))[1] < 1.0);
    }

    #[test]
    fn triangle_points_have_the_centroid_as_mean() {
        let sequence = Sequence::new(1);
        let mut mean = [0.0f32; 2];
        for i in 0..1024 {
            let [b, c] = uniform_triangle([sequence.sample(i, 0), sequence.sample(i, 1)]);
            assert!(b >= 0.0 && c >= 0.0 && b + c <= 1.0 + 1e-6);
            mean = [mean[0] + b / 1024.0, mean[1] + c / 1024.0];
        }
        assert!(mean.iter().all(|m| (m - 1.0 / 3.0).abs() < 1e-3), "{mean:?}");
    }
}
