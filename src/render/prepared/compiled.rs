//! The kernels that frames have needed so far.

use std::sync::{Arc, Mutex, PoisonError};

use crate::gpu::{Gpu, GpuError, Kernel, Program};
use crate::render::kernels::features_without;

/// The kernels compiled so far.
#[derive(Debug, Default)]
pub struct CompiledKernels(Mutex<Vec<(Program, Arc<Kernel>)>>);

impl CompiledKernels {
    /// The kernel of a program, compiled at most once.
    ///
    /// # Errors
    /// The device refuses it.
    pub fn get(&self, gpu: &Gpu, program: Program) -> Result<Arc<Kernel>, GpuError> {
        let mut kernels = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, kernel)) = kernels.iter().find(|(known, _)| *known == program) {
            return Ok(kernel.clone());
        }
        let kernel = Arc::new(gpu.compile(&program)?);
        kernels.push((program, kernel.clone()));
        Ok(kernel)
    }

    /// Features that no module linked so far serves.
    pub fn left_out(&self) -> Vec<&'static str> {
        let kernels = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        features_without(kernels.iter().map(|(program, _)| program))
    }
}
