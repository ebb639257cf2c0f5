//! What is off by little is told from what is right, for every kind of expectation.

use gpu_vpl::extremes::{Cases, Judged, Scale, Verdict};

use super::runner;

/// A plate that emits 2 and fills the image; the same with half of it brighter; one that no file
/// holds.
const START: &str = r#"
row = []
[scenes.plate]
toml = '''
[camera]
position = [0, 0, 1]
target = [0, 0, 0]
fov = 20
size = [4, 4]
[materials.plate]
emission = [2, 2, 2]
[[mesh]]
file = "a.obj"
material = "plate"
'''
shapes = { "a.obj" = "grid 1" }
[scenes.halves]
toml = '''
[camera]
position = [0, 0, 1]
target = [0, 0, 0]
fov = 20
size = [4, 4]
[materials.plate]
emission = [2, 2, 2]
[materials.other]
emission = [2, 2, 2.001]
[[mesh]]
file = "a.obj"
'''
files = { "a.obj" = "v -1 -1 0\nv 0 -1 0\nv 0 1 0\nv -1 1 0\nv 1 -1 0\nv 1 1 0\nusemtl plate\nf 1 2 3 4\nusemtl other\nf 2 5 6 3\n" }
[scenes.missing]
toml = '''
[[mesh]]
file = "b.obj"
'''
[[case]]
name = "case"
row = "row"
methods = ["direct", "both, hard"]
options = "--vpls 16"
"#;

fn judged(rest: &str) -> Vec<Judged> {
    let cases = Cases::parse(&format!("{START}{rest}")).unwrap();
    runner(&cases, Scale::Small).run(&cases.cases[0]).unwrap()
}

/// Both methods come to the same verdict.
fn verdict(rest: &str) -> Verdict {
    let judged = judged(rest);
    let first = judged[0].verdict;
    assert!(judged.iter().all(|judged| judged.verdict == first), "{rest}: {judged:?}");
    first
}

#[test]
fn an_expectation_that_is_off_by_little_is_caught() {
    let plate = "scene = \"plate\"\nwithin = 1e-6\n";
    for (right, wrong) in [
        ("expect = { mean = 2 }", "expect = { mean = 2.00001 }"),
        ("expect = { mean = [2, 2, 2] }", "expect = { mean = [2, 2, 1.99999] }"),
        ("expect = { every-pixel = 2 }", "expect = { every-pixel = 2.00001 }"),
        ("expect = { every-tile = 2 }", "expect = { every-tile = 2.00001 }"),
        ("expect = \"finite\"", "expect = \"black\""),
        ("expect = \"finite\"", "expect = { refused = \"\" }"),
        (
            "expect = \"finite\"",
            "expect = \"finite\"\nregion = [0.1, 0.1, 0.2, 0.2]\nwarns = \"x\"",
        ),
        ("expect = \"finite\"", ""),
        ("expect = \"finite\"", "check = \"none\""),
    ] {
        assert_eq!(verdict(&format!("{plate}{right}\n")), Verdict::Right, "{right}");
        let broken = judged(&format!("{plate}{wrong}\n"));
        assert!(broken.iter().any(|judged| judged.verdict == Verdict::Wrong), "{wrong}");
    }
}

#[test]
fn an_image_that_differs_by_little_is_caught() {
    for kind in ["mean", "pixel", "flip"] {
        let like = |scene: &str| {
            let rest = format!("expect = {{ like = {{ scene = \"{scene}\", {kind} = 1e-6 }} }}");
            verdict(&format!("scene = \"plate\"\n{rest}\n"))
        };
        assert_eq!(like("plate"), Verdict::Right);
        assert_eq!(like("halves"), Verdict::Wrong, "{kind}");
        assert_eq!(like("missing"), Verdict::Wrong, "{kind}");
    }
    // Only where the images differ.
    let part = |x: &str| {
        let like = "expect = { like = { scene = \"halves\", pixel = 1e-6 } }";
        verdict(&format!("scene = \"plate\"\nregion = {x}\n{like}\n"))
    };
    assert_eq!(part("[0, 0, 0.5, 1]"), Verdict::Right);
    assert_eq!(part("[0.5, 0, 1, 1]"), Verdict::Wrong);
    let mirrored = "expect = { like = { mirrored = true, pixel = 1e-6 } }";
    assert_eq!(verdict(&format!("scene = \"plate\"\n{mirrored}\n")), Verdict::Right);
    assert_eq!(verdict(&format!("scene = \"halves\"\n{mirrored}\n")), Verdict::Wrong);
}

#[test]
fn a_refusal_is_the_one_expected() {
    let of = |scene: &str, text: &str| {
        verdict(&format!("scene = \"{scene}\"\nexpect = {{ refused = \"{text}\" }}\n"))
    };
    assert_eq!(of("missing", "b.obj, which is not there"), Verdict::Refused);
    assert_eq!(of("missing", "c.obj"), Verdict::Wrong);
    assert_eq!(of("plate", ""), Verdict::Wrong);
    // Options for publication are not looked at in small.
    let full = "scene = \"plate\"\nfull = \"--vpls 0\"\nexpect = \"finite\"\n";
    assert_eq!(verdict(full), Verdict::Right);
    // The refusal holds no name of a temporary directory.
    let refused = &judged("scene = \"missing\"\nexpect = { refused = \"b.obj\" }\n")[0];
    assert!(refused.refusal.as_deref().is_some_and(|why| why.starts_with("scene.toml:2: ")));
}
