//! What a scene does not need is neither in the source of its programs nor bound, and leaving it
//! out does not change the image.

#![allow(clippy::expect_used, reason = "a helper of tests fails by panicking")]

use std::collections::BTreeSet;

use gpu_vpl::gpu::{AdapterChoice, Gpu, Program};
use gpu_vpl::image::Image;
use gpu_vpl::render::kernels::CATALOGUE;
use gpu_vpl::render::kernels::{features_of, features_without};
use gpu_vpl::render::{Method, Plan, Prepared, Settings, frame};
use gpu_vpl::scene::Scene;

/// What the Cornell box has none of.
const FOREIGN: [&str; 12] = [
    "vertex_color",
    "phong",
    "glass",
    "mirror",
    "texture",
    "texel",
    "sphere",
    "environment",
    "spot",
    "directional",
    "node",
    "bvh",
];

/// Those of [`FOREIGN`] that are in programs with everything linked.
const LINKED: [&str; 8] =
    ["vertex_color", "phong", "glass", "mirror", "texture", "texel", "sphere", "node"];

fn programs(method: Method, link_everything: bool) -> Vec<Program> {
    let scene = Scene::load("builtin:cornell").expect("it is built in");
    let settings = Settings { link_everything, ..Settings::of(method) };
    let programs = Plan::new(scene, &settings, true).programs(&settings);
    assert!(!programs.is_empty(), "{method:?}: nothing is linked");
    programs
}

/// Which of the words are in some identifier of the code, or name of a binding.
fn found<'a>(programs: &[Program], words: &[&'a str]) -> BTreeSet<&'a str> {
    let mut text = String::new();
    for program in programs {
        let linked = program.link().expect("it is valid");
        let lines = linked.source.lines().map(|line| line.split("//").next().unwrap_or_default());
        text.extend(lines.flat_map(|line| [line, "\n"]));
        text.extend(linked.bindings.iter().flat_map(|(name, _)| [name.as_str(), "\n"]));
    }
    // Directions are drawn from hemispheres everywhere, whatever traces rays is told the number of
    // nodes, and tables of all kinds are in textures.
    let harmless = [
        "hemisphere",
        "node_count",
        "params.nodes",
        "nodes: u32",
        "texture_2d",
        "texture_storage_2d",
        "textureload",
        "texturestore",
    ];
    let lean = |text: String, word: &&str| text.replace(*word, "");
    let text = harmless.iter().fold(text.to_lowercase(), lean);
    words.iter().copied().filter(|word| text.contains(word)).collect()
}

#[test]
fn programs_of_the_cornell_box_hold_nothing_that_it_has_none_of() {
    for method in Method::ALL {
        let found = found(&programs(method, false), &FOREIGN);
        assert!(found.is_empty(), "{method:?} holds {found:?}");
    }
}

#[test]
fn with_everything_linked_programs_hold_it_all() {
    for method in [Method::Both, Method::Vpl, Method::Path, Method::Direct] {
        let found = found(&programs(method, true), &LINKED);
        assert_eq!(found, BTreeSet::from(LINKED), "{method:?}");
    }
}

#[test]
fn what_is_left_out_is_what_is_not_linked() {
    let of_catalogue: BTreeSet<_> = CATALOGUE.iter().filter_map(|module| module.feature).collect();
    for method in Method::ALL {
        for link_everything in [false, true] {
            let programs = programs(method, link_everything);
            let modules = || programs.iter().flat_map(|program| &program.modules);
            let linked: BTreeSet<_> = modules().filter_map(|module| module.feature).collect();
            let used = features_of(programs.iter());
            let left_out = features_without(programs.iter());
            assert_eq!(BTreeSet::from_iter(used.iter().copied()), linked);
            let rest: BTreeSet<_> = of_catalogue.difference(&linked).copied().collect();
            assert_eq!(BTreeSet::from_iter(left_out.iter().copied()), rest);
            assert_eq!(used.len() + left_out.len(), of_catalogue.len(), "one is named twice");
        }
    }
}

#[test]
fn features_go_by_the_names_of_reports() {
    let left_out = |method, everything| {
        BTreeSet::from_iter(features_without(programs(method, everything).iter()))
    };
    let both = left_out(Method::Both, false);
    let of_scenes = [
        "textures",
        "vertex colours",
        "emission textures",
        "alpha cut-outs",
        "phong",
        "mirror",
        "glass",
        "spheres",
        "point lights",
    ];
    for feature in of_scenes {
        assert!(both.contains(feature), "{feature} is not in {both:?}");
        assert!(!left_out(Method::Both, true).contains(feature), "{feature} is not linked");
    }
    assert!(both.contains("path tracing") && !both.contains("virtual point lights"), "{both:?}");
    assert!(!both.contains("area lights"), "{both:?}");
    let path = left_out(Method::Path, false);
    assert!(path.contains("virtual point lights") && !path.contains("path tracing"), "{path:?}");
}

/// A device reports what it has compiled, which is what was planned.
#[test]
fn a_device_leaves_out_what_was_planned() {
    let settings = Settings::default();
    let scene = Scene::load("builtin:cornell").expect("it is built in");
    let gpu = Gpu::open(&AdapterChoice::Auto).expect("a device");
    let prepared = Prepared::new(gpu, scene, &settings).expect("it fits");
    let planned = prepared.programs(&settings);
    assert_eq!(prepared.left_out(), features_without(planned.iter()));
}

fn image(method: Method, link_everything: bool) -> Image {
    let (light_paths, samples) = (200, if method == Method::Path { 4 } else { 1 });
    let settings = Settings { light_paths, samples, link_everything, ..Settings::of(method) };
    let scene = Scene::load("builtin:cornell").expect("it is built in");
    let mut camera = scene.camera;
    camera.size = [48, 48];
    let gpu = Gpu::open(&AdapterChoice::Auto).expect("a device");
    let prepared = Prepared::new(gpu, scene, &settings).expect("it fits");
    frame(&prepared, &camera, &settings, 3, &|_, _| {}).expect("it renders").image
}

/// A ray that grazes an edge may meet a triangle through the hierarchy and miss it as it is written
/// into the shader; all other pixels differ by rounding alone. Interleaving brings what a pixel has
/// gathered to those around it.
#[test]
fn linking_everything_leaves_the_image_as_it_is() {
    const GRAZED: usize = 3;
    for method in [Method::Both, Method::Vpl, Method::Path] {
        let settings = Settings::of(method);
        let reach = if settings.interleaves() { 2 * settings.interleave as usize - 1 } else { 1 };
        let [lean, all] = [false, true].map(|everything| image(method, everything));
        let differs = |(a, b): &(&[f32; 3], &[f32; 3])| {
            a.iter().zip(*b).any(|(a, b)| (a - b).abs() > 1e-4 * (a.abs() + b.abs() + 0.1))
        };
        let different = lean.pixels.iter().zip(&all.pixels).filter(differs).count();
        assert!(
            different <= GRAZED * reach * reach,
            "{method:?}: {different} of 2304 pixels differ"
        );
        let sum = |image: &Image| image.pixels.as_flattened().iter().map(|&x| f64::from(x)).sum();
        let [one, two]: [f64; 2] = [&lean, &all].map(sum);
        assert!(one > 0.0 && (one - two).abs() < 2e-3 * one, "{method:?}: {one} and {two}");
    }
}
