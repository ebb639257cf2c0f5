//! What `info` tells.

use serde::Serialize;

use super::scene::SceneInfo;
use crate::gpu::{AdapterDescription, AdapterInfo};

#[derive(Debug, Serialize)]
pub struct Info {
    pub version: &'static str,
    pub adapters: Vec<AdapterDescription>,
    /// The adapter that `render` would take, or why it would fail.
    pub chosen: Option<AdapterInfo>,
    pub chosen_error: Option<String>,
    pub builtin_scenes: Vec<Builtin>,
    pub scene: Option<SceneInfo>,
}

#[derive(Debug, Serialize)]
pub struct Builtin {
    pub name: String,
    pub what: &'static str,
}
