//! Every program that any scene can link is one that parses, validates, and binds what it uses.

#![allow(clippy::expect_used, clippy::panic, reason = "a helper of tests fails by panicking")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use gpu_vpl::gpu::{AdapterChoice, Gpu, Linked, Module, Program};
use gpu_vpl::render::kernels::CATALOGUE;
use gpu_vpl::render::kernels::catalogue::HIT_POINT;
use gpu_vpl::render::{Features, Prepared, Settings, Target, all_programs, kernels};
use gpu_vpl::scene::Scene;
use naga::compact::{KeepUnused, compact};

/// Programs with what linking made of them. There are some, or the test fails.
fn linked() -> Vec<(Program, Linked)> {
    let programs = all_programs();
    assert!(!programs.is_empty(), "no programs: nothing was tested");
    programs
        .into_iter()
        .map(|program| match program.link() {
            Ok(linked) => (program, linked),
            Err(error) => panic!("{}: {error}", program.label),
        })
        .collect()
}

#[test]
fn every_program_links_and_validates() {
    for (program, linked) in linked() {
        let entries = &linked.module.entry_points;
        assert_eq!(entries.len(), 1, "{}: entry points", program.label);
        assert_eq!(entries[0].name, "main", "{}", program.label);
        assert_eq!(entries[0].stage, naga::ShaderStage::Compute, "{}", program.label);
        assert_eq!(entries[0].workgroup_size, [64, 1, 1], "{}", program.label);
        for module in &program.modules {
            assert!(linked.source.contains(module.source), "{} in {}", module.name, program.label);
        }
        let generated = program.generated.as_deref().unwrap_or_default();
        assert!(linked.source.ends_with(generated), "what is generated in {}", program.label);
    }
}

#[test]
fn programs_that_are_wrong_do_not_link() {
    static UNKNOWN: Module = Module {
        name: "unknown",
        source: "@compute @workgroup_size(1)\nfn main() { nowhere(); }",
        feature: None,
    };
    // Parses, but a uniform buffer may not hold an array of stride 4.
    static INVALID: Module = Module {
        name: "invalid",
        source: "@group(0) @binding(0) var<uniform> a: array<u32, 3>;\n\
                 @compute @workgroup_size(1)\nfn main() { let b = a[0]; }",
        feature: None,
    };
    static FINE: Module = Module { name: "fine", source: "const X = 1;\n", feature: None };
    let generated = Some("fn wrong() { nowhere(); }".into());
    let program = Program { label: "bad", modules: vec![&FINE], generated };
    let error = program.link().expect_err("what is generated").to_string();
    assert!(error.contains("bad, generated:1"), "no place in: {error}");
    for (bad, place) in [(&UNKNOWN, "unknown.wgsl:2"), (&INVALID, "invalid.wgsl")] {
        let program = Program::new("bad", vec![&FINE, bad]);
        let error = program.link().expect_err(bad.name).to_string();
        assert!(error.contains(place), "no file and line in: {error}");
    }
}

#[test]
fn every_module_is_used_by_some_program() {
    let programs = all_programs();
    for module in CATALOGUE {
        let used = programs.iter().any(|program| program.modules.contains(module));
        assert!(used, "{}.wgsl is in the catalogue, but in no program", module.name);
    }
    for program in &programs {
        for module in &program.modules {
            assert!(CATALOGUE.contains(module), "{} is not in the catalogue", module.name);
        }
    }
}

/// The files of a folder of `shaders/`, as the catalogue names them.
fn files_of(folder: &Path) -> Vec<String> {
    let name = |path: &Path| path.file_stem().expect("a name").to_string_lossy().into_owned();
    let files = fs::read_dir(folder).expect("a folder of shaders");
    let paths = files.map(|file| file.expect("a file").path());
    let shaders = paths.filter(|path| path.extension().is_some_and(|is| is == "wgsl"));
    shaders.map(|path| format!("{}/{}", name(folder), name(&path))).collect()
}

#[test]
fn every_shader_file_is_in_the_catalogue() {
    let all = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    let folders = fs::read_dir(all).expect("the folder of the shaders");
    let folders = folders.map(|entry| entry.expect("a folder").path()).filter(|path| path.is_dir());
    let files: BTreeSet<String> = folders.flat_map(|folder| files_of(&folder)).collect();
    let known: BTreeSet<String> = CATALOGUE.iter().map(|module| module.name.to_owned()).collect();
    assert_eq!(known.len(), CATALOGUE.len(), "a module is named twice");
    assert_eq!(files, known);
}

