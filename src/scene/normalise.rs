//! From the file's units in f64 to normalised ones in f32.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::{Material, Origin, PointLight, Triangle, Units, Warning};
use crate::error::SceneError;

/// Coordinates beyond this are refused: their products would leave the range of f64.
const FARTHEST: f64 = 1e100;

/// Scenes smaller than this are refused: the square of their scale would leave that range.
const SMALLEST: f64 = 1e-100;

/// Height over longest edge below which a triangle has no area: the rounding of f64 input
/// alone makes slivers of a collinear triple.
const FLATTEST: f64 = 1e-12;

/// Slack by which the half-extent may exceed the scale. Scenes are often a power of two
/// wide; far from the origin they are so but for rounding, which must not halve the image's
/// units.
const SCALE_SLACK: f64 = 1e-6;

/// The triangles of a scene in normalised units.
#[derive(Debug)]
pub struct Normalised {
    /// Those with an area, each but once.
    pub triangles: Vec<Triangle>,
    /// The way back.
    pub units: Units,
    /// How many were left out.
    pub dropped: u64,
    /// One for each reason to leave some out.
    pub warnings: Vec<Warning>,
}

impl Units {
    /// The units in which these corners span [-1, 1] along their longest axis.
    fn around<'a>(corners: impl Iterator<Item = &'a DVec3>) -> Self {
        let (low, high) = corners
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &corner| {
                (low.min(corner), high.max(corner))
            });
        let half_extent = 0.5 * (high - low).max_element();
        Self { center: 0.5 * (low + high), scale: power_of_two_above(half_extent) }
    }

    /// A point of the file in normalised units.
    pub fn normalise(&self, point: DVec3) -> DVec3 {
        (point - self.center) / self.scale
    }
}

/// The least power of two that `length` does not exceed by more than [`SCALE_SLACK`].
fn power_of_two_above(length: f64) -> f64 {
    let mut power = 1.0;
    while power * (1.0 + SCALE_SLACK) < length {
        power *= 2.0;
    }
    while 0.5 * power * (1.0 + SCALE_SLACK) >= length {
        power *= 0.5;
    }
    power
}

/// Rounds to f32. Subnormals become 0, as they do on some devices: no device's choice may
/// show. So does -0.
pub fn round(vector: DVec3) -> Vec3 {
    let flush = |x: f64| {
        let x = x as f32;
        if x.abs() < f32::MIN_POSITIVE { 0.0 } else { x }
    };
    Vec3::new(flush(vector.x), flush(vector.y), flush(vector.z))
}

/// Leaves out what has no area or is there twice, then recentres, scales and rounds.
pub fn triangles(
    origin: &Origin,
    triangles: &[([DVec3; 3], u32)],
    materials: &[Material],
) -> Result<Normalised, SceneError> {
    let reachable = |corner: &DVec3| corner.abs().max_element() <= FARTHEST && !corner.is_nan();
    if triangles.iter().flat_map(|(corners, _)| corners).any(|corner| !reachable(corner)) {
        return Err(origin.error("a coordinate is beyond 1e100, or not a number; scale the scene"));
    }
    let with_area = || triangles.iter().filter(|(corners, _)| has_area(corners));
    if with_area().next().is_none() {
        return Err(origin.error("no triangle with an area: nothing to render"));
    }
    let units = Units::around(with_area().flat_map(|(corners, _)| corners));
    if units.scale < SMALLEST {
        return Err(origin.error("the scene is smaller than 1e-100 units; scale it"));
    }
    let mut distinct = Distinct::default();
    for &(corners, material) in with_area() {
        let vertices = corners.map(|corner| round(units.normalise(corner)));
        let triangle = Triangle { vertices, material };
        if keeps_area(&triangle) {
            distinct.add(triangle, materials);
        }
    }
    if distinct.triangles.is_empty() {
        return Err(origin.error("no triangle with an area: nothing to render"));
    }
    let dropped = triangles.len() - distinct.triangles.len();
    Ok(Normalised {
        warnings: distinct.warnings(origin, dropped),
        triangles: distinct.triangles,
        units,
        dropped: dropped as u64,
    })
}

/// Whether a triangle has an area, whatever its size.
fn has_area(&[a, b, c]: &[DVec3; 3]) -> bool {
    let edges = [b - a, c - b, a - c];
    let longest = edges.iter().map(|edge| edge.abs().max_element()).fold(0.0, f64::max);
    longest > 0.0 && (edges[0] / longest).cross(edges[1] / longest).length() > FLATTEST
}

/// Whether its normal survives f32, in which shaders square its length.
fn keeps_area(triangle: &Triangle) -> bool {
    let square = triangle.scaled_normal().length_squared();
    square >= f32::MIN_POSITIVE && square.is_finite()
}

/// Triangles, each set of corners but once: two surfaces in one place have no order.
#[derive(Debug, Default)]
struct Distinct {
    triangles: Vec<Triangle>,
    seen: HashMap<[[u32; 3]; 3], usize>,
    duplicates: usize,
    lost_light: bool,
}

impl Distinct {
    fn add(&mut self, triangle: Triangle, materials: &[Material]) {
        let mut key = triangle.vertices.map(|vertex| vertex.to_array().map(f32::to_bits));
        key.sort_unstable();
        let index = *self.seen.entry(key).or_insert(self.triangles.len());
        match self.triangles.get(index) {
            None => self.triangles.push(triangle),
            Some(first) => {
                self.duplicates += 1;
                self.lost_light |= shines_elsewhere(first, &triangle, materials);
            }
        }
    }

    fn warnings(&self, origin: &Origin, dropped: usize) -> Vec<Warning> {
        let file = origin.file.display();
        let mut warnings = Vec::new();
        let flat = dropped - self.duplicates;
        if flat > 0 {
            warnings
                .push(Warning::note(format!("{file}: triangles without area left out: {flat}")));
        }
        if self.duplicates > 0 {
            let message = format!("{file}: duplicates of triangles left out: {}", self.duplicates);
            warnings.push(match self.lost_light {
                true => Warning::changed(
                    message + "; some emit otherwise than the first, which is kept",
                ),
                false => Warning::note(message),
            });
        }
        warnings
    }
}

/// Whether leaving out the second of two coincident triangles takes light from the scene.
fn shines_elsewhere(first: &Triangle, second: &Triangle, materials: &[Material]) -> bool {
    let [one, two] = [first, second].map(|t| materials.get(t.material as usize));
    let (Some(one), Some(two)) = (one, two) else { return true };
    if !one.emits() && !two.emits() {
        return false;
    }
    let opposed = first.scaled_normal().dot(second.scaled_normal()) < 0.0;
    one.emission != two.emission || one.two_sided != two.two_sided || (opposed && !one.two_sided)
}

/// Point lights in normalised units.
pub fn point_lights(
    origin: &Origin,
    lights: &[(DVec3, DVec3)],
    units: &Units,
) -> Result<Vec<PointLight>, SceneError> {
    let finish = |&(position, intensity): &(DVec3, DVec3)| {
        let light = PointLight {
            position: round(units.normalise(position)),
            intensity: round(intensity / units.scale / units.scale),
        };
        if !light.position.is_finite() {
            return Err(origin.error("a point light is too far from the scene"));
        }
        if !(light.intensity.is_finite() && light.intensity.min_element() >= 0.0) {
            return Err(origin.error("a point light's intensity is negative, or beyond f32"));
        }
        Ok(light)
    };
    lights.iter().map(finish).collect()
}
