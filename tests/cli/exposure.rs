//! Images that cannot be seen as they are exposed.

use std::fs;

use super::{Run, run};

/// A plane under a lamp of this radiance.
fn lit(radiance: f64) -> Run {
    let run = run("render a.toml --size 16x12 --method direct -o a.png");
    let scene = format!(
        "[camera]\nposition = [0, 1, 3]\ntarget = [0, 0, 0]\nfov = 40\n\
         [[mesh]]\nfile = \"a.obj\"\nmaterial = \"a\"\n[materials.a]\nalbedo = [0.5, 0.5, 0.5]\n\
         [[light]]\ntype = \"point\"\nposition = [0, 2, 0]\nintensity = [{radiance}, {radiance}, {radiance}]\n"
    );
    fs::write(run.path("a.toml"), scene).expect("it can be written");
    let plane = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 4 3 2 1\n";
    fs::write(run.path("a.obj"), plane).expect("it can be written");
    run
}

#[test]
fn images_that_cannot_be_seen_are_warned_of_with_the_exposure_that_fits() {
    let told = |mut run: Run, more: &str| {
        run.arguments.extend(more.split_whitespace().map(str::to_owned));
        let stderr = run.succeeds().stderr;
        let told: Vec<String> = stderr
            .lines()
            .filter(|line| line.starts_with("warning: "))
            .map(str::to_owned)
            .collect();
        told
    };
    assert!(told(lit(10.0), "").is_empty());
    for (radiance, what) in [(1e-3, "black"), (1e4, "white")] {
        let warning = told(lit(radiance), "").join("\n");
        assert!(warning.contains(&format!("nearly all that is seen is {what}")), "{warning}");
        let stops = warning.split("--exposure ").nth(1).and_then(|rest| rest.split(' ').next());
        let stops = stops.expect("an exposure").to_owned();
        assert!(told(lit(radiance), &format!("--exposure {stops}")).is_empty());
        let run = lit(radiance);
        assert!(told(run, "--exposure auto --report r.json").is_empty());
        // Nothing of an image of floats is lost.
        let mut floats = lit(radiance);
        floats.arguments.retain(|word| word != "a.png");
        assert!(told(floats, "a.exr").is_empty());
    }
    let away = lit(10.0);
    let scene = fs::read_to_string(away.path("a.toml")).expect("it was written");
    fs::write(away.path("a.toml"), scene.replace("target = [0, 0, 0]", "target = [0, 1, 9]"))
        .expect("it can be written");
    assert!(told(away, "").join(" ").contains("black all over"));
    let refused = run("render -o a.png --exposure automatic");
    refused.fails(2, "give a number of stops, or auto");
}
