//! The elements of an SVG, written with two decimals.

use super::Style;

/// A picture that grows.
#[derive(Debug)]
pub(super) struct Svg {
    body: String,
}

/// Which end of a text is at its place.
#[derive(Debug, Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

const HEAD: &str = "<defs><pattern id=\"hatch\" width=\"7\" height=\"7\" \
    patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate(45)\">\
    <path d=\"M0 0V7\" stroke=\"#999\" stroke-opacity=\".45\"/></pattern></defs>\n\
    <style>.bar{stroke-opacity:.6}.mark{stroke:#fff;stroke-width:.16}\
    .hollow{fill:#fff;stroke:inherit;stroke-width:.3}</style>\n";

impl Svg {
    /// The radius of marks.
    const RADIUS: f64 = 4.6;

    /// An empty picture; what is to be clipped is clipped to this box.
    pub(super) fn new([left, top]: [f64; 2], [right, bottom]: [f64; 2]) -> Self {
        let (width, height) = (right - left, bottom - top);
        let body = format!(
            "<clipPath id=\"inside\"><rect x=\"{left:.2}\" y=\"{top:.2}\" \
             width=\"{width:.2}\" height=\"{height:.2}\"/></clipPath>\n"
        );
        Self { body }
    }

    /// The whole file, with a text for those who do not see it.
    pub(super) fn finish(self, [width, height]: [f64; 2], alternative: &str) -> String {
        let alternative = escaped(alternative);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" \
             width=\"{width:.0}\" height=\"{height:.0}\" role=\"img\" \
             aria-label=\"{alternative}\" font-family=\"system-ui, 'Helvetica Neue', Helvetica, \
             Arial, sans-serif\" font-size=\"13\">\n<title>{alternative}</title>\n{HEAD}\
             <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{}</svg>\n",
            self.body
        )
    }

    /// Opens a group with these attributes.
    pub(super) fn open(&mut self, attributes: &str) {
        self.add(&format!("<g {attributes}>"));
    }

    pub(super) fn close(&mut self) {
        self.add("</g>");
    }

    pub(super) fn line(&mut self, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2], attributes: &str) {
        self.add(&format!("<path d=\"M{x1:.2} {y1:.2}L{x2:.2} {y2:.2}\" {attributes}/>"));
    }

    /// A line through points; nothing for fewer than two.
    pub(super) fn path(&mut self, points: &[[f64; 2]], attributes: &str) {
        if points.len() < 2 {
            return;
        }
        let points: Vec<_> = points.iter().map(|[x, y]| format!("{x:.2} {y:.2}")).collect();
        self.add(&format!("<path d=\"M{}\" fill=\"none\" {attributes}/>", points.join("L")));
    }

    pub(super) fn hatched(&mut self, [left, top]: [f64; 2], [right, bottom]: [f64; 2]) {
        let (width, height) = (right - left, bottom - top);
        self.add(&format!(
            "<rect x=\"{left:.2}\" y=\"{top:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" \
             fill=\"url(#hatch)\"/>"
        ));
    }

    pub(super) fn ring(&mut self, [x, y]: [f64; 2]) {
        self.add(&format!(
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{:.2}\" fill=\"none\" stroke=\"#222\"/>",
            Self::RADIUS + 4.0
        ));
    }

    /// A mark with a title for the pointer; hollow where it stands for less than the axis
    /// shows.
    pub(super) fn mark(&mut self, [x, y]: [f64; 2], style: Style, hollow: bool, title: &str) {
        let class = if hollow { "mark hollow" } else { "mark" };
        self.add(&format!(
            "<path class=\"{class}\" d=\"{}\" transform=\"translate({x:.2} {y:.2}) \
             scale({:.2})\"><title>{}</title></path>",
            style.shape,
            Self::RADIUS,
            escaped(title)
        ));
    }

    pub(super) fn text(
        &mut self,
        [x, y]: [f64; 2],
        anchor: Anchor,
        attributes: &str,
        content: &str,
    ) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        self.add(&format!(
            "<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\" {attributes}>{}</text>",
            escaped(content)
        ));
    }

    fn add(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }
}

/// Text that is text in XML, within attributes too. What XML has no place for is left out.
pub(super) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

/// Text without the marks of Markdown's code.
pub(super) fn plain(text: &str) -> String {
    text.replace('`', "")
}

/// A number with two digits that count.
pub(super) fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        1e-4..1e4 => {
            let decimals = (1.0 - value.abs().log10().floor()).max(0.0) as usize;
            format!("{value:.decimals$}")
        }
        _ => format!("{value:.1e}"),
    }
}
