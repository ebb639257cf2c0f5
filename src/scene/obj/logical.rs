//! The statements of a text: lines, of which a backslash at the end joins the next.

use super::omitted::is_keyword;

/// Statements that end in a name, which may end in a backslash: those of folders do.
const NAMES: [&str; 8] = ["o", "g", "usemtl", "mtllib", "usemap", "maplib", "call", "csh"];

/// A statement, the number of its first line, and how many lines it takes. A comment ends with its
/// line, whatever that ends in.
pub fn statements(text: &str) -> impl Iterator<Item = (usize, String, usize)> {
    let mut lines = (1..).zip(text.lines()).peekable();
    std::iter::from_fn(move || {
        let (line, first) = lines.next()?;
        let mut content = first.to_owned();
        let mut count = 1;
        while let Some(part) = continued(&content, lines.peek().map(|(_, next)| *next)) {
            content.truncate(part);
            if let Some((_, next)) = lines.next() {
                content.push_str(next);
                count += 1;
            }
        }
        Some((line, content, count))
    })
}

/// How much of a line comes before the backslash that joins the next to it, if one does.
fn continued(content: &str, next: Option<&str>) -> Option<usize> {
    let before = content.trim_end().strip_suffix('\\')?;
    let mut words = before.split_whitespace();
    let keyword = words.next().unwrap_or_default();
    let joins = match keyword {
        name if NAMES.contains(&name) => {
            let begins = next.and_then(|next| next.split_whitespace().next());
            begins.is_some_and(|word| !is_keyword(word) && !word.starts_with('#'))
        }
        _ => !keyword.starts_with('#') && !words.any(|word| word.starts_with('#')),
    };
    joins.then_some(before.len())
}
