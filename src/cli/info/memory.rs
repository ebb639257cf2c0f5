//! What a scene takes on the device and on the host.

use std::fmt::{Result, Write};

use serde::Serialize;

use super::table::{self, Column};
use crate::render::Plan;

/// Bytes, before those of a frame: points, VPLs, clusters and visibility.
#[derive(Debug, Serialize)]
pub struct Memory {
    device: Vec<TableInfo>,
    device_bytes: u64,
    /// Scene and hierarchy.
    host_bytes: u64,
}

#[derive(Debug, Serialize)]
struct TableInfo {
    table: &'static str,
    bytes: u64,
}

/// What a scene takes.
pub fn of(plan: &Plan) -> Memory {
    let tables = plan.tables().into_iter();
    let device: Vec<_> = tables.map(|(table, bytes)| TableInfo { table, bytes }).collect();
    Memory {
        device_bytes: device.iter().map(|table| table.bytes).sum(),
        device,
        host_bytes: host(plan),
    }
}

fn host(plan: &Plan) -> u64 {
    let (scene, bvh) = (&plan.scene, &plan.bvh);
    let sky = scene.environment.as_ref().and_then(|sky| sky.image.as_ref());
    let images: usize = scene.images.iter().map(|image| size_of_val(&image.rgba[..])).sum();
    let tables = [
        size_of_val(&scene.triangles[..]),
        size_of_val(&scene.uvs[..]),
        size_of_val(&scene.spheres[..]),
        size_of_val(&scene.materials[..]),
        size_of_val(&bvh.nodes[..]),
        size_of_val(&bvh.triangles[..]),
        plan.wide.as_ref().map_or(0, |wide| size_of_val(&wide.nodes[..])),
        sky.map_or(0, |image| size_of_val(&image.texels[..])),
        images,
    ];
    tables.into_iter().sum::<usize>() as u64
}

/// The memory as a table, the largest first.
pub fn in_words(text: &mut String, memory: &Memory) -> Result {
    let [device, host] = [memory.device_bytes, memory.host_bytes].map(table::bytes);
    writeln!(text, "\nmemory: {device} on the device, {host} on the host, before a frame's")?;
    let mut largest: Vec<_> = memory.device.iter().collect();
    largest.sort_by_key(|table| std::cmp::Reverse(table.bytes));
    let columns = [Column::Text("table"), Column::Number("memory")];
    let row = |info: &TableInfo| [info.table.to_owned(), table::bytes(info.bytes)];
    table::write(text, columns, largest.into_iter().map(row))
}
