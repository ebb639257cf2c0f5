//! The device: adapter choice, limits, buffers, kernels and passes. Knows nothing of scenes.

mod adapter;
mod buffer;
mod device;
mod error;
mod kernel;
mod layout;
mod pass;
mod shader;
mod timer;

pub use adapter::{AdapterChoice, AdapterDescription, AdapterInfo, adapters};
pub use device::Gpu;
pub use error::GpuError;
pub use kernel::{Bindings, Kernel};
pub use layout::{
    AreaLightRecord, ArrivalRecord, CameraParams, CompensatedParams, DirectParams,
    DirectionalLightRecord, ExpandParams, FinishRecord, GlossyVplRecord, InterleaveParams,
    MaterialRecord, NodeRecord, PathParams, PathRecord, PathSum, PointLightRecord, PointRecord,
    ShadeParams, SphereLightRecord, SpotLightRecord, StartParams, TextureRecord, TriangleRecord,
    VisibilityParams, VplRecord,
};
pub use pass::Pass;
pub use shader::{Linked, Module, Program};
pub use timer::PassTime;
