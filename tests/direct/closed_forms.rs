//! Direct light and emission of whole frames against closed forms.

use std::f64::consts::PI;

use crate::common::Build;
use glam::{DVec3, dvec3};
use gpu_vpl::image::Image;
use gpu_vpl::render::{Direct, Frame, Method, Settings};

/// Sizes of the same scene: micrometres to a thousand kilometres.
const SCALES: [f64; 4] = [1.0, 1e-6, 37.0, 1e6];

fn direct(light_samples: u32) -> Settings {
    Settings { light_samples: Some(light_samples), ..Settings::of(Method::Direct) }
}

/// Pixels whose first channel is off by more than a relative tolerance, out of how many.
fn wrong(image: &Image, tolerance: f64, expected: impl Fn(u32, u32) -> f64) -> Vec<String> {
    let mut wrong = Vec::new();
    for (i, pixel) in (0..).zip(&image.pixels) {
        let expected = expected(i % image.width, i / image.width);
        let got = f64::from(pixel[0]);
        // A NaN is not right.
        let right = (got - expected).abs() <= tolerance * expected;
        if !right {
            wrong.push(format!("pixel {i}: {got} instead of {expected}"));
        }
    }
    wrong
}

fn assert_image(frame: &Frame, tolerance: f64, expected: impl Fn(u32, u32) -> f64) {
    let wrong = wrong(&frame.image, tolerance, expected);
    let all = frame.image.pixels.len();
    assert!(wrong.is_empty(), "{} of {all} are wrong, first {}", wrong.len(), wrong[0]);
}

const ALBEDO: [f64; 3] = [0.5, 0.25, 1.0];

/// The plane z = 0 with a camera above its origin that looks straight down.
fn plane(scale: f64, height: f64, fov: f64, size: u32) -> Build {
    let mut build = Build::at(scale, DVec3::ZERO);
    let white = build.material(ALBEDO, [0.0; 3], false);
    let corner = |x, y| dvec3(x, y, 0.0);
    let half = 8.0;
    build.polygon(
        white,
        &[corner(-half, -half), corner(half, -half), corner(half, half), corner(-half, half)],
    );
    build.camera(dvec3(0.0, 0.0, height), DVec3::NEG_Z, fov, [size, size]);
    build
}

/// Where the camera of [`plane`] sees the plane.
fn seen(height: f64, fov: f64, size: u32) -> impl Fn(u32, u32) -> DVec3 {
    let half = height * (fov.to_radians() / 2.0).tan();
    let at = move |i: u32| (2.0 * (f64::from(i) + 0.5) / f64::from(size) - 1.0) * half;
    move |x, y| dvec3(at(x), -at(y), 0.0)
}

#[test]
fn a_point_light_over_a_plane() {
    let (height, fov, size) = (3.0, 70.0, 16);
    let seen = seen(height, fov, size);
    for scale in SCALES {
        let mut build = plane(scale, height, fov, size);
        let light = dvec3(0.3, -0.2, 0.7);
        build.point_light(light, [2.0, 5.0, 1.0]);
        let frame = build.render(&direct(1));
        // E = I h / (h² + x²)^1.5: some ten roundings of f32.
        assert_image(&frame, 1e-5, |x, y| {
            let square = (seen(x, y) - light).length_squared();
            ALBEDO[0] / PI * 2.0 * light.z / square.powf(1.5)
        });
        // Channels have the ratio of intensity times albedo.
        let [r, g, b] = frame.image.pixels[37].map(f64::from);
        assert!((g / r - 1.25).abs() < 1e-6 && (b / r - 1.0).abs() < 1e-6);
    }
}

#[test]
fn a_disk_light_above_a_point() {
    const SIDES: u32 = 256;
    for (scale, (radius, height)) in
        SCALES.into_iter().zip([(0.5, 1.0), (2.0, 0.5), (0.1, 1.5), (1.0, 1.0)])
    {
        let mut build = plane(scale, height / 2.0, 1.0, 1);
        let lamp = build.material([0.0; 3], [3.0; 3], false);
        let corner = |i: u32| {
            let angle = -2.0 * PI * f64::from(i) / f64::from(SIDES);
            dvec3(radius * angle.cos(), radius * angle.sin(), height)
        };
        build.polygon(lamp, &(0..SIDES).map(corner).collect::<Vec<_>>());
        let frame = build.render(&direct(4096));
        // E = π L r² / (r² + h²). The polygon lacks 1e-4 of the disk's area. The estimate from
        // 4096 samples of a disk whose radius is 4 times its distance, of which the middle gives
        // most, deviates by some 4e-3.
        let e = PI * 3.0 * radius * radius / (radius * radius + height * height);
        assert_image(&frame, 1e-2, |_, _| ALBEDO[0] / PI * e);
    }
}

/// Irradiance of a polygon of radiance 1, all of it above the horizon (Lambert, 1760).
fn lambert(corners: &[DVec3], at: DVec3, normal: DVec3) -> f64 {
    let edges = (0..corners.len()).map(|i| {
        let [a, b] = [i, i + 1].map(|i| (corners[i % corners.len()] - at).normalize());
        a.angle_between(b) * a.cross(b).normalize().dot(normal)
    });
    (0.5 * edges.sum::<f64>()).abs()
}

/// A quad light, tilted and off centre.
fn quad() -> [DVec3; 4] {
    let (center, u, v) = (dvec3(0.4, -0.1, 1.2), dvec3(0.5, 0.1, 0.2), dvec3(0.0, 0.6, -0.3));
    // Counter-clockwise from below.
    [center - u - v, center - u + v, center + u + v, center + u - v]
}

