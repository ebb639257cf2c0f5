//! A first pass over the text of an OBJ file. It finds every fault with its line, takes the
//! texture coordinates, and leaves to `tobj` a plain text it cannot misread: positions,
//! polygons of absolute indices, and materials by number, line for line as in the file.

mod face;

use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::Path;

use glam::{DVec2, Vec2, Vec3};

use super::colors::Colors;
use super::logical::statements;
use super::omitted::{self, Omitted};
use crate::scene::omission::Tally;
use crate::scene::{SceneError, Warning};

/// A name, and the line that first gives it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Named {
    pub name: String,
    pub line: usize,
}

/// What the first pass found.
#[derive(Debug, Default)]
pub struct Scan {
    /// The plain text; its first line is an extra `mtllib`.
    pub text: String,
    /// What `usemtl` names; the plain text says `usemtl INDEX`.
    pub names: Vec<Named>,
    /// What `mtllib` names, a whole line each.
    pub libraries: Vec<Named>,
    /// Texture coordinates, from the image's bottom left.
    coordinates: Vec<DVec2>,
    /// Of each corner of the faces that `text` holds, the number of its texture coordinates,
    /// counted from 1; 0 if it has none.
    corners: Vec<u32>,
    /// The colours of the corners.
    colors: Colors,
    pub warnings: Vec<Warning>,
    /// The first line of points, of a line, or of a face of fewer than three corners.
    pub without_surface: Option<usize>,
}

impl Scan {
    /// The texture coordinates of all corners of faces, from the image's top left; 0 of those
    /// that have none.
    pub fn corner_uvs(&self) -> impl Iterator<Item = Vec2> + '_ {
        self.corners.iter().map(|&number| {
            let uv = (number as usize).checked_sub(1).and_then(|i| self.coordinates.get(i));
            uv.map_or(Vec2::ZERO, |uv| DVec2::new(uv.x, 1.0 - uv.y).as_vec2())
        })
    }

    /// The colours of all corners of faces, linear; white of those that have none.
    pub fn corner_colors(&self) -> impl Iterator<Item = Vec3> + '_ {
        self.colors.of_corners(self.corners.len())
    }
}

/// Checks an OBJ file.
pub fn scan(file: &Path, text: &str) -> Result<Scan, SceneError> {
    let mut scanner = Scanner {
        file,
        line: 0,
        scan: Scan { text: "mtllib all\n".to_owned(), ..Scan::default() },
        vertices: 0,
        last_index: Last::default(),
        last_coordinates: Last::default(),
        index_of: HashMap::new(),
        normals: Vec::new(),
        smooth: false,
        omitted: Omitted::default(),
        missing_coordinates: Tally::default(),
        commas: Tally::default(),
        homogeneous: Tally::default(),
        no_coordinates: Tally::default(),
    };
    for (line, content, lines) in statements(text) {
        scanner.line = line;
        scanner.statement(&content)?;
        (0..lines).for_each(|_| scanner.scan.text.push('\n'));
    }
    scanner.finish()
}

/// The largest index that a face uses, and its line: faces may come before what they name.
#[derive(Debug, Default, Clone, Copy)]
struct Last {
    index: i64,
    line: usize,
}

impl Last {
    fn max(self, index: i64, line: usize) -> Self {
        if index > self.index { Self { index, line } } else { self }
    }
}

struct Scanner<'a> {
    file: &'a Path,
    line: usize,
    scan: Scan,
    vertices: i64,
    last_index: Last,
    last_coordinates: Last,
    index_of: HashMap<String, usize>,
    /// As they stand; what is no number is 0.
    normals: Vec<Vec3>,
    /// Whether a smoothing group is on.
    smooth: bool,
    omitted: Omitted,
    missing_coordinates: Tally,
    commas: Tally,
    homogeneous: Tally,
    no_coordinates: Tally,
}

