//! What a scene holds, ready to be rendered.

use glam::{Vec2, Vec3};

use super::{
    Camera, DirectionalLight, Environment, Material, PointLight, Sphere, Texels, Texture, Triangle,
    Units, Warning,
};

/// A scene ready to be rendered. All lengths are in normalised units, see [`Units`].
#[derive(Debug, Clone)]
pub struct Scene {
    /// The file or `builtin:` name it came from.
    pub name: String,
    /// Where it is seen from.
    pub camera: Camera,
    /// Exposure of the PNG, in EV.
    pub exposure: f32,
    /// All triangles, wound counter-clockwise seen from the side of their normal.
    pub triangles: Vec<Triangle>,
    /// Texture coordinates of the corners of each triangle; none where no material has a texture.
    pub uvs: Vec<[Vec2; 3]>,
    /// What the colours of the corners of each triangle multiply its albedo by, linear, in [0, 1];
    /// none where no triangle has any.
    pub colors: Vec<[Vec3; 3]>,
    /// All spheres.
    pub spheres: Vec<Sphere>,
    /// What triangles and spheres are made of.
    pub materials: Vec<Material>,
    /// What materials vary by.
    pub textures: Vec<Texture>,
    /// The images of the textures.
    pub images: Vec<Texels>,
    /// Point and spot lights; area lights are the triangles and spheres of emitting materials.
    pub point_lights: Vec<PointLight>,
    /// Lights infinitely far away, in one direction each.
    pub directional_lights: Vec<DirectionalLight>,
    /// Light from all directions.
    pub environment: Option<Environment>,
    /// How to get back to the units of the file.
    pub units: Units,
    /// Triangles left out because they have no area.
    pub dropped_triangles: u64,
    /// What the user should know about how the scene was read.
    pub warnings: Vec<Warning>,
}

impl Scene {
    /// Whether any light is not black.
    pub fn is_lit(&self) -> bool {
        let sphere = |sphere: &Sphere| self.materials[sphere.material as usize].emits();
        self.point_lights.iter().any(|light| light.intensity.max_element() > 0.0)
            || self.directional_lights.iter().any(|light| light.irradiance.max_element() > 0.0)
            || self.environment.as_ref().is_some_and(Environment::shines)
            || self.emitters().next().is_some()
            || self.spheres.iter().any(sphere)
    }

    /// Whether light meets mirrors or glass.
    pub fn has_specular(&self) -> bool {
        let specular = |material: u32| self.materials[material as usize].bsdf.is_specular();
        self.triangles.iter().any(|triangle| specular(triangle.material))
            || self.spheres.iter().any(|sphere| specular(sphere.material))
    }

    /// Whether mirrors or glass may turn light that has no extent, which paths from the camera never
    /// run into.
    pub fn has_hidden_caustics(&self) -> bool {
        let points = self.point_lights.len() + self.directional_lights.len();
        points > 0 && self.has_specular()
    }

    /// How many light sources there are; each triangle and sphere that emits is one.
    pub fn light_count(&self) -> usize {
        let emits = |sphere: &&Sphere| self.materials[sphere.material as usize].emits();
        self.point_lights.len()
            + self.directional_lights.len()
            + usize::from(self.environment.is_some())
            + self.emitters().count()
            + self.spheres.iter().filter(emits).count()
    }

    /// Indices of the triangles that emit, in order.
    pub fn emitters(&self) -> impl Iterator<Item = u32> + '_ {
        (0u32..).zip(&self.triangles).filter_map(|(i, triangle)| {
            self.materials[triangle.material as usize].emits().then_some(i)
        })
    }
}
