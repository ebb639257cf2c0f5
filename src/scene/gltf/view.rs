//! The cameras and lights of the nodes.

use std::f64::consts::{FRAC_PI_4, PI};

use glam::{DAffine3, DVec3};

use super::json::{Light, Node};
use super::source::Source;
use crate::scene::{
    Draft, DraftCamera, DraftSpot, FovAxis, Origin, SceneError, Warning, bare, normalise,
};

/// The least and the greatest width over height of an image that a camera asks for.
const ASPECTS: [f64; 2] = [0.125, 64.0];

/// The first perspective camera, and all lights. A candela of glTF is taken as one W/sr in each
/// channel, a lux as one W/m².
#[derive(Debug, Default)]
pub struct View {
    camera: Option<DraftCamera>,
    point_lights: Vec<(DVec3, DVec3)>,
    spot_lights: Vec<DraftSpot>,
    directional_lights: Vec<(DVec3, DVec3)>,
    warnings: Vec<Warning>,
}

impl View {
    /// Adds it to a draft without a camera.
    pub fn add_to(self, draft: &mut Draft) {
        draft.camera = self.camera;
        draft.point_lights.extend(self.point_lights);
        draft.spot_lights.extend(self.spot_lights);
        draft.directional_lights.extend(self.directional_lights);
        draft.warnings.extend(self.warnings);
    }

    /// Adds what a node carries.
    pub fn add(
        &mut self,
        source: &Source,
        node: &Node,
        transform: DAffine3,
    ) -> Result<(), SceneError> {
        if let Some(camera) = node.camera {
            self.add_camera(source, camera, transform)?;
        }
        if let Some(light) = &node.extensions.light {
            self.add_light(source, light.light, transform)?;
        }
        Ok(())
    }

    /// Cameras look along -Z, their top is +Y.
    fn add_camera(
        &mut self,
        source: &Source,
        index: usize,
        transform: DAffine3,
    ) -> Result<(), SceneError> {
        let camera = source.item(&source.document.cameras, "camera", index)?;
        let name = camera.name.clone().unwrap_or_else(|| index.to_string());
        let Some(perspective) = &camera.perspective else {
            let what = format!("camera `{name}` is orthographic, not supported yet; passed over");
            self.warnings.push(Warning::changed(source.says(&what)));
            return Ok(());
        };
        if self.camera.is_some() {
            let what = format!("camera `{name}` is passed over, the first is used");
            self.warnings.push(Warning::note(source.says(&what)));
            return Ok(());
        }
        self.camera = Some(DraftCamera {
            position: transform.translation,
            direction: transform.transform_vector3(-DVec3::Z),
            up: transform.transform_vector3(DVec3::Y),
            fov: perspective.yfov.to_degrees(),
            fov_axis: FovAxis::Y,
            size: size(perspective.aspect_ratio),
            origin: Origin::file(&source.path),
        });
        Ok(())
    }

    /// Lights shine along -Z.
    fn add_light(
        &mut self,
        source: &Source,
        index: usize,
        transform: DAffine3,
    ) -> Result<(), SceneError> {
        let lights = &source.document.extensions.lights.lights;
        let Light { name, kind, color, intensity, spot, range } =
            source.item(lights, "light", index)?;
        let name = name.clone().unwrap_or_else(|| index.to_string());
        let color = color.map_or(DVec3::ONE, DVec3::from_array);
        let power = color * intensity.unwrap_or(1.0);
        if !normalise::is_power(power) {
            let what = format!("light `{name}`: its intensity is negative, or beyond f32");
            return Err(source.fault(what + "; give one of 0 or more"));
        }
        if range.is_some() {
            let what = format!("light `{name}` has a range, which is left out: its light goes on");
            self.warnings.push(Warning::note(source.says(&what)));
        }
        let position = transform.translation;
        let direction = transform.transform_vector3(-DVec3::Z);
        match kind.as_str() {
            "point" => self.point_lights.push((position, power)),
            "directional" => self.directional_lights.push((direction, power)),
            "spot" => {
                let angles = [
                    spot.inner_cone_angle.unwrap_or(0.0),
                    spot.outer_cone_angle.unwrap_or(FRAC_PI_4),
                ];
                let [inner, outer] = angles;
                if !(0.0 <= inner && inner <= outer && outer > 0.0 && outer <= PI) {
                    let what = format!("light `{name}`: its cone of {inner} to {outer} is none");
                    return Err(source.fault(what + "; export it again"));
                }
                let angles = angles.map(f64::to_degrees);
                self.spot_lights.push(DraftSpot { position, direction, intensity: power, angles });
            }
            _ => {
                let what = format!("light `{name}` is of the unknown type {kind:?}; left out");
                self.warnings.push(Warning::changed(source.says(&what)));
            }
        }
        Ok(())
    }
}

/// The image's size, as wide as that of any bare mesh.
fn size(aspect: Option<f64>) -> [u32; 2] {
    let [width, height] = bare::SIZE;
    let [narrowest, widest] = ASPECTS;
    let shaped = |aspect: f64| f64::from(width) / aspect.clamp(narrowest, widest);
    [width, aspect.filter(|&aspect| aspect > 0.0).map_or(height, |a| shaped(a).round() as u32)]
}
