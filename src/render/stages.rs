//! The stages of a frame: kernels with the buffers of a tile bound to them. What a frame does
//! not need is not there.

use std::sync::Arc;
use std::time::Duration;

use super::{Direct, Features, LightKind, Prepared, Settings, Target, kernels};
use crate::gpu::{Bindings, CameraParams, Gpu, GpuError, Kernel, Pass, PointRecord, Program};

/// A kernel with its buffers bound, and the buffer of its parameters.
#[derive(Debug)]
pub struct Stage {
    kernel: Arc<Kernel>,
    bindings: Bindings,
    params: wgpu::Buffer,
}

/// The buffers of a tile.
#[derive(Debug)]
pub struct Buffers {
    /// Radiance, summed over the samples; in w how many of them hit something.
    pub film: wgpu::Buffer,
    /// Visible points of one sample.
    pub points: wgpu::Buffer,
    /// What else is known of them.
    pub kept: Vec<Kept>,
    /// Irradiance of the kind of light being gathered.
    pub irradiance: Option<wgpu::Buffer>,
    /// What bias compensation gives back, where it goes another way than into `irradiance`.
    pub compensated: Option<wgpu::Buffer>,
    /// Radiance of the visible points of a sample, where edges are antialiased, or mirrors or glass
    /// may be in the way.
    pub radiance: Option<wgpu::Buffer>,
    /// Indirect radiance that was reflected and that the clamp removed.
    pub energy: Option<wgpu::Buffer>,
}

/// A buffer and the name by which shaders know it.
pub type Named<'a> = (&'a str, &'a wgpu::Buffer);

