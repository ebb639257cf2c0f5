//! Whether surfaces are near lamps, where places on them are best drawn by solid angle.

use glam::Vec3;

use crate::bvh::Bvh;
use crate::gpu::{AreaLightRecord, NodeRecord, TriangleRecord};

/// An emitting triangle is near where it may fill this solid angle. By area, the strata of a pixel
/// are enough for less.
const NEAR: f32 = 1.0;
/// A surface in the plane of a lamp, to rounding, gets nothing from it.
const IN_PLANE: f32 = 1e-6;

/// Whether some surface that a lamp shines on is near it. No node of the hierarchy tells of a
/// surface that is nearer than it is, so that there are none if this is false.
pub fn any_near(bvh: &Bvh, lamps: &[AreaLightRecord]) -> bool {
    lamps.iter().any(|lamp| {
        let reach = Reach::of(lamp);
        let mut at = 0;
        while let Some(node) = bvh.nodes.get(at) {
            if !reach.meets(node) {
                at = node.skip as usize;
                continue;
            }
            let (first, count) = (node.leaf as usize / 8, node.leaf as usize % 8);
            if bvh.triangles[first..first + count].iter().any(|shape| lights(lamp, shape)) {
                return true;
            }
            at += 1;
        }
        false
    })
}

/// The box of all places at which an emitting triangle may be near.
#[derive(Debug, Clone, Copy)]
struct Reach {
    low: Vec3,
    high: Vec3,
}

impl Reach {
    /// A triangle of area A fills at most A / d² at a distance of d.
    fn of(lamp: &AreaLightRecord) -> Self {
        let [a, b, c] = [lamp.corner, lamp.edge1, lamp.edge2].map(Vec3::from_array);
        let (b, c, d) = (a + b, a + c, Vec3::splat((lamp.area / NEAR).sqrt()));
        Self { low: a.min(b).min(c) - d, high: a.max(b).max(c) + d }
    }

    fn meets(&self, node: &NodeRecord) -> bool {
        let [low, high] = [node.low, node.high].map(Vec3::from_array);
        low.cmple(self.high).all() && high.cmpge(self.low).all()
    }
}

/// Whether some of a shape is on a side of the lamp's plane to which it shines.
fn lights(lamp: &AreaLightRecord, shape: &TriangleRecord) -> bool {
    let (corner, normal) = (Vec3::from_array(lamp.corner), Vec3::from_array(lamp.normal));
    let height = |place: [f32; 3]| (Vec3::from_array(place) - corner).dot(normal);
    let (least, most) = if shape.kind & TriangleRecord::SPHERE != 0 {
        (height(shape.a) - shape.b[0], height(shape.a) + shape.b[0])
    } else {
        let heights = [shape.a, shape.b, shape.c].map(height);
        (heights.into_iter().fold(f32::MAX, f32::min), heights.into_iter().fold(f32::MIN, f32::max))
    };
    most > IN_PLANE || (lamp.two_sided != 0 && least < -IN_PLANE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::lights::area::triangles;
    use crate::scene::Scene;

    /// A lamp of 2 × 2 with a small ball at this height before or behind it.
    fn plate(height: f64, two_sided: bool) -> bool {
        let text = format!(
            "[camera]\nposition = [9, 9, 9]\ntarget = [0, 0, 0]\nfov = 40\nsize = [8, 8]\n\
             [[sphere]]\ncenter = [0, 0, {height}]\nradius = 0.125\nmaterial = \"ball\"\n\
             [materials.ball]\nalbedo = [0.5, 0.5, 0.5]\n\
             [[light]]\ntype = \"quad\"\ntwo_sided = {two_sided}\nradiance = [1, 1, 1]\n\
             corners = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]\n"
        );
        let directory = tempfile::tempdir().unwrap();
        let file = directory.path().join("a.toml");
        std::fs::write(&file, text).unwrap();
        let scene = Scene::load(file.to_str().unwrap()).unwrap();
        let lamps = triangles(&scene).records;
        assert_eq!(lamps.len(), 2);
        any_near(&Bvh::of(&scene), &lamps)
    }

    #[test]
    fn surfaces_before_a_lamp_are_near_it_to_the_root_of_its_area() {
        // A triangle of area 2 fills 1 sr at most at a distance of 1.41.
        for (height, near) in [(0.5, true), (1.5, true), (1.6, false), (5.0, false)] {
            assert_eq!(plate(height, false), near, "at {height}");
            assert_eq!(plate(-height, true), near, "at -{height}, two-sided");
            assert!(!plate(-height, false), "a lamp does not shine on what is behind it");
        }
    }

    #[test]
    fn the_lamp_of_the_cornell_box_is_near_to_nothing_but_its_ceiling() {
        let scene = Scene::load("builtin:cornell").unwrap();
        assert!(!any_near(&Bvh::of(&scene), &triangles(&scene).records));
    }
}
