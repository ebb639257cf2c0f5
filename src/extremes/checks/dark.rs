//! A lit room beside a dark one: no method may let light through.

use glam::{DVec3, dvec3};

use super::builder::SceneBuilder;
use super::measure::{at_most, frame_of, of};
use crate::error::{Error, SceneError};
use crate::extremes::{Figure, Scale};
use crate::gpu::Gpu;
use crate::metrics::largest;
use crate::render::{Bounces, Method, Prepared, Settings};
use crate::scene::Scene;

/// What parts the rooms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    /// One wall, on a floor and under a ceiling that go on.
    Wall,
    /// Two closed boxes that touch.
    Touching,
    /// Two closed boxes a ten thousandth of the scene apart.
    Gap,
}

impl Part {
    const ALL: [(Self, &str); 3] = [
        (Self::Wall, "a wall on one floor"),
        (Self::Touching, "boxes that touch"),
        (Self::Gap, "boxes 1e-4 apart"),
    ];

    fn build(self, builder: &mut SceneBuilder, wall: u32) {
        let low = dvec3(-1.0, -0.5, -0.5);
        let apart = if self == Self::Gap { 2e-4 } else { 0.0 };
        if self == Self::Wall {
            builder.cuboid(wall, low, dvec3(1.0, 0.5, 0.5), true);
            let corner = |y, z| dvec3(0.0, y, z);
            builder.quad(
                wall,
                [corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)],
            );
        } else {
            builder.cuboid(wall, low, dvec3(0.0, 0.5, 0.5), true);
            builder.cuboid(wall, dvec3(apart, -0.5, -0.5), dvec3(1.0 + apart, 0.5, 0.5), true);
        }
    }
}

/// The image of the dark room is exactly 0: at every scale, wherever the scene is, with lamps in
/// the lit room that touch the wall, shine along the floor towards it, and stand at its foot.
pub fn rooms(gpu: &Gpu, scale: Scale) -> Result<Vec<Figure>, Error> {
    let full = scale == Scale::Full;
    let places =
        [(1.0, DVec3::ZERO), (1e-6, DVec3::ZERO), (1e6, DVec3::ZERO), (1.0, dvec3(1e6, -1e6, 1e6))];
    let few = if full { &places[..] } else { &places[..1] };
    let mut figures = Vec::new();
    for (part, name) in Part::ALL {
        // The small size has each place with one of the walls.
        let places = if part == Part::Gap { &places[..] } else { few };
        for &(unit, offset) in places {
            let scene = dark_room(part, unit, offset, if full { [128, 96] } else { [24, 16] })?;
            let settings = |method| Settings {
                light_paths: if full { 20_000 } else { 1000 },
                bounces: Bounces::Finite(3),
                ..Settings::of(method)
            };
            let prepared = Prepared::new(gpu.clone(), scene, &settings(Method::Vpl))?;
            for method in [Method::Vpl, Method::Vplc, Method::Vpc, Method::Both, Method::Path] {
                let frame = frame_of(&prepared, &settings(method))?;
                let values = frame.image.pixels.iter().flatten();
                let most = largest(values.map(|value| f64::from(value.abs())));
                let what =
                    format!("{name}, scale {unit:e}, at {:e}: largest pixel", offset.length());
                figures.push(of(method, at_most(what, most, 0.0)));
            }
        }
    }
    Ok(figures)
}

fn dark_room(part: Part, scale: f64, offset: DVec3, size: [u32; 2]) -> Result<Scene, SceneError> {
    let mut builder = SceneBuilder::at(scale, offset);
    let wall = builder.material([0.8; 3], [0.0; 3])?;
    let lamp = builder.material([0.5; 3], [100.0; 3])?;
    part.build(&mut builder, wall);
    let corner = |y, z| dvec3(-1e-4, y, z);
    builder
        .quad(lamp, [corner(-0.5, -0.5), corner(-0.5, -0.4), corner(0.5, -0.4), corner(0.5, -0.5)]);
    builder.point_light(dvec3(-0.9, 0.1, -0.5 + 1e-3), [1.0; 3]);
    builder.point_light(dvec3(-1e-3, 0.2, -0.5 + 1e-3), [1.0; 3]);
    builder.point_light(dvec3(-1e-5, -0.2, 0.0), [1.0; 3]);
    // Towards the foot of the wall.
    builder.camera(dvec3(0.6, 0.0, -0.2), dvec3(-0.6, 0.05, -0.28), 80.0, size);
    builder.scene()
}
