//! The device: adapter choice, limits, buffers, kernels and dispatches. Knows nothing of scenes.

mod adapter;
mod buffer;
mod device;
mod dispatch;
mod error;
mod kernel;
mod layout;
mod shader;
mod texture;
mod timer;

pub use adapter::{AdapterChoice, AdapterDescription, AdapterInfo, adapters};
pub use device::Gpu;
pub use dispatch::Dispatch;
pub use error::GpuError;
pub use kernel::{Bindings, Kernel};
pub use layout::{
    AreaLightRecord, ArrivalRecord, BsdfRecord, CameraParams, CompensatedParams, CorrectParams,
    DeltaLightRecord, DirectParams, DirectionalLightRecord, ExpandParams, FilterParams,
    GlossyVplRecord, GuideParams, InterleaveParams, LightStratumRecord, MaterialRecord, NodeRecord,
    PathParams, PathRecord, PathSum, PointLightRecord, PointRecord, ShadeParams, SphereLightRecord,
    SpotLightRecord, StartParams, TextureRecord, TriangleRecord, VisibilityParams, VplRecord,
};
pub use shader::{Linked, Module, Program};
pub use texture::{TableFormat, Texture};
pub use timer::DispatchTimes;
