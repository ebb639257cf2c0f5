//! What all formats have and we do not show, in one list. The scene file's own is empty: an unknown key is
//! an error.

use super::omission::Omission;
use super::{environment, gltf, mtl, obj, texture};

/// Each row of the lists that the readers warn by.
pub fn omissions() -> impl Iterator<Item = &'static Omission> {
    let lists: [&[Omission]; 5] = [
        &obj::OMITTED,
        &mtl::omitted::OMITTED,
        &gltf::omitted::OMITTED,
        &texture::omitted::OMITTED,
        &environment::omitted::OMITTED,
    ];
    lists.into_iter().flatten()
}
