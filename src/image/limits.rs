//! How large an image may be.

use std::io;

/// The most pixels an image may have: what a header claims is not believed beyond.
const MOST_PIXELS: u64 = 1 << 28;

/// The number of pixels, if an image of that size is one we would hold.
///
/// # Errors
/// It is empty, or too large.
pub(super) fn area(width: u64, height: u64) -> io::Result<usize> {
    let area = width.checked_mul(height).filter(|area| (1..=MOST_PIXELS).contains(area));
    area.and_then(|area| usize::try_from(area).ok()).ok_or_else(|| {
        io::Error::other(format!("{width} x {height} pixels are none, or more than {MOST_PIXELS}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_bounded() {
        assert_eq!(area(16384, 16384).ok(), Some(1 << 28));
        for [width, height] in [[0, 5], [5, 0], [16384, 16385], [u64::MAX, u64::MAX]] {
            assert!(area(width, height).is_err());
        }
    }
}
