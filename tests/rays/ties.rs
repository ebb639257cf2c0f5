//! Of coincident triangles the lowest is hit. That closed surfaces let no ray out is among the checks
//! of extreme cases.

use crate::common::Rng;
use crate::common::tracing::{on_all, random_rays, soup};
use gpu_vpl::bvh::Bvh;

/// Of triangles in the same place the lowest is hit, whatever the order of the leaves.
#[test]
fn ties_go_to_the_lowest_index() {
    let mut rng = Rng(3);
    let mut triangles = soup(&mut rng, 60, 0.6);
    triangles.extend_from_within(..);
    triangles.extend_from_within(..60);
    let bvh = Bvh::build(&triangles);
    let rays = random_rays(&mut rng, 5000);
    for (_, answers) in on_all(&bvh, &rays, false) {
        let hits = || answers.iter().filter(|answer| answer.hits());
        assert!(hits().count() > 1000, "few rays hit");
        assert!(hits().all(|hit| hit.triangle < 60), "a higher index won");
        assert!(hits().all(|hit| hit.material == 3));
    }
}
