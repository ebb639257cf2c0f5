//! Light from all directions, drawn by its image: the image is divided into cells, which have
//! probabilities in proportion to their light, and a place in a cell is uniform on the image.

use std::f64::consts::PI;

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::bounds::Bounds;
use super::start::Start;
use super::table::{Share, mean, shares};
use crate::sampling::uniform_sphere;
use crate::scene::environment::{direction, unpack};
use crate::scene::{Environment, EnvironmentImage, Scene};

/// Cells across and down, at most.
const MOST_CELLS: [u32; 2] = [1024, 512];
/// Cells across and down, at least: within a cell the solid angle varies little.
const LEAST_CELLS: [u32; 2] = [64, 32];
/// A cell that is not black is drawn as if its radiance were at least this share of the mean.
const LEAST_SHARE: f64 = 1e-3;

/// The environment of a scene, as a light.
#[derive(Debug, Clone)]
pub struct EnvironmentLight {
    radiance: Vec3,
    cells: Option<Cells>,
    /// Its integral over all directions, mean of the channels.
    pub radiance_integral: f64,
    /// What goes through the discs across a sphere around the scene, mean of the channels.
    pub power: f64,
}

/// The cells of an image.
#[derive(Debug, Clone)]
struct Cells {
    image_size: [u32; 2],
    columns: usize,
    rows: Vec<Share>,
    /// Row after row.
    cells: Vec<Share>,
}

impl EnvironmentLight {
    /// That of a scene, if it is not black.
    pub fn of(scene: &Scene, bounds: &Bounds) -> Option<Self> {
        let environment = scene.environment.as_ref().filter(|environment| environment.shines())?;
        let radiance = environment.radiance;
        let (all, cells) = match &environment.image {
            None => (4.0 * PI * mean(radiance), None),
            Some(image) => {
                let (all, cells) = Cells::of(image, radiance);
                (all, Some(cells))
            }
        };
        Some(Self {
            radiance,
            cells,
            radiance_integral: all,
            power: all * PI * f64::from(bounds.radius).powi(2),
        })
    }

    /// Whether it has one radiance everywhere.
    pub fn is_even(&self) -> bool {
        self.cells.is_none()
    }

    /// The words that the device reads: see `shaders/lights/environment_image.wgsl`.
    pub fn words(&self) -> Vec<u32> {
        let mut words: Vec<u32> = self.radiance.to_array().map(f32::to_bits).to_vec();
        let Some(cells) = &self.cells else { return words };
        words.extend(cells.image_size);
        words.extend([cells.columns as u32, cells.rows.len() as u32, 0]);
        let mut extend = |shares: &[Share]| {
            words.extend(shares.iter().map(|share| share.before.to_bits()));
            words.push(1f32.to_bits());
        };
        extend(&cells.rows);
        cells.cells.chunks(cells.columns).for_each(extend);
        words
    }

    /// A direction by the image, a place on the disc across it.
    pub fn start(&self, environment: &Environment, bounds: &Bounds, u: [f32; 4]) -> Start {
        let [a, b, u, v] = u;
        let (toward, radiance, density) = match (&self.cells, &environment.image) {
            (Some(cells), Some(image)) => {
                let (place, density) = cells.draw([u, v]);
                (direction(place), self.radiance * image.at(place), density)
            }
            _ => (uniform_sphere([u, v]), self.radiance, (1.0 / (4.0 * PI)) as f32),
        };
        let (ray, area) = bounds.ray_along(-toward, [a, b]);
        Start { ray, flux: radiance * (area / density) }
    }
}

/// How many cells an image of some texels across, or down, has there.
fn cells_of(texels: u32, least: u32, most: u32) -> u32 {
    if texels < least { texels * least.div_ceil(texels) } else { texels.min(most) }
}

/// The texels that a cell touches.
fn touched(cell: u32, cells: u32, texels: u32) -> std::ops::Range<usize> {
    let at = |cell: u32| u64::from(cell) * u64::from(texels);
    (at(cell) / u64::from(cells)) as usize..at(cell + 1).div_ceil(u64::from(cells)) as usize
}

