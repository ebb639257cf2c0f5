//! The page of a study in a browser: what is drawn, what hands do to it, that it complains of
//! nothing and asks for nothing. Skipped where no Chromium is installed.

#![cfg(unix)]
#![expect(clippy::expect_used, clippy::panic, reason = "a helper of tests fails by panicking")]

mod browser;
mod plot;
mod sample;
mod viewer;

use std::fs::File;
use std::io::BufWriter;

use gpu_vpl::study::page::{self, Picture};
use gpu_vpl::study::results::Results;
use serde_json::json;

use browser::Browser;
use viewer::fingers_move_the_split;

const WIDE: [u32; 2] = [1280, 900];
const PHONE: [u32; 2] = [390, 844];

/// What is looked at in a browser.
type Check = fn(&mut Browser);

/// Checks under their names.
macro_rules! checks {
    ($($check:ident),* $(,)?) => { [$((stringify!($check), $check as Check)),*] };
}
use checks;

/// Each check looks at a fresh page of the sample, of this size, in one browser; the page has
/// nothing to complain of.
fn look(size: [u32; 2], checks: impl IntoIterator<Item = (&'static str, Check)>) {
    let (results, pictures) = sample::study();
    with_browser(|browser| {
        for (name, check) in checks {
            eprintln!("{name}");
            browser.resize(size);
            look_at(browser, &results, &pictures, check);
        }
    });
}

fn with_browser(run: impl FnOnce(&mut Browser)) {
    match browser::installed() {
        Some(program) => run(&mut Browser::start(&program)),
        None => eprintln!("skipped: no Chromium on the path (Debian's package is `chromium`)"),
    }
}

fn look_at(browser: &mut Browser, results: &Results, pictures: &[Picture], check: Check) {
    let directory = tempfile::tempdir().expect("a directory for the page");
    let file = directory.path().join("page.html");
    let mut out = BufWriter::new(File::create(&file).expect("a file"));
    page::write(&mut out, results, pictures).expect("the page is written");
    drop(out);
    browser.open(&file);
    check(browser);
    assert_eq!(browser.complaints, Vec::<String>::new());
}

#[test]
fn the_page_says_what_is_so() {
    look(
        WIDE,
        checks![
            names_are_text_and_nothing_else,
            the_heading_says_what_was_measured,
            the_table_sorts_and_unfolds,
            bars_show_where_the_error_comes_from,
            the_command_of_a_row_is_copied,
        ],
    );
}

#[test]
fn the_page_fits_a_phone() {
    look(PHONE, checks![nothing_is_wider_than_the_view, fingers_move_the_split]);
}

fn names_are_text_and_nothing_else(browser: &mut Browser) {
    assert_eq!(browser.text("document.title"), "a <study>");
    assert_eq!(browser.text("document.querySelector('h1').textContent"), "a <study>");
    assert_eq!(browser.text("document.querySelector('#scene option').text"), sample::HOSTILE);
    assert_eq!(browser.number("document.images.length"), 0.0);
    assert_eq!(browser.number("document.querySelectorAll('#legend i, .warning b').length"), 0.0);
    let legend = browser.text("document.querySelector('[data-curve=C] .name').textContent");
    assert_eq!(legend, "C. <i>odd</i> ones");
}

fn the_heading_says_what_was_measured(browser: &mut Browser) {
    let summary = browser.text("document.querySelector('#summary').textContent");
    for part in ["15 settings of 2 scenes", "llvmpipe", "2 host threads", "5 seeds each"] {
        assert!(summary.contains(part), "{summary}");
    }
    let interrupted = browser.text("document.querySelector('#interrupted').textContent");
    assert!(interrupted.contains("90 of 100 frames"), "{interrupted}");
    let command = browser.text("document.querySelector('header code').textContent");
    assert_eq!(command, "gpu-vpl study -o study");
    let warning = browser.text("document.querySelector('.reference .warning').textContent");
    assert_eq!(warning, "<b>it is noisy</b>");
}

#[test]
fn a_page_without_rows_is_a_page() {
    with_browser(|browser| {
        browser.resize(WIDE);
        let empty = sample::scene("builtin:empty", vec![], vec![]);
        for scenes in [vec![], vec![empty]] {
            look_at(browser, &sample::results("nothing", scenes), &[], nothing_is_said_plainly);
        }
    });
}

fn nothing_is_said_plainly(browser: &mut Browser) {
    let said = browser.text("document.querySelector('#plot .empty').textContent");
    assert!(said.contains("No setting"), "{said}");
    let table = browser.text("document.querySelector('#rows').textContent");
    assert_eq!(table, "Nothing was measured yet.");
}

fn nothing_is_wider_than_the_view(browser: &mut Browser) {
    let overflow = "document.documentElement.scrollWidth - innerWidth";
    assert_eq!(browser.number("innerWidth"), 390.0);
    assert_eq!(browser.number(overflow), 0.0);
    browser.value("document.querySelector('#rows .fold').click()");
    browser.value("document.querySelector('input[value=difference]').click()");
    browser.set("#scene", "1");
    assert_eq!(browser.number(overflow), 0.0);
    browser.set("#scene", "0");
    assert_eq!(browser.number(overflow), 0.0);
    let scrolls = "(box => box.scrollWidth > box.clientWidth)(document.querySelector('#rows'))";
    assert_eq!(browser.value(scrolls), json!(true), "the table scrolls within itself");
}

fn the_table_sorts_and_unfolds(browser: &mut Browser) {
    let first = "document.querySelector('#rows tbody tr .setting span').textContent";
    assert_eq!(browser.text(first), "0.2 s");
    assert_eq!(browser.number("document.querySelectorAll('#rows tr[data-row]').length"), 13.0);
    let place = browser.middle("th[data-column=relmse] button");
    browser.click(place);
    assert_eq!(browser.text(first), "perfect");
    browser.click(place);
    assert_eq!(browser.text(first), "B at 0.3");
    let last = "[...document.querySelectorAll('#rows .setting span')].at(-1).textContent";
    assert_eq!(browser.text(last), "unjudged", "what has no value is last either way");
    let place = browser.middle("tr[data-row='5'] .fold");
    browser.click(place);
    let details = browser.text("document.querySelector('tr.details').textContent");
    assert!(details.contains("shading0.120 s") && details.contains("--interleave 4"), "{details}");
}

fn bars_show_where_the_error_comes_from(browser: &mut Browser) {
    let part = |id: &str, what: &str| {
        format!("document.querySelector('.parts-bar .{id}').getBoundingClientRect().{what}")
    };
    let bar = browser.number("document.querySelector('.parts-bar').clientWidth");
    let mut width = |id: &str| browser.number(&part(id, "width")) / bar;
    // From -0.2 to 1.2 of the error, which the shares add up to.
    for (id, share) in [
        ("direct", 0.5),
        ("antialiasing", 0.1),
        ("sharing", 0.2),
        ("vpls", 0.6),
        ("interaction", 0.0),
    ] {
        let expected = share / 1.4;
        assert!((width(id) - expected).abs() < 0.01, "{id}: {} for {expected}", width(id));
    }
    let zero = browser.number(&part("direct", "left"));
    assert!((browser.number(&part("sharing", "right")) - zero).abs() < 1.0);
    assert!((browser.number(&part("vpls", "right")) - zero - 1.2 / 1.4 * bar).abs() < 1.5);
    assert_eq!(browser.number("document.querySelectorAll('.parts-bar').length"), 1.0);
    let table = browser.text("document.querySelector('#parts table').textContent");
    assert!(table.contains("0.00500") && table.contains("−1.0 %"), "{table}");
    let noise = browser.text("document.querySelector('#parts-noise').textContent");
    assert!(noise.contains("is not known"), "{noise}");
    browser.set("#scene", "1");
    assert_eq!(browser.value("document.querySelector('#parts-section').hidden"), json!(true));
}

fn the_command_of_a_row_is_copied(browser: &mut Browser) {
    browser.value("navigator.clipboard.writeText = (text) => { window.copied = text; return Promise.resolve(); }");
    browser.value("document.querySelector('tr[data-row=\"1\"] .copy').click()");
    browser.until("document.querySelector('tr[data-row=\"1\"] .copy').textContent === 'copied'");
    assert_eq!(browser.text("copied"), "gpu-vpl render --vpls 1600 -o '0.4 s.exr'");
}
