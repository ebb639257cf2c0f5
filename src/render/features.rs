//! What a scene has, and so what its shaders hold: the one place that decides what is left out.

use crate::scene::{Bsdf, Material, Scene, Sphere};

/// Features of a scene beside plain diffuse triangles. What is not there is not linked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Features {
    /// Shapes that are spheres.
    pub spheres: bool,
    /// Spheres that emit.
    pub sphere_lights: bool,
    /// Surfaces with holes where a texture's alpha is low.
    pub cutouts: bool,
    /// Albedo that varies along a surface.
    pub textures: bool,
    /// It does so by the colours of corners.
    pub vertex_colors: bool,
    /// Area lights whose emission varies, or that have holes.
    pub emission_textures: bool,
    /// Surfaces with a Phong lobe.
    pub phong: bool,
    /// Ideal mirrors.
    pub mirror: bool,
    /// Smooth dielectrics.
    pub glass: bool,
    /// An environment that is not black.
    pub sky: Sky,
}

impl Features {
    /// Those of a scene.
    pub fn of(scene: &Scene) -> Self {
        let any = |is: &dyn Fn(Bsdf) -> bool| scene.materials.iter().any(|m| is(m.bsdf));
        let emits = |sphere: &Sphere| scene.materials[sphere.material as usize].emits();
        let emission_textures =
            |m: &&Material| m.emits() && m.emission_texture.or(m.cutout).is_some();
        let vertex_colors = !scene.colors.is_empty();
        Self {
            spheres: !scene.spheres.is_empty(),
            sphere_lights: scene.spheres.iter().any(emits),
            cutouts: scene.materials.iter().any(|material| material.cutout.is_some()),
            textures: vertex_colors
                || scene.materials.iter().any(|material| material.texture.is_some()),
            vertex_colors,
            emission_textures: scene.materials.iter().filter(emission_textures).count() > 0,
            phong: any(&|bsdf| matches!(bsdf, Bsdf::Phong { .. })),
            mirror: any(&|bsdf| matches!(bsdf, Bsdf::Mirror { .. })),
            glass: any(&|bsdf| matches!(bsdf, Bsdf::Glass { .. })),
            sky: Sky::of(scene),
        }
    }

    /// Whether any surface is more than diffuse.
    pub fn has_bsdfs(self) -> bool {
        self.phong || self.specular()
    }

    /// Whether rays go on at some surfaces.
    pub fn specular(self) -> bool {
        self.mirror || self.glass
    }

    /// Whether there is any texture.
    pub fn has_textures(self) -> bool {
        self.textures || self.cutouts || self.emission_textures
    }

    /// All there are, whatever the scene has: for measuring what leaving out saves.
    pub fn everything() -> Self {
        Self {
            spheres: true,
            sphere_lights: true,
            cutouts: true,
            textures: true,
            vertex_colors: true,
            emission_textures: true,
            phong: true,
            mirror: true,
            glass: true,
            sky: Sky::Image,
        }
    }
}

/// What is seen where there is no surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sky {
    /// Nothing.
    #[default]
    None,
    /// The same radiance everywhere.
    Constant,
    /// Radiance by an image.
    Image,
}

impl Sky {
    fn of(scene: &Scene) -> Self {
        match &scene.environment {
            Some(environment) if environment.shines() => match environment.image {
                Some(_) => Self::Image,
                None => Self::Constant,
            },
            _ => Self::None,
        }
    }

    /// Whether anything is.
    pub fn shines(self) -> bool {
        self != Self::None
    }
}

/// What programs are linked for: a device and a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Target {
    /// Whether the device has subgroups of eight lanes or more.
    pub subgroups: bool,
    /// What the scene has.
    pub features: Features,
    /// Whether its triangles are written into the shaders.
    pub literals: bool,
    /// Whether they are for packets of shadow rays, too.
    pub literal_packets: bool,
}

impl Target {
    /// A scene with these features, and a hierarchy.
    pub fn of(subgroups: bool, features: Features) -> Self {
        Self { subgroups, features, literals: false, literal_packets: false }
    }

    /// A scene of plain diffuse triangles.
    pub fn plain(subgroups: bool) -> Self {
        Self::of(subgroups, Features::default())
    }

    /// How many values of four channels a point gathers: irradiance, and another for a lobe.
    pub fn lobes(&self) -> usize {
        if self.features.phong { 2 } else { 1 }
    }

    /// Enough of the possible ones to link every module: each feature by itself, none, and all.
    pub fn all() -> Vec<Self> {
        let none = Features::default();
        let features = [
            none,
            Features { spheres: true, ..none },
            Features { spheres: true, sphere_lights: true, ..none },
            Features { cutouts: true, ..none },
            Features { textures: true, ..none },
            Features { emission_textures: true, ..none },
            Features { phong: true, ..none },
            Features { mirror: true, ..none },
            Features { glass: true, ..none },
            Features { sky: Sky::Constant, ..none },
            Features { sky: Sky::Image, ..none },
            Features::everything(),
        ];
        let both = [false, true].into_iter();
        let large = both.flat_map(|subgroups| features.map(|all| Self::of(subgroups, all)));
        let small = large.clone().filter(|of| !of.features.spheres && !of.features.cutouts);
        let small = small.map(|of| Self { literals: true, literal_packets: true, ..of });
        large.chain(small).collect()
    }
}
