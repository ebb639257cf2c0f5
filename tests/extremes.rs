//! The checks of extreme cases in their small size: each figure holds.

mod common;

use gpu_vpl::study::extremes::Scale;
use gpu_vpl::study::extremes::checks::CHECKS;

/// Named by `EXTREMES_CHECK`, or all of them; `EXTREMES_FULL` makes them of full size.
#[test]
fn all_checks_hold() {
    let wanted = std::env::var("EXTREMES_CHECK").ok();
    let full = std::env::var_os("EXTREMES_FULL").is_some();
    let scale = if full { Scale::Full } else { Scale::Small };
    let mut faults = Vec::new();
    for (name, check) in CHECKS {
        if wanted.as_deref().is_some_and(|wanted| wanted != *name) {
            continue;
        }
        let start = std::time::Instant::now();
        let figures = check(common::gpu(), scale).unwrap();
        eprintln!("{name}: {} figures in {:.2} s", figures.len(), start.elapsed().as_secs_f64());
        assert!(!figures.is_empty(), "{name} measures nothing");
        for figure in figures {
            eprintln!("    {figure:?}");
            if !figure.holds() {
                faults.push(format!("{name}: {figure:?}"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
