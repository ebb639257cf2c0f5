//! Shapes for built-in scenes, wound so that their normals point outward.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, dvec3};

use crate::scene::{Draft, DraftMaterial, Origin, SceneError};

/// Adds shapes to a draft.
pub struct Shapes<'a> {
    pub draft: &'a mut Draft,
}

impl Shapes<'_> {
    /// A diffuse material.
    pub fn diffuse(&mut self, name: &str, albedo: [f64; 3]) -> Result<u32, SceneError> {
        self.light(name, albedo, [0.0; 3])
    }

    /// A material that also emits.
    pub fn light(
        &mut self,
        name: &str,
        albedo: [f64; 3],
        emission: [f64; 3],
    ) -> Result<u32, SceneError> {
        let origin = Origin::file(&self.draft.name);
        self.draft.add_material(DraftMaterial {
            name: name.to_owned(),
            albedo: DVec3::from_array(albedo),
            emission: DVec3::from_array(emission),
            two_sided: false,
            origin,
            ..DraftMaterial::default()
        })
    }

    /// A quad, counter-clockwise from its front; a triangle where two neighbours coincide.
    pub fn quad(&mut self, material: u32, [a, b, c, d]: [DVec3; 4]) {
        let is_flat = |[a, b, c]: &[DVec3; 3]| a == b || b == c || c == a;
        let halves = [[a, b, c], [a, c, d]].into_iter().filter(|half| !is_flat(half));
        self.draft.triangles.extend(halves.map(|half| (half, material)));
    }

    /// A parallelogram of n × m quads, its normal along u × v; `color` gives each quad's
    /// material.
    pub fn grid(
        &mut self,
        [corner, u, v]: [DVec3; 3],
        [n, m]: [usize; 2],
        color: impl Fn(usize, usize) -> u32,
    ) {
        self.surface([n, m], color, |s, t| corner + s * u + t * v);
    }

    /// A surface over the unit square in n × m quads, its normal along ∂u × ∂v.
    pub fn surface(
        &mut self,
        [n, m]: [usize; 2],
        color: impl Fn(usize, usize) -> u32,
        point: impl Fn(f64, f64) -> DVec3,
    ) {
        let at = |i: usize, j: usize| point(i as f64 / n as f64, j as f64 / m as f64);
        for j in 0..m {
            for i in 0..n {
                let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                self.quad(color(i, j), corners);
            }
        }
    }

    /// A box along the axes.
    pub fn block(&mut self, material: u32, low: DVec3, high: DVec3) {
        let at = |i: u32| {
            let pick = |bit: u32, low: f64, high: f64| if i >> bit & 1 == 0 { low } else { high };
            dvec3(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z))
        };
        for face in
            [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]
        {
            self.quad(material, face.map(at));
        }
    }

    /// A profile of (radius, height) from its foot up, turned about the vertical through
    /// `foot`. `flutes` grooves of relative depth `depth` run along it.
    pub fn lathe(
        &mut self,
        material: u32,
        foot: DVec3,
        profile: &[DVec2],
        sides: usize,
        (flutes, depth): (usize, f64),
    ) {
        let rings = profile.len().saturating_sub(1);
        self.surface(
            [sides, rings],
            |_, _| material,
            |s, t| {
                let ring = profile[(t * rings as f64).round() as usize];
                // The last side ends exactly where the first begins.
                let angle = -TAU * (s % 1.0);
                let groove = 1.0 - depth * (0.5 * flutes as f64 * angle).sin().powi(2);
                foot + dvec3(ring.x * groove * angle.cos(), ring.y, ring.x * groove * angle.sin())
            },
        );
    }

    /// A sphere of a radius that may vary with the direction.
    pub fn ball(
        &mut self,
        material: u32,
        center: DVec3,
        detail: usize,
        radius: impl Fn(DVec3) -> f64,
    ) {
        self.surface(
            [2 * detail, detail],
            |_, _| material,
            |s, t| {
                let (azimuth, polar) = (-TAU * (s % 1.0), PI * (1.0 - t));
                // Both poles are exact points, all of whose copies agree.
                let across = if t == 0.0 || t == 1.0 { 0.0 } else { polar.sin() };
                let direction = dvec3(across * azimuth.cos(), polar.cos(), across * azimuth.sin());
                center + radius(direction) * direction
            },
        );
    }

    /// A tube of this radius about the (p, q) torus knot of radius `size`.
    pub fn knot(
        &mut self,
        material: u32,
        center: DVec3,
        size: f64,
        radius: f64,
        [n, m]: [usize; 2],
    ) {
        let (p, q) = (2.0, 3.0);
        let curve = |s: f64| {
            let angle = TAU * (s % 1.0);
            let ring = 1.0 + 0.45 * (q * angle).cos();
            let height = 0.45 * (q * angle).sin();
            size * dvec3(ring * (p * angle).cos(), height, ring * (p * angle).sin())
        };
        self.surface(
            [n, m],
            |_, _| material,
            |s, t| {
                let along = (curve(s + 1e-4) - curve(s + 1.0 - 1e-4)).normalize();
                // The frame needs no transport: the curve never runs along its own radius.
                let side = along.cross(curve(s)).normalize();
                let (sin, cos) = (TAU * (t % 1.0)).sin_cos();
                center + curve(s) + radius * (cos * side + sin * side.cross(along))
            },
        );
    }
}
