//! Random scenes: shapes of every kind, touching, coincident, flat and tiny; all lights and bsdfs.

use glam::{DMat3, DVec3, Vec2, dvec3};
use gpu_vpl::error::SceneError;
use gpu_vpl::scene::environment::pack;
use gpu_vpl::scene::{Bsdf, Environment, EnvironmentImage, Scene, Wrap};

use super::common::{Build, Rng};
use super::random::{
    between, count, direction, magnitude, percent, pick, place, power, reflectance,
};

/// A scene; an error where what was drawn is refused, as a scene without light is.
pub fn scene(rng: &mut Rng) -> Result<Scene, SceneError> {
    let scale = if percent(rng, 50) { 1.0 } else { magnitude(rng, 1e-6, 1e6) };
    let offset = match percent(rng, 50) {
        true => DVec3::ZERO,
        // The scene's extent is about twice its scale.
        false => direction(rng).normalize() * 2.0 * scale * magnitude(rng, 0.1, 1e6),
    };
    let mut build = Build::at(scale, offset);
    let materials: Vec<u32> = (0..1 + rng.below(6)).map(|_| material(rng, &mut build)).collect();
    if percent(rng, 40) {
        let wall = pick(rng, &materials);
        let (low, high) = (DVec3::splat(-1.0), dvec3(1.0, between(rng, 0.01, 1.0), 1.0));
        build.cuboid(wall, low, high, percent(rng, 80));
    }
    for _ in 0..1 + rng.below(5) {
        let shape = pick(rng, SHAPES);
        let [material, other] = [0; 2].map(|_| pick(rng, &materials));
        shape(rng, &mut build, material, other);
    }
    lights(rng, &mut build);
    camera(rng, &mut build);
    build.draft.finish()
}

fn material(rng: &mut Rng, build: &mut Build) -> u32 {
    let emission = if percent(rng, 20) { power(rng) } else { [0.0; 3] };
    let specular = DVec3::from_array(reflectance(rng)).as_vec3();
    let bsdf = match rng.below(8) {
        0 | 1 => Bsdf::Phong { specular, shininess: magnitude(rng, 1.0, 1e5) as f32 },
        2 => Bsdf::Mirror { specular },
        3 => Bsdf::Glass { specular, ior: between(rng, 0.1, 3.0) as f32 },
        _ => Bsdf::Diffuse,
    };
    let left = match bsdf {
        Bsdf::Phong { specular, .. } => (DVec3::ONE - specular.as_dvec3()).max(DVec3::ZERO),
        Bsdf::Mirror { .. } | Bsdf::Glass { .. } => DVec3::ZERO,
        Bsdf::Diffuse => DVec3::ONE,
    };
    let albedo = (DVec3::from_array(reflectance(rng)) * left).to_array();
    let material = build.material(albedo, emission, percent(rng, 30));
    let mut texture = |rng: &mut Rng| percent(rng, 15).then(|| image(rng, build));
    let textures = [texture(rng), texture(rng), texture(rng)];
    let draft = &mut build.draft.materials[material as usize];
    draft.bsdf = bsdf;
    [draft.texture, draft.cutout, draft.emission_texture] = textures;
    material
}

/// A texture of random texels.
fn image(rng: &mut Rng, build: &mut Build) -> u32 {
    let [width, height] = [0; 2].map(|_| count(rng, 1, 9));
    let texels = (0..width * height).map(|_| rng.bits().to_le_bytes()).collect();
    let texture = build.texture(width, texels);
    let scale = Vec2::splat(magnitude(rng, 1e-3, 1e6) as f32);
    let wraps = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp];
    let laid = &mut build.draft.textures[texture as usize];
    laid.wrap = [0; 2].map(|_| pick(rng, &wraps));
    laid.scale = scale;
    laid.offset = Vec2::new(rng.unit(), -rng.unit());
    texture
}

/// Adds something of one material, at times with something of another.
type Shape = fn(&mut Rng, &mut Build, u32, u32);

const SHAPES: &[Shape] = &[soup, slivers, boxes, coincident, gap, spheres, textured, sheet];

/// Triangles in no order, of a size.
fn soup(rng: &mut Rng, build: &mut Build, material: u32, other: u32) {
    let size = magnitude(rng, 1e-3, 1.0);
    for index in 0..count(rng, 1, 300) {
        let center = place(rng);
        let corners = [0; 3].map(|_| center + size * rng.cube().as_dvec3());
        build.triangle(if index % 2 == 0 { material } else { other }, corners);
    }
}

/// Triangles up to a million times as long as wide.
fn slivers(rng: &mut Rng, build: &mut Build, material: u32, _: u32) {
    for _ in 0..count(rng, 1, 50) {
        let (from, along) = (place(rng), direction(rng).normalize());
        let width = magnitude(rng, 1e-6, 1.0);
        let across = along.any_orthonormal_vector() * width;
        build.triangle(
            material,
            [from, from + along, from + along * between(rng, 0.0, 1.0) + across],
        );
    }
}

/// Boxes that share a face.
fn boxes(rng: &mut Rng, build: &mut Build, material: u32, other: u32) {
    let low = place(rng) - DVec3::splat(0.5);
    let size = dvec3(1.0, magnitude(rng, 1e-5, 1.0), magnitude(rng, 1e-2, 1.0));
    let inward = percent(rng, 50);
    build.cuboid(material, low, low + size, inward);
    let beside = low + size * DVec3::X;
    build.cuboid(other, beside, beside + size, percent(rng, 50));
}

