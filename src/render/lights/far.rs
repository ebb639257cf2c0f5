//! Lights infinitely far away, which shine through discs across a sphere around the scene: all alike,
//! and around any place of the scene.

/// A light infinitely far away.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FarLight {
    /// The directional light of this index.
    Directional(u32),
    /// The environment.
    Environment,
}
