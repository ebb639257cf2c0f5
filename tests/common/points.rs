//! Sets of points with normals to cluster.

use glam::{Vec3, vec3};
use gpu_vpl::cluster::Points;

use super::Rng;

#[derive(Debug, Clone, Default)]
pub struct Set {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
}

impl Set {
    pub fn points(&self) -> Points<'_> {
        Points { positions: &self.positions, normals: &self.normals }
    }

    fn push(&mut self, position: Vec3, normal: Vec3) {
        self.positions.push(position);
        self.normals.push(normal);
    }
}

/// What each pixel of a picture sees, in the order of a Morton curve: `hit` is given the
/// direction of its ray.
fn picture(count: usize, hit: impl Fn(Vec3) -> (Vec3, Vec3)) -> Set {
    let side = 1u32 << ((count as f64).sqrt().log2().ceil() as u32);
    let every_other = |bits: u32| (0..16).fold(0, |x, at| x | (bits >> (2 * at) & 1) << at);
    let mut set = Set::default();
    for index in 0..count as u32 {
        let [x, y] = [every_other(index), every_other(index >> 1)]
            .map(|pixel| 2.0 * (pixel as f32 + 0.5) / side as f32 - 1.0);
        let (position, normal) = hit(vec3(1.5 * x, 1.5 * y, -1.0).normalize());
        set.push(position, normal);
    }
    set
}

/// The walls of the box from −1 to 1 around the ray's origin.
fn wall(direction: Vec3) -> (Vec3, Vec3) {
    let most = direction.abs().max_element();
    let axis = direction.abs().to_array().iter().position(|&x| x == most).unwrap_or(0);
    let mut normal = Vec3::ZERO;
    normal[axis] = -direction[axis].signum();
    let mut position = direction / most;
    position[axis] = -normal[axis];
    (position, normal)
}

pub fn box_of_walls(count: usize) -> Set {
    let mut set = picture(count, wall);
    // The wall behind is seen in a mirror, say.
    for index in (0..count).step_by(97) {
        set.positions[index].z = 1.0;
        set.normals[index] = Vec3::NEG_Z;
    }
    set
}

/// From the centre of a sphere.
pub fn sphere(count: usize) -> Set {
    picture(count, |direction| (3.0 * direction, -direction))
}

/// Walls with one point far away.
pub fn outlier(count: usize) -> Set {
    let mut set = picture(count, wall);
    set.positions[count / 2] = vec3(1e4, -3e4, 1e3);
    set
}

/// Two sheets back to back, hardly apart.
pub fn sheets(count: usize) -> Set {
    let mut set = picture(count, |d| (vec3(d.x, d.y, 0.0), Vec3::Z));
    for index in (0..count).step_by(2) {
        set.positions[index].z = -1e-4;
        set.normals[index] = Vec3::NEG_Z;
    }
    set
}

/// Anywhere, in no order.
pub fn cloud(count: usize) -> Set {
    let mut random = Rng(1);
    let mut cloud = Set::default();
    for _ in 0..count {
        cloud.push(random.cube(), random.direction());
    }
    cloud
}

/// These and adversarial ones, of a thousand points or fewer.
pub fn everything() -> Vec<(&'static str, Set)> {
    let cloud = cloud(1000);
    let with = |change: &dyn Fn(usize, &mut Vec3, &mut Vec3)| {
        let mut set = cloud.clone();
        for (index, pair) in set.positions.iter_mut().zip(&mut set.normals).enumerate() {
            change(index, pair.0, pair.1);
        }
        set
    };
    vec![
        ("walls", box_of_walls(1000)),
        ("sphere", sphere(1000)),
        ("sheets", sheets(1000)),
        ("outlier", outlier(1000)),
        ("coincident", with(&|_, position, _| *position = vec3(0.1, 0.7, -3.3))),
        ("one point", with(&|_, position, normal| (*position, *normal) = (Vec3::ONE, Vec3::Y))),
        ("collinear", with(&|_, position, _| *position = position.x * vec3(1.0, 2.0, 3.0))),
        ("on an axis", with(&|_, position, _| *position = position.x * Vec3::Z)),
        ("lattice", with(&|_, position, _| *position = (*position * 4.0).round())),
        (
            "opposed",
            with(&|index, _, normal| *normal = if index % 2 == 0 { Vec3::X } else { -Vec3::X }),
        ),
        (
            "opposed in one place",
            with(&|index, position, normal| {
                *position = Vec3::ONE;
                *normal = if index % 2 == 0 { Vec3::X } else { -Vec3::X };
            }),
        ),
        (
            "clumps",
            with(&|index, position, _| {
                *position = *position * 1e-5 + if index % 2 == 0 { Vec3::ONE } else { Vec3::ZERO };
            }),
        ),
        ("far away", with(&|_, position, _| *position += 1e4)),
        ("huge", with(&|_, position, _| *position *= 3e38)),
        ("tiny", with(&|_, position, _| *position *= 1e-36)),
        ("single", Set { positions: vec![Vec3::ONE], normals: vec![Vec3::Z] }),
        (
            "three",
            Set {
                positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
                normals: vec![Vec3::Z, Vec3::Z, -Vec3::Z],
            },
        ),
    ]
}
