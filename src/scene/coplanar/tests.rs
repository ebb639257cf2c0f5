use super::*;

fn triangle(corners: [[f32; 3]; 3], material: u32) -> Triangle {
    Triangle { vertices: corners.map(Vec3::from_array), material }
}

fn parted(triangles: Vec<Triangle>) -> (usize, Vec<Triangle>) {
    let count = triangles.len();
    let (uvs, colors) = (vec![[Vec2::ZERO; 3]; count], vec![[Vec3::ONE; 3]; count]);
    let mut shapes = Shapes { triangles, uvs, colors };
    let pairs = shapes.part(&[Material::default(), Material::default()]);
    assert_eq!(
        (shapes.uvs.len(), shapes.colors.len()),
        (shapes.triangles.len(), shapes.triangles.len())
    );
    (pairs, shapes.triangles)
}

const WALL: [[f32; 3]; 3] = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
const SMALL: [[f32; 3]; 3] = [[-0.2, -0.2, 0.0], [0.2, -0.2, 0.0], [0.0, 0.2, 0.0]];

#[test]
fn the_smaller_of_two_is_put_in_front_on_both_sides() {
    for (order, turned) in [([0, 1], false), ([1, 0], false), ([0, 1], true)] {
        let mut small = SMALL;
        if turned {
            small.swap(1, 2);
        }
        let all = [triangle(WALL, 0), triangle(small, 1)];
        let (pairs, parted) = parted(order.map(|i| all[i]).to_vec());
        assert_eq!((pairs, parted.len()), (1, 3));
        let mut heights: Vec<f32> =
            parted.iter().filter(|t| t.material == 1).map(|t| t.vertices[0].z).collect();
        heights.sort_by(f32::total_cmp);
        assert_eq!(heights, [-LIFT, LIFT]);
        assert!(parted.iter().any(|t| *t == all[0]));
    }
}

#[test]
fn neighbours_and_other_planes_are_left_alone() {
    let beside = [[1.0, -1.0, 0.0], [3.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
    let above = SMALL.map(|[x, y, _]| [x, y, 1e-4]);
    let tilted = SMALL.map(|[x, y, _]| [x, y, 0.01 * x]);
    for other in [beside, above, tilted] {
        assert_eq!(parted(vec![triangle(WALL, 0), triangle(other, 1)]).0, 0, "{other:?}");
    }
    assert_eq!(parted(vec![triangle(WALL, 0), triangle(SMALL, 0)]).0, 0);
}

#[test]
fn bodies_that_stand_on_a_floor_are_left_alone() {
    // A pyramid whose base looks at the wall, and the base alone.
    let top = [0.0, 0.0, 0.3];
    let [a, b, c] = SMALL;
    let base = triangle([a, c, b], 1);
    let sides = [[a, b, top], [b, c, top], [c, a, top]].map(|side| triangle(side, 1));
    let wall = triangle(WALL, 0);
    assert_eq!(parted([&[wall, base][..], &sides].concat()).0, 0);
    assert_eq!(parted(vec![wall, base]).0, 1);
}

#[test]
fn rounding_does_not_part_a_plane() {
    let turn = glam::Quat::from_euler(glam::EulerRot::XYZ, 0.3, 0.7, 1.1);
    for step in 0..50 {
        let shift = Vec3::new(0.01, 0.013, 0.0173) * step as f32;
        let turned = |corners: [[f32; 3]; 3], material| Triangle {
            vertices: corners.map(|corner| {
                let exact = turn * Vec3::from_array(corner) + shift;
                (exact * 1e6).round() / 1e6
            }),
            material,
        };
        assert_eq!(parted(vec![turned(WALL, 0), turned(SMALL, 1)]).0, 1, "{step}");
    }
}
