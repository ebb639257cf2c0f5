//! Triangles of one plane that cover the same part of it.

use glam::{DVec2, DVec3};

use crate::scene::Triangle;

/// The part of the smaller of two triangles below which they only touch.
const TOUCHING: f64 = 1e-4;

/// Whether two triangles of a plane have more than a border in common: what one leaves of the other
/// (Sutherland and Hodgman, "Reentrant Polygon Clipping", CACM 1974) has an area.
pub fn overlap(one: &Triangle, two: &Triangle, normal: DVec3) -> bool {
    let (x, y) = normal.any_orthonormal_pair();
    let flat = |triangle: &Triangle| {
        triangle.vertices.map(|v| DVec2::new(x.dot(v.as_dvec3()), y.dot(v.as_dvec3())))
    };
    let (mut polygon, mut window) = (flat(one).to_vec(), flat(two));
    if area(&window) < 0.0 {
        window.swap(1, 2);
    }
    let least = TOUCHING * area(&polygon).abs().min(area(&window));
    for edge in 0..3 {
        let (from, to) = (window[edge], window[(edge + 1) % 3]);
        let inside = |point: DVec2| (to - from).perp_dot(point - from);
        let mut left = Vec::with_capacity(polygon.len() + 1);
        for (at, &point) in polygon.iter().enumerate() {
            let next = polygon[(at + 1) % polygon.len()];
            let (here, there) = (inside(point), inside(next));
            if here >= 0.0 {
                left.push(point);
            }
            if (here < 0.0) != (there < 0.0) {
                left.push(point + (next - point) * (here / (here - there)));
            }
        }
        polygon = left;
    }
    area(&polygon).abs() > least
}

/// The area of a polygon, negative if it goes around clockwise.
fn area(polygon: &[DVec2]) -> f64 {
    let next = |at: usize| polygon[(at + 1) % polygon.len()];
    0.5 * polygon.iter().enumerate().map(|(at, point)| point.perp_dot(next(at))).sum::<f64>()
}
