//! Spot and directional lights: as direct light, and as the source of VPLs.

use std::f64::consts::PI;

use crate::common::Build;
use crate::common::lights::{ALBEDO, direct_light, first_flux, one_bounce_agrees, plane, seen};
use glam::{DVec3, dvec3};

const SCALES: [f64; 3] = [1.0, 1e-6, 1e6];

/// The square of the ramp of a spot light.
fn ramp(cosine: f64, angles: [f64; 2]) -> f64 {
    let [inner, outer] = angles.map(|angle| angle.to_radians().cos());
    ((cosine - outer) / (inner - outer)).clamp(0.0, 1.0).powi(2)
}

#[test]
fn a_spot_light_over_a_plane() {
    let (height, fov, size) = (3.0, 70.0, 16);
    let seen = seen(height, fov, size);
    let light = dvec3(0.3, -0.2, 1.7);
    let axis = dvec3(0.3, 0.1, -1.0);
    for (scale, angles) in SCALES.into_iter().zip([[20.0, 40.0], [0.0, 60.0], [100.0, 170.0]]) {
        let mut build = plane(scale, height, fov, size);
        build.spot_light(light, 7.0 * axis, [2.0, 5.0, 1.0], angles);
        for (way, frame) in direct_light(&build.scene(), 1) {
            let mut kinds = [0; 3];
            for (i, pixel) in frame.image.pixels.iter().enumerate() {
                if way == "path" {
                    // The camera rays of paths are jittered in the pixel.
                    continue;
                }
                let to_point = seen(i) - light;
                let square = to_point.length_squared();
                let share = ramp(to_point.normalize().dot(axis.normalize()), angles);
                let expected = ALBEDO[0] / PI * 2.0 * share * light.z / square.powf(1.5);
                let off = (f64::from(pixel[0]) - expected).abs();
                assert!(off <= 2e-5 * (expected + 0.01), "{way} {i}: {pixel:?}, not {expected}");
                assert_eq!(share == 0.0, pixel[0] == 0.0, "{way} {i}: {share}");
                kinds[if share == 0.0 {
                    0
                } else if share < 1.0 {
                    1
                } else {
                    2
                }] += 1;
            }
            if angles == [20.0, 40.0] && way != "path" {
                assert!(kinds.iter().all(|&count| count > 10), "{kinds:?}");
            }
        }
    }
}

/// A hard edge is one: inside all, outside nothing.
#[test]
fn a_spot_light_with_a_hard_edge() {
    let (height, fov, size) = (3.0, 70.0, 16);
    let seen = seen(height, fov, size);
    let mut build = plane(1.0, height, fov, size);
    let light = dvec3(0.0, 0.0, 2.0);
    build.spot_light(light, DVec3::NEG_Z, [1.0; 3], [30.0, 30.0]);
    for (way, frame) in direct_light(&build.scene(), 1).iter().take(3) {
        for (i, pixel) in frame.image.pixels.iter().enumerate() {
            let square = (seen(i) - light).length_squared();
            let inside = light.z / square.sqrt() > 30f64.to_radians().cos();
            let whole = ALBEDO[0] / PI * light.z / square.powf(1.5);
            let expected = if inside { whole } else { 0.0 };
            let off = (f64::from(pixel[0]) - expected).abs();
            assert!(off <= 1e-5 * expected, "{way} {i}: {pixel:?}, not {expected}");
        }
    }
}

/// E cos θ everywhere, but where a plate is between.
#[test]
fn a_directional_light_over_a_plane_and_behind_a_plate() {
    let (height, fov, size) = (1.0, 70.0, 16);
    let seen = seen(height, fov, size);
    let direction = dvec3(1.0, 2.0, -2.0) / 3.0;
    for scale in SCALES {
        let mut build = plane(scale, height, fov, size);
        let black = build.material([0.0; 3], [0.0; 3], false);
        let corner = |x, y| dvec3(x, y, 3.0);
        let plate = [corner(-2.0, -8.0), corner(-1.5, -8.0), corner(-1.5, 2.0), corner(-2.0, 2.0)];
        build.polygon(black, &plate);
        build.directional_light(10.0 * direction, [3.0, 6.0, 1.5]);
        for (way, frame) in direct_light(&build.scene(), 4) {
            let mut lit = 0;
            for (i, pixel) in frame.image.pixels.iter().enumerate() {
                let below = seen(i) - 4.5 * direction;
                let distance = (below.x + 2.0).abs().min((below.x + 1.5).abs());
                if way == "path" && distance < 0.1 {
                    continue;
                }
                let shadow = (-2.0..-1.5).contains(&below.x);
                let expected = if shadow { 0.0 } else { ALBEDO[0] / PI * 2.0 };
                let off = (f64::from(pixel[0]) - expected).abs();
                assert!(off <= 1e-5 * expected, "{way} {i}: {pixel:?}, not {expected}");
                assert!((pixel[1] - pixel[0]).abs() <= 1e-6 && (pixel[2] - pixel[0]).abs() <= 1e-6);
                lit += u32::from(!shadow);
            }
            assert!((20..250).contains(&lit), "{lit} of 256 pixels are lit");
        }
    }
}

