//! The scene file.

use glam::Vec3;
use gpu_vpl::scene::{Bsdf, FovAxis};

use super::{CAMERA, load, load_more, load_toml, refused};

const POINT: &str = "[[light]]\ntype = \"point\"\nposition = [0, 0, 1]\nintensity = [1, 1, 1]\n";

#[test]
fn camera_mesh_and_mtl_make_a_scene() {
    let scene = load_more("").unwrap();
    assert_eq!(scene.triangles.len(), 2);
    assert_eq!(scene.materials[1].emission.to_array(), [1.0, 2.0, 3.0]);
    assert_eq!(scene.emitters().collect::<Vec<_>>(), [1]);
    assert_eq!((scene.camera.fov_axis, scene.camera.size), (FovAxis::Y, [512, 512]));
    assert_eq!(scene.camera.right.to_array(), [1.0, 0.0, 0.0]);
    assert!(scene.warnings.is_empty());
}

#[test]
fn every_table_refuses_unknown_keys_with_their_line() {
    refused(load_more("\ncolour = 1\n"), "scene.toml:8", "`colour` in [[mesh]]");
    refused(load_toml("exposre = 1\n"), "scene.toml:1", "`exposre` in the scene file");
    refused(load_toml(&format!("{CAMERA}aperture = 1\n")), "scene.toml:5", "`aperture`");
    let material = "[materials.a]\nalbedo = [0, 0, 0]\nroughness = 1\n";
    refused(load_more(material), "scene.toml:9", "`roughness` in [materials.a]");
    refused(load_more(&format!("{POINT}\nsize = 1\n")), "scene.toml:12", "`size`");
    let quad = "[[light]]\ntype = \"quad\"\nintensity = [1, 1, 1]\n";
    refused(load_more(quad), "scene.toml:9", "`intensity` in [[light]] of type \"quad\"");
    refused(load_more("[[sphere]]\nradios = 1\n"), "scene.toml:8", "`radios` in [[sphere]]");
}

#[test]
fn broken_toml_is_refused_with_its_line() {
    refused(load_toml("exposure = 0\n[camera\n"), "scene.toml:2", "not valid TOML");
    refused(load_more("material = \"one\"\nmaterial = \"two\"\n"), "scene.toml:8", "TOML");
    refused(load_toml("camera = 3\n"), "scene.toml:1", "must be a table");
    refused(load_toml("[mesh]\nfile = \"mesh.obj\"\n"), "scene.toml:1", "[[mesh]]");
    refused(load_toml("exposure = \"bright\"\n"), "scene.toml:1", "finite number");
    refused(load_toml("exposure = nan\n"), "scene.toml:1", "finite number");
    refused(load_toml(&format!("exposure = 300\n{CAMERA}")), "scene.toml", "exposure");
}

#[test]
fn a_camera_that_cannot_be_is_refused_with_its_line() {
    let camera = |text: &str| load_toml(&format!("\n[camera]\n{text}"));
    let from = "position = [0, 0, 5]\n";
    refused(camera("fov = 45\n"), "scene.toml:2", "`position` is missing");
    refused(camera(&format!("{from}fov = 45\n")), "scene.toml:2", "`target` or `direction`");
    refused(camera(&format!("{from}target = [0, 0, 0]\n")), "scene.toml:2", "`fov` is missing");
    let both = format!("{from}target = [0, 0, 0]\ndirection = [0, 0, 1]\nfov = 45\n");
    refused(camera(&both), "scene.toml:2", "not both");
    for fov in ["0", "180", "-3", "inf"] {
        let text = format!("{from}target = [0, 0, 0]\nfov = {fov}\n");
        refused(camera(&text), "scene.toml:5", "`fov`");
    }
    for size in ["[0, 4]", "[4, 65537]", "[4]", "[4, 4, 4]", "[1.5, 4]", "\"4x4\"", "[-1, 4]"] {
        let text = format!("{from}target = [0, 0, 0]\nfov = 45\nsize = {size}\n");
        refused(camera(&text), "scene.toml:6", "`size`");
    }
    let axis = format!("{from}target = [0, 0, 0]\nfov = 45\nfov_axis = \"z\"\n");
    refused(camera(&axis), "scene.toml:6", "one of x, y, smaller, larger");

    let rest = "fov = 45\n[[mesh]]\nfile = \"mesh.obj\"\n";
    let nowhere = format!("{from}target = [0, 0, 5]\n{rest}");
    refused(camera(&nowhere), "scene.toml:2", "looks nowhere");
    let up = format!("{from}direction = [0, 0, -2]\nup = [0, 0, 7]\n{rest}");
    refused(camera(&up), "scene.toml:2", "up is parallel");
}

