//! The viewer of pictures, against what the program itself makes of the same pixels.

use gpu_vpl::image::{Image, Tone, tone};
use serde_json::json;

use super::browser::Browser;
use super::sample::{self, SIZE};
use super::{Check, WIDE, checks, look};

/// A pixel in the middle of each quarter of the pictures.
const QUARTERS: [[u32; 2]; 4] = [[16, 12], [48, 12], [16, 36], [48, 36]];

#[test]
fn the_viewer_shows_pictures() {
    look(
        WIDE,
        checks![
            pixels_are_those_of_the_png,
            the_split_follows_pointer_and_keys,
            the_difference_is_one,
            the_pixel_pointed_at_is_told,
            it_zooms_and_pans
        ],
    );
}

/// The colour on the canvas at a pixel of the picture, all of which is shown.
fn colour(browser: &mut Browser, [x, y]: [u32; 2]) -> [u8; 3] {
    let [width, height] = SIZE;
    let rgba = browser.value(&format!(
        "(() => {{ const view = document.querySelector('#view');
          const place = [({x} + 0.5) / {width} * view.width, ({y} + 0.5) / {height} * view.height];
          const copy = new OffscreenCanvas(1, 1).getContext('2d');
          copy.drawImage(view, ...place.map((coordinate) => -Math.floor(coordinate)));
          return [...copy.getImageData(0, 0, 1, 1).data]; }})()"
    ));
    [0, 1, 2].map(|channel| rgba[channel].as_u64().expect("a byte") as u8)
}

fn colours(browser: &mut Browser) -> [[u8; 3]; 4] {
    QUARTERS.map(|pixel| colour(browser, pixel))
}

/// The colours that the program's own PNG has in the quarters.
fn expected(image: &Image, exposure: f32) -> [[u8; 3]; 4] {
    let bytes = tone::to_rgb8(image, Tone::Radiance { exposure });
    QUARTERS.map(|[x, y]| {
        let first = 3 * (y * SIZE[0] + x) as usize;
        [bytes[first], bytes[first + 1], bytes[first + 2]]
    })
}

/// Waits until the pictures of the first scene are unpacked.
fn unpacked(browser: &mut Browser) {
    browser.until("document.querySelector('#says').hidden");
}

fn mode(browser: &mut Browser, mode: &str) {
    browser.value(&format!("document.querySelector('[name=mode][value={mode}]').click()"));
}

fn pixels_are_those_of_the_png(browser: &mut Browser) {
    unpacked(browser);
    for (name, image) in [("a", sample::one()), ("b", sample::other())] {
        mode(browser, name);
        for exposure in [0.0_f32, 1.0, -2.0] {
            browser.set("#exposure", &exposure.to_string());
            assert_eq!(colours(browser), expected(&image, exposure), "{name} at {exposure} EV");
        }
    }
    browser.set("#exposure", "0");
    assert_eq!(colour(browser, [63, 47]), [0, 255, 0], "not finite");
    let shown = browser.text("document.querySelector('#exposure-value').textContent");
    assert_eq!(shown, "0 EV");
}

fn the_split_follows_pointer_and_keys(browser: &mut Browser) {
    unpacked(browser);
    let (a, b) = (expected(&sample::one(), 0.0), expected(&sample::other(), 0.0));
    assert_eq!(colours(browser), [a[0], b[1], a[2], b[3]], "A is on the left");
    let from = browser.middle("#split");
    let width = browser.number("document.querySelector('#stage').clientWidth");
    browser.drag(from, [from[0] + 0.4 * width, from[1]]);
    assert_eq!(colours(browser), a);
    let now = "Number(document.querySelector('#split').ariaValueNow)";
    assert_eq!(browser.number(now), 90.0);
    for _ in 0..40 {
        browser.key("ArrowLeft");
    }
    assert_eq!(browser.number(now), 10.0);
    assert_eq!(colours(browser), b);
    assert_eq!(colour(browser, [2, 2]), a[0]);
}

