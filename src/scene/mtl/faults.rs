//! What a material of MTL says that is not shown.

/// What a reading of a material found fault with.
#[derive(Debug, Default)]
pub struct Faults {
    pub changes: Vec<String>,
    pub notes: Vec<String>,
}
