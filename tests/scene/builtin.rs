//! Scenes made by the program, and those shipped beside it.

use std::collections::HashMap;

use gpu_vpl::scene::{BUILTIN_SCENES, Scene};

use super::refused;

fn load(name: &str) -> Scene {
    Scene::load(&format!("builtin:{name}")).unwrap()
}

#[test]
fn all_load_without_a_warning() {
    for (name, description) in BUILTIN_SCENES {
        let scene = load(name);
        assert!(scene.warnings.is_empty(), "{name}: {:?}", scene.warnings);
        assert_eq!(scene.dropped_triangles, 0);
        assert!(!description.is_empty());
    }
    refused(Scene::load("builtin:none"), "builtin:none", "cornell, cornell-point, room");
}

#[test]
fn the_cornell_box_has_its_measures() {
    let scene = load("cornell");
    assert_eq!(scene.triangles.len(), 38);
    assert_eq!(scene.emitters().count(), 2);
    for emitter in scene.emitters() {
        assert!(scene.triangles[emitter as usize].scaled_normal().y < 0.0);
    }
    let area: f32 = scene.emitters().map(|i| scene.triangles[i as usize].area()).sum();
    let area = f64::from(area) * scene.units.scale.powi(2);
    assert!((area - 130.0 * 105.0).abs() < 0.01);
    // The surface around the light has the ceiling's height, and no overlap with it.
    let point = load("cornell-point");
    assert_eq!((point.triangles.len(), point.point_lights.len()), (30, 1));
}

#[test]
fn what_the_cornell_camera_sees_faces_it() {
    let scene = load("cornell");
    let middle = glam::Vec3::ZERO;
    // Walls face inward: the first ten triangles are floor, back, right and left.
    for triangle in &scene.triangles[..8] {
        let normal = triangle.scaled_normal();
        assert!(normal.dot(middle - triangle.vertices[0]) > 0.0);
    }
}

#[test]
fn the_room_is_large_and_the_same_each_time() {
    let scene = load("room");
    assert!(scene.triangles.len() >= 100_000);
    assert_eq!(scene.point_lights.len(), 1);
    assert!(scene.emitters().count() >= 20);
    assert_eq!(scene.triangles, load("room").triangles);
}

/// Closed shapes have outward normals: the volume that each material's shape encloses, by
/// the divergence theorem, is positive. Only sums over closed shapes are independent of the
/// origin, so furniture alone is looked at.
#[test]
fn the_room_is_wound_outward() {
    let scene = load("room");
    let mut volumes: HashMap<&str, f64> = HashMap::new();
    for triangle in &scene.triangles {
        let [a, b, c] = triangle.vertices.map(|vertex| vertex.as_dvec3());
        let name = scene.materials[triangle.material as usize].name.as_str();
        *volumes.entry(name).or_default() += a.dot(b.cross(c)) / 6.0;
    }
    for name in ["gold", "wood", "book red", "book green", "book blue", "book ivory"] {
        assert!(volumes[name] > 0.0, "{name}: {}", volumes[name]);
    }
}

#[test]
fn the_shipped_scenes_load() {
    let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/");
    let mut found = 0;
    for entry in std::fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let scene = Scene::load(path.to_str().unwrap()).unwrap();
            assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
            found += 1;
        }
    }
    assert!(found >= 2);
    let shipped = Scene::load(&format!("{directory}cornell.toml")).unwrap();
    assert_eq!(shipped.triangles.len(), load("cornell").triangles.len());
}
