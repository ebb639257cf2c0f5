//! What several test files need: a device, random numbers, scenes built by hand.

#![allow(dead_code, reason = "each test file uses its own share")]
#![allow(clippy::expect_used, clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

pub mod child;
pub mod compare;
pub mod gather;
pub mod lights;
pub mod paths;
pub mod points;
pub mod tracing;

use std::sync::OnceLock;

use glam::{DVec3, Vec2, dvec3};
pub use gpu_vpl::extremes::checks::random::Rng;
use gpu_vpl::gpu::{AdapterChoice, Gpu};
use gpu_vpl::metrics::largest;
use gpu_vpl::render::{self, Frame, Prepared, Settings};
use gpu_vpl::scene::{
    Bsdf, Draft, DraftCamera, DraftMaterial, DraftSphere, FovAxis, Origin, Scene, Texels, Texture,
};

/// A device of one's own.
pub fn open_gpu() -> Gpu {
    Gpu::open(&AdapterChoice::Auto).expect("tests need an adapter; Mesa's lavapipe is enough")
}

/// The device that the tests of a binary share.
pub fn gpu() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(open_gpu)
}

/// A scene under construction: everything given in tame units, then scaled and moved in f64.
#[derive(Debug)]
pub struct Build {
    pub draft: Draft,
    pub scale: f64,
    pub offset: DVec3,
}

impl Build {
    pub fn new() -> Self {
        Self::at(1.0, DVec3::ZERO)
    }

    pub fn at(scale: f64, offset: DVec3) -> Self {
        Self { draft: Draft::new("test"), scale, offset }
    }

    fn place(&self, point: DVec3) -> DVec3 {
        point * self.scale + self.offset
    }

    pub fn material(&mut self, albedo: [f64; 3], emission: [f64; 3], two_sided: bool) -> u32 {
        let material = DraftMaterial {
            name: format!("m{}", self.draft.materials.len()),
            albedo: DVec3::from_array(albedo),
            emission: DVec3::from_array(emission),
            two_sided,
            origin: Origin::default(),
            ..DraftMaterial::default()
        };
        self.draft.add_material(material).expect("there are few materials")
    }

    /// A material that does not emit.
    pub fn finished(&mut self, albedo: [f64; 3], bsdf: Bsdf) -> u32 {
        let index = self.material(albedo, [0.0; 3], false);
        self.draft.materials[index as usize].bsdf = bsdf;
        index
    }

    pub fn triangle(&mut self, material: u32, corners: [DVec3; 3]) {
        let corners = corners.map(|corner| self.place(corner));
        self.draft.triangles.push((corners, material));
    }

    /// A convex polygon, as a fan.
    pub fn polygon(&mut self, material: u32, corners: &[DVec3]) {
        for pair in corners[1..].windows(2) {
            self.triangle(material, [corners[0], pair[0], pair[1]]);
        }
    }

    /// An axis-aligned box whose normals point inwards or outwards.
    pub fn cuboid(&mut self, material: u32, low: DVec3, high: DVec3, inward: bool) {
        for axis in 0..3 {
            for side in 0..2 {
                let corner = |u: usize, v: usize| {
                    let mut point = [0.0; 3];
                    for (k, s) in [(axis, side), ((axis + 1) % 3, u), ((axis + 2) % 3, v)] {
                        point[k] = [low.to_array(), high.to_array()][s][k];
                    }
                    DVec3::from_array(point)
                };
                let mut face = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                if (side == 0) != inward {
                    face.reverse();
                }
                self.polygon(material, &face);
            }
        }
    }

    pub fn sphere(&mut self, material: u32, center: DVec3, radius: f64) {
        let (center, radius) = (self.place(center), radius * self.scale);
        self.draft.spheres.push(DraftSphere { center, radius, material });
    }

    /// A texture of rows from the top; its index.
    pub fn texture(&mut self, width: u32, rgba: Vec<[u8; 4]>) -> u32 {
        let size = [width, rgba.len() as u32 / width];
        self.draft.images.push(Texels { name: "image".to_owned(), size, rgba });
        self.draft.textures.push(Texture::of(self.draft.images.len() as u32 - 1));
        self.draft.textures.len() as u32 - 1
    }

