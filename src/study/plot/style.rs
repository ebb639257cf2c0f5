//! How curves are told apart, in static plots and on the page alike: by colour, and by the
//! shape of their marks for those who do not see the difference.

use serde::Serialize;

/// The look of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Style {
    /// Its colour on a light background.
    pub light: &'static str,
    /// Its colour on a dark one.
    pub dark: &'static str,
    /// The outline of its marks as the data of an SVG path, about the origin, about 1 in radius.
    pub shape: &'static str,
}

impl Style {
    /// The look of the curve of an index; it repeats after ten.
    pub fn of(index: usize) -> Self {
        Self::ALL[index % Self::ALL.len()]
    }

    /// The first six colours are those of Okabe and Ito (2008), purple and yellow darkened to
    /// be seen on white; neighbours differ in lightness too.
    pub const ALL: [Self; 10] = [
        Self { light: "#0072b2", dark: "#4fa8e0", shape: "M1 0A1 1 0 1 1 -1 0A1 1 0 1 1 1 0Z" },
        Self { light: "#d55e00", dark: "#f0844a", shape: "M-.9 -.9H.9V.9H-.9Z" },
        Self { light: "#009e73", dark: "#35c49b", shape: "M0 -1.2L1.1 .8H-1.1Z" },
        Self { light: "#aa4499", dark: "#d884ca", shape: "M0 -1.3L1.3 0L0 1.3L-1.3 0Z" },
        Self { light: "#b07d00", dark: "#e3b341", shape: "M0 1.2L1.1 -.8H-1.1Z" },
        Self {
            light: "#3b9fd6",
            dark: "#8fd0f5",
            shape: "M-.4 -1.2H.4V-.4H1.2V.4H.4V1.2H-.4V.4H-1.2V-.4H-.4Z",
        },
        Self {
            light: "#882255",
            dark: "#d0708f",
            shape: "M0 -.5L.7 -1.2L1.2 -.7L.5 0L1.2 .7L.7 1.2L0 .5L-.7 1.2L-1.2 .7L-.5 0L-1.2 -.7L-.7 -1.2Z",
        },
        Self {
            light: "#555555",
            dark: "#b4b4b4",
            shape: "M0 -1.2L1.14 -.37L.71 .97H-.71L-1.14 -.37Z",
        },
        Self { light: "#7a8a1e", dark: "#bcc95a", shape: "M-1.3 -.6H1.3V.6H-1.3Z" },
        Self { light: "#117777", dark: "#5cb8b8", shape: "M-.6 -1.3H.6V1.3H-.6Z" },
    ];
}
