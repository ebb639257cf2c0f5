//! What to render, and how well.

mod check;
mod clustering;

pub use clustering::{Clustering, Merge, Representative};

/// What the image shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Emission, direct light, and indirect light from every VPL.
    Vpl,
    /// The same from clusters of VPLs.
    Vplc,
    /// The same with visibility shared by clusters of visible points.
    Vpc,
    /// Clusters of both.
    #[default]
    Both,
    /// All light, by paths from the camera: the reference for the others.
    Path,
    /// Emission and direct light.
    Direct,
    /// The geometric normal that faces the camera, in world space.
    Normal,
    /// The distance from the camera, in the scene file's units; 0 where nothing is hit.
    Depth,
    /// The surface's reflectance.
    Albedo,
    /// Clusters of visible points in random colours, their representatives as green dots.
    PointClusters,
    /// VPLs as small blue dots over the directly lit scene.
    VplMap,
    /// Clusters of VPLs as large blue dots over the directly lit scene.
    VplClustersMap,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Vpl,
        Self::Vplc,
        Self::Vpc,
        Self::Both,
        Self::Path,
        Self::Direct,
        Self::Normal,
        Self::Depth,
        Self::Albedo,
        Self::PointClusters,
        Self::VplMap,
        Self::VplClustersMap,
    ];

    /// The name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Vpl => "vpl",
            Self::Vplc => "vplc",
            Self::Vpc => "vpc",
            Self::Both => "both",
            Self::Path => "path",
            Self::Direct => "direct",
            Self::Normal => "normal",
            Self::Depth => "depth",
            Self::Albedo => "albedo",
            Self::PointClusters => "point-clusters",
            Self::VplMap => "vpl-map",
            Self::VplClustersMap => "vpl-clusters-map",
        }
    }

    /// Whether light is computed at all.
    pub fn is_lit(self) -> bool {
        self.is_indirect()
            || matches!(self, Self::Path | Self::Direct | Self::VplMap | Self::VplClustersMap)
    }

    /// Whether light paths are traced.
    pub fn traces_paths(self) -> bool {
        self.is_indirect() || matches!(self, Self::VplMap | Self::VplClustersMap)
    }

    /// Whether VPLs light the picture.
    pub fn is_indirect(self) -> bool {
        matches!(self, Self::Vpl | Self::Vplc | Self::Vpc | Self::Both)
    }

    /// Whether clusters of visible points share visibility.
    pub fn clusters_points(self) -> bool {
        matches!(self, Self::Vpc | Self::Both | Self::PointClusters)
    }

    /// Whether VPLs are clustered.
    pub fn clusters_vpls(self) -> bool {
        matches!(self, Self::Vplc | Self::Both | Self::VplClustersMap)
    }
}

/// How many indirect bounces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bounces {
    /// Just so many.
    Finite(u32),
    /// As many as Russian roulette lets live.
    Unlimited,
}

/// What becomes of the light that comes straight from its source.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Direct {
    /// Shadow rays from every visible point.
    #[default]
    PerPixel,
    /// Visibility shared by clusters of visible points, as in the thesis: that of point lights and
    /// of places on area lights. Spots, directional lights and the environment have shadow rays
    /// from every visible point all the same.
    Clustered,
    /// Left out; emission towards the camera stays.
    Off,
}

/// The bound on the geometry term G between a visible point and a VPL.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Clamp {
    /// From the density of the VPLs.
    #[default]
    Auto,
    /// Given, in 1/length² of the scene file's units.
    At(f64),
    /// None.
    Off,
}

/// Whose row of the bit matrix a point reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sharing {
    /// Its own.
    Own,
    /// That of its cluster.
    Cluster,
    /// Those of the nearest clusters, weighted.
    Fuzzy,
}

/// All that a frame depends on beside scene, camera and seed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// What to show.
    pub method: Method,
    /// Light paths N; with candidates, VPLs that are gathered.
    pub light_paths: u32,
    /// Light paths go on until they have left so many candidates for each VPL that is gathered, of which
    /// those are kept that the image needs; 1 is none: N light paths, and all that they leave.
    pub candidates: u32,
    /// Indirect bounces B.
    pub bounces: Bounces,
    /// Direct light.
    pub direct: Direct,
    /// Shadow rays from each visible point to all lights that have some extent, and to those without
    /// if they are more than 8 and the rays few ([`Settings::few_light_samples`]); `None` chooses: 4 a
    /// pixel where they are combined over pixels, and up to 16 where few pixels are alike; 16 where
    /// they are not. Glossy surfaces take as many rays by their lobes. With clusters, from each
    /// cluster: 256. Paths have one.
    pub light_samples: Option<u32>,
    /// Whether light samples are combined over pixels that see the same surface.
    pub direct_filter: bool,
    /// Bound on G.
    pub clamp: Clamp,
    /// Whether what the bound removes is given back by short paths (Kollig and Keller 2004).
    pub compensate: bool,
    /// Shadow rays of each visible point that correct what it shares of the visibility of VPLs; 0 is none.
    pub correct: u32,
    /// Samples (visible points) per pixel; paths, where there are paths.
    pub samples: u32,
    /// Camera rays over all samples of a pixel around which surfaces of unlike radiance meet; others
    /// have four, or as many if that is fewer. Each takes the light of a visible point around on its
    /// surface; emission and background are its own. 1 is none but the samples themselves.
    pub edge_samples: u32,
    /// How visible points and VPLs are clustered, where the method does so.
    pub clustering: Clustering,
    /// A pixel gathers one of s² subsets of the VPLs, up to [`Settings::MOST_INTERLEAVE`]²; 1 is
    /// all.
    pub interleave: u32,
    /// What the scene does not need is linked, too: for measuring what leaving it out saves. A
    /// scene is prepared with or without it, whatever frames say.
    pub link_everything: bool,
}

