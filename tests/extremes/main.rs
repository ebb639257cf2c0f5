//! The stiff and the extreme: every row has a case, and every case gives what it must.

#![expect(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use std::collections::BTreeSet;
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use std::{env, fs, thread};

use gpu_vpl::cli;
use gpu_vpl::extremes::checks::CHECKS;
use gpu_vpl::extremes::{CASES, Case, Cases, Expect, Judged, Runner, Scale, Verdict};
use gpu_vpl::gpu::AdapterChoice;

mod fails;

/// As the file is now: a changed case needs no build of the library.
fn cases() -> Cases {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/extremes/cases.toml");
    Cases::parse(&fs::read_to_string(file).unwrap()).unwrap()
}

fn runner(cases: &Cases, scale: Scale) -> Runner<'_> {
    Runner::new(cases, scale, cli::front(), AdapterChoice::Auto)
}

fn describe(judged: &Judged) -> String {
    let figure = &judged.figure;
    format!(
        "{} [{}] {} {}: {:e} instead of {:e}, off by {:.2e}, which may be {:.2e} {}",
        judged.case,
        judged.row,
        figure.method,
        figure.what,
        figure.measured,
        figure.expected,
        figure.error,
        figure.within,
        judged.refusal.as_deref().unwrap_or_default(),
    )
}

/// All in one, so that cases of a scene share it and its images; scenes are dealt to as many threads
/// as there are cores. `GPU_VPL_CASES=TEXT` runs those alone whose name, row or scene holds it, and
/// tells every figure; `GPU_VPL_SCALE=full` in full size.
#[test]
fn every_case_gives_what_it_must() {
    let cases = cases();
    let wanted = env::var("GPU_VPL_CASES").ok();
    let full = env::var_os("GPU_VPL_SCALE").is_some_and(|scale| scale == "full");
    let scale = if full { Scale::Full } else { Scale::Small };
    let mut scenes: Vec<(&str, Vec<&Case>)> = Vec::new();
    for case in &cases.cases {
        let names = [&case.name, &case.row, &case.scene];
        if wanted.as_ref().is_some_and(|text| !names.iter().any(|name| name.contains(text))) {
            continue;
        }
        // Two rows may be shown by one check, which need not run twice.
        if case.check.is_some() && scenes.iter().any(|(_, of)| of[0].check == case.check) {
            continue;
        }
        match scenes.iter_mut().find(|(scene, _)| case.check.is_none() && *scene == case.scene) {
            Some((_, of_scene)) => of_scene.push(case),
            None => scenes.push((&case.scene, vec![case])),
        }
    }
    let next = AtomicUsize::new(0);
    let work = || {
        let mut all = Vec::new();
        while let Some((_, of_scene)) = scenes.get(next.fetch_add(1, Ordering::Relaxed)) {
            let mut runner = runner(&cases, scale);
            all.extend(
                of_scene.iter().flat_map(|case| judged(&mut runner, case, wanted.is_some())),
            );
        }
        all
    };
    let judged: Vec<Judged> = thread::scope(|scope| {
        let cores = thread::available_parallelism().map_or(1, NonZero::get);
        let threads: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
    });
    assert!(!judged.is_empty(), "no case was run");
    let wrong: Vec<_> =
        judged.iter().filter(|one| one.verdict == Verdict::Wrong).map(describe).collect();
    let (some, all) = (wrong.len(), judged.len());
    assert!(wrong.is_empty(), "{some} of {all} are wrong:\n{}", wrong.join("\n"));
}

/// What came of a case; with `tell`, it is printed.
fn judged(runner: &mut Runner<'_>, case: &Case, tell: bool) -> Vec<Judged> {
    let start = Instant::now();
    let judged = runner.run(case).unwrap();
    assert!(!judged.is_empty(), "{}: nothing was measured", case.name);
    if tell {
        let figures: Vec<_> = judged.iter().map(describe).collect();
        eprintln!("{:.2} s\n  {}", start.elapsed().as_secs_f64(), figures.join("\n  "));
    }
    judged
}

#[test]
fn the_program_has_the_cases_that_are_tested() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/extremes/cases.toml");
    assert_eq!(fs::read_to_string(file).unwrap(), CASES);
}

#[test]
fn every_row_has_a_case_and_every_case_a_row() {
    let cases = cases();
    let rows: BTreeSet<_> = cases.rows.iter().map(|row| &row.name).collect();
    let shown: BTreeSet<_> = cases.cases.iter().map(|case| &case.row).collect();
    assert_eq!(rows.len(), cases.rows.len(), "rows of the same name");
    assert_eq!(rows, shown, "rows, and those that cases are of");
    // Both tables of the list of what goes wrong.
    assert_eq!(rows.len(), 9 + 30);
    let names: BTreeSet<_> = cases.cases.iter().map(|case| &case.name).collect();
    assert_eq!(names.len(), cases.cases.len(), "cases of the same name");
}

#[test]
fn every_case_says_where_it_comes_from() {
    for case in &cases().cases {
        let name = &case.name;
        assert!(case.check.is_some() || !case.from.is_empty(), "{name}: where is it from?");
        let like = case.expect.as_ref().is_some_and(|expect| match expect {
            Expect::Like(like) => {
                [like.flip, like.mean, like.pixel].into_iter().flatten().any(|most| most > 0.0)
            }
            _ => false,
        });
        let own = case.of.values().any(|own| own.within.is_some());
        let tolerant = case.within > 0.0 || like || own;
        assert!(!tolerant || !case.because.is_empty(), "{name}: why may it be off?");
    }
}

#[test]
fn every_check_is_there_and_is_run() {
    let known: BTreeSet<_> = CHECKS.iter().map(|(name, _)| (*name).to_owned()).collect();
    let run: BTreeSet<_> = cases().cases.iter().filter_map(|case| case.check.clone()).collect();
    assert_eq!(known, run, "checks that are registered, and those that cases name");
}
