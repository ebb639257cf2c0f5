//! The same run gives the same bytes, twice and with any number of threads.

use super::builder::room;
use super::measure::{frame_of, none, of};
use crate::error::Error;
use crate::extremes::{Figure, Scale};
use crate::gpu::Gpu;
use crate::render::{Bounces, Direct, Frame, Method, Prepared, Settings};

/// Pixels with other bits.
fn unlike(one: &Frame, two: &Frame) -> usize {
    let bits = |pixel: &[f32; 3]| pixel.map(f32::to_bits);
    let pairs = one.image.pixels.iter().zip(&two.image.pixels);
    let lengths = one.image.pixels.len().abs_diff(two.image.pixels.len());
    lengths + pairs.filter(|(a, b)| bits(a) != bits(b)).count()
}

/// Of every method: again, again from the scene on, and with one thread and with three.
pub fn bytes(gpu: &Gpu, scale: Scale) -> Result<Vec<Figure>, Error> {
    let (size, light_paths) =
        if scale == Scale::Full { ([256, 192], 20_000) } else { ([40, 24], 500) };
    let settings = |method: Method| Settings {
        light_paths,
        bounces: Bounces::Unlimited,
        direct: match method.clusters_points() {
            true => Direct::Clustered,
            false => Direct::PerPixel,
        },
        ..Settings::of(method)
    };
    let prepare = |settings: &Settings| -> Result<Prepared, Error> {
        Ok(Prepared::new(gpu.clone(), room(1.0, size)?.scene()?, settings)?)
    };
    let prepared = prepare(&settings(Method::Both))?;
    let pools = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.map_err(|error| Error::Usage(format!("{threads} threads: {error}")))
    });
    let [one, three] = pools;
    let pools = [(1, one?), (3, three?)];
    let mut figures = Vec::new();
    let compensated = Settings { compensate: true, ..settings(Method::Both) };
    let all = Method::ALL.map(|method| ("", settings(method)));
    for (name, settings) in all.into_iter().chain([("compensated, ", compensated)]) {
        let method = settings.method;
        let first = frame_of(&prepared, &settings)?;
        let again = frame_of(&prepared, &settings)?;
        figures.push(of(
            method,
            none(format!("{name}again: pixels with other bits"), unlike(&first, &again)),
        ));
        for (threads, pool) in &pools {
            let other = pool.install(|| frame_of(&prepare(&settings)?, &settings))?;
            let what = format!("{name}prepared anew, {threads} threads: pixels with other bits");
            figures.push(of(method, none(what, unlike(&first, &other))));
        }
    }
    Ok(figures)
}