/// Why settings are refused: one line that names the setting as the command line does.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct SettingsError(String);

impl SettingsError {
    /// With this reason.
    pub(super) fn new(why: String) -> Self {
        Self(why)
    }
}

impl Default for Settings {
    /// Those of [`Method::Both`].
    fn default() -> Self {
        Self::of(Method::default())
    }
}

impl Settings {
    /// The defaults with a method. Interleaving goes with clusters of visible points: without
    /// them, methods stay what they are in the literature.
    ///
    /// Measured with [`Method::Both`]: RMSE of the indirect light against a path tracer's, and
    /// seconds of a frame, Cornell box lit from above and one lit upwards, 512², B = 2:
    ///
    /// | paths | merge | K_v | s | above | | upwards | |
    /// | --- | --- | --- | --- | --- | --- | --- | --- |
    /// | 2000 | light | 400 | 1 | .0043 | 0.35 s | .0069 | 0.35 s |
    /// | 2000 | light | 4000 | 4 | .0028 | 0.50 s | .0039 | 0.64 s |
    /// | 8000 | light | 1000 | 4 | .0031 | 0.41 s | .0054 | 0.40 s |
    /// | 2000 | visibility | 1000 | 1 | .0031 | 0.88 s | .0045 | 0.98 s |
    /// | 2000 | visibility | 1000 | 2 | .0030 | 0.52 s | .0042 | 0.54 s |
    /// | 2000 | visibility | 1000 | 4 | .0028 | 0.42 s | .0039 | 0.43 s |
    /// | 8000 | visibility | 1000 | 1 | .0022 | 2.67 s | .0035 | 3.02 s |
    /// | 8000 | visibility | 1000 | 2 | .0020 | 1.03 s | .0032 | 1.13 s |
    /// | 8000 | visibility | 1000 | 4 | .0019 | 0.62 s | .0030 | 0.64 s |
    /// | 8000 | visibility | 1000 | 8 | .0020 | 0.56 s | .0030 | 0.57 s |
    /// | 16000 | visibility | 1000 | 4 | .0016 | 0.87 s | .0025 | 0.94 s |
    /// | 60000 | visibility | 1000 | 4 | .0012 | 2.27 s | .0022 | 2.56 s |
    ///
    /// Of VPLs that are chosen, shared by 1000 clusters of which rows draw members, with unlimited bounces
    /// (relMSE of the whole image and seconds of a frame, one seed, two cores of another machine): an office
    /// behind a door that is ajar, a classroom, a hall with lamps:
    ///
    /// | VPLs | candidates | s | office | | classroom | | hall | |
    /// | --- | --- | --- | --- | --- | --- | --- | --- | --- |
    /// | 8000 | 8 | 4 | .0479 | 1.76 s | .0166 | 5.04 s | .0028 | 2.83 s |
    /// | 16000 | 4 | 4 | .0335 | 2.22 s | .0153 | 4.97 s | .0022 | 3.63 s |
    /// | 16000 | 4 | 8 | .0484 | 1.79 s | .0176 | 4.65 s | .0026 | 3.16 s |
    /// | 32000 | 4 | 8 | .0214 | 2.09 s | .0156 | 5.31 s | .0025 | 3.40 s |
    pub fn of(method: Method) -> Self {
        Self::of_vpls(method, if method.clusters_points() { 32_000 } else { 8000 })
    }

    /// The defaults with a method and a number of VPLs: of many, pixels gather smaller subsets, and fewer
    /// candidates do.
    pub fn of_vpls(method: Method, light_paths: u32) -> Self {
        /// Between 16,000, which as 64 subsets are noisier than as 16, and 32,000.
        const MANY: u32 = 24_000;
        let (candidates, interleave) = match method.clusters_points() {
            false => (1, 1),
            true if light_paths < MANY => (8, 4),
            true => (4, 8),
        };
        Self {
            method,
            light_paths,
            candidates,
            bounces: Bounces::Finite(2),
            direct: Direct::PerPixel,
            light_samples: None,
            direct_filter: true,
            clamp: Clamp::Auto,
            compensate: false,
            correct: 0,
            samples: if method == Method::Path { 16 } else { 1 },
            edge_samples: 16,
            clustering: Clustering::default(),
            interleave,
            link_everything: false,
        }
    }
}

