//! A map of the unit cube onto itself whose density is learned from weighted places: a tree of halves.

/// Dimensions of the cube.
pub const DIMENSIONS: usize = 4;
/// A box with fewer places is not divided.
const LEAST: usize = 16;
/// No edge is halved more often, so that the middles are exact in f32.
const MOST_HALVINGS: u32 = 22;
/// This share of the probability is uniform.
const UNIFORM: f64 = 0.1;
/// Each half of a box is taken to hold this many places of mean weight besides: what no place
/// happened to hit beside many that did is likelier than what is far off.
const PRIOR: f64 = 1.0;

/// A map of the unit cube onto itself.
#[derive(Debug, Clone)]
pub struct Warp {
    nodes: Vec<Node>,
}

#[derive(Debug, Clone, Copy)]
enum Node {
    Leaf,
    /// Halved across a dimension; the upper half's node follows that of the lower one.
    Halved {
        dimension: usize,
        lower: usize,
        probability: f64,
    },
}

/// A box of the tree with the places in it.
struct Part<'a> {
    places: &'a mut [Place],
    /// The probability that is learned.
    learned: f64,
    low: [f32; DIMENSIONS],
    halvings: [u32; DIMENSIONS],
}

/// A place and its weight.
pub type Place = ([f32; DIMENSIONS], f64);

impl Warp {
    /// Dense where the places, in the unit cube, have weight.
    pub fn of(mut places: Vec<Place>) -> Self {
        let weight: f64 = places.iter().map(|place| place.1).sum();
        let mut warp = Self { nodes: vec![Node::Leaf] };
        if weight > 0.0 {
            let prior = PRIOR * weight / places.len() as f64;
            let root = Part {
                places: &mut places,
                learned: 1.0,
                low: [0.0; DIMENSIONS],
                halvings: [0; DIMENSIONS],
            };
            warp.divide(0, root, prior);
        }
        warp
    }

    fn divide(&mut self, node: usize, part: Part<'_>, prior: f64) {
        let Some(dimension) = part.dimension() else { return };
        let [lower, upper] = part.halves(dimension, prior);
        let [below, above] = [&lower, &upper].map(Part::probability);
        let children = self.nodes.len();
        let probability = below / (below + above);
        self.nodes[node] = Node::Halved { dimension, lower: children, probability };
        self.nodes.extend([Node::Leaf; 2]);
        self.divide(children, lower, prior);
        self.divide(children + 1, upper, prior);
    }

    /// Where a place is mapped to, and the density there. What is evenly spread stays so within and among
    /// all boxes.
    pub fn at(&self, u: [f32; DIMENSIONS]) -> ([f32; DIMENSIONS], f64) {
        let mut u = u.map(f64::from);
        let (mut low, mut extent) = ([0.0; DIMENSIONS], [1.0; DIMENSIONS]);
        let (mut node, mut density) = (0, 1.0);
        while let Node::Halved { dimension: d, lower, probability } = self.nodes[node] {
            extent[d] *= 0.5;
            if u[d] < probability {
                u[d] /= probability;
                density *= 2.0 * probability;
                node = lower;
            } else {
                u[d] = (u[d] - probability) / (1.0 - probability);
                density *= 2.0 * (1.0 - probability);
                low[d] += extent[d];
                node = lower + 1;
            }
        }
        let most = 1.0 - 0.5 * f32::EPSILON;
        (std::array::from_fn(|d| ((low[d] + extent[d] * u[d]) as f32).min(most)), density)
    }
}

impl<'a> Part<'a> {
    fn probability(&self) -> f64 {
        let volume = 0.5f64.powi(self.halvings.iter().sum::<u32>() as i32);
        UNIFORM * volume + (1.0 - UNIFORM) * self.learned
    }

    fn middle(&self, dimension: usize) -> f32 {
        self.low[dimension] + 0.5f32.powi(self.halvings[dimension] as i32 + 1)
    }

