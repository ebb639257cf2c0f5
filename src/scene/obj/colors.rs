//! Colours of vertices: `v x y z r g b`, no part of the format, but written by MeshLab, Blender,
//! CloudCompare and others. They are in sRGB, from 0 to 1, or in whole numbers to 255.

use glam::Vec3;

use crate::scene::texture::linear;

/// The colours of vertices, and which corners of faces have them.
#[derive(Debug, Default)]
pub struct Colors {
    /// As they stand, from the first vertex on; what lacks has none.
    of_vertices: Vec<Option<Vec3>>,
    /// The vertices of the last corners, counted from 0: those since there are colours.
    of_corners: Vec<u32>,
    largest: f32,
}

impl Colors {
    /// Gives a vertex, counted from 0, a colour.
    pub fn add(&mut self, vertex: i64, color: [f64; 3]) {
        let color = Vec3::from_array(color.map(|channel| channel.max(0.0) as f32));
        self.of_vertices.resize(usize::try_from(vertex).unwrap_or_default(), None);
        self.of_vertices.push(Some(color));
        self.largest = self.largest.max(color.max_element());
    }

    /// Notes the vertex of the next corner, counted from 1.
    pub fn add_corner(&mut self, vertex: i64) {
        if !self.of_vertices.is_empty() {
            self.of_corners.push(u32::try_from(vertex - 1).unwrap_or(u32::MAX));
        }
    }

    /// Those of so many corners, linear; white of those that have none.
    pub fn of_corners(&self, count: usize) -> impl Iterator<Item = Vec3> + '_ {
        let one = if self.largest > 1.0 { 255.0 } else { 1.0 };
        let decode = move |value: f32| linear((value / one).min(1.0));
        let color = move |&vertex: &u32| {
            let color = self.of_vertices.get(vertex as usize).copied().flatten();
            color.map_or(Vec3::ONE, |color| color.map(decode))
        };
        let before = count - self.of_corners.len();
        std::iter::repeat_n(Vec3::ONE, before).chain(self.of_corners.iter().map(color))
    }
}
