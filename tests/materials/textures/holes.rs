//! Holes that textures cut: light through them, and rays.

use std::f64::consts::PI;

use glam::{DVec3, Vec3, dvec3};
use gpu_vpl::bvh::{Bvh, Ray};
use gpu_vpl::render::{Bounces, Method, Settings};
use gpu_vpl::scene::{Scene, texture};

use super::random_texels;
use crate::common::tracing::{on_all_of, random_rays, world_of};
use crate::common::{Build, Rng};

/// Opaque and clear fields in turn, each of 8 × 8 texels.
fn checker(fields: u32) -> Vec<[u8; 4]> {
    let side = 8 * fields;
    let clear = |i: u32| (i % side / 8 + i / side / 8) % 2 == 1;
    (0..side * side).map(|i| [255, 255, 255, if clear(i) { 0 } else { 255 }]).collect()
}

/// Light through a checkered screen half way to the floor, in every method, and seen through it
/// from above; the screen is a flat one or has triangles of its own for each field.
#[test]
fn the_shadow_of_a_screen_with_holes() {
    let fields = 4;
    for method in [Method::Direct, Method::Path, Method::Both] {
        let mut build = Build::new();
        let white = build.material([1.0; 3], [0.0; 3], false);
        let screen = build.material([0.0; 3], [0.0; 3], false);
        let cutout = build.texture(8 * fields, checker(fields));
        build.draft.materials[screen as usize].cutout = Some(cutout);
        build.textured(screen, dvec3(-1.0, 1.0, 1.0), 2.0 * DVec3::X, -2.0 * DVec3::Y);
        let corner = |x: f64, y: f64| dvec3(4.0 * x, 4.0 * y, 0.0);
        build.polygon(
            white,
            &[corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
        );
        build.point_light(dvec3(0.0, 0.0, 2.0), [1.0; 3]);
        // The shadow is twice the screen's size.
        let size = 32;
        build.camera(
            dvec3(0.0, 0.0, 0.5),
            DVec3::NEG_Z,
            2.0 * 4.0f64.atan().to_degrees(),
            [size; 2],
        );
        let settings = Settings {
            edge_samples: 1,
            bounces: Bounces::Finite(0),
            samples: 1,
            ..Settings::of(method)
        };
        let image = build.render(&settings).image;
        let (mut lit, mut dark) = (0, 0);
        for (i, pixel) in (0..).zip(&image.pixels) {
            let at = |i: u32| 2.0 * ((2.0 * f64::from(i) + 1.0) / f64::from(size) - 1.0);
            let place = dvec3(at(i % size), -at(i / size), 0.0);
            // In fields of the screen, from its top left.
            let [x, y] = [place.x, -place.y].map(|x| (x / 2.0 + 1.0) / 2.0 * f64::from(fields));
            let inside = x < f64::from(fields) && y < f64::from(fields) && x > 0.0 && y > 0.0;
            let blocked = inside && (x as u32 + y as u32).is_multiple_of(2);
            let square = place.length_squared() + 4.0;
            let expected = if blocked { 0.0 } else { 2.0 / square.powf(1.5) / PI };
            let off = (f64::from(pixel[0]) - expected).abs();
            assert!(off < 1e-5, "{method:?}, {i}: {}, not {expected}", pixel[0]);
            *(if blocked { &mut dark } else { &mut lit }) += 1;
        }
        assert!(lit > 400 && dark > 400, "{lit} lit, {dark} dark");
    }
}

/// Triangles and spheres with holes of random shapes.
fn holey_scene(rng: &mut Rng, cut: bool) -> Scene {
    let mut build = Build::new();
    let image = build.texture(8, random_texels(&mut Rng(7), 64));
    let materials = [false, true].map(|is| {
        let material = build.material([0.5; 3], [0.0; 3], false);
        build.draft.materials[material as usize].texture = Some(image);
        build.draft.materials[material as usize].cutout = (is && cut).then_some(image);
        material
    });
    for i in 0..150 {
        let [corner, across, down] =
            [rng.cube(), 0.8 * rng.direction(), 0.8 * rng.direction()].map(|v| v.as_dvec3());
        build.textured(materials[usize::from(i % 4 > 0)], corner, across, down);
        let (center, radius) = (0.8 * rng.cube().as_dvec3(), f64::from(0.5 * rng.unit()));
        build.sphere(materials[usize::from(i % 4 > 0)], center, radius);
    }
    build.point_light(DVec3::Z, [1.0; 3]);
    build.camera(DVec3::Z, DVec3::NEG_Z, 40.0, [8, 8]);
    build.scene()
}

/// The first place at which a ray is stopped, peeling off what is clear there.
fn peel(scene: &Scene, whole: &Bvh, ray: &Ray) -> Option<f32> {
    let mut from = 0.0;
    loop {
        let rest =
            Ray { origin: ray.origin + from * ray.direction, limit: ray.limit - from, ..*ray };
        let hit = whole.closest(&rest)?;
        let uv = match scene.uvs.get(hit.shape as usize) {
            Some(corners) => texture::on_triangle(*corners, hit.weights),
            None => texture::on_sphere(Vec3::from_array(hit.weights)),
        };
        let alpha = scene.textures[0].sample(&scene.images, uv).w;
        if hit.material == 0 || alpha >= 0.5 {
            return Some(from + hit.t);
        }
        from += hit.t + 1e-5;
    }
}

#[test]
fn rays_go_through_holes() {
    let [cut, whole] = [true, false].map(|cut| holey_scene(&mut Rng(5), cut));
    let (world, whole_bvh) = (world_of(&cut), Bvh::of(&whole));
    assert!(world.features.cutouts && world.features.spheres);
    let mut rays = random_rays(&mut Rng(6), 4000);
    for ray in &mut rays {
        // Among the shapes.
        (ray.origin, ray.limit) = (0.4 * ray.origin, ray.limit.min(10.0));
    }
    let expected: Vec<_> = rays.iter().map(|ray| peel(&whole, &whole_bvh, ray)).collect();
    let through = rays
        .iter()
        .zip(&expected)
        .filter(|(ray, t)| whole_bvh.closest(ray).map(|hit| hit.t) != **t)
        .count();
    assert!(through > 300, "{through} rays through holes");
    for any in [false, true] {
        for (side, answers) in on_all_of(&world, &rays, any) {
            let mut wrong = 0;
            for (answer, expected) in answers.iter().zip(&expected) {
                let right = match expected {
                    Some(t) => answer.hits() && (any || (answer.t - t).abs() < 1e-4),
                    None => !answer.hits(),
                };
                wrong += u32::from(!right);
            }
            // A hole's rim, or a sphere's, within rounding.
            assert!(wrong <= 8, "{side}, any = {any}: {wrong} of {}", rays.len());
        }
    }
}