#[test]
fn a_quad_light_by_lamberts_formula() {
    let (height, fov, size) = (0.45, 130.0, 8);
    let seen = seen(height, fov, size);
    for (scale, two_sided) in SCALES.into_iter().zip([false, true, false, true]) {
        let mut build = plane(scale, height, fov, size);
        let lamp = build.material([0.0; 3], [4.0; 3], two_sided);
        build.polygon(lamp, &quad());
        let frame = build.render(&direct(4096));
        assert_image(&frame, 3e-3, |x, y| {
            ALBEDO[0] / PI * 4.0 * lambert(&quad(), seen(x, y), DVec3::Z)
        });
        let brightest = frame.image.pixels.iter().map(|p| p[0]).fold(0.0, f32::max);
        let darkest = frame.image.pixels.iter().map(|p| p[0]).fold(f32::MAX, f32::min);
        assert!(brightest > 3.0 * darkest, "the points do not differ: a weak test");
    }
}

/// A square lamp that shines down; the i-th of 8 × 8.
fn small_lamp(i: u32) -> [DVec3; 4] {
    let at = |i: u32| 0.5 * (f64::from(i) - 3.5);
    let center = dvec3(at(i % 8), at(i / 8), 0.5);
    let corner = |x: f64, y: f64| center + dvec3(x, y, 0.0);
    // Counter-clockwise from below.
    [corner(-0.1, -0.1), corner(-0.1, 0.1), corner(0.1, 0.1), corner(0.1, -0.1)]
}

/// Each point has its light from few of them, the others have more power: by power alone, 64
/// samples are off by tens of per cent.
#[test]
fn many_lamps_of_different_power() {
    let (height, fov, size) = (0.45, 130.0, 16);
    let seen = seen(height, fov, size);
    let radiance = |i: u32| f64::from(1 + i * i % 7);
    let expected = |x, y| {
        let light = |i| radiance(i) * lambert(&small_lamp(i), seen(x, y), DVec3::Z);
        ALBEDO[0] / PI * (0..64).map(light).sum::<f64>()
    };
    for (scale, (samples, tolerance)) in SCALES.into_iter().zip([(64, 0.1), (4096, 5e-3)]) {
        let mut build = plane(scale, height, fov, size);
        for i in 0..64 {
            let lamp = build.material([0.0; 3], [radiance(i); 3], false);
            build.polygon(lamp, &small_lamp(i));
        }
        assert_image(&build.render(&direct(samples)), tolerance, expected);
    }
}

/// The back of a one-sided light is dark and lights nothing.
#[test]
fn sides_of_lights() {
    for two_sided in [false, true] {
        for upside_down in [false, true] {
            let mut corners = quad();
            if upside_down {
                corners.reverse();
            }
            let mut build = plane(1.0, 0.45, 1.0, 1);
            let lamp = build.material([0.0; 3], [4.0; 3], two_sided);
            build.polygon(lamp, &corners);
            let below = build.render(&direct(256)).image.pixels[0][0];

            let mut build = plane(1.0, 0.0, 1.0, 1);
            let lamp = build.material([0.0; 3], [4.0, 5.0, 6.0], two_sided);
            build.polygon(lamp, &corners);
            build.camera(dvec3(0.4, -0.1, 0.3), DVec3::Z, 1.0, [1, 1]);
            let seen = build.render(&Settings { direct: Direct::Off, ..direct(1) });

            let lit = two_sided || !upside_down;
            assert_eq!(below > 0.1, lit);
            assert_eq!(below == 0.0, !lit);
            // Emission is seen as it is, to the last bit.
            let expected = if lit { [4.0, 5.0, 6.0] } else { [0.0; 3] };
            assert_eq!(seen.image.pixels, [expected]);
        }
    }
}

/// A two-sided plate in the middle of a slab lights both floors alike.
#[test]
fn a_two_sided_light_shines_up_and_down() {
    let up_and_down = [DVec3::NEG_Z, DVec3::Z].map(|direction| {
        let mut build = Build::new();
        let white = build.material(ALBEDO, [0.0; 3], false);
        let lamp = build.material([0.0; 3], [1.0; 3], true);
        build.cuboid(white, dvec3(-3.0, -3.0, -1.0), dvec3(3.0, 3.0, 1.0), true);
        let corner = |x, y| dvec3(x, y, 0.0);
        let plate = [corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)];
        build.polygon(lamp, &plate);
        build.camera(0.5 * direction, direction, 1.0, [1, 1]);
        let expected = ALBEDO[0] / PI * lambert(&plate, direction, DVec3::Z);
        let frame = build.render(&direct(4096));
        assert_image(&frame, 2e-3, |_, _| expected);
        frame.image.pixels[0][0]
    });
    assert!((up_and_down[0] / up_and_down[1] - 1.0).abs() < 2e-3);
}

#[test]
fn pixels_that_are_wrong_are_seen() {
    let image = |value| Image { width: 2, height: 1, pixels: vec![[1.0; 3], [value; 3]] };
    assert!(wrong(&image(2.0), 1e-5, |x, _| f64::from(x + 1)).is_empty());
    assert_eq!(wrong(&image(2.001), 1e-5, |x, _| f64::from(x + 1)).len(), 1);
    assert_eq!(wrong(&image(f32::NAN), 1e-5, |x, _| f64::from(x + 1)).len(), 1);
    assert_eq!(wrong(&image(2.0), 1e-5, |x, _| f64::from(x)).len(), 2);
    // The formula itself: of a whole hemisphere, and of Lambert's own disk.
    let far = 1e4;
    let sky = [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)];
    let sky = sky.map(|(x, y)| dvec3(far * x, far * y, 1.0));
    assert!((lambert(&sky, DVec3::ZERO, DVec3::Z) - PI).abs() < 1e-3);
}
