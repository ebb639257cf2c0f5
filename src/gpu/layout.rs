//! The records that host and shaders share. A test holds each against naga's layout of the
//! WGSL struct of the same name.

mod lights;
mod params;
mod scene;

pub use lights::{
    AreaLightRecord, DeltaLightRecord, DirectionalLightRecord, GlossyVplRecord, LightStratumRecord,
    PointLightRecord, SphereLightRecord, SpotLightRecord, VplRecord,
};
pub use params::{
    ArrivalRecord, CameraParams, CompensatedParams, CorrectParams, DirectParams, ExpandParams,
    FilterParams, GuideParams, InterleaveParams, PathParams, PathRecord, PathSum, ShadeParams,
    StartParams, VisibilityParams,
};
pub use scene::{
    BsdfRecord, MaterialRecord, NodeRecord, PointRecord, TextureRecord, TriangleRecord,
};
