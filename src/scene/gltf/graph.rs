//! The nodes of the scene that is shown, and where they put things.

use glam::{DAffine3, DMat4, DQuat, DVec3};

use super::json::Node;
use super::source::Source;
use crate::scene::SceneError;
use crate::scene::mesh::affine;

/// The nodes of the default scene, of the first if none is, or all if there are no scenes;
/// parents before their children, with their transforms to the scene.
pub fn nodes(source: &Source) -> Result<Vec<(usize, DAffine3)>, SceneError> {
    let document = &source.document;
    let is_child = children(source)?;
    check_cycles(source, &is_child)?;
    let roots = match (document.scene, document.scenes.first()) {
        (Some(scene), _) => source.item(&document.scenes, "scene", scene)?.nodes.clone(),
        (None, Some(scene)) => scene.nodes.clone(),
        (None, None) => roots(&is_child).collect(),
    };
    check_roots(source, &roots, &is_child)?;
    let mut nodes = Vec::new();
    // A stack of its own: a file may nest nodes deeper than the thread's.
    let mut waiting: Vec<_> = roots.iter().rev().map(|&root| (root, DAffine3::IDENTITY)).collect();
    while let Some((index, parent)) = waiting.pop() {
        let node = source.item(&document.nodes, "node", index)?;
        let transform = parent * local(source, index, node)?;
        waiting.extend(node.children.iter().rev().map(|&child| (child, transform)));
        nodes.push((index, transform));
    }
    Ok(nodes)
}

fn roots(is_child: &[bool]) -> impl Iterator<Item = usize> + '_ {
    (0..).zip(is_child).filter_map(|(index, is_child)| (!is_child).then_some(index))
}

/// Which nodes have a parent. None may have two.
fn children(source: &Source) -> Result<Vec<bool>, SceneError> {
    let nodes = &source.document.nodes;
    let mut is_child = vec![false; nodes.len()];
    for &child in nodes.iter().flat_map(|node| &node.children) {
        source.item(nodes, "node", child)?;
        if is_child[child] {
            return Err(source.fault(format!("node {child} has two parents; export it again")));
        }
        is_child[child] = true;
    }
    Ok(is_child)
}

/// With at most one parent each, the nodes that no root leads to form cycles.
fn check_cycles(source: &Source, is_child: &[bool]) -> Result<(), SceneError> {
    let nodes = &source.document.nodes;
    let mut waiting: Vec<usize> = roots(is_child).collect();
    let mut reached = 0;
    while let Some(index) = waiting.pop() {
        reached += 1;
        waiting.extend(&nodes[index].children);
    }
    match reached == nodes.len() {
        true => Ok(()),
        false => Err(source.fault("nodes are their own ancestors; export it again")),
    }
}

/// A scene names roots, and each but once.
fn check_roots(source: &Source, roots: &[usize], is_child: &[bool]) -> Result<(), SceneError> {
    let mut named = vec![false; is_child.len()];
    for &root in roots {
        source.item(&source.document.nodes, "node", root)?;
        if is_child[root] || named[root] {
            return Err(source.fault(format!(
                "the scene names node {root}, which is another's child or named twice; \
                 export it again"
            )));
        }
        named[root] = true;
    }
    Ok(())
}

/// A node's transform to its parent: a matrix, or scale, rotation, translation.
fn local(source: &Source, index: usize, node: &Node) -> Result<DAffine3, SceneError> {
    let fault = |what: &str| source.fault(format!("node {index}: {what}; export it again"));
    if let Some(matrix) = &node.matrix {
        return affine(DMat4::from_cols_array(matrix))
            .ok_or_else(|| fault("its matrix is no affine map (the last row is not 0, 0, 0, 1)"));
    }
    let rotation = DQuat::from_array(node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]));
    let length = rotation.length();
    if !(length.is_normal() && (rotation / length).is_finite()) {
        return Err(fault("its rotation is no quaternion of length 1"));
    }
    Ok(DAffine3::from_scale_rotation_translation(
        node.scale.map_or(DVec3::ONE, DVec3::from_array),
        rotation / length,
        node.translation.map_or(DVec3::ZERO, DVec3::from_array),
    ))
}