/// `shaders/README.md` has a section for each folder, which names the folder's files and no others.
#[test]
fn the_page_of_the_shaders_names_every_file() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    let page = fs::read_to_string(root.join("README.md")).expect("the page");
    let sections = page.split("\n### `").skip(1).flat_map(|section| {
        let (folder, text) = section.split_once('`').expect("a folder in the heading");
        // The last paragraph is the list.
        let list = text.trim().rsplit("\n\n").next().expect("a list");
        let names = list.split('`').skip(1).step_by(2);
        names.map(move |name| format!("{folder}/{name}"))
    });
    let mut named: Vec<String> = sections.collect();
    named.sort();
    let mut known: Vec<String> = CATALOGUE.iter().map(|module| module.name.to_owned()).collect();
    known.sort();
    assert_eq!(named, known, "shaders/README.md (left) against the catalogue");
}

/// The resources that are left when naga has removed what the entry point does not use.
fn used(linked: &Linked) -> BTreeMap<String, naga::ResourceBinding> {
    let mut module = linked.module.clone();
    compact(&mut module, KeepUnused::No);
    let named = module.global_variables.iter().filter_map(|(_, global)| {
        Some((global.name.clone().expect("resources have names"), global.binding?))
    });
    named.collect()
}

#[test]
fn programs_bind_group_0_and_only_what_they_use() {
    let mut numbers: BTreeMap<String, u32> = BTreeMap::new();
    for (program, linked) in linked() {
        let label = program.label;
        let used = used(&linked);
        assert!(!used.is_empty(), "{label} uses no resource");
        assert!(used.values().all(|binding| binding.group == 0), "{label}: {used:?}");
        let expected: BTreeSet<_> = used.iter().map(|(n, b)| (n.clone(), b.binding)).collect();
        let bound: BTreeSet<_> = linked.bindings.iter().cloned().collect();
        assert_eq!(bound, expected, "{label}: bound against used");
        let distinct: BTreeSet<u32> = bound.iter().map(|(_, number)| *number).collect();
        assert_eq!(distinct.len(), bound.len(), "{label}: a binding number twice in {bound:?}");
        // Nor is anything linked whose resources are not used.
        let declared = linked.module.global_variables.iter().filter(|(_, g)| g.binding.is_some());
        assert_eq!(declared.count(), bound.len(), "{label} declares what it does not use");
        for (name, number) in bound {
            let known = *numbers.entry(name.clone()).or_insert(number);
            assert_eq!(known, number, "{label}: '{name}' has another number elsewhere");
        }
    }
}

/// Triangles that are written into a shader are not loaded, but for those that were hit.
#[test]
fn literals_leave_the_hierarchy_out() {
    let mut some = 0;
    for (program, linked) in linked().iter().filter(|(program, _)| program.generated.is_some()) {
        let binds = |name: &str| linked.bindings.iter().any(|(bound, _)| bound == name);
        assert!(!binds("nodes"), "{} binds nodes", program.label);
        assert_eq!(binds("triangles"), program.modules.contains(&&HIT_POINT), "{}", program.label);
        some += 1;
    }
    assert!(some > 0, "nothing is generated");
}

/// Whether the hierarchy is linked depends on the size of the scene.
#[test]
fn a_small_scene_leaves_the_hierarchy_out() {
    let left_out = |copies: usize| {
        let mut scene = Scene::load("builtin:cornell").expect("it is built in");
        scene.triangles = scene.triangles.repeat(copies);
        let gpu = Gpu::open(&AdapterChoice::Auto).expect("a device");
        let prepared = Prepared::new(gpu, scene, &Settings::default()).expect("it fits");
        prepared.left_out()
    };
    let (hierarchy, literals) = ("bounding volume hierarchy", "triangles as literals");
    let (small, large) = (left_out(1), left_out(2));
    assert!(small.contains(&hierarchy) && !small.contains(&literals), "{small:?}");
    assert!(large.contains(&literals) && !large.contains(&hierarchy), "{large:?}");
}

#[test]
fn what_an_entry_point_does_not_use_is_not_bound() {
    static SPARE: Module = Module {
        name: "spare",
        source: "@group(0) @binding(1) var<storage, read> spare: array<u32>;\n\
                 @group(0) @binding(2) var<storage, read_write> out: array<u32>;\n\
                 fn unused() -> u32 { return spare[0]; }\n\
                 @compute @workgroup_size(64)\nfn main() { out[0] = 1u; }",
        feature: None,
    };
    let linked = Program::new("spare", vec![&SPARE]).link().expect("it is valid");
    assert_eq!(linked.bindings, [("out".to_owned(), 2)]);
    assert_eq!(used(&linked).keys().collect::<Vec<_>>(), ["out"]);
}

/// What a scene of plain triangles has no use for is not in the source of its programs.
#[test]
fn plain_programs_hold_neither_spheres_nor_textures() {
    let words = |program: &Program| {
        let source = program.link().expect("it is valid").source.to_lowercase();
        ["sphere", "sample_texture", "texels", "cutout", "alpha"].map(|word| source.contains(word))
    };
    let [none, all] = [Features::default(), Features::everything()].map(|features| {
        let target = Target::of(true, features);
        words(&kernels::visible_points(target, true, false))
    });
    assert_eq!((none, all), ([false; 5], [true; 5]));
}
