//! The cameras and lights of the nodes.

use glam::{DAffine3, DVec3};

use super::json::{Light, Node};
use super::source::Source;
use crate::error::SceneError;
use crate::scene::{DraftCamera, FovAxis, Origin, Warning, bare, draft};

/// The first perspective camera, and all point lights.
#[derive(Debug)]
pub struct View<'a> {
    source: &'a Source,
    pub camera: Option<DraftCamera>,
    /// Position, and intensity in W/sr.
    pub point_lights: Vec<(DVec3, DVec3)>,
    pub warnings: Vec<Warning>,
}

impl<'a> View<'a> {
    pub fn new(source: &'a Source) -> Self {
        Self { source, camera: None, point_lights: Vec::new(), warnings: Vec::new() }
    }

    /// Adds what a node carries.
    pub fn add(&mut self, node: &Node, transform: DAffine3) -> Result<(), SceneError> {
        if let Some(camera) = node.camera {
            self.add_camera(camera, transform)?;
        }
        if let Some(light) = &node.extensions.light {
            self.add_light(light.light, transform)?;
        }
        Ok(())
    }

    /// Cameras look along -Z, their top is +Y.
    fn add_camera(&mut self, index: usize, transform: DAffine3) -> Result<(), SceneError> {
        let camera = self.source.item(&self.source.document.cameras, "camera", index)?;
        let name = camera.name.clone().unwrap_or_else(|| index.to_string());
        let Some(perspective) = &camera.perspective else {
            let what = format!("camera `{name}` is orthographic, not supported yet; passed over");
            self.warnings.push(Warning::changed(self.source.says(&what)));
            return Ok(());
        };
        if self.camera.is_some() {
            let what = format!("camera `{name}` is passed over, the first is used");
            self.warnings.push(Warning::note(self.source.says(&what)));
            return Ok(());
        }
        self.camera = Some(DraftCamera {
            position: transform.translation,
            direction: transform.transform_vector3(-DVec3::Z),
            up: transform.transform_vector3(DVec3::Y),
            fov: perspective.yfov.to_degrees(),
            fov_axis: FovAxis::Y,
            size: bare::SIZE,
            origin: Origin::file(&self.source.path),
        });
        Ok(())
    }

    /// A candela of glTF is taken as one W/sr in each channel.
    fn add_light(&mut self, index: usize, transform: DAffine3) -> Result<(), SceneError> {
        let lights = &self.source.document.extensions.lights.lights;
        let light = self.source.item(lights, "light", index)?;
        let Light { name, kind, color, intensity } = light;
        let name = name.clone().unwrap_or_else(|| index.to_string());
        if kind != "point" {
            let what = format!("light `{name}` is of type {kind:?}, not supported yet; left out");
            self.warnings.push(Warning::changed(self.source.says(&what)));
            return Ok(());
        }
        let color = color.map_or(DVec3::ONE, DVec3::from_array);
        let intensity = color * intensity.unwrap_or(1.0);
        if !draft::is_power(intensity) {
            let what = format!("light `{name}`: its intensity is negative, or beyond f32");
            return Err(self.source.fault(what + "; give one of 0 or more"));
        }
        self.point_lights.push((transform.translation, intensity));
        Ok(())
    }
}