    /// A parallelogram from a corner, its edges those of a whole texture: u along the first, v
    /// along the second.
    pub fn textured(&mut self, material: u32, corner: DVec3, across: DVec3, down: DVec3) {
        let at = |u: f64, v: f64| corner + u * across + v * down;
        let uv = |u: f32, v: f32| Vec2::new(u, v);
        self.draft.uvs.resize(self.draft.triangles.len(), [Vec2::ZERO; 3]);
        self.triangle(material, [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0)]);
        self.triangle(material, [at(0.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]);
        self.draft.uvs.push([uv(0.0, 0.0), uv(1.0, 0.0), uv(1.0, 1.0)]);
        self.draft.uvs.push([uv(0.0, 0.0), uv(1.0, 1.0), uv(0.0, 1.0)]);
    }

    /// A point light; its intensity grows with the scene, so that irradiance stays.
    pub fn point_light(&mut self, position: DVec3, intensity: [f64; 3]) {
        let intensity = DVec3::from_array(intensity) * self.scale * self.scale;
        self.draft.point_lights.push((self.place(position), intensity));
    }

    pub fn camera(&mut self, position: DVec3, direction: DVec3, fov: f64, size: [u32; 2]) {
        let up = if direction.x == 0.0 && direction.y == 0.0 { DVec3::Y } else { DVec3::Z };
        self.draft.camera = Some(DraftCamera {
            position: self.place(position),
            direction,
            up,
            fov,
            fov_axis: FovAxis::Y,
            size,
            origin: Origin::default(),
        });
    }

    pub fn scene(self) -> Scene {
        self.draft.finish().expect("a scene of the tests is valid")
    }

    pub fn render(self, settings: &Settings) -> Frame {
        render_scene(self.scene(), settings)
    }
}

pub fn render_scene(scene: Scene, settings: &Settings) -> Frame {
    render_on(gpu().clone(), scene, settings)
}

pub fn render_on(gpu: Gpu, scene: Scene, settings: &Settings) -> Frame {
    frame(&Prepared::new(gpu, scene, settings).expect("the scene fits the device"), settings)
}

pub fn frame(prepared: &Prepared, settings: &Settings) -> Frame {
    let camera = prepared.scene.camera;
    render::frame(prepared, &camera, settings, 1, &|_, _| {}).expect("the frame renders")
}

/// A closed box whose walls all emit and reflect, seen from inside.
pub fn furnace(albedo: [f64; 3], emission: [f64; 3], scale: f64) -> Build {
    let mut build = Build::at(scale, DVec3::ZERO);
    let wall = build.material(albedo, emission, false);
    build.cuboid(wall, dvec3(-1.0, -0.8, -0.6), dvec3(1.0, 0.8, 0.6), true);
    build.camera(dvec3(-0.3, 0.2, 0.1), dvec3(1.0, 0.4, 0.2), 90.0, [32, 32]);
    build
}

/// A closed room [-1, 1]³ with a block in it, in three colours, seen from one corner: lit by a
/// quad under the ceiling and a point light.
pub fn room(scale: f64, offset: DVec3, size: [u32; 2]) -> Build {
    let mut build = Build::at(scale, offset);
    let wall = build.material([0.7, 0.6, 0.5], [0.0; 3], false);
    let block = build.material([0.2, 0.5, 0.8], [0.0; 3], false);
    let lamp = build.material([0.5; 3], [9.0, 8.0, 7.0], false);
    build.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
    build.cuboid(block, dvec3(-0.3, 0.1, -1.0), dvec3(0.4, 0.7, 0.2), false);
    let corner = |x, y| dvec3(x, y, 0.875);
    let quad = [corner(-0.25, -0.25), corner(-0.25, 0.25), corner(0.25, 0.25), corner(0.25, -0.25)];
    build.polygon(lamp, &quad);
    build.point_light(dvec3(0.7, -0.6, 0.3), [0.4, 0.5, 0.6]);
    build.camera(dvec3(-0.9, -0.8, 0.1), dvec3(0.7, 0.65, -0.1), 80.0, size);
    build
}

/// The largest difference of two images, relative to the second one's mean.
pub fn difference(one: &[[f32; 3]], two: &[[f32; 3]]) -> f64 {
    assert_eq!(one.len(), two.len(), "images of different sizes");
    let all = || one.as_flattened().iter().zip(two.as_flattened());
    let mean = all().map(|(_, &b)| f64::from(b.abs())).sum::<f64>() / (3 * two.len()) as f64;
    assert!(mean > 0.0, "a black image compares with everything");
    largest(all().map(|(&a, &b)| f64::from((a - b).abs()))) / mean
}

/// The mean of an image, per channel.
pub fn mean(pixels: &[[f32; 3]]) -> [f64; 3] {
    std::array::from_fn(|channel| {
        pixels.iter().map(|pixel| f64::from(pixel[channel])).sum::<f64>() / pixels.len() as f64
    })
}
