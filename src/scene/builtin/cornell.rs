//! The Cornell box as measured at Cornell University's Program of Computer Graphics
//! (<https://www.graphics.cornell.edu/online/box/data.html>), in its units of about a
//! millimetre. Reflectances are RGB stand-ins of the measured spectra.

use glam::{DVec3, dvec3};

use super::shapes::Shapes;
use crate::scene::{Draft, DraftCamera, FovAxis, Origin, SceneError};

const WHITE: [f64; 3] = [0.725, 0.71, 0.68];
const RED: [f64; 3] = [0.63, 0.065, 0.05];
const GREEN: [f64; 3] = [0.14, 0.45, 0.091];
const LIGHT_ALBEDO: [f64; 3] = [0.78; 3];
const RADIANCE: [f64; 3] = [27.0, 20.0, 9.0];

/// A quad of the measurements.
type Quad = [[f64; 3]; 4];

const FLOOR: Quad = [[552.8, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 559.2], [549.6, 0.0, 559.2]];
const CEILING: Quad =
    [[556.0, 548.8, 0.0], [556.0, 548.8, 559.2], [0.0, 548.8, 559.2], [0.0, 548.8, 0.0]];
const LIGHT: Quad =
    [[343.0, 548.8, 227.0], [343.0, 548.8, 332.0], [213.0, 548.8, 332.0], [213.0, 548.8, 227.0]];
const BACK: Quad =
    [[549.6, 0.0, 559.2], [0.0, 0.0, 559.2], [0.0, 548.8, 559.2], [556.0, 548.8, 559.2]];
const RIGHT: Quad = [[0.0, 0.0, 559.2], [0.0, 0.0, 0.0], [0.0, 548.8, 0.0], [0.0, 548.8, 559.2]];
const LEFT: Quad =
    [[552.8, 0.0, 0.0], [549.6, 0.0, 559.2], [556.0, 548.8, 559.2], [556.0, 548.8, 0.0]];

/// The corners of a block's top, x and z, and its height.
type Block = ([[f64; 2]; 4], f64);

const SHORT: Block = ([[130.0, 65.0], [82.0, 225.0], [240.0, 272.0], [290.0, 114.0]], 165.0);
const TALL: Block = ([[423.0, 247.0], [265.0, 296.0], [314.0, 456.0], [472.0, 406.0]], 330.0);

/// The box with its area light.
pub fn area(draft: &mut Draft) -> Result<(), SceneError> {
    let mut shapes = Shapes { draft };
    let white = walls(&mut shapes)?;
    // The light fills a hole of the ceiling.
    for i in 0..4 {
        let j = (i + 1) % 4;
        let frame = [CEILING[i], CEILING[j], LIGHT[j], LIGHT[i]];
        shapes.quad(white, frame.map(DVec3::from_array));
    }
    let light = shapes.light("light", LIGHT_ALBEDO, RADIANCE)?;
    shapes.quad(light, LIGHT.map(DVec3::from_array));
    Ok(())
}

/// The box with a closed ceiling and a point light below it.
pub fn point(draft: &mut Draft) -> Result<(), SceneError> {
    let mut shapes = Shapes { draft };
    let white = walls(&mut shapes)?;
    shapes.quad(white, CEILING.map(DVec3::from_array));
    let intensity = dvec3(1.3e5, 1.1e5, 0.7e5);
    shapes.draft.point_lights.push((dvec3(278.0, 430.0, 279.6), intensity));
    Ok(())
}

/// All but the ceiling, and the camera; returns the white material.
fn walls(shapes: &mut Shapes) -> Result<u32, SceneError> {
    let white = shapes.diffuse("white", WHITE)?;
    let red = shapes.diffuse("red", RED)?;
    let green = shapes.diffuse("green", GREEN)?;
    for (material, wall) in [(white, FLOOR), (white, BACK), (green, RIGHT), (red, LEFT)] {
        shapes.quad(material, wall.map(DVec3::from_array));
    }
    block(shapes, white, &SHORT);
    block(shapes, white, &TALL);
    shapes.draft.camera = Some(DraftCamera {
        position: dvec3(278.0, 273.0, -800.0),
        direction: DVec3::Z,
        up: DVec3::Y,
        // A film of 25 mm behind a focal length of 35 mm.
        fov: 39.3077,
        fov_axis: FovAxis::Smaller,
        size: [512, 512],
        origin: Origin::file(&shapes.draft.name),
    });
    Ok(white)
}

/// Top and sides of a block; it stands on the floor.
fn block(shapes: &mut Shapes, material: u32, &(corners, height): &Block) {
    let foot = corners.map(|[x, z]| dvec3(x, 0.0, z));
    let top = corners.map(|[x, z]| dvec3(x, height, z));
    shapes.quad(material, top);
    for i in 0..4 {
        let j = (i + 1) % 4;
        shapes.quad(material, [foot[j], top[j], top[i], foot[i]]);
    }
}