#[test]
fn a_scene_needs_camera_light_and_triangles() {
    refused(load_toml("[[mesh]]\nfile = \"mesh.obj\"\n"), "scene.toml", "no camera");
    refused(load_toml(&format!("{CAMERA}{POINT}")), "scene.toml", "nothing to render");
    let dark = "material = \"one\"\n";
    refused(load_more(dark), "scene.toml", "no light");
    let black = "[[light]]\ntype = \"point\"\nposition = [0, 0, 1]\nintensity = [0, 0, 0]\n";
    refused(load_more(&format!("{dark}{black}")), "scene.toml", "no light");
    assert!(load_more(&format!("{dark}{POINT}")).is_ok());
}

#[test]
fn materials_override_those_of_the_mtl() {
    let scene = load_more(
        "[materials.one]\nalbedo = [0.1, 0.2, 0.3]\n[materials.other]\nalbedo = [0, 0, 0]\n",
    )
    .unwrap();
    let material = &scene.materials[scene.triangles[0].material as usize];
    assert_eq!((material.name.as_str(), material.albedo.to_array()), ("one", [0.1, 0.2, 0.3]));

    let scene = load_more("material = \"two\"\n").unwrap();
    assert_eq!(scene.emitters().count(), 2);
    refused(load_more("material = \"none\"\n"), "scene.toml:7", "`none` is not in [materials]");

    let glow = "material = \"glow\"\n[materials.glow]\nemission = [1, 1, 1]\ntwo_sided = true\n";
    let scene = load_more(glow).unwrap();
    let material = &scene.materials[scene.triangles[0].material as usize];
    assert!(material.two_sided && material.albedo.max_element() == 0.0);
}

#[test]
fn materials_that_cannot_be_are_refused_with_their_line() {
    let material = |text: &str| load_more(&format!("[materials.a]\n{text}"));
    refused(material("albedo = [0, 0.5, 1.1]\n"), "scene.toml:8", "`albedo` must lie");
    refused(material("albedo = [0, -0.5, 1]\n"), "scene.toml:8", "within 0 and 1");
    refused(material("albedo = [0, 1]\n"), "scene.toml:8", "3 finite numbers");
    refused(material("albedo = 0.5\n"), "scene.toml:8", "3 finite numbers");
    refused(material("emission = [0, 0, -1]\n"), "scene.toml:8", "negative");
    refused(material("emission = [0, 0, 1e300]\n"), "scene.toml:8", "f32");
    refused(material("type = \"diffuse\"\n"), "scene.toml:7", "`albedo` is missing");
    refused(material("type = \"metal\"\n"), "scene.toml:8", "one of diffuse");
    refused(material("albedo = [0, 0, 0]\ntwo_sided = 1\n"), "scene.toml:9", "true or false");
}

#[test]
fn materials_of_all_types_are_read() {
    let bsdf = |text: &str| {
        let scene = load_more(&format!("material = \"a\"\n{POINT}[materials.a]\n{text}")).unwrap();
        let material = &scene.materials[scene.triangles[0].material as usize];
        (material.albedo.to_array(), material.bsdf)
    };
    let specular = Vec3::new(0.25, 0.5, 0.125);
    let keys = "specular = [0.25, 0.5, 0.125]\n";
    let phong = format!("type = \"phong\"\nalbedo = [0.5, 0.5, 0.5]\nshininess = 50\n{keys}");
    assert_eq!(bsdf(&phong), ([0.5; 3], Bsdf::Phong { specular, shininess: 50.0 }));
    let mirror = "type = \"mirror\"\n";
    assert_eq!(bsdf(mirror), ([0.0; 3], Bsdf::Mirror { specular: Vec3::ONE }));
    assert_eq!(bsdf(&format!("{mirror}{keys}")), ([0.0; 3], Bsdf::Mirror { specular }));
    let glass = "type = \"glass\"\n";
    assert_eq!(bsdf(glass), ([0.0; 3], Bsdf::Glass { specular: Vec3::ONE, ior: 1.5 }));
    let dense = format!("{glass}ior = 2.5\n{keys}");
    assert_eq!(bsdf(&dense), ([0.0; 3], Bsdf::Glass { specular, ior: 2.5 }));
    let plain = "type = \"diffuse\"\nalbedo = [1, 1, 1]\n";
    assert_eq!(bsdf(plain), ([1.0; 3], Bsdf::Diffuse));
}

