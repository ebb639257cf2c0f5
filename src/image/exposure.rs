//! Whether an image can be seen as it is exposed, and the exposure at which it can.

use super::Image;

/// What is darker is black on a screen.
const DARK: f64 = 0.01;

/// The share of the pixels that must be too dark, or too bright.
const NEARLY_ALL: f64 = 0.95;

/// The share of the pixels that a fitting exposure leaves below its level.
const BELOW: f64 = 0.95;

/// The radiance that a fitting exposure brings there: a light grey.
const LEVEL: f64 = 0.8;

/// How an image looks at an exposure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Look {
    /// As it should.
    Fine,
    /// No pixel is anything but black, at any exposure.
    Black,
    /// Nearly all of it that is not black is too dark; the exposure that fits, in EV.
    Dark(f32),
    /// Nearly all of it that is not black is white; the exposure that fits, in EV.
    Clipped(f32),
}

/// How an image of radiance looks at an exposure in EV. Pixels that are black are taken for what is not
/// there: behind a bare mesh there is nothing.
pub fn look(image: &Image, exposure: f32) -> Look {
    let Some(fitting) = fitting(image) else { return Look::Black };
    let gain = libm::exp2(f64::from(exposure));
    let lit = || image.pixels.iter().filter(|pixel| is_lit(pixel));
    let most = NEARLY_ALL * lit().count() as f64;
    let share = |test: &dyn Fn(f64) -> bool| {
        lit().filter(|pixel| pixel.iter().all(|&channel| test(gain * f64::from(channel)))).count()
    };
    match () {
        () if share(&|value| value < DARK) as f64 >= most => Look::Dark(fitting),
        () if share(&|value| value >= 1.0) as f64 >= most => Look::Clipped(fitting),
        () => Look::Fine,
    }
}

/// The exposure at which all but the brightest pixels of an image of radiance are seen, in EV to a
/// tenth; none if all are black.
pub fn fitting(image: &Image) -> Option<f32> {
    let lit = image.pixels.iter().filter(|pixel| is_lit(pixel));
    let mut values: Vec<f32> = lit.map(|pixel| pixel.iter().copied().fold(0.0, f32::max)).collect();
    let at = (BELOW * values.len() as f64) as usize;
    let at = at.min(values.len().checked_sub(1)?);
    let (_, value, _) = values.select_nth_unstable_by(at, f32::total_cmp);
    let stops = libm::log2(LEVEL / f64::from(*value));
    Some((((10.0 * stops).round() / 10.0) as f32).clamp(-100.0, 100.0))
}

fn is_lit(pixel: &[f32; 3]) -> bool {
    pixel.iter().all(|channel| channel.is_finite()) && pixel.iter().any(|&channel| channel > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(values: &[f32]) -> Image {
        let pixels: Vec<[f32; 3]> = values.iter().map(|&value| [value; 3]).collect();
        Image { width: pixels.len() as u32, height: 1, pixels }
    }

    #[test]
    fn images_are_judged_by_what_is_not_black() {
        assert_eq!(look(&of(&[0.0, f32::NAN]), 0.0), Look::Black);
        assert_eq!(look(&of(&[0.0, 0.0, 0.5]), 0.0), Look::Fine);
        assert_eq!(look(&of(&[0.0, 0.0, 0.005]), 0.0), Look::Dark(7.3));
        assert_eq!(look(&of(&[0.0, 3.2, 3.2]), 0.0), Look::Clipped(-2.0));
        assert_eq!(look(&of(&[0.0, 3.2, 3.2]), -2.0), Look::Fine);
        assert_eq!(look(&of(&[0.5]), -7.0), Look::Dark(0.7));
    }

    #[test]
    fn a_lamp_that_is_seen_does_not_make_the_room_dark() {
        let mut values = vec![0.1; 100];
        values[..4].fill(1000.0);
        assert_eq!(fitting(&of(&values)), Some(3.0));
        assert_eq!(fitting(&of(&[0.0])), None);
    }
}
