//! Lights of every kind, and what is asked of each.

use glam::{DVec3, dvec3};
use gpu_vpl::bvh::Bvh;
use gpu_vpl::image::Image;
use gpu_vpl::render::{
    Bounces, Clamp, Direct, Frame, LightPaths, Lights, Method, Prepared, Settings, Vpl,
};
use gpu_vpl::scene::{DraftSpot, Scene};

use super::{Build, frame, gpu};

pub const ALBEDO: [f64; 3] = [0.5, 0.25, 1.0];

impl Build {
    /// A spot light whose intensity grows with the scene; angles in degrees.
    pub fn spot_light(
        &mut self,
        position: DVec3,
        direction: DVec3,
        intensity: [f64; 3],
        angles: [f64; 2],
    ) {
        let position = position * self.scale + self.offset;
        let intensity = DVec3::from_array(intensity) * self.scale * self.scale;
        self.draft.spot_lights.push(DraftSpot { position, direction, intensity, angles });
    }

    pub fn directional_light(&mut self, direction: DVec3, irradiance: [f64; 3]) {
        self.draft.directional_lights.push((direction, DVec3::from_array(irradiance)));
    }

    /// A room [-1, 1]³ without ceiling and front, with a block in it, seen from the front.
    pub fn open_room() -> Self {
        let mut build = Self::new();
        let wall = build.material([0.7, 0.6, 0.5], [0.0; 3], false);
        let block = build.material([0.2, 0.5, 0.8], [0.0; 3], false);
        let quad = |a, b, c, d| [a, b, c, d];
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z];
        build.polygon(wall, &quad(-x - y - z, x - y - z, x + y - z, -x + y - z));
        build.polygon(wall, &quad(-x + y - z, x + y - z, x + y + z, -x + y + z));
        build.polygon(wall, &quad(-x - y - z, -x + y - z, -x + y + z, -x - y + z));
        build.polygon(wall, &quad(x - y - z, x - y + z, x + y + z, x + y - z));
        build.cuboid(block, dvec3(-0.2, 0.1, -0.99), dvec3(0.4, 0.7, -0.3), false);
        build.camera(dvec3(0.1, -2.6, 0.3), dvec3(0.0, 1.0, -0.15), 50.0, [16, 16]);
        build
    }
}

/// The plane z = 0 with a camera above its origin that looks straight down.
pub fn plane(scale: f64, height: f64, fov: f64, size: u32) -> Build {
    let mut build = Build::at(scale, DVec3::ZERO);
    let white = build.material(ALBEDO, [0.0; 3], false);
    let corner = |x, y| dvec3(8.0 * x, 8.0 * y, 0.0);
    let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    build.polygon(white, &corners);
    build.camera(dvec3(0.0, 0.0, height), DVec3::NEG_Z, fov, [size, size]);
    build
}

/// Where the camera of [`plane`] sees the plane, by the index of the pixel.
pub fn seen(height: f64, fov: f64, size: u32) -> impl Fn(usize) -> DVec3 {
    let half = height * (fov.to_radians() / 2.0).tan();
    let at = move |i: usize| (2.0 * (i as f64 + 0.5) / f64::from(size) - 1.0) * half;
    move |i| dvec3(at(i % size as usize), -at(i / size as usize), 0.0)
}

/// Direct light as the direct method, the path tracer and clusters show it, with so many rays to
/// lights of some extent.
pub fn direct_light(scene: &Scene, samples: u32) -> Vec<(&'static str, Frame)> {
    let edge_samples = 1;
    let direct =
        Settings { edge_samples, light_samples: Some(samples), ..Settings::of(Method::Direct) };
    let clustered = Settings {
        method: Method::Vpc,
        direct: Direct::Clustered,
        bounces: Bounces::Finite(0),
        interleave: 1,
        candidates: 1,
        ..direct
    };
    let bounces = Bounces::Finite(0);
    let path = Settings { bounces, samples, ..Settings::of(Method::Path) };
    let render = |gpu, settings: &Settings| {
        let prepared = Prepared::new(gpu, scene.clone(), settings).unwrap();
        frame(&prepared, settings)
    };
    vec![
        ("direct", render(gpu().clone(), &direct)),
        ("direct, plain", render(gpu().clone().without_subgroups(), &direct)),
        ("clustered", render(gpu().clone(), &clustered)),
        ("path", render(gpu().clone(), &path)),
    ]
}

/// What light paths leave at their first hits.
pub fn first_hits(scene: &Scene, count: u32) -> Vec<Vpl> {
    let (bvh, lights) = (Bvh::of(scene), Lights::of(scene));
    let bounces = Bounces::Finite(1);
    LightPaths { scene, bvh: &bvh, lights: &lights, count, bounces, seed: 1 }.trace()
}

/// Flux of the first hits, and its standard error if paths were independent.
pub fn first_flux(scene: &Scene, count: u32) -> [DVec3; 2] {
    let hits = first_hits(scene, count);
    let flux: DVec3 = hits.iter().map(|vpl| vpl.flux.as_dvec3()).sum();
    let squares: DVec3 = hits.iter().map(|vpl| vpl.flux.as_dvec3().powf(2.0)).sum();
    let variance = squares - flux * flux / f64::from(count);
    [flux, variance.max(DVec3::ZERO).map(f64::sqrt)]
}

pub fn mean_of(image: &Image, pixels: impl Iterator<Item = usize>) -> DVec3 {
    let (mut sum, mut count) = (DVec3::ZERO, 0.0);
    for pixel in pixels {
        sum += DVec3::from_array(image.pixels[pixel].map(f64::from));
        count += 1.0;
    }
    sum / count
}

/// The light of one bounce is the same from VPLs and from paths: over the image to 1.5 % and the
/// noise, over its quarters to 4 %.
pub fn one_bounce_agrees(scene: &Scene, light_paths: u32, what: &str) {
    let [vpl, path] = [Method::Vpl, Method::Path].map(|method| {
        let settings = Settings {
            light_paths,
            samples: if method == Method::Path { 1024 } else { 1 },
            bounces: Bounces::Finite(1),
            direct: Direct::Off,
            clamp: Clamp::Off,
            // Paths see all of a pixel.
            edge_samples: 64,
            ..Settings::of(method)
        };
        let prepared = Prepared::new(gpu().clone(), scene.clone(), &settings).unwrap();
        frame(&prepared, &settings)
    });
    // Emission and background are in both, exactly; what is compared is the rest.
    let (_, error) = super::paths::mean_and_error(&path, 0);
    let width = path.image.width as usize;
    let quarter = |q: usize| {
        let half = width / 2;
        (0..half * half).map(move |i| (q / 2 * half + i / half) * width + q % 2 * half + i % half)
    };
    let compare = |pixels: &dyn Fn() -> Vec<usize>, most: f64| {
        let [a, b] = [&vpl, &path].map(|frame| mean_of(&frame.image, pixels().into_iter()));
        let off = (a / b - DVec3::ONE).abs().max_element();
        assert!(off < most + 4.0 * error / b.x, "{what}: {a} from VPLs, {b} from paths ± {error}");
        assert!(b.min_element() > 0.0);
    };
    compare(&|| (0..width * width).collect(), 0.015);
    for q in 0..4 {
        compare(&|| quarter(q).collect(), 0.04);
    }
}
