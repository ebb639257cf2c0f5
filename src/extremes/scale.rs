//! How large cases are.

/// How large cases are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// For tests: seconds in all.
    Small,
    /// For publication.
    Full,
}
