//! From the file's units in f64 to normalised ones in f32.

use std::collections::HashMap;

use glam::{DVec3, Vec2, Vec3};

use super::coplanar::Shapes;
use super::{
    Cone, DirectionalLight, Draft, DraftSphere, DraftSpot, Material, Origin, PointLight,
    SceneError, Sphere, Triangle, Units, Warning,
};

/// Coordinates beyond this are refused: their products would leave the range of f64.
const FARTHEST: f64 = 1e100;

/// Scenes smaller than this are refused: the square of their scale would leave that range.
const SMALLEST: f64 = 1e-100;

/// Height over longest edge below which a triangle has no area: the rounding of f64 input
/// alone makes slivers of a collinear triple.
const FLATTEST: f64 = 1e-12;

/// The shapes of a scene in normalised units.
#[derive(Debug)]
pub struct Normalised {
    /// Those with an area, each but once.
    pub triangles: Vec<Triangle>,
    /// Their texture coordinates.
    pub uvs: Vec<[Vec2; 3]>,
    /// What their albedo is multiplied by at their corners.
    pub colors: Vec<[Vec3; 3]>,
    /// The spheres.
    pub spheres: Vec<Sphere>,
    /// The way back.
    pub units: Units,
    /// How many were left out.
    pub dropped: u64,
    /// One for each reason to leave some out.
    pub warnings: Vec<Warning>,
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

/// Whether a radiance or an intensity is possible: finite in f32, and not negative.
pub fn is_power(value: DVec3) -> bool {
    value.to_array().iter().all(|&v| v >= 0.0 && (v as f32).is_finite())
}

/// Leaves out what has no area or is there twice, then recentres, scales and rounds.
pub fn shapes(
    origin: &Origin,
    draft: &Draft,
    materials: &[Material],
) -> Result<Normalised, SceneError> {
    let (triangles, spheres) = (&draft.triangles, &draft.spheres);
    let reachable = |corner: &DVec3| corner.abs().max_element() <= FARTHEST && !corner.is_nan();
    let corners = triangles.iter().flat_map(|(corners, _)| corners).copied();
    if corners.chain(spheres.iter().flat_map(extremes)).any(|corner| !reachable(&corner)) {
        return Err(origin.error("a coordinate is beyond 1e100, or not a number; scale the scene"));
    }
    let nothing = || origin.error("no triangle with an area, and no sphere: nothing to render");
    let attributes = || draft.uvs.iter().zip(&draft.colors);
    let with_area =
        || triangles.iter().zip(attributes()).filter(|((corners, _), _)| has_area(corners));
    if with_area().next().is_none() && spheres.is_empty() {
        return Err(nothing());
    }
    let corners = with_area().flat_map(|((corners, _), _)| corners).copied();
    let units = Units::around(corners.chain(spheres.iter().flat_map(extremes)));
    if units.scale < SMALLEST {
        return Err(origin.error("the scene is smaller than 1e-100 units; scale it"));
    }
    let mut distinct = Distinct::default();
    for (&(corners, material), (&uvs, &colors)) in with_area() {
        let vertices = corners.map(|corner| round(units.normalise(corner)));
        let triangle = Triangle { vertices, material };
        if keeps_area(&triangle) {
            distinct.add(triangle, uvs, colors, materials);
        }
    }
    let spheres = spheres
        .iter()
        .map(|sphere| Sphere {
            center: round(units.normalise(sphere.center)),
            radius: (sphere.radius / units.scale) as f32,
            material: sphere.material,
        })
        // Else its area would be lost in f32.
        .filter(|sphere| sphere.radius * sphere.radius >= f32::MIN_POSITIVE)
        .collect::<Vec<_>>();
    if distinct.shapes.triangles.is_empty() && spheres.is_empty() {
        return Err(nothing());
    }
    let dropped = triangles.len() - distinct.shapes.triangles.len();
    let mut warnings = distinct.warnings(origin, dropped);
    let mut shapes = distinct.shapes;
    let pairs = shapes.part(materials);
    if pairs > 0 {
        warnings.push(origin.note(format!(
            "{pairs} pairs of triangles of different materials overlap in one plane; of two, that of \
             the material with the smaller area there is shown"
        )));
    }
    Ok(Normalised {
        warnings,
        triangles: shapes.triangles,
        uvs: shapes.uvs,
        colors: shapes.colors,
        spheres,
        units,
        dropped: dropped as u64,
    })
}

/// Opposite corners of the bounds of a sphere.
fn extremes(sphere: &DraftSphere) -> [DVec3; 2] {
    [sphere.center - sphere.radius, sphere.center + sphere.radius]
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
    shapes: Shapes,
    seen: HashMap<[[u32; 3]; 3], usize>,
    duplicates: usize,
    lost_light: bool,
}

impl Distinct {
    fn add(
        &mut self,
        triangle: Triangle,
        uvs: [Vec2; 3],
        colors: [Vec3; 3],
        materials: &[Material],
    ) {
        let mut key = triangle.vertices.map(|vertex| vertex.to_array().map(f32::to_bits));
        key.sort_unstable();
        let index = *self.seen.entry(key).or_insert(self.shapes.triangles.len());
        match self.shapes.triangles.get(index) {
            None => {
                self.shapes.triangles.push(triangle);
                self.shapes.uvs.push(uvs);
                self.shapes.colors.push(colors);
            }
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

/// Point and spot lights in normalised units.
pub fn point_lights(
    origin: &Origin,
    draft: &Draft,
    units: &Units,
) -> Result<Vec<PointLight>, SceneError> {
    let finish = |position: DVec3, intensity: DVec3, cone: Option<Cone>| {
        let light = PointLight {
            position: round(units.normalise(position)),
            intensity: round(intensity / units.scale / units.scale),
            cone,
        };
        if !light.position.is_finite() {
            return Err(origin.error("a point light is too far from the scene"));
        }
        if !(light.intensity.is_finite() && light.intensity.min_element() >= 0.0) {
            return Err(origin.error("a point light's intensity is negative, or beyond f32"));
        }
        Ok(light)
    };
    let points = draft.point_lights.iter().map(|&(at, intensity)| finish(at, intensity, None));
    let spots = draft.spot_lights.iter().map(|spot| {
        let cone = cone(spot).ok_or_else(|| {
            origin.error("a spot light's direction is 0, or its angles are not within 0 and 180")
        })?;
        finish(spot.position, spot.intensity, Some(cone))
    });
    points.chain(spots).collect()
}

fn cone(spot: &DraftSpot) -> Option<Cone> {
    /// A hard edge is a ramp this wide, of cosines: its slope stays finite.
    const LEAST_RAMP: f64 = 1e-5;
    let [inner, outer] = spot.angles;
    if !(0.0 <= inner && inner <= outer && outer > 0.0 && outer <= 180.0) {
        return None;
    }
    let axis = round(spot.direction.try_normalize()?);
    let [inner, outer] = [inner, outer].map(|angle| angle.to_radians().cos());
    let outer = outer.min(1.0 - LEAST_RAMP);
    let inner = inner.max(outer + LEAST_RAMP);
    Some(Cone { axis, cos_inner: inner as f32, cos_outer: outer as f32 })
}

/// Directional lights: the scale of the scene is nothing to them.
pub fn directional_lights(
    origin: &Origin,
    lights: &[(DVec3, DVec3)],
) -> Result<Vec<DirectionalLight>, SceneError> {
    let finish = |&(direction, irradiance): &(DVec3, DVec3)| {
        let Some(direction) = direction.try_normalize() else {
            return Err(origin.error("a directional light's direction is 0, or not a number"));
        };
        let light = DirectionalLight { direction: round(direction), irradiance: round(irradiance) };
        if !(light.irradiance.is_finite() && light.irradiance.min_element() >= 0.0) {
            return Err(origin.error("a directional light's irradiance is negative, or beyond f32"));
        }
        Ok(light)
    };
    lights.iter().map(finish).collect()
}
