//! Maps turned about the axes of the scene.

use glam::{DQuat, DVec3, Vec2, Vec3};
use rayon::prelude::*;

use super::radiance::{direction, place};

/// Places a side of a texel at which a turned map is looked up.
const PLACES: u32 = 3;

/// The pixels of an equirectangular map whose surroundings are turned so. About the vertical, columns are
/// moved, and their sum stays; about any other axis, texels are means of a few places.
pub fn turned(size: [u32; 2], pixels: Vec<[f32; 3]>, turn: DQuat) -> Vec<[f32; 3]> {
    let up = turn * DVec3::Y;
    if (turn * DVec3::X).distance(DVec3::X) < 1e-12 && up.distance(DVec3::Y) < 1e-12 {
        return pixels;
    }
    let [width, height] = size.map(|extent| extent as usize);
    if up.distance(DVec3::Y) < 1e-12 {
        let from = turn.inverse() * -DVec3::Z;
        let shift = f64::from(width as u32) * from.x.atan2(-from.z) / std::f64::consts::TAU;
        return pixels.par_chunks(width).flat_map(|row| moved(row, shift)).collect();
    }
    let back = turn.inverse();
    let looked_up = |x: u32, y: u32| {
        let mut sum = Vec3::ZERO;
        for step in 0..PLACES * PLACES {
            let within = |i: u32| (f64::from(i) + 0.5) / f64::from(PLACES);
            let at = [
                (f64::from(x) + within(step % PLACES)) / f64::from(size[0]),
                (f64::from(y) + within(step / PLACES)) / f64::from(size[1]),
            ];
            let seen = direction(Vec2::new(at[0] as f32, at[1] as f32));
            let source = place((back * seen.as_dvec3()).normalize().as_vec3());
            sum += interpolated(size, &pixels, source);
        }
        (sum / (PLACES * PLACES) as f32).to_array()
    };
    (0..width * height)
        .into_par_iter()
        .map(|index| looked_up((index % width) as u32, (index / width) as u32))
        .collect()
}

/// A row whose columns come from so many further right.
fn moved(row: &[[f32; 3]], shift: f64) -> Vec<[f32; 3]> {
    let width = row.len();
    // A turn by whole columns is exact.
    let whole = if (shift - shift.round()).abs() < 1e-6 { shift.round() } else { shift.floor() };
    let part = (shift - whole).max(0.0) as f32;
    let first = whole.rem_euclid(width as f64) as usize % width;
    let at = |x: usize| Vec3::from_array(row[(first + x) % width]);
    let mixed = |x: usize| if part < 1e-6 { at(x) } else { at(x).lerp(at(x + 1), part) };
    (0..width).map(|x| mixed(x).to_array()).collect()
}

/// The colour at a place, from the four texels around it.
fn interpolated(size: [u32; 2], pixels: &[[f32; 3]], at: Vec2) -> Vec3 {
    let [width, height] = size.map(i64::from);
    let x = at.x * size[0] as f32 - 0.5;
    let y = at.y * size[1] as f32 - 0.5;
    let texel = |x: i64, y: i64| {
        let (x, y) = (x.rem_euclid(width), y.clamp(0, height - 1));
        Vec3::from_array(pixels[(y * width + x) as usize])
    };
    let (left, top) = (x.floor() as i64, y.floor() as i64);
    let row = |y: i64| texel(left, y).lerp(texel(left + 1, y), x - x.floor());
    row(top).lerp(row(top + 1), y - y.floor())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    /// A map of one bright texel.
    fn dot(at: usize) -> Vec<[f32; 3]> {
        (0..32).map(|i| [if i == at { 1.0 } else { 0.0 }; 3]).collect()
    }

    #[test]
    fn a_quarter_turn_moves_the_front_to_the_left() {
        // Column 4 of 8 begins at -Z, and column 2 at -X.
        let turn = DQuat::from_rotation_y(FRAC_PI_2);
        assert_eq!(turned([8, 4], dot(8 + 4), turn), dot(8 + 2));
        assert_eq!(turned([8, 4], dot(5), DQuat::IDENTITY), dot(5));
        let part = turned([8, 4], dot(12), DQuat::from_rotation_y(0.3));
        let sum: f32 = part.iter().map(|pixel| pixel[0]).sum();
        assert!((sum - 1.0).abs() < 1e-5);
    }

    #[test]
    fn turns_about_other_axes_move_the_pole() {
        let mut bright = vec![[0.0; 3]; 32 * 16];
        bright[..3 * 32].fill([1.0; 3]);
        let turned = turned([32, 16], bright, DQuat::from_rotation_x(FRAC_PI_2));
        // From +Y to +Z: the left and right borders, halfway down.
        assert!(turned[8 * 32][0] > 0.9 && turned[8 * 32 + 16][0] < 0.1 && turned[16][0] < 0.1);
    }
}