#[test]
fn keys_of_another_type_are_refused_with_their_line() {
    let material = |kind: &str, key: &str| {
        load_more(&format!("[materials.a]\ntype = \"{kind}\"\n{key} = 1\n"))
    };
    for (kind, keys) in [
        ("diffuse", &["specular", "shininess", "ior"][..]),
        ("phong", &["ior"]),
        ("mirror", &["albedo", "texture", "shininess", "ior"]),
        ("glass", &["albedo", "texture", "shininess"]),
    ] {
        for key in keys {
            let text = format!("unknown key `{key}` in [materials.a] of type {kind:?}");
            refused(material(kind, key), "scene.toml:9", &text);
        }
    }
}

#[test]
fn finishes_that_cannot_be_are_refused_with_their_line() {
    let material = |text: &str| load_more(&format!("[materials.a]\n{text}"));
    let phong = "type = \"phong\"\nalbedo = [0.75, 0, 0]\n";
    refused(material(&format!("{phong}shininess = 1\n")), "scene.toml:7", "`specular` is missing");
    let specular = "specular = [0.25, 0, 0]\n";
    refused(material(&format!("{phong}{specular}")), "scene.toml:7", "`shininess` is missing");
    let shiny = |n: &str| material(&format!("{phong}{specular}shininess = {n}\n"));
    refused(shiny("-1"), "scene.toml:11", "`shininess` must lie within 0 and 1000000");
    refused(shiny("1e7"), "scene.toml:11", "`shininess` must lie within 0 and 1000000");
    let bright = format!("{phong}shininess = 5\nspecular = [0.5, 0, 0]\n");
    refused(material(&bright), "scene.toml:7", "material `a`: albedo and specular together");
    let bare = "type = \"phong\"\nshininess = 5\nspecular = [0.5, 0, 0]\n";
    refused(material(bare), "scene.toml:7", "`albedo` is missing");
    let mirror = "type = \"mirror\"\nspecular = [1.5, 1, 1]\n";
    refused(material(mirror), "scene.toml:9", "`specular` must lie within 0 and 1");
    let glass = |ior: &str| material(&format!("type = \"glass\"\nior = {ior}\n"));
    refused(glass("0"), "scene.toml:9", "`ior` must lie within 0.1 and 10");
    refused(glass("11"), "scene.toml:9", "`ior` must lie within 0.1 and 10");
    refused(material("texture = 3\n"), "scene.toml:8", "must be a string");
}

#[test]
fn lights_that_cannot_be_are_refused_with_their_line() {
    let light = |text: &str| load_more(&format!("[[light]]\n{text}"));
    refused(light("position = [0, 0, 0]\n"), "scene.toml:7", "`type` is missing");
    refused(light("type = \"laser\"\n"), "scene.toml:8", "one of point");
    let point = "type = \"point\"\nposition = [0, 0, 1]\n";
    refused(light(point), "scene.toml:7", "`intensity` is missing");
    refused(light(&format!("{point}intensity = [1, -1, 1]\n")), "scene.toml:10", "negative");
    let quad = |corners: &str| {
        light(&format!("type = \"quad\"\nradiance = [1, 1, 1]\ncorners = {corners}\n"))
    };
    refused(quad("[[0, 0, 0], [1, 0, 0], [1, 1, 0]]"), "scene.toml:10", "4 points");
    refused(quad("[[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]]"), "scene.toml:10", "area");
    refused(quad("[[0, 0, 0], [1, 1, 0], [1, 0, 0], [0, 1, 0]]"), "scene.toml:10", "area");
    let disk = "type = \"disk\"\ncenter = [0, 0, 1]\nradiance = [1, 1, 1]\n";
    let flat = format!("{disk}normal = [0, 0, 0]\nradius = 1\n");
    refused(light(&flat), "scene.toml:11", "must not be 0");
    let none = format!("{disk}normal = [0, 0, 1]\nradius = 0\n");
    refused(light(&none), "scene.toml:12", "greater than 0");
}

