//! A first pass over the text of an OBJ file. It finds every fault with its line, takes the
//! texture coordinates, and leaves to `tobj` a plain text it cannot misread: positions,
//! polygons of absolute indices, and materials by number, line for line as in the file.

use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::Path;

use glam::{DVec2, Vec2};

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
        no_surface: Tally::default(),
        free_form: Tally::default(),
        homogeneous: Tally::default(),
        no_coordinates: Tally::default(),
    };
    let mut lines = (1..).zip(text.lines());
    while let Some((line, first)) = lines.next() {
        let mut content = first.to_owned();
        let mut line_ends = 1;
        while content.ends_with('\\') {
            content.pop();
            let Some((_, next)) = lines.next() else { break };
            content.push_str(next);
            line_ends += 1;
        }
        scanner.line = line;
        scanner.statement(&content)?;
        (0..line_ends).for_each(|_| scanner.scan.text.push('\n'));
    }
    scanner.finish()
}

/// How often something occurs, and the line where it does first.
#[derive(Debug, Default)]
struct Tally {
    count: u64,
    first: usize,
}

impl Tally {
    fn add(&mut self, line: usize) {
        self.first = if self.count == 0 { line } else { self.first };
        self.count += 1;
    }
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
    no_surface: Tally,
    free_form: Tally,
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
        let mut words = content.split_whitespace().take_while(|word| !word.starts_with('#'));
        let Some(keyword) = words.next() else { return Ok(()) };
        // Names may hold blanks and '#'.
        let name = content[keyword.len()..].trim();
        match keyword {
            "v" => self.vertex(&words.collect::<Vec<_>>()),
            "vt" => {
                self.coordinates(words);
                Ok(())
            }
            "f" => self.face(&words.collect::<Vec<_>>()),
            "p" | "l" => {
                self.no_surface.add(self.line);
                Ok(())
            }
            "surf" | "curv" => {
                self.free_form.add(self.line);
                Ok(())
            }
            "usemtl" => {
                self.material(name);
                Ok(())
            }
            "mtllib" => {
                self.scan.libraries.push(Named { name: name.to_owned(), line: self.line });
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// `v x y z`, with a weight w by which `tobj` divides, or with a colour, left out.
    fn vertex(&mut self, words: &[&str]) -> Result<(), SceneError> {
        let mut numbers = Vec::with_capacity(words.len());
        for word in words {
            match word.parse::<f64>() {
                Ok(number) if number.is_finite() => numbers.push(number),
                _ => return self.fault(format!("vertex: `{word}` is not a finite number")),
            }
        }
        let weight = match numbers[..] {
            [_, _, _] | [_, _, _, _, _, _] => 1.0,
            [_, _, _, w] => w,
            _ => {
                let n = numbers.len();
                return self.fault(format!("vertex of {n} numbers; give x y z, with w or r g b"));
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

    /// `vt u`, `vt u v` or `vt u v w`. Some writers put no numbers where they have none.
    fn coordinates<'a>(&mut self, mut words: impl Iterator<Item = &'a str>) {
        let mut next = || words.next().map_or(Some(0.0), |word| word.parse::<f64>().ok());
        let uv = next().zip(next()).map(|(u, v)| DVec2::new(u, v));
        let uv = uv.filter(|uv| uv.as_vec2().is_finite());
        if uv.is_none() {
            self.no_coordinates.add(self.line);
        }
        self.scan.coordinates.push(uv.unwrap_or_default());
    }

    /// A polygon; the indices of its normals are left out.
    fn face(&mut self, words: &[&str]) -> Result<(), SceneError> {
        let mut corners = Vec::with_capacity(words.len());
        for word in words {
            corners.push(self.corner(word)?);
        }
        if corners.len() < 3 {
            self.no_surface.add(self.line);
            return Ok(());
        }
        self.scan.text.push('f');
        for (vertex, coordinates) in corners {
            let _ = write!(self.scan.text, " {vertex}");
            self.scan.corners.push(u32::try_from(coordinates).unwrap_or(u32::MAX));
        }
        Ok(())
    }

    /// The vertex of a corner such as `7`, `-1`, `7/3`, `7//2` or `7/3/2`, counted from 1, and
    /// its texture coordinates, 0 if it has none.
    fn corner(&mut self, word: &str) -> Result<(i64, i64), SceneError> {
        let mut parts = word.split('/').map(|part| (part, part.parse::<i64>()));
        let Some((_, Ok(vertex))) = parts.next() else {
            return self.fault(format!("face: `{word}` does not begin with a vertex's number"));
        };
        let rest: Vec<_> = parts.collect();
        if rest.len() > 2 || rest.iter().any(|(part, number)| number.is_err() && !part.is_empty()) {
            return self
                .fault(format!("face: `{word}` is not of the form v, v/vt, v//vn, v/vt/vn"));
        }
        let vertex = self.absolute("vertex", vertex, self.vertices)?;
        self.last_index = self.last_index.max(vertex, self.line);
        let Some((_, Ok(coordinates))) = rest.first() else { return Ok((vertex, 0)) };
        let there = self.scan.coordinates.len() as i64;
        let coordinates = self.absolute("texture coordinates", *coordinates, there)?;
        self.last_coordinates = self.last_coordinates.max(coordinates, self.line);
        Ok((vertex, coordinates))
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
        for (what, last, there) in [
            ("vertex", self.last_index, self.vertices),
            ("texture coordinates", self.last_coordinates, coordinates),
        ] {
            if last.index > there {
                self.line = last.line;
                return self.fault(format!("face: {what} {}, but there are {there}", last.index));
            }
        }
        let notes = [
            (&self.no_surface, "points, lines or faces of fewer than three corners are left out"),
            (&self.homogeneous, "vertices have a weight w; x y z are divided by it"),
        ];
        let file = self.file.display();
        let some = |(tally, what): (&Tally, &str)| {
            let Tally { count, first } = tally;
            (*count > 0).then(|| format!("{file}:{first}: {count} {what}"))
        };
        let mut warnings: Vec<Warning> =
            notes.into_iter().filter_map(some).map(Warning::note).collect();
        let changes = [
            (&self.free_form, "free-form curves or surfaces are left out"),
            (&self.no_coordinates, "texture coordinates are no finite numbers; 0 is used"),
        ];
        warnings.extend(changes.into_iter().filter_map(some).map(Warning::changed));
        let Tally { count, first } = self.no_surface;
        Ok(Scan { warnings, without_surface: (count > 0).then_some(first), ..self.scan })
    }
}
