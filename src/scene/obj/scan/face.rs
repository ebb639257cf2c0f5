//! Faces: their corners, checked.

use std::fmt::Write as _;

use super::{Scanner, omitted};
use crate::scene::SceneError;

/// What a corner of a face names, each counted from 1; 0 is none.
#[derive(Debug, Clone, Copy)]
struct Corner {
    vertex: i64,
    coordinates: i64,
    normal: i64,
}

/// The number of an index; some writers give it a fraction of 0.
fn index(part: &str) -> Option<i64> {
    let whole = |number: &f64| number.fract() == 0.0 && number.abs() < 1e15;
    let real = || part.parse::<f64>().ok().filter(whole).map(|number| number as i64);
    part.parse().ok().or_else(real)
}

impl Scanner<'_> {
    /// A polygon; of its normals, only whether they differ is of interest.
    pub(super) fn face(&mut self, words: &[&str]) -> Result<(), SceneError> {
        let mut corners = Vec::with_capacity(words.len());
        for word in words {
            corners.push(self.corner(word)?);
        }
        if corners.len() < 3 {
            self.omitted.add(omitted::NO_SURFACE, self.line);
            return Ok(());
        }
        self.note_shading(&corners);
        self.scan.text.push('f');
        for Corner { vertex, coordinates, .. } in corners {
            let _ = write!(self.scan.text, " {vertex}");
            self.scan.corners.push(u32::try_from(coordinates).unwrap_or(u32::MAX));
            self.scan.colors.add_corner(vertex);
        }
        Ok(())
    }

    /// Counts a face that asks for a smooth surface.
    fn note_shading(&mut self, corners: &[Corner]) {
        let same = |a: i64, b: i64| {
            let normal = |number: i64| self.normals.get(usize::try_from(number - 1).ok()?);
            a == b || normal(a).zip(normal(b)).is_some_and(|(a, b)| a.distance(*b) < 1e-3)
        };
        if corners.iter().all(|corner| corner.normal == 0) {
            if self.smooth {
                self.omitted.add(omitted::SMOOTHING, self.line);
            }
        } else if corners.windows(2).any(|pair| !same(pair[0].normal, pair[1].normal)) {
            self.omitted.add(omitted::NORMALS, self.line);
        }
    }

    /// A corner such as `7`, `-1`, `7/3`, `7//2` or `7/3/2`.
    fn corner(&mut self, word: &str) -> Result<Corner, SceneError> {
        let mut parts = word.split('/').map(|part| (part, index(part)));
        let Some((_, Some(vertex))) = parts.next() else {
            return self.fault(format!("face: `{word}` does not begin with a vertex's number"));
        };
        let rest: Vec<_> = parts.collect();
        if rest.len() > 2 || rest.iter().any(|(part, number)| number.is_none() && !part.is_empty())
        {
            return self
                .fault(format!("face: `{word}` is not of the form v, v/vt, v//vn, v/vt/vn"));
        }
        let vertex = self.absolute("vertex", vertex, self.vertices)?;
        self.last_index = self.last_index.max(vertex, self.line);
        let normals = self.normals.len() as i64;
        let number = |at: usize| rest.get(at).and_then(|(_, number)| *number);
        let normal = number(1).map_or(0, |i| if i < 0 { normals + 1 + i } else { i }).max(0);
        let there = self.scan.coordinates.len() as i64;
        let coordinates = match number(0) {
            None => 0,
            // Some writers count on from what there is none of.
            Some(..0) if there == 0 => {
                self.missing_coordinates.add(self.line);
                0
            }
            Some(coordinates) => self.absolute("texture coordinates", coordinates, there)?,
        };
        self.last_coordinates = self.last_coordinates.max(coordinates, self.line);
        Ok(Corner { vertex, coordinates, normal })
    }

    /// An index counted from 1, of one that may count from the end of what is there so far.
    fn absolute(&self, what: &str, index: i64, there: i64) -> Result<i64, SceneError> {
        match index {
            0 => self.fault(format!("face: {what} 0; the first is 1")),
            1.. => Ok(index),
            _ if index < -there => {
                self.fault(format!("face: {what} {index}, but there are {there} so far"))
            }
            _ => Ok(there + 1 + index),
        }
    }
}
