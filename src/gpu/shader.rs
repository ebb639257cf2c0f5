//! Shaders as ordered lists of WGSL files. What a scene does not need is not in the list.

use std::sync::Arc;

use naga::valid::{Capabilities, ValidationFlags, Validator};

use super::GpuError;

/// One WGSL file.
#[derive(Debug, PartialEq, Eq)]
pub struct Module {
    /// Its folder in `shaders/` and its name there, without the ending.
    pub name: &'static str,
    /// Its text.
    pub source: &'static str,
    /// The feature of a scene or of the settings without which it is left out.
    pub feature: Option<&'static str>,
}

/// The files of a kernel, in order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Program {
    /// The kernel's name in reports and debuggers.
    pub label: &'static str,
    /// Its files; the last has the entry point `main`.
    pub modules: Vec<&'static Module>,
    /// What is written for one scene, and follows the files.
    pub generated: Option<Arc<str>>,
}

/// A program that has been parsed and validated.
#[derive(Debug)]
pub struct Linked {
    /// The whole source.
    pub source: String,
    /// naga's form of it.
    pub module: naga::Module,
    /// Name and binding of each resource that the entry point uses, all of group 0.
    pub bindings: Vec<(String, u32)>,
}

impl Program {
    /// Of files, each of which is linked once, where it first stands.
    pub fn new(label: &'static str, modules: Vec<&'static Module>) -> Self {
        let mut once: Vec<&'static Module> = Vec::with_capacity(modules.len());
        for module in modules {
            if !once.contains(&module) {
                once.push(module);
            }
        }
        Self { label, modules: once, generated: None }
    }

    /// Joins the files, parses and validates them, and finds what they bind.
    ///
    /// # Errors
    /// A file does not parse, or the whole is not valid: a fault of this program, named with
    /// file and line.
    pub fn link(&self) -> Result<Linked, GpuError> {
        let files = self.modules.iter().map(|module| module.source);
        let source = files.chain(self.generated.as_deref()).collect::<Vec<_>>().join("\n");
        let module = naga::front::wgsl::parse_str(&source).map_err(|error| {
            let line = error.location(&source).map_or(0, |l| l.line_number as usize);
            GpuError::Invalid(format!("{}: {}", self.place(line), error.message()))
        })?;
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::SUBGROUP);
        let info = validator.validate(&module).map_err(|error| {
            let line = error.location(&source).map_or(0, |l| l.line_number as usize);
            GpuError::Invalid(format!("{}: {:?}", self.place(line), error.into_inner()))
        })?;
        let entry = info.get_entry_point(0);
        let bindings = module
            .global_variables
            .iter()
            .filter(|(handle, _)| !entry[*handle].is_empty())
            .filter_map(|(_, global)| Some((global.name.clone()?, global.binding?.binding)))
            .collect();
        Ok(Linked { source, module, bindings })
    }

    /// File and line of a line of the joined source.
    fn place(&self, mut line: usize) -> String {
        for module in &self.modules {
            let lines = module.source.matches('\n').count() + 1;
            if line <= lines {
                return format!("{}.wgsl:{line}", module.name);
            }
            line -= lines;
        }
        format!("{}, generated:{line}", self.label)
    }
}