/// The same square twice, the second at times the other way round.
fn coincident(rng: &mut Rng, build: &mut Build, material: u32, other: u32) {
    let (corner, turn) = (place(rng), turned(rng));
    let at = |x: f64, y: f64| corner + turn * dvec3(x, y, 0.0);
    let mut square = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
    build.polygon(material, &square);
    if percent(rng, 50) {
        square.reverse();
    } else {
        // Cut along the other diagonal, so that no triangle is there twice.
        square.rotate_left(1);
    }
    build.polygon(other, &square);
}

/// Two plates that hardly stand apart.
fn gap(rng: &mut Rng, build: &mut Build, material: u32, other: u32) {
    let (corner, turn) = (place(rng), turned(rng));
    let apart = magnitude(rng, 1e-7, 1e-1);
    for (material, z) in [(material, 0.0), (other, apart)] {
        let at = |x: f64, y: f64| corner + turn * dvec3(x, y, z);
        build.polygon(material, &[at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]);
    }
}

/// Spheres of every size, each of which touches the one before.
fn spheres(rng: &mut Rng, build: &mut Build, material: u32, other: u32) {
    let (mut center, mut radius) = (place(rng), magnitude(rng, 1e-6, 1.0));
    for index in 0..count(rng, 1, 20) {
        build.sphere(if index % 2 == 0 { material } else { other }, center, radius);
        let next = magnitude(rng, 1e-6, 1.0);
        center += direction(rng).normalize() * (radius + next);
        radius = next;
    }
}

/// A parallelogram with texture coordinates.
fn textured(rng: &mut Rng, build: &mut Build, material: u32, _: u32) {
    let (corner, turn) = (place(rng), turned(rng));
    build.textured(material, corner, turn * DVec3::X, turn * dvec3(0.3, 1.0, 0.0));
}

/// Many triangles in a plane, all of whose edges are shared.
fn sheet(rng: &mut Rng, build: &mut Build, material: u32, _: u32) {
    let (corner, turn, n) = (place(rng), turned(rng), count(rng, 1, 40));
    let at = |x: u32, y: u32| corner + turn * dvec3(f64::from(x), f64::from(y), 0.0) / f64::from(n);
    for (x, y) in (0..n * n).map(|i| (i % n, i / n)) {
        build.polygon(material, &[at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)]);
    }
}

/// A rotation; often none.
fn turned(rng: &mut Rng) -> DMat3 {
    match rng.below(2) {
        0 => DMat3::IDENTITY,
        _ => DMat3::from_axis_angle(direction(rng).normalize(), between(rng, 0.0, 7.0)),
    }
}

/// Lights of every kind, in any number. Materials that emit are lights, too.
fn lights(rng: &mut Rng, build: &mut Build) {
    for _ in 0..rng.below(4) {
        let at = near(rng, build);
        build.point_light(at, power(rng));
    }
    for _ in 0..rng.below(3) {
        let inner = between(rng, 0.0, 180.0);
        let angles = [inner, if percent(rng, 30) { inner } else { between(rng, inner, 180.0) }];
        let at = near(rng, build);
        build.spot_light(at, direction(rng), power(rng), angles);
    }
    for _ in 0..rng.below(3) {
        build.directional_light(direction(rng), power(rng));
    }
    if percent(rng, 25) {
        let radiance = DVec3::from_array(power(rng)).as_vec3();
        let image = percent(rng, 50).then(|| environment_image(rng));
        build.draft.environment = Some(Environment { radiance, image });
    }
}

fn environment_image(rng: &mut Rng) -> EnvironmentImage {
    let size = [0; 2].map(|_| count(rng, 1, 16));
    let texel = |_| pack(DVec3::from_array(power(rng)).as_vec3());
    let texels = (0..size[0] * size[1]).map(texel).collect();
    EnvironmentImage { name: "environment".to_owned(), size, texels }
}

/// Anywhere, at times at a corner of a surface or on it. In the units before scaling.
fn near(rng: &mut Rng, build: &Build) -> DVec3 {
    let anywhere = place(rng) * magnitude(rng, 0.1, 3.0);
    if build.draft.triangles.is_empty() || percent(rng, 50) {
        return anywhere;
    }
    let ([a, b, c], _) = build.draft.triangles[rng.below(build.draft.triangles.len())];
    let [u, v, w] = if percent(rng, 50) { [1.0, 0.0, 0.0] } else { rng.weights().map(f64::from) };
    (a * u + b * v + c * w - build.offset) / build.scale
}

/// In a wall, at a vertex, or anywhere; all angles of view.
fn camera(rng: &mut Rng, build: &mut Build) {
    let fov =
        if percent(rng, 70) { between(rng, 20.0, 100.0) } else { magnitude(rng, 1e-3, 179.0) };
    let far = if percent(rng, 10) { magnitude(rng, 1.0, 1e4) } else { 1.0 };
    let (position, target) = (near(rng, build) * far, near(rng, build));
    let towards = target - position;
    let direction = if towards.length() > 0.0 { towards } else { DVec3::X };
    build.camera(position, direction, fov, [1, 1]);
}
