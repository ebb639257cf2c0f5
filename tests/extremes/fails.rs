//! The judge fails what is off: cases whose expectation is wrong by little.

use gpu_vpl::study::extremes::{Cases, Judged, Scale, Verdict};

use super::runner;

/// A plate that emits 2, seen by all pixels, and one that is not seen.
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
[[case]]
name = "case"
row = "row"
scene = "plate"
methods = ["direct"]
"#;

fn judged(rest: &str) -> Vec<Judged> {
    let cases = Cases::parse(&format!("{START}{rest}")).unwrap();
    runner(&cases, Scale::Small).run(&cases.cases[0]).unwrap()
}

fn verdicts(rest: &str) -> Vec<Verdict> {
    judged(rest).iter().map(|judged| judged.verdict).collect()
}

#[test]
fn an_expectation_that_is_off_by_little_is_caught() {
    let (right, wrong) = (vec![Verdict::Right], vec![Verdict::Wrong]);
    let within = "within = 1e-6\n";
    for (sound, broken) in [
        ("expect = { mean = 2 }", "expect = { mean = 2.0001 }"),
        ("expect = { mean = [2, 2, 2] }", "expect = { mean = [2, 2, 1.9999] }"),
        ("expect = { every-pixel = 2 }", "expect = { every-pixel = 2.0001 }"),
        ("expect = \"finite\"", "expect = \"black\""),
        ("expect = \"finite\"", "expect = { refused = \"\" }"),
        ("expect = \"finite\"", "check = \"none\""),
        ("expect = \"finite\"", ""),
        (
            "expect = { like = { flip = 1e-6, set = { a = 1 } } }",
            "expect = { like = { flip = 1e-6, scene = \"none\" } }",
        ),
        (
            "expect = { like = { pixel = 1e-6, method = \"vpl\" } }",
            "expect = { like = { pixel = 1e-6, method = \"normal\" } }",
        ),
        (
            "expect = { like = { mean = 1e-6, method = \"vpl\" } }",
            "expect = { like = { mean = 1e-6, method = \"depth\" } }",
        ),
        (
            "expect = { like = { flip = 1e-6, method = \"vpl\" } }",
            "expect = { like = { flip = 1e-6, method = \"normal\" } }",
        ),
        ("expect = \"finite\"", "expect = \"finite\"\nwarns = \"of something\""),
        ("expect = \"finite\"", "expect = \"finite\"\nregion = [0.1, 0.1, 0.1, 0.1]\nexpect2 = 1"),
    ] {
        if let Ok(cases) = Cases::parse(&format!("{START}{within}{broken}\n")) {
            let judged = runner(&cases, Scale::Small).run(&cases.cases[0]).unwrap();
            assert!(judged.iter().any(|judged| judged.verdict == Verdict::Wrong), "{broken}");
        }
        assert_eq!(verdicts(&format!("{within}{sound}\n")), right, "{sound}");
    }
    let _ = wrong;
}