impl Scanner<'_> {
    fn fault<T>(&self, what: impl Into<String>) -> Result<T, SceneError> {
        Err(SceneError::at(self.file, self.line, what))
    }

    /// Checks one statement and appends its plain form, without the line's end.
    fn statement(&mut self, content: &str) -> Result<(), SceneError> {
        let content = content.trim();
        if content.starts_with("#MRGB") {
            self.omitted.add(omitted::POLYPAINT, self.line);
        }
        let mut words = content.split_whitespace().take_while(|word| !word.starts_with('#'));
        let Some(keyword) = words.next() else { return Ok(()) };
        // Names may hold blanks and '#'.
        let name = content[keyword.len()..].trim();
        match keyword {
            "v" => self.vertex(&words.collect::<Vec<_>>())?,
            "vt" => self.coordinates(words),
            "vn" => self.normal(words),
            "f" | "fo" => self.face(&words.collect::<Vec<_>>())?,
            "s" => self.smooth = words.next().is_some_and(|word| !["off", "0"].contains(&word)),
            "p" | "l" => self.omitted.add(omitted::NO_SURFACE, self.line),
            "usemtl" => self.material(name),
            "mtllib" => {
                self.scan.libraries.push(Named { name: name.to_owned(), line: self.line });
            }
            _ => self.omitted.add_statement(keyword, name, self.line),
        }
        Ok(())
    }

    /// A number; some writers have a comma for the point.
    fn number(&mut self, word: &str) -> Option<f64> {
        let point = word.parse::<f64>().ok();
        let number = point.or_else(|| {
            let number = word.replacen(',', ".", 1).parse::<f64>().ok()?;
            self.commas.add(self.line);
            Some(number)
        });
        number.filter(|number| number.is_finite())
    }

    /// `v x y z`, with a weight w by which `tobj` divides, or with a colour and perhaps its alpha.
    fn vertex(&mut self, words: &[&str]) -> Result<(), SceneError> {
        let mut numbers = Vec::with_capacity(words.len());
        for word in words {
            match self.number(word) {
                Some(number) => numbers.push(number),
                None => return self.fault(format!("vertex: `{word}` is not a finite number")),
            }
        }
        let weight = match numbers[..] {
            [_, _, _] => 1.0,
            [_, _, _, w] => w,
            [_, _, _, r, g, b] => {
                self.scan.colors.add(self.vertices, [r, g, b]);
                1.0
            }
            [_, _, _, r, g, b, a] => {
                self.scan.colors.add(self.vertices, [r, g, b]);
                if a != 1.0 && a != 255.0 {
                    self.omitted.add(omitted::ALPHA, self.line);
                }
                1.0
            }
            _ => {
                let n = numbers.len();
                return self
                    .fault(format!("vertex of {n} numbers; give x y z, with w, r g b or r g b a"));
            }
        };
        if numbers[..3].iter().any(|x| !(x / weight).is_finite()) {
            return self.fault(format!("vertex: its weight {weight} puts it at infinity"));
        }
        if weight != 1.0 {
            self.homogeneous.add(self.line);
        }
        self.vertices += 1;
        let [x, y, z] = [numbers[0], numbers[1], numbers[2]];
        // Writing to a string cannot fail. The digits of `{}` read back as the same number.
        let _ = write!(self.scan.text, "v {x} {y} {z} {weight}");
        Ok(())
    }

    fn normal<'a>(&mut self, words: impl Iterator<Item = &'a str>) {
        let mut normal = [0.0; 3];
        for (number, word) in normal.iter_mut().zip(words) {
            *number = self.number(word).unwrap_or_default() as f32;
        }
        self.normals.push(Vec3::from_array(normal));
    }

    /// `vt u`, `vt u v` or `vt u v w`. Some writers put no numbers where they have none.
    fn coordinates<'a>(&mut self, mut words: impl Iterator<Item = &'a str>) {
        let mut next = || words.next().map_or(Some(0.0), |word| self.number(word));
        let uv = next().zip(next()).map(|(u, v)| DVec2::new(u, v));
        if next().is_some_and(|third| third != 0.0) {
            self.omitted.add(omitted::THIRD, self.line);
        }
        let uv = uv.filter(|uv| uv.as_vec2().is_finite());
        if uv.is_none() {
            self.no_coordinates.add(self.line);
        }
        self.scan.coordinates.push(uv.unwrap_or_default());
    }

    fn material(&mut self, name: &str) {
        let names = &mut self.scan.names;
        let index = *self.index_of.entry(name.to_owned()).or_insert_with(|| {
            names.push(Named { name: name.to_owned(), line: self.line });
            names.len() - 1
        });
        let _ = write!(self.scan.text, "usemtl {index}");
    }

    fn finish(mut self) -> Result<Scan, SceneError> {
        let coordinates = self.scan.coordinates.len() as i64;
        if coordinates == 0 && self.last_coordinates.index > 0 {
            self.missing_coordinates.add(self.last_coordinates.line);
            self.last_coordinates = Last::default();
        }
        for (what, last, there) in [
            ("vertex", self.last_index, self.vertices),
            ("texture coordinates", self.last_coordinates, coordinates),
        ] {
            if last.index > there {
                self.line = last.line;
                return self.fault(format!("face: {what} {}, but there are {there}", last.index));
            }
        }
        let file = self.file.display();
        let some = |(tally, what): (&Tally, &str)| {
            let Tally { count, first } = tally;
            (*count > 0).then(|| format!("{file}:{first}: {count} {what}"))
        };
        let notes = [
            (&self.homogeneous, "vertices have a weight w; x y z are divided by it"),
            (&self.commas, "numbers have a comma for the decimal point; they are read so"),
        ];
        let changes =
            (&self.no_coordinates, "texture coordinates are no finite numbers; 0 is used");
        let mut warnings: Vec<Warning> =
            notes.into_iter().filter_map(some).map(Warning::note).collect();
        warnings.extend(some(changes).map(Warning::changed));
        if self.missing_coordinates.count > 0 {
            let what = "faces name texture coordinates, but the file has none; 0 is used";
            let line = self.missing_coordinates.first;
            warnings.push(Warning::changed(format!("{file}:{line}: {what}")));
        }
        warnings.extend(self.omitted.warnings(self.file));
        let without_surface = self.omitted.without_surface();
        Ok(Scan { warnings, without_surface, ..self.scan })
    }
}