impl Settings {
    /// Candidates for a VPL, at most.
    pub const MOST_CANDIDATES: u32 = 64;
    /// Rays that correct what a visible point shares, at most.
    pub const MOST_CORRECTIONS: u32 = 256;
    /// A pixel combines with those up to one block of 8 × 8 away.
    pub const MOST_INTERLEAVE: u32 = 8;

    /// Whether there is indirect light to gather.
    pub fn traces_light_paths(&self) -> bool {
        self.method.is_indirect() && self.bounces != Bounces::Finite(0)
    }

    /// Whether VPLs are chosen among candidates.
    pub fn chooses_vpls(&self) -> bool {
        self.traces_light_paths() && self.candidates > 1
    }

    /// Whether there is something to give back of what the bound on G removes.
    pub fn compensates(&self) -> bool {
        self.compensate && self.traces_light_paths() && self.clamp != Clamp::Off
    }

    /// Whether shared visibility is corrected.
    pub fn corrects(&self) -> bool {
        let shares = self.method.clusters_points() || self.shares_columns();
        self.correct > 0 && self.traces_light_paths() && shares
    }

    /// Whether little time and noise give back what the bound on G removes: pixels combine it, and
    /// the bound is the one that suits it.
    pub fn compensates_cheaply(&self) -> bool {
        self.interleaves() && self.clamp == Clamp::Auto
    }

    /// Whether what is given back is combined over pixels.
    pub fn filters_compensation(&self) -> bool {
        self.compensates() && self.interleaves()
    }

    /// Whether VPLs share the visibility of their cluster.
    pub fn shares_columns(&self) -> bool {
        self.method.clusters_vpls() && self.clustering.merge == Merge::Visibility
    }

    /// Whether each cluster of visible points draws the member whose visibility it takes.
    pub fn draws_members(&self) -> bool {
        let drawn = self.clustering.representative == Representative::Drawn;
        drawn && self.shares_columns() && self.method.clusters_points()
    }

    /// Whether clusters of visible points share what they see of clusters of VPLs.
    pub fn shares_sights(&self) -> bool {
        self.shares_columns() && self.method.clusters_points()
    }

    /// Whether pixels are antialiased by more camera rays than the samples.
    pub fn antialiases(&self) -> bool {
        let few = self.edge_samples > self.samples;
        self.method.is_lit() && self.method != Method::Path && few
    }

    /// Whether the visibility of visible points is probed.
    pub fn probes(&self) -> bool {
        self.method.clusters_points() && self.traces_light_paths() && self.clustering.probes > 0
    }

    /// Whether pixels gather subsets of the VPLs.
    pub fn interleaves(&self) -> bool {
        self.method.is_indirect() && self.interleave > 1
    }

    /// Whose visibility a visible point uses.
    pub fn sharing(&self) -> Sharing {
        match self.clustering.fuzzy {
            _ if !self.method.clusters_points() => Sharing::Own,
            1 => Sharing::Cluster,
            _ => Sharing::Fuzzy,
        }
    }

    /// Places on the area lights whose visibility clusters share. All points see the same
    /// places, so that shadows have as many steps.
    pub fn shared_light_samples(&self) -> u32 {
        self.light_samples.unwrap_or(256)
    }

    /// Whether light samples are few, so that they are guided, and combined over pixels. Many are
    /// stratified over all lights better than a guide draws them, and leave little noise.
    pub fn few_light_samples(&self) -> bool {
        const MANY: u32 = 64;
        self.light_samples_per_point().saturating_mul(self.samples) < MANY
    }

    /// Whether light samples are combined over pixels. Not where a pixel has so many visible points
    /// that each takes one: there is nothing to tell its noise by.
    pub fn filters_direct(&self) -> bool {
        let samples = self.method.is_lit() && self.method != Method::Path;
        let lit = samples && self.direct != Direct::Off;
        lit && self.direct_filter && self.few_light_samples() && self.light_samples_per_point() > 1
    }

    /// Whether visible points take numbers of light samples of their own.
    pub fn counts_light_samples(&self) -> bool {
        self.filters_direct() && self.light_samples.is_none()
    }

    /// Shadow rays from each visible point to the lights that have some extent.
    pub fn light_samples_per_point(&self) -> u32 {
        /// A pixel gets so many over all its samples, unless the user says otherwise: if they are
        /// combined with those of the pixels around, or not.
        const COMBINED: u32 = 4;
        const PER_PIXEL: u32 = 16;
        match self.light_samples {
            Some(count) => count.max(1),
            None if self.direct_filter && self.samples <= PER_PIXEL => {
                COMBINED.div_ceil(self.samples).max(2)
            }
            None => PER_PIXEL.div_ceil(self.samples),
        }
    }
}
