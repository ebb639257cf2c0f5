//! Errors taken apart: where the error of an image comes from, as [`parts`](super::parts) tell.

mod frames;
mod terms;

use super::measure::Measured;
use super::parts::Decomposition;
use super::reference::Reference;
use super::store::name_of;
use super::{Event, options};
use crate::error::Error;
use crate::render::{Method, Settings};

pub use frames::Frames;

/// Whether an image of these settings is made of the parts.
pub fn has_parts(settings: &Settings) -> bool {
    settings.method.is_indirect() || settings.method == Method::Direct
}

/// Takes the error of an image apart, or finds that done; `sharing` asks for exact visibility, too.
/// None if there is no pixel to compare.
///
/// # Errors
/// The device fails, the disk is full, or the user interrupts.
pub fn decomposed(
    frames: &mut Frames<'_, '_>,
    settings: &Settings,
    seed: u32,
    reference: &Reference,
    sharing: bool,
) -> Result<Option<Decomposition>, Error> {
    let Frames { key, light_samples, .. } = frames;
    let key = format!(
        "{} taken apart with {light_samples} rays, reference {} mask {} sharing {sharing}",
        options::of_frame(key, settings, seed),
        reference.identity,
        name_of(&reference.lens.keep),
    );
    let kept = frames.store.get(&key).and_then(|measured| measured.decomposition.clone());
    let was_kept = kept.is_some();
    let found = match kept {
        Some(kept) => kept,
        None => {
            let found = frames.decomposition(settings, seed, reference, sharing)?;
            let Some(found) = found else { return Ok(None) };
            let decomposition = Some(found.clone());
            frames.store.put(&key, Measured { decomposition, ..Measured::default() })?;
            frames.forget();
            found
        }
    };
    let (scene, decomposition) = (frames.scene, &found);
    (frames.tell)(Event::Decomposed { scene, settings, seed, decomposition, kept: was_kept });
    Ok(Some(found))
}
