//! Polygons to triangles, in f64.

use glam::{DVec2, DVec3};

/// A triangulated polygon.
#[derive(Debug, PartialEq, Eq)]
pub struct Triangulation {
    /// Indices of the polygon's corners, wound as it is.
    pub triangles: Vec<[usize; 3]>,
    /// Whether they cover the polygon, which one that crosses itself does not allow.
    pub exact: bool,
}

/// Beyond so many corners a polygon is fanned unseen: cutting ears takes O(n³) at worst.
const MAX_CONCAVE: usize = 1024;

/// Fans a polygon about its first corner where that covers it, and else cuts off ears
/// (Meisters 1975). Corners may be slightly out of plane; the average plane then decides.
pub fn triangulate(corners: &[DVec3]) -> Triangulation {
    let fan = fan(corners.len());
    if corners.len() <= 3 {
        return Triangulation { triangles: fan, exact: true };
    }
    let flat = flatten(corners);
    let fan_covers = fan.iter().all(|&[a, b, c]| turns_left(flat[a], flat[b], flat[c]));
    if corners.len() > MAX_CONCAVE {
        return Triangulation { triangles: fan, exact: fan_covers };
    }
    let simple = !crosses_itself(&flat);
    if fan_covers {
        return Triangulation { triangles: fan, exact: simple };
    }
    let cut = cut_ears(&flat);
    Triangulation { exact: cut.exact && simple, ..cut }
}

/// Whether two sides cross between their ends.
fn crosses_itself(flat: &[DVec2]) -> bool {
    let side = |i: usize| [flat[i], flat[(i + 1) % flat.len()]];
    let splits = |[a, b]: [DVec2; 2], [c, d]: [DVec2; 2]| {
        (turns_left(a, b, c) && turns_left(a, d, b)) || (turns_left(a, b, d) && turns_left(a, c, b))
    };
    let cross = |i: usize, j: usize| splits(side(i), side(j)) && splits(side(j), side(i));
    (0..flat.len()).any(|i| (0..i).any(|j| cross(i, j)))
}

fn fan(corners: usize) -> Vec<[usize; 3]> {
    (2..corners).map(|i| [0, i - 1, i]).collect()
}

/// Projects along the axis nearest to the normal (Newell's), counter-clockwise, to unit size.
fn flatten(corners: &[DVec3]) -> Vec<DVec2> {
    let first = corners[0];
    let extent = corners.iter().map(|&c| (c - first).abs().max_element()).fold(0.0, f64::max);
    let unit = if extent > 0.0 { extent } else { 1.0 };
    let corners: Vec<DVec3> = corners.iter().map(|&c| (c - first) / unit).collect();
    let normal: DVec3 =
        corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, &b)| a.cross(b)).sum();
    let size = normal.abs();
    let project = |c: &DVec3| {
        if size.z >= size.x && size.z >= size.y {
            DVec2::new(c.x, c.y * normal.z.signum())
        } else if size.x >= size.y {
            DVec2::new(c.y, c.z * normal.x.signum())
        } else {
            DVec2::new(c.z, c.x * normal.y.signum())
        }
    };
    corners.iter().map(project).collect()
}

/// Twice the signed area of a triangle.
fn orient(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Whether a triangle of unit-size coordinates is wound counter-clockwise, with some area.
fn turns_left(a: DVec2, b: DVec2, c: DVec2) -> bool {
    orient(a, b, c) > 1e-14
}

fn cut_ears(flat: &[DVec2]) -> Triangulation {
    let mut left: Vec<usize> = (0..flat.len()).collect();
    let mut triangles = Vec::with_capacity(flat.len() - 2);
    let mut exact = true;
    while left.len() > 3 {
        let n = left.len();
        let at = |i: usize| left[i % n];
        let ear = (0..n).find(|&i| is_ear(flat, &left, [at(i + n - 1), at(i), at(i + 1)]));
        // What crosses itself, or has no area, has no ear: any corner is as good.
        exact &= ear.is_some();
        let i = ear.unwrap_or(1);
        triangles.push([at(i + n - 1), at(i), at(i + 1)]);
        left.remove(i);
    }
    triangles.push([left[0], left[1], left[2]]);
    Triangulation { triangles, exact }
}

/// Whether the triangle of three neighbours holds no other corner.
fn is_ear(flat: &[DVec2], left: &[usize], [a, b, c]: [usize; 3]) -> bool {
    let [a, b, c] = [flat[a], flat[b], flat[c]];
    // Slits touch themselves: a corner in the place of one of the three is not in the way.
    let in_the_way = |p: DVec2| {
        p != a
            && p != b
            && p != c
            && orient(a, b, p) >= 0.0
            && orient(b, c, p) >= 0.0
            && orient(c, a, p) >= 0.0
    };
    turns_left(a, b, c) && !left.iter().any(|&i| in_the_way(flat[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(corners: &[DVec3]) -> f64 {
        let side = |&[a, b, c]: &[usize; 3]| {
            0.5 * (corners[b] - corners[a]).cross(corners[c] - corners[a]).length()
        };
        triangulate(corners).triangles.iter().map(side).sum()
    }

    fn polygon(points: &[(f64, f64)]) -> Vec<DVec3> {
        points.iter().map(|&(x, y)| DVec3::new(x, 5.0, y)).collect()
    }

    #[test]
    fn an_l_shape_keeps_its_area_from_every_start_and_in_both_windings() {
        let mut l =
            polygon(&[(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)]);
        for _ in 0..2 {
            for _ in 0..l.len() {
                l.rotate_left(1);
                assert_eq!(triangulate(&l).triangles.len(), 4);
                assert!(triangulate(&l).exact);
                assert!((area(&l) - 5.0).abs() < 1e-12);
            }
            l.reverse();
        }
    }

    #[test]
    fn a_concave_quad_is_cut_along_its_inner_diagonal() {
        let dart = polygon(&[(0.0, 0.0), (2.0, 0.0), (0.5, 0.5), (0.0, 2.0)]);
        assert!((area(&dart) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_corner_on_an_edge_stays_a_corner() {
        let square = polygon(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]);
        let cut = triangulate(&square);
        assert!(cut.exact);
        assert!((area(&square) - 4.0).abs() < 1e-12);
        assert!(cut.triangles.iter().flatten().any(|&i| i == 1));
    }

    #[test]
    fn what_crosses_itself_is_said_to_be_inexact() {
        let star = polygon(&[(0.0, 3.0), (2.0, -2.0), (-3.0, 1.0), (3.0, 1.0), (-2.0, -2.0)]);
        assert!(!triangulate(&star).exact);
    }
}
