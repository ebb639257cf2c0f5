//! Which adapter is asked for.

use crate::gpu::AdapterChoice;

/// The adapter asked for: by option, else by the environment.
pub fn adapter_choice(option: Option<&str>) -> AdapterChoice {
    let variable = || std::env::var("WGPU_ADAPTER_NAME").ok();
    let named = option.map(str::to_owned).or_else(variable).filter(|name| !name.is_empty());
    named.map_or(AdapterChoice::Auto, AdapterChoice::Named)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_option_chooses_the_adapter() {
        assert_eq!(adapter_choice(Some("x")), AdapterChoice::Named("x".into()));
        assert_eq!(adapter_choice(Some("")), AdapterChoice::Auto);
    }
}
