//! Results as one HTML file to look at and to play with: plots, tables, a viewer of the
//! pictures. It needs no other file and no network.

mod picture;

use std::io::{self, Write};

use serde::Serialize;

use super::plot::Style;
use super::results::{Metric, Results};
use crate::image::heat::{DIVERGING, SEQUENTIAL};

pub use picture::Picture;

const PAGE: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/page.css");

/// One module, in this order.
const SCRIPTS: [&str; 14] = [
    include_str!("page/dom.js"),
    include_str!("page/format.js"),
    include_str!("page/data.js"),
    include_str!("page/scale.js"),
    include_str!("page/plot.js"),
    include_str!("page/points.js"),
    include_str!("page/table.js"),
    include_str!("page/notes.js"),
    include_str!("page/parts.js"),
    include_str!("page/pixels.js"),
    include_str!("page/stage.js"),
    include_str!("page/tools.js"),
    include_str!("page/viewer.js"),
    include_str!("page/main.js"),
];

/// What the scripts know.
#[derive(Debug, Serialize)]
struct Data<'a> {
    results: &'a Results,
    metrics: Vec<Named>,
    styles: &'static [Style],
    /// The colours of differences.
    sequential: &'static [[u8; 3]],
    diverging: &'static [[u8; 3]],
    /// In the order of the elements that hold their pixels.
    pictures: &'a [Picture],
}

/// A metric's key in rows, and its name for people.
#[derive(Debug, Serialize)]
struct Named {
    id: Metric,
    name: &'static str,
}

/// Writes the page.
///
/// # Errors
/// The sink fails.
pub fn write(
    out: &mut (impl Write + ?Sized),
    results: &Results,
    pictures: &[Picture],
) -> io::Result<()> {
    let mut pieces = PAGE.split("{{");
    out.write_all(pieces.next().unwrap_or_default().as_bytes())?;
    for piece in pieces {
        let (name, rest) = piece.split_once("}}").unwrap_or((piece, ""));
        match name {
            "title" => write!(out, "{}", text(&results.name))?,
            "style" => out.write_all(STYLE.as_bytes())?,
            "data" => out.write_all(data(results, pictures)?.as_bytes())?,
            "pictures" => write_pictures(out, pictures)?,
            _ => SCRIPTS.iter().try_for_each(|script| out.write_all(script.as_bytes()))?,
        }
        out.write_all(rest.as_bytes())?;
    }
    Ok(())
}

/// JSON that is at home in a `<script>`: nothing in it can end that.
fn data(results: &Results, pictures: &[Picture]) -> io::Result<String> {
    let named = |id: Metric| Named { id, name: id.name() };
    let data = Data {
        results,
        metrics: Metric::ALL.map(named).into(),
        styles: &Style::ALL,
        sequential: SEQUENTIAL,
        diverging: DIVERGING,
        pictures,
    };
    Ok(serde_json::to_string(&data)?.replace('<', "\\u003c"))
}

fn write_pictures(out: &mut (impl Write + ?Sized), pictures: &[Picture]) -> io::Result<()> {
    for (index, picture) in pictures.iter().enumerate() {
        let Picture { data, .. } = picture;
        writeln!(out, "<script type=\"text/plain\" id=\"picture-{index}\">{data}</script>")?;
    }
    Ok(())
}

/// Text that is text in HTML.
fn text(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::AdapterInfo;
    use crate::image::Image;

    fn page(name: &str) -> String {
        let word = String::new;
        let adapter =
            AdapterInfo { name: word(), backend: word(), driver: word(), device_type: word() };
        let results = Results {
            schema: 2,
            version: "0",
            name: name.to_owned(),
            command: word(),
            adapter,
            threads: 1,
            seeds: vec![1],
            planned: 0,
            finished: 0,
            scenes: Vec::new(),
            claims: Vec::new(),
        };
        let image = Image { width: 1, height: 1, pixels: vec![[0.5; 3]] };
        let picture = Picture::encode(name, name, name, &image);
        let mut page = Vec::new();
        write(&mut page, &results, &[picture]).unwrap();
        String::from_utf8(page).unwrap()
    }

    #[test]
    fn every_placeholder_is_filled_and_every_script_ends_once() {
        let page = page("a study");
        assert!(!page.contains("{{") && !page.contains("}}"));
        assert!(page.contains("<title>a study</title>") && page.contains("\"name\":\"a study\""));
        assert_eq!(page.matches("<script").count(), 3);
        assert_eq!(page.matches("</script>").count(), 3);
        assert!(SCRIPTS.iter().all(|script| page.contains(script)));
    }

    #[test]
    fn names_stay_text() {
        let name = "</script><img onerror=x>{{data}}&amp;";
        let page = page(name);
        assert_eq!(page.matches("</script>").count(), 3);
        assert!(!page.contains("<img"));
        assert!(page.contains("&lt;/script&gt;&lt;img onerror=x&gt;{{data}}&amp;amp;"));
    }

    #[test]
    fn nothing_comes_from_elsewhere() {
        let page = page("x");
        let policy = "default-src 'none'; style-src 'unsafe-inline'; \
                      script-src 'unsafe-inline'; img-src data: blob:";
        assert!(page.contains(&format!("\"Content-Security-Policy\" content=\"{policy}\"")));
        let links = page.matches("http").count();
        assert_eq!(links, page.matches("http-equiv").count() + page.matches(NAMESPACE).count());
    }

    /// A name, not an address to load.
    const NAMESPACE: &str = "http://www.w3.org/2000/svg";
}
