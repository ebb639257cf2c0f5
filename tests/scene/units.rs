//! Recentring, scaling, rounding, and what is left out.

use glam::{DVec3, Vec3, dvec3};
use gpu_vpl::error::SceneError;
use gpu_vpl::scene::{Bsdf, Draft, DraftCamera, DraftMaterial, FovAxis, Origin, Scene};

use super::{refused, warned};

/// Some triangles of no round coordinates, a point light and a camera, scaled and moved.
fn draft(scale: f64, offset: DVec3) -> Draft {
    let place = |point: DVec3| scale * point + offset;
    let corner = |i: i32| {
        let t = f64::from(i);
        place(dvec3((1.7 * t).sin(), 0.8 * (2.3 * t).cos(), 0.6 * (0.9 * t).sin()))
    };
    let material = |name: &str, albedo: f64| DraftMaterial {
        name: name.to_owned(),
        albedo: DVec3::splat(albedo),
        ..DraftMaterial::default()
    };
    Draft {
        camera: Some(DraftCamera {
            position: place(dvec3(0.3, 0.4, 4.0)),
            direction: dvec3(0.1, 0.0, -3.0),
            up: DVec3::Y,
            fov: 40.0,
            fov_axis: FovAxis::Y,
            size: [64, 48],
            origin: Origin::line("draft", 7),
        }),
        triangles: (0..40).map(|i| ([corner(i), corner(i + 1), corner(i + 2)], 0)).collect(),
        materials: vec![material("grey", 0.5), material("white", 0.8)],
        point_lights: vec![(place(dvec3(0.1, 0.9, 0.2)), scale * scale * dvec3(3.0, 2.0, 1.0))],
        ..Draft::new("draft")
    }
}

fn half_extent(scene: &Scene) -> f32 {
    let corners = scene.triangles.iter().flat_map(|triangle| triangle.vertices);
    corners.map(|corner| corner.abs().max_element()).fold(0.0, f32::max)
}

#[test]
fn scaling_by_a_power_of_two_changes_no_bit() {
    let offset = dvec3(3.1, -0.7, 12.9);
    let one = draft(1.0, offset).finish().unwrap();
    for exponent in [-40, -10, -1, 1, 10, 40] {
        let scale = 2f64.powi(exponent);
        let other = draft(scale, scale * offset).finish().unwrap();
        assert_eq!(one.triangles, other.triangles);
        assert_eq!(one.camera, other.camera);
        assert_eq!(one.point_lights, other.point_lights);
        assert_eq!(one.units.scale * scale, other.units.scale);
    }
}

#[test]
fn the_scene_fills_its_units_at_every_scale() {
    let one = draft(1.0, DVec3::ZERO).finish().unwrap();
    for scale in [1e-6, 0.37, 1.0, 2.5, 1e6] {
        let scene = draft(scale, DVec3::ZERO).finish().unwrap();
        let half = half_extent(&scene);
        assert!((half - 1.0).abs() < 1e-6, "{scale}: {half}");
        assert_eq!(scene.triangles.len(), 40);
        // Rounding of f64 decides that of f32 once in a great while.
        let corners =
            |scene: &Scene| scene.triangles.iter().flat_map(|t| t.vertices).collect::<Vec<_>>();
        let pairs: Vec<_> = corners(&one).into_iter().zip(corners(&scene)).collect();
        let other = pairs.iter().filter(|(a, b)| a != b).count();
        assert!(100 * other < pairs.len(), "{scale}: {other} of {}", pairs.len());
    }
}

#[test]
fn far_from_the_origin_the_triangles_are_the_same() {
    let near = draft(1.0, DVec3::ZERO).finish().unwrap();
    for offset in [dvec3(1e6, 0.0, 0.0), dvec3(-3e5, 1e6, 7e5)] {
        let far = draft(1.0, offset).finish().unwrap();
        assert!((near.units.scale / far.units.scale - 1.0).abs() < 1e-9);
        for (one, other) in near.triangles.iter().zip(&far.triangles) {
            for (a, b) in one.vertices.iter().zip(other.vertices) {
                assert!(a.distance(b) < 1e-6, "{a} {b}");
            }
        }
    }
}

#[test]
fn a_box_of_two_units_keeps_its_scale_far_away() {
    let mut draft = draft(1.0, DVec3::ZERO);
    let corner = |x: f64, y: f64| dvec3(1e6 + 0.1 + x, y, 0.0);
    draft.triangles = vec![([corner(-1.0, -1.0), corner(1.0, -1.0), corner(0.0, 1.0)], 0)];
    assert_eq!(draft.finish().unwrap().units.scale, 1.0);
}