    /// The dimension across which the halves differ most; the one that was halved least if they differ by
    /// no more than chance has it. None of a box that stays whole.
    fn dimension(&self) -> Option<usize> {
        let count = self.places.len();
        if count < LEAST {
            return None;
        }
        let excess = |dimension: usize| {
            let middle = self.middle(dimension);
            let below = self.places.iter().filter(|place| place.0[dimension] < middle).count();
            (2 * below).abs_diff(count)
        };
        let open = || (0..DIMENSIONS).filter(|&d| self.halvings[d] < MOST_HALVINGS);
        let (most, dimension) =
            open().map(|d| (excess(d), d)).max_by_key(|&(excess, d)| (excess, DIMENSIONS - d))?;
        if most * most > 4 * count {
            return Some(dimension);
        }
        open().min_by_key(|&d| self.halvings[d])
    }

    fn halves(self, dimension: usize, prior: f64) -> [Part<'a>; 2] {
        let middle = self.middle(dimension);
        let Part { places, learned, low, mut halvings } = self;
        // Stable, so that sums do not depend on how it is done.
        places.sort_by_key(|place| place.0[dimension] >= middle);
        let below = places.partition_point(|place| place.0[dimension] < middle);
        let (lower, upper) = places.split_at_mut(below);
        let [a, b] =
            [&*lower, &*upper].map(|half| half.iter().map(|place| place.1).sum::<f64>() + prior);
        halvings[dimension] += 1;
        let mut high = low;
        high[dimension] = middle;
        [
            Part { places: lower, learned: learned * a / (a + b), low, halvings },
            Part { places: upper, learned: learned * b / (a + b), low: high, halvings },
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Sequence;

    /// Dense in a small box and along a diagonal.
    fn learned() -> Warp {
        let sequence = Sequence::new(1);
        let place = |i| {
            let u: [f32; DIMENSIONS] = std::array::from_fn(|d| sequence.sample(i, d as u32));
            match i % 2 {
                0 => (u.map(|x| 0.7 + 0.001 * x), 1.0),
                _ => ([u[0], (u[0] + 0.02 * u[1]).min(0.999), u[2], u[3]], f64::from(u[2])),
            }
        };
        Warp::of((0..8192).map(place).collect())
    }

    /// Of any function, the mean of values over densities is its integral.
    #[test]
    fn densities_are_those_of_the_map() {
        let (warp, sequence) = (learned(), Sequence::new(2));
        let functions: [fn([f32; DIMENSIONS]) -> f64; 4] = [
            |_| 1.0,
            |u| f64::from(u[0] * u[1] * u[2] * u[3]) * 16.0,
            |u| if u[0] < 0.25 && u[1] > 0.5 { 8.0 } else { 0.0 },
            |u| if u.iter().all(|&x| x > 0.5) { 16.0 } else { 0.0 },
        ];
        let count = 1 << 16;
        for (i, function) in functions.iter().enumerate() {
            let sum: f64 = (0..count)
                .map(|i| warp.at(std::array::from_fn(|d| sequence.sample(i, d as u32))))
                .map(|(place, density)| function(place) / density)
                .sum();
            let mean = sum / f64::from(count);
            assert!((mean - 1.0).abs() < 0.02, "function {i}: {mean}");
        }
    }

    #[test]
    fn most_is_where_weight_is() {
        let (warp, sequence) = (learned(), Sequence::new(2));
        let (mut inside, count) = (0, 1 << 14);
        for i in 0..count {
            let (place, density) = warp.at(std::array::from_fn(|d| sequence.sample(i, d as u32)));
            assert!(place.iter().all(|x| (0.0..1.0).contains(x)));
            assert!(density >= UNIFORM, "{density}");
            inside += u32::from(place.iter().all(|x| (0.699..0.702).contains(x)));
        }
        // Two thirds of the weight, a part of it spread a little.
        let share = f64::from(inside) / f64::from(count);
        assert!((0.5..0.67).contains(&share), "{share}");
    }

    #[test]
    fn nothing_learned_leaves_places_where_they_are() {
        let u = [0.25, 0.5, 0.999, 0.0];
        for places in [vec![], vec![([0.5; DIMENSIONS], 0.0); 100]] {
            assert_eq!(Warp::of(places).at(u), (u, 1.0));
        }
    }
}
