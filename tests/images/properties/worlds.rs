//! Random rooms, and what is done to all of a scene at once.

use glam::{DMat3, DVec3, Vec3, dvec3};
use gpu_vpl::scene::{Bsdf, Draft, Scene};

use crate::common::{Build, Rng};

/// A closed room with a block, a sphere, some triangles and point lights in it; with `lamp`, an
/// area light under the ceiling, too. So many shapes that they are no literals: all rooms share
/// their kernels.
pub fn room(seed: u64, lamp: bool) -> Draft {
    let random = &mut Rng(seed);
    let mut build = Build::new();
    let color = |random: &mut Rng| [0; 3].map(|_| 0.2 + 0.6 * f64::from(random.unit()));
    let wall = build.material(color(random), [0.0; 3], false);
    let block = build.material(color(random), [0.0; 3], false);
    let specular = Vec3::splat(0.3);
    let gloss = Bsdf::Phong { specular, shininess: 1.0 + 30.0 * random.unit() };
    let glossy = build.finished([0.4, 0.5, 0.3], gloss);
    build.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
    let low = dvec3(-0.5, 0.1, -0.9) + 0.2 * random.cube().as_dvec3();
    build.cuboid(block, low, low + dvec3(0.5, 0.4, 0.7), false);
    build.sphere(glossy, dvec3(0.5, 0.3, -0.5) + 0.1 * random.cube().as_dvec3(), 0.25);
    for index in 0..6 {
        let center = 0.6 * random.cube().as_dvec3();
        let corners = [0; 3].map(|_| center + 0.2 * random.cube().as_dvec3());
        build.triangle(if index % 2 == 0 { block } else { glossy }, corners);
    }
    for _ in 0..1 + random.below(2) {
        let place = 0.7 * random.cube().as_dvec3();
        build.point_light(place, color(random));
    }
    if lamp {
        let lamp = build.material([0.5; 3], [9.0, 8.0, 7.0], false);
        let corner = |x, y| dvec3(x, y, 0.9);
        let quad = [corner(-0.3, -0.3), corner(-0.3, 0.3), corner(0.3, 0.3), corner(0.3, -0.3)];
        build.polygon(lamp, &quad);
    }
    let position = dvec3(-0.9, -0.85, 0.3) + 0.05 * random.cube().as_dvec3();
    build.camera(position, dvec3(0.8, 0.75, -0.4), 75.0, [24, 16]);
    build.draft
}

/// A rotation or reflection, then a scale and a translation, of everything.
#[derive(Debug, Clone, Copy)]
pub struct Move {
    pub turn: DMat3,
    pub scale: f64,
    pub offset: DVec3,
}

impl Default for Move {
    fn default() -> Self {
        Self { turn: DMat3::IDENTITY, scale: 1.0, offset: DVec3::ZERO }
    }
}

impl Move {
    pub fn apply(&self, draft: &Draft) -> Draft {
        let place = |p: DVec3| self.scale * (self.turn * p) + self.offset;
        let mut draft = draft.clone();
        for (corners, _) in &mut draft.triangles {
            *corners = corners.map(place);
            // A reflection turns the winding round.
            if self.turn.determinant() < 0.0 {
                corners.swap(1, 2);
            }
        }
        for sphere in &mut draft.spheres {
            sphere.center = place(sphere.center);
            sphere.radius *= self.scale;
        }
        for (position, intensity) in &mut draft.point_lights {
            *position = place(*position);
            *intensity *= self.scale * self.scale;
        }
        let camera = draft.camera.as_mut().unwrap();
        camera.position = place(camera.position);
        camera.direction = self.turn * camera.direction;
        camera.up = self.turn * camera.up;
        draft
    }
}

/// Every triangle of a material that does not emit in four, or of all materials.
pub fn split(draft: &Draft, lamps: bool) -> Draft {
    let mut split = draft.clone();
    split.triangles.clear();
    split.uvs.clear();
    for &([a, b, c], material) in &draft.triangles {
        let emits = draft.materials[material as usize].emission != DVec3::ZERO;
        if emits && !lamps {
            split.triangles.push(([a, b, c], material));
            continue;
        }
        let [ab, bc, ca] = [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0];
        let parts = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]];
        split.triangles.extend(parts.map(|corners| (corners, material)));
    }
    split
}

/// All lights so many times as bright.
pub fn brighter(draft: &Draft, factor: f64) -> Draft {
    let mut draft = draft.clone();
    draft.point_lights.iter_mut().for_each(|(_, intensity)| *intensity *= factor);
    draft.materials.iter_mut().for_each(|material| material.emission *= factor);
    draft
}

pub fn scene(draft: Draft) -> Scene {
    draft.finish().unwrap()
}