/// From below, and grazing.
#[test]
fn a_directional_light_lights_the_side_that_it_reaches() {
    for (direction, expected) in [(DVec3::Z, 0.0), (DVec3::X, 0.0), (dvec3(0.0, 3.0, -4.0), 0.8)] {
        let mut build = plane(1.0, 1.0, 10.0, 4);
        build.directional_light(direction, [1.0; 3]);
        // There is a light that is seen, whatever the other does.
        build.point_light(dvec3(0.0, 0.0, -1.0), [1.0; 3]);
        for (way, frame) in direct_light(&build.scene(), 1) {
            let wanted = (ALBEDO[0] / PI * expected) as f32;
            for pixel in &frame.image.pixels {
                assert!((pixel[0] - wanted).abs() <= 1e-6, "{way}: {pixel:?}, not {wanted}");
            }
        }
    }
}

/// A closed cube around a spot light takes up all its flux.
#[test]
fn the_flux_of_a_spot_light() {
    for angles in [[10.0, 35.0], [0.0, 90.0], [60.0, 60.0], [170.0, 180.0]] {
        let mut build = Build::new();
        let wall = build.material([0.5; 3], [0.0; 3], false);
        build.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
        build.spot_light(dvec3(0.1, 0.2, 0.3), dvec3(1.0, -2.0, 0.5), [1.0, 2.0, 3.0], angles);
        build.camera(DVec3::ZERO, DVec3::X, 60.0, [4, 4]);
        let [flux, _] = first_flux(&build.scene(), 1 << 14);
        let [inner, outer] = angles.map(|angle: f64| angle.to_radians().cos());
        // ∫ ramp² dω, the ramp's cube over three.
        let expected = 2.0 * PI * (1.0 - inner + (inner - outer) / 3.0);
        let off = (flux / dvec3(1.0, 2.0, 3.0) / expected - DVec3::ONE).abs().max_element();
        assert!(off < 1e-3, "{angles:?}: {flux}, not {expected}");
    }
}

/// A cube takes up E times the area of its projection.
#[test]
fn the_flux_of_a_directional_light() {
    for (direction, area) in [(DVec3::X, 6.0), (dvec3(2.0, -1.0, 2.0) / 3.0, 19.0 / 3.0)] {
        let mut build = Build::at(1.0, dvec3(10.0, 0.0, 0.0));
        let wall = build.material([0.5; 3], [0.0; 3], false);
        build.cuboid(wall, dvec3(-0.5, -1.0, -1.5), dvec3(0.5, 1.0, 1.5), false);
        build.directional_light(direction, [1.0, 2.0, 3.0]);
        build.camera(dvec3(9.0, 0.0, 0.0), DVec3::X, 60.0, [4, 4]);
        let scene = build.scene();
        let scale = scene.units.scale.powi(2);
        let [flux, error] = first_flux(&scene, 1 << 16);
        let expected = dvec3(1.0, 2.0, 3.0) * area / scale;
        let off = (flux - expected).abs();
        // Of independent paths 68 % were within the error; these are evenly spread.
        assert!(off.cmplt(error).all(), "{flux}, not {expected}, ± {error}");
        assert!(error.x < 0.01 * expected.x, "± {error}");
    }
}

/// All kinds at once, each drawn by its power: the sum is that of each by itself.
#[test]
fn lights_of_several_kinds_share_the_paths() {
    let build = |which: [bool; 4]| {
        let mut build = Build::new();
        let wall = build.material([0.5; 3], [0.0; 3], false);
        let lamp = build.material([0.5; 3], [0.7; 3], false);
        build.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
        // Without the wall at x = -1.
        build.draft.triangles.drain(0..2);
        let [spot, point, sun, area] = which;
        if spot {
            build.spot_light(DVec3::ZERO, DVec3::X, [3.0; 3], [20.0, 30.0]);
        }
        if point {
            build.point_light(dvec3(0.5, 0.0, 0.0), [0.5; 3]);
        }
        if sun {
            build.directional_light(dvec3(1.0, 0.2, 0.0), [1.0; 3]);
        }
        let corner = |y: f64, z: f64| dvec3(-0.5, y, z);
        let quad = [corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)];
        build.polygon(if area { lamp } else { wall }, &quad);
        build.camera(DVec3::ZERO, DVec3::X, 60.0, [4, 4]);
        first_flux(&build.scene(), 1 << 15)
    };
    let each = (0..4).map(|i| build([0, 1, 2, 3].map(|kind| kind == i)));
    let [sum, error] = each.fold([DVec3::ZERO; 2], |[a, b], [c, d]| [a + c, b + d]);
    let [all, own] = build([true; 4]);
    assert!((all - sum).abs().x < 2.0 * (error + own).x, "{all}, not {sum}");
    assert!(own.x < 0.02 * all.x);
}

#[test]
fn one_bounce_of_a_spot_light() {
    let mut build = Build::open_room();
    build.spot_light(dvec3(0.5, -1.0, 1.2), dvec3(-0.6, 1.0, -1.5), [9.0, 8.0, 7.0], [10.0, 40.0]);
    one_bounce_agrees(&build.scene(), 1 << 14, "spot");
}

#[test]
fn one_bounce_of_a_directional_light() {
    let mut build = Build::open_room();
    build.directional_light(dvec3(-0.5, 1.0, -1.2), [3.0, 2.5, 2.0]);
    one_bounce_agrees(&build.scene(), 1 << 14, "directional");
}
