//! No input panics, and every refusal is one line.

use proptest::prelude::*;

use super::{MESH, MTL, load};

const TOML: &str = include_str!("../../scenes/blocks.toml");
const CUBE: &str = include_str!("../../scenes/cube.obj");

/// Loads and looks only at the shape of the message.
fn survives(files: &[(&str, &str)]) {
    if let Err(error) = load(files) {
        assert!(!error.to_string().contains('\n'), "{error}");
    }
}

/// A text with some of its characters replaced, doubled or cut.
fn mutated(text: &'static str) -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        any::<char>().prop_map(String::from),
        "[-0-9.e/# \\[\\]\"]{0,4}",
        Just("nan".to_owned()),
        Just("1e308".to_owned()),
        Just("-9223372036854775808".to_owned()),
        Just("\n".to_owned()),
        Just(String::new()),
    ];
    prop::collection::vec((0..text.len(), 0..4usize, piece), 1..6).prop_map(move |edits| {
        let mut characters: Vec<char> = text.chars().collect();
        for (at, length, piece) in edits {
            let at = at % characters.len();
            let end = (at + length).min(characters.len());
            characters.splice(at..end, piece.chars());
            if characters.is_empty() {
                break;
            }
        }
        characters.into_iter().collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    #[test]
    fn random_text(text in any::<String>()) {
        survives(&[("mesh.obj", &text)]);
        survives(&[("scene.toml", &text)]);
        survives(&[("mesh.obj", MESH), ("mesh.mtl", &text)]);
    }

    #[test]
    fn random_statements(text in "((v|f|l|vt|usemtl|mtllib|o)( -?[0-9]{1,3}(/-?[0-9]?){0,2}){0,7}\\\\?\n){0,30}") {
        survives(&[("mesh.obj", &text)]);
    }

    #[test]
    fn mutated_mesh(text in mutated(MESH)) {
        survives(&[("mesh.obj", &text), ("mesh.mtl", MTL)]);
    }

    #[test]
    fn mutated_materials(text in mutated(MTL)) {
        survives(&[("mesh.obj", MESH), ("mesh.mtl", &text)]);
    }

    #[test]
    fn mutated_scene(text in mutated(TOML)) {
        survives(&[("scene.toml", &text), ("cube.obj", CUBE)]);
    }

    #[test]
    fn random_polygons(corners in prop::collection::vec((-3i8..3, -3i8..3, -1i8..1), 3..12)) {
        let mut text: String = corners.iter().map(|(x, y, z)| format!("v {x} {y} {z}\n")).collect();
        text += "f";
        (1..=corners.len()).for_each(|i| text += &format!(" {i}"));
        survives(&[("mesh.obj", &text)]);
    }
}
