//! Where the error of an image comes from: what is left of it when a part of its light is replaced
//! by the converged one, everything else staying what it is.

use serde::{Deserialize, Serialize};

use super::spread::Spread;

/// What is replaced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Part {
    /// Direct light by that of many shadow rays from the same visible points.
    Direct,
    /// All indirect light by the reference's: that less direct light converged over the pixel.
    Indirect,
    /// Visible points by many in a pixel, with the same light: edges, textures, shading.
    Antialiasing,
    /// What the bound on near VPLs took is given back, by short paths from many points of a pixel.
    Clamp,
    /// Visibility that clusters share by exact visibility from every visible point.
    Sharing,
    /// A subset of the VPLs at each pixel by all of them.
    Interleaving,
    /// What these VPLs would give without all that by what any number of them would.
    Vpls,
    /// All parts that have a frame of their own at once: what the VPLs' own spread leaves.
    All,
}

impl Part {
    /// All, in the order of tables.
    pub const ALL: [Self; 8] = [
        Self::Direct,
        Self::Indirect,
        Self::Antialiasing,
        Self::Clamp,
        Self::Sharing,
        Self::Interleaving,
        Self::Vpls,
        Self::All,
    ];

    /// The name in tables, and, in lower case, in the columns of the CSV.
    pub fn name(self) -> &'static str {
        match self {
            Self::Direct => "direct",
            Self::Indirect => "indirect",
            Self::Antialiasing => "antialiasing",
            Self::Clamp => "clamp",
            Self::Sharing => "sharing",
            Self::Interleaving => "interleaving",
            Self::Vpls => "vpls",
            Self::All => "all",
        }
    }

    /// Whether it is one of those into which the error is taken apart; the others hold several.
    pub fn is_single(self) -> bool {
        !matches!(self, Self::Indirect | Self::All)
    }

    /// Whether the noise of the reference is in what is left: not where the reference's own light
    /// stands in for the image's.
    fn leaves_reference_noise(self) -> bool {
        !matches!(self, Self::Indirect | Self::Vpls)
    }
}

/// An error that is left.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Left {
    /// As in [`crate::metrics::Metrics`].
    pub relmse: f64,
    /// As there.
    pub bias: f64,
}

/// An image with a part replaced.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Replaced {
    /// Which.
    pub part: Part,
    /// The error left.
    pub left: Left,
    /// The relMSE that the noise of the converged part gives a perfect image, at most.
    pub noise: f64,
}

/// The error of one image, taken apart.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Decomposition {
    /// That of the image itself.
    pub whole: Left,
    /// Those of the parts that the settings have.
    pub parts: Vec<Replaced>,
}

/// Errors taken apart, over the seeds. The noise of the reference, where it is known, is
/// subtracted from every relMSE that holds it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Decomposed {
    /// Seeds taken apart.
    pub seeds: usize,
    /// The relMSE of the image.
    pub relmse: Spread,
    /// Its bias.
    pub bias: Spread,
    /// The relMSE subtracted; null where the reference's noise is not known.
    pub reference_noise: Option<f64>,
    /// The parts that the settings have.
    pub parts: Vec<PartLeft>,
    /// The relMSE of the image less all shares of single parts: errors that cancel each other, or
    /// add up, are in several shares, or in none.
    pub interaction: Spread,
}

/// What is left with a part replaced, over the seeds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PartLeft {
    /// Which.
    pub part: Part,
    /// The relMSE left.
    pub relmse: Spread,
    /// The bias left.
    pub bias: Spread,
    /// The relMSE of the image less that: below 0 where the part makes up for another.
    pub share: Spread,
    /// The relMSE that the noise of the converged part adds to what is left, at most.
    pub noise: f64,
}

impl Decomposed {
    /// Over seeds of the same settings; none without any.
    pub fn of(seeds: &[&Decomposition], reference_noise: Option<f64>) -> Option<Self> {
        let first = seeds.first()?;
        let noise = reference_noise.unwrap_or(0.0);
        let over = |of: &dyn Fn(&Decomposition) -> f64| {
            let values: Vec<_> = seeds.iter().map(|seed| of(seed)).collect();
            Spread::of(&values)
        };
        let left = |seed: &Decomposition, part: Part| seed.part(part).left;
        let relmse = |seed: &Decomposition, part: Part| {
            let own = if part.leaves_reference_noise() { noise } else { 0.0 };
            left(seed, part).relmse - own
        };
        let share =
            |seed: &Decomposition, part: Part| seed.whole.relmse - noise - relmse(seed, part);
        let part = |replaced: &Replaced| {
            let part = replaced.part;
            PartLeft {
                part,
                relmse: over(&|seed| relmse(seed, part)),
                bias: over(&|seed| left(seed, part).bias),
                share: over(&|seed| share(seed, part)),
                noise: over(&|seed| seed.part(part).noise).mean,
            }
        };
        let single: Vec<_> = first.parts.iter().map(|p| p.part).filter(|p| p.is_single()).collect();
        let shares =
            |seed: &Decomposition| single.iter().map(|part| share(seed, *part)).sum::<f64>();
        Some(Self {
            seeds: seeds.len(),
            relmse: over(&|seed| seed.whole.relmse - noise),
            bias: over(&|seed| seed.whole.bias),
            reference_noise,
            parts: first.parts.iter().map(part).collect(),
            interaction: over(&|seed| seed.whole.relmse - noise - shares(seed)),
        })
    }

    /// A part, if the settings have it.
    pub fn part(&self, part: Part) -> Option<&PartLeft> {
        self.parts.iter().find(|own| own.part == part)
    }
}

impl Decomposition {
    /// A part; what the settings do not have leaves the error as it is.
    fn part(&self, part: Part) -> Replaced {
        let own = self.parts.iter().find(|own| own.part == part).copied();
        own.unwrap_or(Replaced { part, left: self.whole, noise: 0.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn left(relmse: f64) -> Left {
        Left { relmse, bias: -relmse }
    }

    fn decomposition(whole: f64, parts: &[(Part, f64)]) -> Decomposition {
        let replaced =
            |&(part, relmse): &(Part, f64)| Replaced { part, left: left(relmse), noise: 0.5 };
        Decomposition { whole: left(whole), parts: parts.iter().map(replaced).collect() }
    }

    #[test]
    fn shares_and_interaction_make_the_whole() {
        let parts = [
            (Part::Direct, 7.0),
            (Part::Antialiasing, 6.0),
            (Part::Vpls, 5.0),
            (Part::Indirect, 5.0),
            (Part::All, 5.0),
        ];
        let seeds = [decomposition(11.0, &parts), decomposition(13.0, &parts)];
        let found = Decomposed::of(&seeds.each_ref(), Some(1.0)).unwrap();
        assert_eq!((found.seeds, found.relmse.mean, found.bias.mean), (2, 11.0, -12.0));
        let share = |part| found.part(part).unwrap().share.mean;
        assert_eq!((share(Part::Direct), share(Part::Antialiasing)), (5.0, 6.0));
        // The reference's noise is in the image, and not in what its own light leaves.
        assert_eq!((share(Part::Indirect), share(Part::Vpls)), (6.0, 6.0));
        assert_eq!(found.part(Part::All).unwrap().relmse.mean, 4.0);
        assert_eq!(found.part(Part::Vpls).unwrap().relmse.mean, 5.0);
        assert_eq!(found.interaction.mean, 11.0 - 5.0 - 6.0 - 6.0);
        assert_eq!(found.part(Part::Direct).unwrap().noise, 0.5);
        assert_eq!((found.part(Part::Sharing), Decomposed::of(&[], None)), (None, None));
    }
}