#[test]
fn area_lights_have_their_area_and_face_their_front() {
    let text = "material = \"one\"\n[[light]]\ntype = \"disk\"\ncenter = [0, 0, 3]\n\
        normal = [0, -2, 0]\nradius = 0.5\nradiance = [1, 1, 1]\n[[light]]\ntype = \"quad\"\n\
        corners = [[0, 0, 2], [2, 0, 2], [2, 1, 2], [0, 1, 2]]\nradiance = [3, 2, 1]\n";
    let scene = load_more(text).unwrap();
    let area_of = |name: &str| {
        let is_of = |m: u32| scene.materials[m as usize].name == name;
        let triangles = scene.triangles.iter().filter(|triangle| is_of(triangle.material));
        let normal: Vec3 = triangles.map(|triangle| 0.5 * triangle.scaled_normal()).sum();
        normal.as_dvec3() * scene.units.scale.powi(2)
    };
    let disk = std::f64::consts::PI * 0.25;
    assert!((area_of("light 1") + disk * glam::DVec3::Y).length() < 1e-6);
    assert!((area_of("light 2") - 2.0 * glam::DVec3::Z).length() < 1e-6);
    assert_eq!(scene.emitters().count(), 66);
}

#[test]
fn a_mesh_is_scaled_then_turned_then_moved() {
    let text = "scale = [1, 2, 1]\nrotate = [90, 0, 90]\ntranslate = [10, 0, 0]\n";
    let scene = load_more(text).unwrap();
    // (1, 2, 0) → about x (1, 0, 2) → about z (0, 1, 2) → (10, 1, 2).
    let corner = scene.triangles[1].vertices[1].as_dvec3() * scene.units.scale;
    assert!((corner + scene.units.center - glam::dvec3(10.0, 1.0, 2.0)).length() < 1e-6);

    let matrix = "matrix = [0, 0, 1, 10, 1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 1]\n";
    let scene = load_more(matrix).unwrap();
    let corner = scene.triangles[1].vertices[1].as_dvec3() * scene.units.scale;
    assert!((corner + scene.units.center - glam::dvec3(10.0, 1.0, 2.0)).length() < 1e-6);
}

#[test]
fn a_mirrored_mesh_emits_to_the_mirrored_side() {
    let normal = |text: &str| load_more(text).unwrap().triangles[1].scaled_normal();
    let (plain, mirrored) = (normal(""), normal("scale = [-1, 1, 1]\n"));
    assert!(plain.z > 0.0 && plain.z == mirrored.z, "{plain} {mirrored}");
    assert!(normal("scale = [1, 1, -1]\n").z < 0.0);
    assert!(normal("scale = -1\n").z < 0.0);
}

#[test]
fn transforms_that_cannot_be_are_refused_with_their_line() {
    refused(load_more("scale = [1, 0, 1]\n"), "scene.toml:5", "singular");
    refused(load_more("scale = 0\n"), "scene.toml:5", "singular");
    refused(load_more("scale = [1, 2]\n"), "scene.toml:7", "3 finite numbers");
    refused(load_more("rotate = 90\n"), "scene.toml:7", "3 finite numbers");
    let matrix = "matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n";
    refused(load_more(&format!("{matrix}scale = 2\n")), "scene.toml:7", "excludes");
    let perspective = matrix.replace("0, 1]", "1, 1]");
    refused(load_more(&perspective), "scene.toml:7", "0, 0, 0, 1");
}

#[test]
fn meshes_that_cannot_be_read_are_refused() {
    let mesh = |text: &str| load_toml(&format!("{CAMERA}[[mesh]]\n{text}"));
    refused(mesh("material = \"one\"\n"), "scene.toml:5", "`file` is missing");
    refused(mesh("file = \"gone.obj\"\n"), "scene.toml:6", "gone.obj, which is not there");
    refused(mesh("file = \"a.glb\"\n"), "scene.toml:6", "a.glb, which is not there");
    refused(mesh("file = \"a.ply\"\n"), "scene.toml:6", "unknown kind of mesh");
    let text = format!("{CAMERA}[[mesh]]\nfile = \"bad.obj\"\n");
    let files = [("scene.toml", text.as_str()), ("bad.obj", "v 0 0 0\nf 1 2 3\n")];
    refused(load(&files), "bad.obj:2", "vertex 3");
    refused(load(&[("scene.xyz", "")]), "scene.xyz", "unknown kind of scene");
}
