//! Mutated inputs, and how long to try them.

use std::time::{Duration, Instant};

use proptest::prelude::*;
use proptest::test_runner::TestRunner;

/// Bytes that break things.
const PIECES: [&[u8]; 20] = [
    b"",
    b"\0",
    b"\xff\xff\xff\xff",
    b"\n",
    b" ",
    b"#",
    b"-",
    b"0",
    b"-1",
    b"nan",
    b"inf",
    b"1e308",
    b"1e-320",
    b"4294967296",
    b"-9223372036854775808",
    b"\"",
    b"[",
    b"}",
    b"\\",
    b"\xc3\xa4",
];

#[derive(Debug, Clone)]
enum Mutation {
    Flip(prop::sample::Index, u8),
    Insert(prop::sample::Index, Vec<u8>),
    Delete(prop::sample::Index, usize),
    Duplicate(prop::sample::Index, usize),
    /// Puts one word in the place of another.
    Splice(prop::sample::Index, prop::sample::Index),
    Truncate(prop::sample::Index),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let at = any::<prop::sample::Index>;
    let piece = prop_oneof![
        prop::sample::select(&PIECES[..]).prop_map(<[u8]>::to_vec),
        prop::collection::vec(any::<u8>(), 1..5),
    ];
    prop_oneof![
        4 => (at(), any::<u8>()).prop_map(|(at, mask)| Mutation::Flip(at, mask)),
        4 => (at(), piece).prop_map(|(at, piece)| Mutation::Insert(at, piece)),
        2 => (at(), 1..40_usize).prop_map(|(at, length)| Mutation::Delete(at, length)),
        1 => (at(), 1..200_usize).prop_map(|(at, length)| Mutation::Duplicate(at, length)),
        4 => (at(), at()).prop_map(|(to, from)| Mutation::Splice(to, from)),
        1 => at().prop_map(Mutation::Truncate),
    ]
}

/// The word around a place: digits, letters and what numbers hold.
fn word(bytes: &[u8], at: usize) -> std::ops::Range<usize> {
    let is_word = |byte: &u8| byte.is_ascii_alphanumeric() || b"+-._".contains(byte);
    let start = bytes[..at].iter().rposition(|byte| !is_word(byte)).map_or(0, |i| i + 1);
    let end = bytes[at..].iter().position(|byte| !is_word(byte)).map_or(bytes.len(), |i| at + i);
    start..end
}

impl Mutation {
    fn apply(&self, bytes: &mut Vec<u8>) {
        if bytes.is_empty() {
            return;
        }
        let length = bytes.len();
        match self {
            Self::Flip(at, mask) => bytes[at.index(length)] ^= mask,
            Self::Insert(at, piece) => {
                let at = at.index(length);
                bytes.splice(at..at, piece.iter().copied());
            }
            Self::Delete(at, count) => {
                let at = at.index(length);
                bytes.drain(at..(at + count).min(length));
            }
            Self::Duplicate(at, count) => {
                let at = at.index(length);
                let copy = bytes[at..(at + count).min(length)].to_vec();
                bytes.splice(at..at, copy);
            }
            Self::Splice(to, from) => {
                let (to, from) = (word(bytes, to.index(length)), word(bytes, from.index(length)));
                let copy = bytes[from].to_vec();
                bytes.splice(to, copy);
            }
            Self::Truncate(at) => bytes.truncate(at.index(length)),
        }
    }
}

/// One of some valid inputs, mutated a few times.
pub fn mutated(seeds: Vec<Vec<u8>>) -> impl Strategy<Value = Vec<u8>> {
    let seed = prop::sample::select(seeds);
    (seed, prop::collection::vec(mutation(), 0..6)).prop_map(|(mut bytes, mutations)| {
        mutations.iter().for_each(|mutation| mutation.apply(&mut bytes));
        bytes
    })
}

/// Runs a test on a few cases; for `SCENE_FUZZ_SECONDS`, if they are given, on many.
pub fn fuzz<S: Strategy>(name: &str, strategy: &S, test: impl Fn(S::Value)) {
    let seconds = std::env::var("SCENE_FUZZ_SECONDS").ok().and_then(|text| text.parse().ok());
    let (start, mut cases) = (Instant::now(), 0);
    let mut runner = TestRunner::new(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(150)
    });
    loop {
        let result = runner.run(strategy, |value| {
            let start = Instant::now();
            test(value);
            prop_assert!(start.elapsed() < Duration::from_secs(20), "it hangs");
            Ok(())
        });
        cases += 150;
        let failure = result.err().map(|error| error.to_string());
        assert_eq!(failure, None, "{name}, after some {cases} cases");
        if seconds.is_none_or(|seconds| start.elapsed() >= Duration::from_secs(seconds)) {
            break;
        }
    }
    if seconds.is_some() {
        eprintln!("{name}: {cases} cases in {} s", start.elapsed().as_secs());
    }
}
