//! What is to be known of the files compared beside their colours.

use std::path::Path;

use crate::cli::console;
use crate::image::Picture;

/// Alphas this near each other are the same: what 16 bits tell apart.
const SAME: f32 = 1.0 / 65535.0;

/// Warns of what was read otherwise than it stands, and of alphas that differ, which no metric sees.
pub fn tell(pictures: [(&Picture, &Path); 2]) {
    for (picture, file) in pictures {
        for note in &picture.notes {
            console::warning(&format!("{}: it {note}", file.display()));
        }
    }
    let [(reference, of_reference), (image, of_image)] = pictures;
    if let Some((count, largest)) = difference(reference, image) {
        console::warning(&format!(
            "the alpha of {} and {} differs in {count} pixels, by up to {largest:.4}; colours alone are \
             compared",
            of_reference.display(),
            of_image.display()
        ));
    }
}

/// In how many pixels alphas differ, and by how much at most; without one a pixel is opaque.
fn difference(reference: &Picture, image: &Picture) -> Option<(usize, f32)> {
    if reference.alpha.is_none() && image.alpha.is_none() {
        return None;
    }
    let alpha = |picture: &Picture, at: usize| {
        picture.alpha.as_ref().map_or(1.0, |alpha| alpha.get(at).copied().unwrap_or(1.0))
    };
    let differences = (0..reference.image.pixels.len()).map(|at| {
        let difference = (alpha(reference, at) - alpha(image, at)).abs();
        if difference.is_nan() { f32::INFINITY } else { difference }
    });
    let different: Vec<f32> = differences.filter(|&difference| difference > SAME).collect();
    let largest = different.iter().copied().fold(0.0, f32::max);
    (!different.is_empty()).then_some((different.len(), largest))
}
