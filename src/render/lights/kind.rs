//! The kinds of light sources.

/// The kinds of light sources, each with a table and stages of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LightKind {
    /// Lights without extent that shine in all directions.
    Point,
    /// Lights without extent that shine into a cone.
    Spot,
    /// Lights infinitely far away.
    Directional,
    /// Emitting triangles.
    Area,
    /// Emitting spheres.
    Sphere,
    /// Light from all directions.
    Environment,
}

impl LightKind {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Point, Self::Spot, Self::Directional, Self::Area, Self::Sphere, Self::Environment];

    /// Whether it takes one shadow ray to know what a light gives to a point: it has no extent.
    pub fn is_exact(self) -> bool {
        matches!(self, Self::Point | Self::Spot | Self::Directional)
    }

    /// Whether its lights, or places on them, can be gathered as VPLs are, with a visibility that
    /// clusters share. Spots are no such lights, as they shine neither by the cosine nor in all
    /// directions.
    pub fn has_places(self) -> bool {
        matches!(self, Self::Point | Self::Area)
    }
}