impl Cells {
    /// Those of an image, and the integral of the radiance over all directions.
    fn of(image: &EnvironmentImage, radiance: Vec3) -> (f64, Self) {
        let [width, height] = image.size;
        let columns = cells_of(width, LEAST_CELLS[0], MOST_CELLS[0]);
        let rows = cells_of(height, LEAST_CELLS[1], MOST_CELLS[1]);
        let texels: Vec<&[u32]> = image.texels.chunks(width as usize).collect();
        let light = |texel: u32| mean(radiance * unpack(texel));

        // Of a row of texels the solid angle is exact.
        let turn = 2.0 * PI / f64::from(width);
        let edge = |y: u32| (PI * f64::from(y) / f64::from(height)).cos();
        let of_row = |y: u32| {
            let sum: f64 = texels[y as usize].iter().map(|&texel| light(texel)).sum();
            sum * turn * (edge(y) - edge(y + 1))
        };
        let all: f64 = (0..height).into_par_iter().map(of_row).collect::<Vec<_>>().iter().sum();

        let least = LEAST_SHARE * all / (4.0 * PI);
        let weight = |row: u32, column: u32| {
            let (mut sum, mut count, mut lit) = (0.0, 0.0, false);
            for y in touched(row, rows, height) {
                for x in touched(column, columns, width) {
                    sum += light(texels[y][x]);
                    count += 1.0;
                    lit |= texels[y][x] & 0x07ff_ffff != 0;
                }
            }
            let sine = (PI * (f64::from(row) + 0.5) / f64::from(rows)).sin();
            if lit { f64::max(sum / count, least) * sine } else { 0.0 }
        };
        let weights: Vec<Vec<f64>> = (0..rows)
            .into_par_iter()
            .map(|row| (0..columns).map(|column| weight(row, column)).collect())
            .collect();
        let of_rows: Vec<f64> = weights.iter().map(|row| row.iter().sum()).collect();
        let cells = Self {
            image_size: image.size,
            columns: columns as usize,
            rows: shares(&of_rows),
            cells: weights.iter().flat_map(|row| shares(row)).collect(),
        };
        (all, cells)
    }

    /// A place of the image, and its density by solid angle.
    fn draw(&self, [u, v]: [f32; 2]) -> (Vec2, f32) {
        let find = |shares: &[Share], u: f32| {
            let at = shares.partition_point(|share| share.before <= u).saturating_sub(1);
            let Share { before, probability } = shares[at];
            (at, ((u - before) / probability).clamp(0.0, 1.0), probability)
        };
        let (row, down, of_row) = find(&self.rows, v);
        let (column, across, of_cell) = find(&self.cells[row * self.columns..][..self.columns], u);
        let count = Vec2::new(self.columns as f32, self.rows.len() as f32);
        let place = Vec2::new(column as f32 + across, row as f32 + down) / count;
        let sine = libm::sinf(PI as f32 * place.y).max(1e-6);
        let density = of_row * of_cell * count.x * count.y / ((2.0 * PI * PI) as f32 * sine);
        (place, density)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Sequence;
    use crate::scene::environment::pack;

    /// Dim, but for a few texels.
    fn image(size: [u32; 2]) -> EnvironmentImage {
        let [width, height] = size;
        let texel = |i: u32| {
            let light = if i % 97 == 5 { 300.0 } else { (i % 7) as f32 * 0.1 };
            pack(Vec3::new(light, 0.5 * light, 2.0 * light))
        };
        EnvironmentImage {
            name: String::new(),
            size,
            texels: (0..width * height).map(texel).collect(),
        }
    }

    /// The mean of radiance over density is the integral, whatever the size of the image is to
    /// that of the cells; and the density is 1 over all directions.
    #[test]
    fn cells_are_drawn_with_their_density() {
        for size in [[1, 1], [8, 4], [100, 50], [1024, 512], [1500, 700], [3, 2000]] {
            let image = image(size);
            let scale = Vec3::new(1.0, 2.0, 0.5);
            let (all, cells) = Cells::of(&image, scale);
            if size == [1, 1] {
                // Black: nothing is drawn from it.
                assert!(all == 0.0);
                continue;
            }
            let sequence = Sequence::new(1);
            let count = 1 << 16;
            let (mut light, mut sphere) = (0.0, 0.0);
            for i in 0..count {
                let (place, density) = cells.draw([sequence.sample(i, 0), sequence.sample(i, 1)]);
                light += mean(scale * image.at(place)) / f64::from(density);
                // Uniform over the sphere, as far as the cells that are drawn go.
                sphere += f64::from(direction(place).y.abs()) / f64::from(density);
            }
            light /= f64::from(count);
            sphere /= f64::from(count);
            assert!((light / all - 1.0).abs() < 0.01, "{size:?}: {light}, not {all}");
            assert!(sphere < 1.05 * 2.0 * PI, "{size:?}: {sphere}");
        }
    }

    #[test]
    fn every_texel_that_shines_can_be_drawn() {
        for size in [[5, 3], [1024, 512], [4000, 1000]] {
            let mut image = image(size);
            image.texels.fill(0);
            for (i, texel) in [(1, 1e-3), (size[0] * size[1] - 2, 60_000.0)] {
                image.texels[i as usize] = pack(Vec3::splat(texel));
            }
            let (_, cells) = Cells::of(&image, Vec3::ONE);
            let drawn = |share: &Share| share.probability > 0.0;
            assert!(drawn(&cells.rows[0]) && drawn(&cells.rows[cells.rows.len() - 1]));
            assert!(cells.cells[..cells.columns].iter().any(drawn));
        }
    }
}