#[test]
fn triangles_without_area_and_duplicates_are_left_out() {
    let mut draft = draft(1.0, DVec3::ZERO);
    let ([a, b, c], _) = draft.triangles[0];
    draft.triangles.extend([
        ([a, b, b], 0),
        ([a, b, a + 0.3 * (b - a)], 0),
        ([a, b, a + 1e-30 * c], 0),
        ([a, a + 1e-25 * b, a + 1e-25 * c], 0),
        ([b, c, a], 1),
        ([c, b, a], 0),
    ]);
    let scene = draft.finish().unwrap();
    assert_eq!((scene.triangles.len(), scene.dropped_triangles), (40, 6));
    assert_eq!(scene.triangles[0].material, 0);
    warned(&scene, "without area left out: 4", false);
    warned(&scene, "duplicates of triangles left out: 2", false);
}

#[test]
fn a_lost_light_is_told() {
    let mut draft = draft(1.0, DVec3::ZERO);
    let ([a, b, c], _) = draft.triangles[0];
    draft.materials[1].emission = DVec3::ONE;
    draft.triangles.push(([c, b, a], 1));
    warned(&draft.finish().unwrap(), "some emit otherwise", true);
}

#[test]
fn slivers_stay() {
    let mut draft = draft(1.0, DVec3::ZERO);
    draft.triangles = vec![([DVec3::ZERO, DVec3::X, dvec3(0.5, 1e-6, 0.0)], 0)];
    let scene = draft.finish().unwrap();
    assert_eq!((scene.triangles.len(), scene.dropped_triangles), (1, 0));
}

#[test]
fn values_that_cannot_be_are_refused() {
    let with = |change: &dyn Fn(&mut Draft)| -> Result<Scene, SceneError> {
        let mut draft = draft(1.0, DVec3::ZERO);
        change(&mut draft);
        draft.finish()
    };
    let camera =
        |change: &dyn Fn(&mut DraftCamera)| with(&|draft| change(draft.camera.as_mut().unwrap()));
    refused(camera(&|c| c.fov = 180.0), "draft:7", "fov");
    refused(camera(&|c| c.fov = f64::NAN), "draft:7", "fov");
    refused(camera(&|c| c.size = [0, 1]), "draft:7", "size");
    refused(camera(&|c| c.up = DVec3::ZERO), "draft:7", "up is 0");
    refused(camera(&|c| c.up = c.direction), "draft:7", "parallel");
    refused(camera(&|c| c.direction = DVec3::NAN), "draft:7", "nowhere");
    refused(camera(&|c| c.position = DVec3::splat(1e60)), "draft:7", "too far");
    refused(with(&|d| d.camera = None), "draft", "no camera");
    refused(with(&|d| d.point_lights.clear()), "draft", "no light");
    refused(with(&|d| d.point_lights[0].0 = DVec3::NAN), "draft", "point light");
    refused(with(&|d| d.point_lights[0].1 = -DVec3::ONE), "draft", "intensity");
    refused(with(&|d| d.triangles.clear()), "draft", "nothing to render");
    refused(with(&|d| d.triangles[3].0[1].y = f64::NAN), "draft", "not a number");
    refused(with(&|d| d.triangles[3].0[1].y = f64::INFINITY), "draft", "1e100");
    refused(with(&|d| d.materials[1].albedo.x = 1.5), "", "material `white`: albedo");
    refused(with(&|d| d.materials[1].emission.x = f64::NAN), "", "material `white`: emission");
    let mirror = Bsdf::Mirror { specular: Vec3::splat(0.5) };
    refused(with(&|d| d.materials[1].bsdf = mirror), "", "have no albedo");
    refused(with(&|d| d.exposure = f64::NAN), "draft", "exposure");
}

#[test]
fn extreme_cameras_are_finite() {
    for fov in [1e-3, 179.0] {
        let mut draft = draft(1.0, DVec3::ZERO);
        let camera = draft.camera.as_mut().unwrap();
        camera.fov = fov;
        camera.position = draft.triangles[0].0[0];
        let camera = draft.finish().unwrap().camera;
        assert!(camera.half_tangents().iter().all(|t| t.is_finite() && *t > 0.0));
        assert!(camera.right.cross(camera.forward).distance(camera.up) < 1e-6);
    }
}