/// What the rays that find points keep of them beside their records: a name, and four numbers a
/// point.
pub type Kept = (&'static str, wgpu::Buffer);

/// What a scene's features ask to be kept of so many points.
///
/// # Errors
/// The device refuses.
pub fn keep(gpu: &Gpu, features: Features, points: usize) -> Result<Vec<Kept>, GpuError> {
    let names = [
        ("albedos", features.textures),
        ("glows", features.glows),
        ("throughputs", features.specular()),
    ];
    let asked = names.into_iter().filter(|(_, is)| *is);
    asked.map(|(name, _)| Ok((name, gpu.storage::<[f32; 4]>(name, points)?))).collect()
}

impl Buffers {
    fn new(
        prepared: &Prepared,
        points: usize,
        gathers: bool,
        clamps: bool,
        settings: &Settings,
        target: Target,
    ) -> Result<Self, GpuError> {
        let edges = settings.antialiases();
        let compensates = clamps && settings.compensates() && settings.interleaves();
        let specular = target.features.specular();
        let gpu = &prepared.gpu;
        let colours = |label: &str| gpu.storage::<[f32; 4]>(label, points);
        let gathered = |label: &str| gpu.storage::<[f32; 4]>(label, points * target.lobes());
        Ok(Self {
            film: colours("film")?,
            points: gpu.storage::<PointRecord>("visible points", points)?,
            kept: keep(gpu, target.features, points)?,
            irradiance: gathers.then(|| gathered("irradiance")).transpose()?,
            compensated: compensates.then(|| gathered("compensated irradiance")).transpose()?,
            radiance: (edges || specular).then(|| colours("radiance")).transpose()?,
            energy: clamps.then(|| gpu.storage::<[f32; 2]>("energy", points)).transpose()?,
        })
    }

    /// These and the scene's, by name.
    pub fn named<'a>(&'a self, prepared: &'a Prepared) -> Vec<Named<'a>> {
        let mut named = vec![("points", &self.points), ("film", &self.film)];
        named.extend(prepared.tables.iter().chain(&self.kept).map(|(name, of)| (*name, of)));
        named.extend(prepared.environment());
        named.extend(self.radiance.as_ref().map(|buffer| ("radiance", buffer)));
        named.extend(self.irradiance.as_ref().map(|buffer| ("irradiance", buffer)));
        named.extend(self.compensated.as_ref().map(|buffer| ("compensated", buffer)));
        named.extend(self.energy.as_ref().map(|buffer| ("energy", buffer)));
        named
    }
}

/// The stages of a frame but for those that gather indirect light.
#[derive(Debug)]
pub struct Stages {
    /// What they work on.
    pub buffers: Buffers,
    /// Camera rays.
    pub visible: Stage,
    /// More camera rays where pixels see edges.
    pub antialias: Option<Stage>,
    /// Radiance through mirrors and glass, where edges aren't antialiased.
    pub resolve: Option<Stage>,
    /// The picture of a method without light.
    pub show: Option<Stage>,
    /// Emission towards the camera, of surfaces and of the environment.
    pub emit: Vec<Stage>,
    /// Direct light, a stage for each kind of lights.
    pub direct: Vec<(LightKind, Stage)>,
    /// Irradiance to radiance.
    pub reflect: Option<Stage>,
    /// What the clamp removed.
    pub removed: Option<Stage>,
}

impl Stages {
    /// Allocates the buffers of a tile of at most so many points, and binds the kernels that a frame needs; `indirect`
    /// is whether there are VPLs, `clamps` whether they are bounded.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &Prepared,
        points: usize,
        settings: &Settings,
        indirect: bool,
        clamps: bool,
    ) -> Result<Self, GpuError> {
        let lit = settings.method.is_lit();
        let direct = lit && settings.direct != Direct::Off;
        let gathers = direct || indirect;
        let edges = settings.antialiases();
        let target = prepared.target_of(settings);
        let buffers = Buffers::new(prepared, points, gathers, clamps, settings, target)?;
        let on_film = buffers.named(prepared);
        // The first buffer of a name counts.
        let mut named = Vec::new();
        named.extend(buffers.radiance.as_ref().map(|radiance| ("film", radiance)));
        named.extend(&on_film);
        let bind = |program: Program| Stage::new(prepared, &program, &named);
        let when = |is: bool, program: Program| is.then(|| bind(program)).transpose();
        let with_lights = |(kind, table): &(LightKind, wgpu::Buffer)| {
            let named = [&named[..], &[("lights", table)]].concat();
            Ok((*kind, Stage::new(prepared, &kernels::direct_for(prepared, *kind), &named)?))
        };
        let lit = settings.method.is_lit();
        // Clusters share the visibility of lights that have places; the others are exact.
        let per_pixel = |kind: LightKind| {
            direct && !(settings.direct == Direct::Clustered && kind.has_places())
        };
        let tables = prepared.light_tables.iter().filter(|(kind, _)| per_pixel(*kind));
        Ok(Self {
            visible: Stage::new(prepared, &kernels::visible_points(target, lit), &on_film)?,
            antialias: edges
                .then(|| Stage::new(prepared, &kernels::antialias(target), &on_film))
                .transpose()?,
            resolve: (target.features.specular() && !edges)
                .then(|| Stage::new(prepared, &kernels::resolve(target), &on_film))
                .transpose()?,
            show: kernels::show(prepared.target(), settings.method).map(bind).transpose()?,
            emit: kernels::emitted(prepared)
                .into_iter()
                .filter(|_| lit)
                .map(bind)
                .collect::<Result<_, GpuError>>()?,
            direct: tables.map(with_lights).collect::<Result<_, GpuError>>()?,
            reflect: when(gathers, kernels::reflect(target))?,
            removed: when(clamps, kernels::removed(target, buffers.compensated.is_some()))?,
            buffers,
        })
    }
}

impl Stage {
    /// Binds buffers to the kernel of a program.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &Prepared,
        program: &Program,
        buffers: &[Named<'_>],
    ) -> Result<Self, GpuError> {
        let kernel = prepared.kernels.get(prepared, program.clone())?;
        // The largest of the parameter records; a kernel reads its own.
        let params = prepared.gpu.parameters::<CameraParams>("parameters")?;
        let buffers = [buffers, &[("params", &params)]].concat();
        let bindings = prepared.gpu.bind(&kernel, &buffers)?;
        Ok(Self { kernel, bindings, params })
    }

    /// Runs the stage over so many workgroups and waits for it.
    ///
    /// # Errors
    /// The device fails.
    pub fn run<P: bytemuck::Pod>(
        &self,
        prepared: &Prepared,
        params: &P,
        workgroups: [u32; 2],
    ) -> Result<Duration, GpuError> {
        if size_of::<P>() > 0 {
            prepared.gpu.write(&self.params, std::slice::from_ref(params))?;
        }
        let (kernel, bindings) = (&*self.kernel, &self.bindings);
        prepared.gpu.run(&[Pass { kernel, bindings, workgroups }])
    }
}
