//! How visible points and VPLs are clustered.

/// K-means of the visible points and of the VPLs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clustering {
    /// Clusters of visible points, C.
    pub points: u32,
    /// Clusters of VPLs, K_v.
    pub vpls: u32,
    /// Iterations over the points, at most.
    pub point_iterations: u32,
    /// Iterations over the VPLs, at most.
    pub vpl_iterations: u32,
    /// A point or VPL may join a cluster if the cosine of their normals is above this.
    pub normal_threshold: f32,
    /// Middle iterations over the points see one in so many.
    pub stride: u32,
    /// Nearest clusters that share a point's visibility, up to [`Clustering::MOST_FUZZY`]; 1 is
    /// hard clustering.
    pub fuzzy: u32,
    /// VPLs, up to [`Clustering::MOST_PROBES`], to which every visible point traces a shadow ray,
    /// which tells where it sees others than its cluster does; 0 is none.
    pub probes: u32,
    /// What stands for a cluster of VPLs.
    pub representative: Representative,
    /// What a cluster of VPLs shares.
    pub merge: Merge,
}

/// What a cluster of VPLs shares.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Merge {
    /// One light stands for all members, as in the thesis.
    Light,
    /// Visibility alone: every VPL is gathered.
    #[default]
    Visibility,
}

/// What stands for a cluster of VPLs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Representative {
    /// The mean of its members' positions and normals, as in the thesis.
    Mean,
    /// The member nearest to the mean.
    Member,
    /// For each cluster of visible points a member of its own, drawn in proportion to what each
    /// would give it if nothing were between, so that no light is lost in the mean. Where light is
    /// merged, or points are not in clusters, the member nearest to the mean.
    #[default]
    Drawn,
}

impl Clustering {
    /// The rows that the shading kernel blends, at most.
    pub const MOST_FUZZY: u32 = 4;
    /// Bits of a signature.
    pub const MOST_PROBES: u32 = 8;
}

impl Default for Clustering {
    /// Chosen by error at equal time. Clustering error: nRMSE of the indirect light against
    /// [`Method::Vpl`](super::Method::Vpl) with the same VPLs, Cornell box lit from above, 512², 2000 paths, B = 2,
    /// no interleaving, and pT + rT on two cores without a GPU:
    ///
    /// | C | hard | fuzzy 4 | hard, 8 probes | fuzzy 4, 8 probes | seconds, first and last |
    /// | --- | --- | --- | --- | --- | --- |
    /// | 500 | 9.9 % | 6.9 % | 2.8 % | 2.0 % | 0.54, 0.79 |
    /// | 1000 | 4.2 % | 3.1 % | 2.2 % | 1.3 % | 0.57, 0.79 |
    /// | 2000 | 1.7 % | 1.2 % | 2.3 % | 1.8 % | 0.63, 0.83 |
    /// | 4000 | 3.7 % | 2.6 % | 1.2 % | 0.84 % | 0.70, 0.94 |
    /// | 8000 | 3.3 % | 2.2 % | 0.90 % | 0.59 % | 0.98, 1.08 |
    ///
    /// Without probes a strip of a few pixels behind the lamp decides: whether it has a cluster
    /// is chance. With them C = 2600 has 0.96 %, with 2 and 3 shared clusters 1.06 and 0.99 %.
    /// Merging VPLs at C = 2600: one light for each of 400 clusters 13 %, of 2000 2.7 % (the
    /// mean) and 3.6 % (a member); visibility alone of 400 1.2 %, of 1000 1.2 %, of 2000 1.0 %,
    /// with either. More than 4 iterations over the points gain nothing above chance; a stride
    /// of 2, 4 or 8 saves 14, 23 or 28 ms of 52 ms.
    ///
    /// Of 8000 VPLs chosen among 64,000 (unlimited bounces, without compensation) 1000, 2000 and 4000
    /// clusters leave, in an office behind a door that is ajar (320 × 180, means of three seeds), a relMSE
    /// of .052, .036 and .038, 14, 7 and 1 % too little light, and take 0.14, 0.23 and 0.39 s; in a
    /// classroom (two seeds) .022, .021 and .020.
    ///
    /// A member that each row draws ([`Representative::Drawn`]) takes that loss away. Half size, two seeds,
    /// relMSE of the difference to [`Method::Vpc`](super::Method::Vpc) with the same VPLs, and seconds of
    /// visibility: the office with 250, 500 and 1000 clusters .010, .0049 and .0021 in 0.14, 0.21 and
    /// 0.27 s (one member: .040 with 1000, .018 with 2000 in 0.18 s), the classroom .0028, .0016 and
    /// .0013 in 0.49, 0.71 and 1.09 s (one member: .0051 and .0047, 1.10 s). With 500 the draws are seen
    /// as blotches in the office.
    ///
    /// The built-in room, of small and curved surfaces, in the columns of the table: C = 500
    /// 20, 18, 15 and 14 %; C = 2000 13, 12, 11 and 10 %; C = 8000 8.5, 7.4, 7.7 and 6.6 %.
    /// Visibility of 1000 clusters of VPLs: 10 % with members, 19 % with means before those
    /// were lifted to the surfaces. Thresholds of the normals of 0.7, 0.9 and 0.97: 9.3, 9.0 and 10.9 %.
    fn default() -> Self {
        Self {
            points: 2600,
            vpls: 1000,
            point_iterations: 4,
            vpl_iterations: 2,
            normal_threshold: 0.9,
            stride: 4,
            fuzzy: 4,
            probes: 8,
            representative: Representative::default(),
            merge: Merge::default(),
        }
    }
}
