//! From a [`Draft`] to a [`Scene`]: what is impossible is refused, the rest is recentred, scaled
//! and rounded.

use glam::{DVec3, Vec2, Vec3};

use super::shape::UNCOLORED;
use super::{
    Bsdf, Camera, Draft, DraftCamera, DraftMaterial, Material, Origin, Scene, SceneError, Triangle,
    Units, Warning, normalise,
};

impl Draft {
    /// Checks, recentres, scales and rounds the draft to a [`Scene`].
    ///
    /// # Errors
    /// No camera, no light, impossible values, or nothing to render.
    pub fn finish(mut self) -> Result<Scene, SceneError> {
        let origin = Origin::file(&self.name);
        let materials: Vec<Material> =
            self.materials.iter().map(DraftMaterial::finish).collect::<Result<_, _>>()?;
        if !(-100.0..=100.0).contains(&self.exposure) {
            return Err(origin.error("exposure is not within -100 and 100 EV"));
        }
        let draft_camera = self.camera.take().ok_or_else(|| {
            origin.error("no camera: add a [camera] table with position, target and fov")
        })?;
        self.uvs.resize(self.triangles.len(), [Vec2::ZERO; 3]);
        let colored = !self.colors.is_empty();
        self.colors.resize(self.triangles.len(), UNCOLORED);
        let mesh = normalise::shapes(&origin, &self, &materials)?;
        let point_lights = normalise::point_lights(&origin, &self, &mesh.units)?;
        let directional_lights = normalise::directional_lights(&origin, &self.directional_lights)?;
        let textured = materials.iter().any(|material| material.textures().next().is_some());
        let mut warnings = self.warnings;
        warnings.extend(mesh.warnings);
        warnings.extend(uncolorable(&origin, &mesh.triangles, &mesh.colors, &materials));
        let scene = Scene {
            name: self.name,
            camera: camera(&draft_camera, &mesh.units)?,
            exposure: self.exposure as f32,
            triangles: mesh.triangles,
            uvs: if textured { mesh.uvs } else { Vec::new() },
            colors: if colored { mesh.colors } else { Vec::new() },
            spheres: mesh.spheres,
            materials,
            textures: self.textures,
            images: self.images,
            point_lights,
            directional_lights,
            environment: self.environment,
            units: mesh.units,
            dropped_triangles: mesh.dropped,
            warnings,
        };
        if !scene.is_lit() {
            return Err(origin.error(
                "no light: add a [[light]], or a material with an emission, that is not black",
            ));
        }
        Ok(scene)
    }
}

impl DraftMaterial {
    /// Checks and rounds it.
    fn finish(&self) -> Result<Material, SceneError> {
        let fault = |what: &str, value: DVec3, range: &str| {
            let DVec3 { x, y, z } = value;
            let name = &self.name;
            self.origin.error(format!("material `{name}`: {what} [{x}, {y}, {z}] is not {range}"))
        };
        if !self.albedo.to_array().iter().all(|a| (0.0..=1.0).contains(a)) {
            return Err(fault("albedo", self.albedo, "within 0 and 1"));
        }
        if !normalise::is_power(self.emission) {
            return Err(fault("emission", self.emission, "a finite radiance of 0 or more"));
        }
        let bsdf = self.bsdf;
        if let Some(what) = impossible(&bsdf, normalise::round(self.albedo)) {
            return Err(self.origin.error(format!("material `{}`: {what}", self.name)));
        }
        Ok(Material {
            name: self.name.clone(),
            albedo: normalise::round(self.albedo),
            texture: self.texture,
            cutout: self.cutout,
            bsdf,
            emission: normalise::round(self.emission),
            emission_texture: self.emission_texture,
            two_sided: self.two_sided,
        })
    }
}

/// What is lost of the colours at corners: they multiply an albedo, and nothing else.
fn uncolorable(
    origin: &Origin,
    triangles: &[Triangle],
    colors: &[[Vec3; 3]],
    materials: &[Material],
) -> Option<Warning> {
    let black = |triangle: &Triangle| {
        let material = &materials[triangle.material as usize];
        material.albedo == Vec3::ZERO && material.bsdf != Bsdf::Diffuse
    };
    let lost = triangles.iter().zip(colors).filter(|(t, c)| **c != UNCOLORED && black(t)).count();
    let what = format!(
        "{lost} triangles have colours at their corners, but a material without a diffuse part"
    );
    (lost > 0).then(|| origin.changed(what + "; they are left out"))
}

/// What is wrong with a BSDF over a diffuse albedo.
fn impossible(bsdf: &Bsdf, albedo: Vec3) -> Option<&'static str> {
    /// What the sum of two rounded reflectances may exceed 1 by.
    const ROUNDING: f32 = 1e-5;
    let within = |color: Vec3| color.to_array().iter().all(|c| (0.0..=1.0).contains(c));
    match *bsdf {
        Bsdf::Diffuse => None,
        Bsdf::Phong { specular, .. } | Bsdf::Mirror { specular } | Bsdf::Glass { specular, .. }
            if !within(specular) =>
        {
            Some("specular is not within 0 and 1")
        }
        // Light would take no notice of it, but images of the reflectance would.
        Bsdf::Mirror { .. } | Bsdf::Glass { .. } if albedo != Vec3::ZERO => {
            Some("mirror and glass have no albedo; make it 0")
        }
        Bsdf::Phong { specular, .. } if (specular + albedo).max_element() > 1.0 + ROUNDING => {
            Some("albedo and specular together exceed 1; lower one of them")
        }
        Bsdf::Phong { shininess, .. } if !(0.0..=1e6).contains(&shininess) => {
            Some("shininess is not within 0 and 1e6")
        }
        Bsdf::Glass { ior, .. } if !(0.1..=10.0).contains(&ior) => {
            Some("ior is not within 0.1 and 10")
        }
        _ => None,
    }
}

/// Checks the camera and brings it to normalised units.
fn camera(draft: &DraftCamera, units: &Units) -> Result<Camera, SceneError> {
    let fault = |what: &str| draft.origin.error(format!("camera: {what}"));
    if !(draft.fov > 0.0 && draft.fov < 180.0) {
        return Err(fault("fov must lie between 0 and 180 degrees, both excluded"));
    }
    if draft.size.iter().any(|extent| !(1..=Camera::MAX_EXTENT).contains(extent)) {
        return Err(fault("size must be 1 to 65536 pixels in width and in height"));
    }
    let forward = draft.direction.try_normalize().ok_or_else(|| {
        fault("it looks nowhere; give a direction other than 0, or a target apart from position")
    })?;
    let up = draft.up.try_normalize().ok_or_else(|| fault("up is 0; give another"))?;
    // Below this sine of their angle, rounding of the input decides where up is.
    let right = forward.cross(up);
    if right.length() < 1e-9 {
        return Err(fault("up is parallel to the direction of view; give another up"));
    }
    let right = right.normalize();
    let position = normalise::round(units.normalise(draft.position));
    if !position.is_finite() {
        return Err(fault("position is too far from the scene"));
    }
    Ok(Camera {
        position,
        right: normalise::round(right),
        up: normalise::round(right.cross(forward)),
        forward: normalise::round(forward),
        fov: draft.fov,
        fov_axis: draft.fov_axis,
        size: draft.size,
    })
}
