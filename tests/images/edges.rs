//! Edges at one sample a pixel: what is thinner than a pixel has its share of light, and rays go
//! where radiance differs alone.

use glam::{DVec3, dvec3};
use gpu_vpl::gpu::Gpu;
use gpu_vpl::image::Image;
use gpu_vpl::render::{Method, Settings};

use crate::common::{Build, gpu, render_on};

/// A camera at the origin that looks along z: a pixel at distance 1.
fn pixel(fov: f64, height: u32) -> f64 {
    2.0 * (0.5 * fov.to_radians()).tan() / f64::from(height)
}

/// A wall at distance 1.2 with a light at the camera, so that shadows are behind what throws them.
fn wall(size: [u32; 2], radiance: f64) -> Build {
    let mut build = Build::new();
    let material = build.material([0.5; 3], [0.0; 3], false);
    let corner = |x: f64, y: f64| dvec3(3.0 * x, 3.0 * y, 1.2);
    let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    build.polygon(material, &corners);
    build.camera(DVec3::ZERO, DVec3::Z, 40.0, size);
    let intensity = radiance * std::f64::consts::PI / 0.5 * 1.44;
    build.point_light(DVec3::ZERO, [intensity; 3]);
    build
}

/// So many triangles behind the camera that the scene has a hierarchy.
fn crowd(build: &mut Build) {
    let material = build.material([0.5; 3], [0.0; 3], false);
    for i in 0..70 {
        let corner = dvec3(f64::from(i % 10) - 5.0, f64::from(i / 10) - 3.0, -2.0);
        build.triangle(material, [corner, corner + 0.3 * DVec3::X, corner + 0.3 * DVec3::Y]);
    }
}

/// A strip at distance 1 that faces the camera, its length and width in pixels.
fn strip(build: &mut Build, material: u32, center: [f64; 2], extent: [f64; 2], turn: f64, of: f64) {
    let along = 0.5 * extent[0] * of * dvec3(turn.cos(), turn.sin(), 0.0);
    let across = 0.5 * extent[1] * of * dvec3(-turn.sin(), turn.cos(), 0.0);
    let center = dvec3(center[0] * of, center[1] * of, 1.0);
    let corner = |x: f64, y: f64| center + x * along + y * across;
    let corners = [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
    build.polygon(material, &corners);
}

fn render(gpu: &Gpu, build: Build, edge_samples: u32) -> Image {
    let settings = Settings { edge_samples, ..Settings::of(Method::Direct) };
    render_on(gpu.clone(), build.scene(), &settings).image
}

/// A lamp a third of a pixel thin over dark walls.
#[test]
fn a_thin_lamp_has_all_its_light() {
    let size = [40, 40];
    let of = pixel(40.0, size[1]);
    for gpu in [gpu().clone(), gpu().clone().without_subgroups()] {
        let dark = render(&gpu, wall(size, 0.05), 1);
        let mut shares = Vec::new();
        for turn in 0..20 {
            let mut build = wall(size, 0.05);
            crowd(&mut build);
            let lamp = build.material([0.0; 3], [17.0; 3], false);
            let turn = f64::from(turn);
            let center = [0.37 * turn % 1.0, 0.61 * turn % 1.0];
            strip(&mut build, lamp, center, [10.0, 1.0 / 3.0], 0.157 * turn, of);
            let image = render(&gpu, build, 16);
            let more = image.pixels.iter().zip(&dark.pixels).map(|(a, b)| f64::from(a[1] - b[1]));
            // What the lamp hides is lost.
            shares.push(more.sum::<f64>() / ((17.0 - 0.05) * 10.0 / 3.0));
        }
        let mean = shares.iter().sum::<f64>() / 20.0;
        let all = shares.iter().all(|share| (share - 1.0).abs() < 0.2);
        assert!(all && (mean - 1.0).abs() < 0.03, "{mean} of {shares:?}");
    }
}

/// A dark wire .3 pixel thick before a bright wall.
#[test]
fn a_thin_wire_has_no_gaps() {
    let size = [232, 180];
    let of = pixel(40.0, size[1]);
    let bright = render(gpu(), wall(size, 1.0), 1);
    for (turn, crowded) in [(0.0, false), (0.07, true), (0.4, true), (0.78, false)] {
        let mut build = wall(size, 1.0);
        if crowded {
            crowd(&mut build);
        }
        let wire = build.material([0.0; 3], [0.0; 3], false);
        strip(&mut build, wire, [0.3, 0.2], [200.0, 0.3], turn, of);
        let image = render(gpu(), build, 16);
        let mut columns = vec![0.0; size[0] as usize];
        for (i, (a, b)) in image.pixels.iter().zip(&bright.pixels).enumerate() {
            columns[i % size[0] as usize] += f64::from(1.0 - a[1] / b[1]);
        }
        let share = columns.iter().sum::<f64>() / (200.0 * 0.3);
        assert!((share - 1.0).abs() < 0.05, "turned by {turn}: {share}");
        let half = 100.0 * f64::cos(turn) - 2.0;
        let [first, last] = [-half, half].map(|x| (116.3 + x) as usize);
        let dark = |gap: &[f64]| gap.iter().any(|&darker| darker > 0.1);
        let gap = columns[first..last].windows(3).position(|gap| !dark(gap));
        assert_eq!(gap, None, "turned by {turn}: {columns:?}");
    }
}

/// Rays beyond the first four are traced where surfaces of unlike radiance meet, and not for what
/// is painted on a wall.
#[test]
fn a_texture_is_no_edge() {
    let painted = |shade: Option<f64>| {
        let mut build = Build::new();
        let checks = (0..64).map(|i| if (i + i / 8) % 2 == 0 { [255; 4] } else { [9, 9, 9, 255] });
        let texture = build.texture(8, checks.collect());
        let material = build.material([0.8; 3], [0.0; 3], false);
        build.draft.materials[material as usize].texture = Some(texture);
        let (across, down) = (dvec3(4.0, 0.0, 0.3), dvec3(0.0, -4.0, 0.2));
        build.textured(material, dvec3(-2.0, 2.0, 1.2), across, down);
        build.camera(DVec3::ZERO, DVec3::Z, 40.0, [48, 40]);
        build.point_light(dvec3(0.3, 0.2, -0.5), [5.0; 3]);
        if let Some(shade) = shade {
            let board = build.material([shade; 3], [0.0; 3], false);
            strip(&mut build, board, [0.0; 2], [20.0, 15.0], 0.3, pixel(40.0, 40));
        }
        build
    };
    let same = |shade| render(gpu(), painted(shade), 16) == render(gpu(), painted(shade), 4);
    assert!(same(None), "more rays for a painted wall");
    assert!(!same(Some(0.1)), "no more rays at the edges of a board");
}
