//! `info`: the adapters and built-in scenes there are, and what a scene holds.

mod adapters;
mod formats;
mod lights;
mod listing;
mod materials;
mod memory;
mod scene;
mod table;

use std::fmt::Write;

use clap::Args;

use super::adapter::adapter_choice;
use super::console;
use crate::error::{Error, OutputError};
use crate::gpu::{self, Gpu};
use crate::scene::{BUILTIN_SCENES, Scene};
use listing::{Builtin, Info};

/// The options of `info`.
#[derive(Debug, Args)]
pub struct InfoArgs {
    /// A .toml scene file, a bare .obj, .gltf or .glb, or builtin:NAME
    scene: Option<String>,

    /// Print JSON
    #[arg(long)]
    json: bool,

    /// List what the formats of scenes and images have and is not shown
    #[arg(long, conflicts_with_all = ["scene", "adapter"])]
    formats: bool,

    /// Part of an adapter's name or driver, its index, or cpu; as `render` takes it
    #[arg(long, value_name = "NAME|INDEX")]
    adapter: Option<String>,
}

/// Prints what there is. That there is no adapter is part of the answer and no error, unless
/// one was asked for by name.
///
/// # Errors
/// The scene cannot be read, or the adapter asked for is not there.
pub fn run(args: &InfoArgs) -> Result<(), Error> {
    if args.formats {
        return print(&formats::text(args.json));
    }
    let scene = args.scene.as_deref().map(Scene::load).transpose()?;
    let choice = adapter_choice(args.adapter.as_deref());
    let opened = Gpu::open(&choice);
    let (gpu, error) = match opened {
        Ok(gpu) => (Some(gpu), None),
        Err(error) if args.adapter.is_some() => return Err(error.into()),
        Err(error) => (None, Some(error.to_string())),
    };
    // Without an adapter, what most have.
    let subgroups = gpu.as_ref().is_none_or(Gpu::has_subgroups);
    let info = Info {
        version: env!("CARGO_PKG_VERSION"),
        adapters: gpu::adapters(),
        chosen: gpu.as_ref().map(|gpu| gpu.info.clone()),
        chosen_error: error,
        builtin_scenes: BUILTIN_SCENES
            .iter()
            .map(|&(name, what)| Builtin { name: format!("builtin:{name}"), what })
            .collect(),
        scene: scene.map(|scene| scene::describe(scene, subgroups)),
    };
    let text = if args.json {
        serde_json::to_string_pretty(&info).unwrap_or_default() + "\n"
    } else {
        in_words(&info)
    };
    print(&text)
}

fn print(text: &str) -> Result<(), Error> {
    console::print(text).map_err(|error| {
        OutputError::Write { file: "standard output".into(), why: error.to_string() }.into()
    })
}

fn in_words(info: &Info) -> String {
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = match &info.scene {
        None => adapters::in_words(&mut text, info),
        Some(scene) => writeln!(text, "gpu-vpl {}\n", info.version)
            .and_then(|()| adapters::chosen_in_words(&mut text, info))
            .and_then(|()| scene::in_words(&mut text, scene)),
    };
    text
}