fn the_difference_is_one(browser: &mut Browser) {
    unpacked(browser);
    mode(browser, "difference");
    let high = "document.querySelector('#scale-high').textContent";
    // The largest is in the upper left: √((0.4375² + 0.1875² + 0.0625²) / 3) = 0.277.
    assert_eq!(browser.text(high), "0.5");
    let [largest, right, below, _] =
        colours(browser).map(|rgb| rgb.iter().map(|&c| u32::from(c)).sum::<u32>());
    assert!(largest > right && right > below && below > 0, "{largest} {right} {below}");
    let middle = 0.277_f64 / 0.5 * 8.0;
    // Magma between its fifth and sixth colour.
    let part = middle - 4.0;
    let red = f64::from(181_u8) + part * f64::from(229_u8 - 181);
    assert!((f64::from(colour(browser, QUARTERS[0])[0]) - red).abs() < 2.0);
    browser.set("#kind", "signed");
    assert_eq!(browser.text("document.querySelector('#scale-low').textContent"), "−0.5");
    let [r, _, b] = colour(browser, QUARTERS[0]);
    assert!(r > b, "A is brighter: red");
    browser.value("document.querySelector('[title=\"Exchange A and B\"]').click()");
    browser.until("document.querySelector('#picture-a').value === '1'");
    unpacked(browser);
    let [r, _, b] = colour(browser, QUARTERS[0]);
    assert!(r < b, "A is darker: blue");
    browser.set("#picture-a", "0");
    browser.set("#picture-b", "0");
    browser.until("document.querySelector('#caption-a').textContent === 'A − B'");
    browser.until("document.querySelector('#says').hidden");
    assert_eq!(colours(browser), [[255; 3]; 4], "nothing differs from itself");
}

fn the_pixel_pointed_at_is_told(browser: &mut Browser) {
    unpacked(browser);
    let centre = browser.middle("#stage");
    let [width, height] = ["Width", "Height"]
        .map(|extent| browser.number(&format!("document.querySelector('#stage').client{extent}")));
    let [x, y] = QUARTERS[2].map(|coordinate| f64::from(coordinate) + 0.5);
    browser.point([
        centre[0] + width * (x / f64::from(SIZE[0]) - 0.5),
        centre[1] + height * (y / f64::from(SIZE[1]) - 0.5),
    ]);
    let told = browser.text("[...document.querySelectorAll('#probe tr')].map((line) => line.innerText.replaceAll('\\t', ' ')).join('|')");
    let line =
        "16, 36 red green blue|A 0.250 0.125 0.0625|B 0.0625 0.0625 0.0625|A − B +0.188 +0.0625 0";
    assert_eq!(told, line);
}

fn it_zooms_and_pans(browser: &mut Browser) {
    unpacked(browser);
    mode(browser, "a");
    let a = expected(&sample::one(), 0.0);
    let centre = browser.middle("#stage");
    // Into the upper left quarter, until it fills the view.
    let corner = [centre[0] - 200.0, centre[1] - 200.0];
    for _ in 0..4 {
        let wheel = json!({"type": "mouseWheel", "x": corner[0], "y": corner[1], "deltaX": 0, "deltaY": -300});
        browser.call("Input.dispatchMouseEvent", wheel);
    }
    browser.until("document.querySelector('#stage').classList.contains('zoomed')");
    browser.until("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
    assert_eq!(colours(browser), [a[0]; 4]);
    for _ in 0..30 {
        browser.drag(centre, [centre[0] - 300.0, centre[1] - 200.0]);
    }
    assert_eq!(colours(browser), [a[3]; 4], "at the lower right end");
    browser.value("document.querySelector('[title=\"Show all\"]').click()");
    assert_eq!(colours(browser), a);
}

pub fn fingers_move_the_split(browser: &mut Browser) {
    unpacked(browser);
    browser.touch(true);
    let [x, y] = browser.middle("#split");
    for (kind, points) in [
        ("touchStart", json!([{"x": x, "y": y}])),
        ("touchMove", json!([{"x": x + 60.0, "y": y}])),
        ("touchMove", json!([{"x": x + 120.0, "y": y}])),
        ("touchEnd", json!([])),
    ] {
        browser.call("Input.dispatchTouchEvent", json!({"type": kind, "touchPoints": points}));
    }
    browser.until("Number(document.querySelector('#split').ariaValueNow) > 70");
    let a = expected(&sample::one(), 0.0);
    assert_eq!(colour(browser, [36, 12]), a[1]);
}
