//! The pictures that explain the method, as in the thesis: clusters of visible points in
//! random colours with their representatives as green dots; VPLs as small blue dots over the
//! scene; clusters of VPLs as large ones.

use glam::Vec3;

use super::camera::pixel_of;
use super::frame::ClusteredPoints;
use super::plan::Plan;
use super::virtual_light::VirtualLight;
use crate::bvh::Ray;
use crate::gpu::PointRecord;
use crate::image::Image;
use crate::sampling::{SURFACE_OFFSET, hash};
use crate::scene::Camera;

const GREEN: [f32; 3] = [0.0, 0.8, 0.0];
const BLUE: [f32; 3] = [0.02, 0.08, 1.0];

/// Paints each pixel in the colour of its first sample's cluster, and the representatives.
pub fn point_clusters(clustered: &ClusteredPoints, image: &mut Image) {
    let clusters = &clustered.clusters;
    let mut marks = Vec::new();
    for tile in clustered.tiling.tiles().filter(|tile| tile.sample == 0) {
        let first = tile.of_frame().start;
        for point in tile.own() {
            let index = first + point;
            let [x, y] = pixel_of(point as u32, tile.first_block, image.width);
            let hit = clustered.records[index].surface != PointRecord::NOTHING;
            if hit && x < image.width && y < image.height {
                let cluster = clusters.of_points[index * clusters.shared];
                let at = y as usize * image.width as usize + x as usize;
                image.pixels[at] = colour(cluster);
                if clusters.representatives[cluster as usize] == clustered.records[index] {
                    marks.push([x, y]);
                }
            }
        }
    }
    for [x, y] in marks {
        dot(image, x as f32, y as f32, 1.5, GREEN);
    }
}

/// Paints the lights that the camera sees as dots of a radius in pixels.
pub fn lights(
    plan: &Plan,
    camera: &Camera,
    lights: &[VirtualLight],
    radius: f32,
    image: &mut Image,
) {
    for light in lights.iter().filter(|light| is_seen(plan, camera, light.position)) {
        if let Some([x, y]) = project(camera, light.position) {
            dot(image, x, y, radius, BLUE);
        }
    }
}

/// A bright colour, the same for the same number.
fn colour(number: u32) -> [f32; 3] {
    let bits = hash(number.wrapping_add(1));
    [0, 8, 16].map(|shift| 0.1 + 0.8 * ((bits >> shift & 255) as f32 / 255.0).powi(2))
}

/// Where a position appears, in pixels; none behind the camera.
fn project(camera: &Camera, position: Vec3) -> Option<[f32; 2]> {
    let view = position - camera.position;
    let depth = view.dot(camera.forward);
    let [tan_x, tan_y] = camera.half_tangents();
    let [width, height] = camera.size.map(|extent| extent as f32);
    (depth > 0.0).then(|| {
        let x = view.dot(camera.right) / (depth * tan_x);
        let y = view.dot(camera.up) / (depth * tan_y);
        [(x + 1.0) / 2.0 * width - 0.5, (1.0 - y) / 2.0 * height - 0.5]
    })
}

fn is_seen(plan: &Plan, camera: &Camera, position: Vec3) -> bool {
    let view = position - camera.position;
    let limit = 1.0 - 16.0 * SURFACE_OFFSET / view.length();
    !plan.bvh.occluded(&Ray { origin: camera.position, direction: view, limit })
}

fn dot(image: &mut Image, x: f32, y: f32, radius: f32, colour: [f32; 3]) {
    let reach = |center: f32, extent: u32| {
        let low = (center - radius).ceil().max(0.0) as u32;
        let high = (center + radius + 1.0).floor().clamp(0.0, extent as f32) as u32;
        low..high
    };
    for row in reach(y, image.height) {
        for column in reach(x, image.width) {
            let (dx, dy) = (column as f32 - x, row as f32 - y);
            if dx * dx + dy * dy <= radius * radius {
                let at = row as usize * image.width as usize + column as usize;
                image.pixels[at] = colour;
            }
        }
    }
}
