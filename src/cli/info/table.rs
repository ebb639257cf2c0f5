//! Tables in words: aligned, and of bounded width and length.

use std::fmt::{Result, Write};

use crate::cli::console::one_line;

/// Rows that are shown of a list; all are in the JSON.
pub const MOST_ROWS: usize = 20;
/// Characters that are shown of a cell.
const MOST_CHARACTERS: usize = 40;

/// A column's name, and whether its cells are numbers, which end below one another.
#[derive(Debug, Clone, Copy)]
pub enum Column {
    /// Left-aligned.
    Text(&'static str),
    /// Right-aligned.
    Number(&'static str),
}

impl Column {
    fn name(self) -> &'static str {
        match self {
            Self::Text(name) | Self::Number(name) => name,
        }
    }
}

/// Writes a table, indented by two; without the columns that are empty, and cut off after
/// [`MOST_ROWS`].
pub fn write<const N: usize>(
    text: &mut String,
    columns: [Column; N],
    rows: impl ExactSizeIterator<Item = [String; N]>,
) -> Result {
    let all = rows.len();
    let rows: Vec<[String; N]> = rows.take(MOST_ROWS).map(|row| row.map(|c| clip(&c))).collect();
    let width = |at: usize| rows.iter().map(|row| row[at].chars().count()).max().unwrap_or(0);
    let widths: Vec<_> = (0..N).map(width).collect();
    let names = columns.map(|column| column.name().to_owned());
    for row in std::iter::once(&names).chain(&rows) {
        let mut line = String::new();
        for ((cell, column), &width) in row.iter().zip(&columns).zip(&widths) {
            let wide = width.max(column.name().chars().count());
            match column {
                _ if width == 0 => {}
                Column::Text(_) => write!(line, "  {cell:wide$}")?,
                Column::Number(_) => write!(line, "  {cell:>wide$}")?,
            }
        }
        writeln!(text, "{}", line.trim_end())?;
    }
    match all - rows.len() {
        0 => Ok(()),
        more => writeln!(text, "  ... and {more} more"),
    }
}

/// One line, of bounded length.
pub fn clip(cell: &str) -> String {
    let line = one_line(cell);
    match line.char_indices().nth(MOST_CHARACTERS) {
        None => line,
        // The end tells names apart that begin with the same folders.
        Some(_) => {
            let skipped = line.chars().count() + 3 - MOST_CHARACTERS;
            format!("...{}", line.chars().skip(skipped).collect::<String>())
        }
    }
}

/// To five digits.
pub fn number(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    if !(1e-4..1e7).contains(&magnitude) {
        return format!("{value:.4e}");
    }
    let decimals = (4 - magnitude.log10().floor() as i32).max(0) as usize;
    let fixed = format!("{value:.decimals$}");
    match fixed.contains('.') {
        true => fixed.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => fixed,
    }
}

/// Numbers to five digits.
pub fn numbers<const N: usize>(values: [f64; N]) -> String {
    values.map(number).join(" ")
}

/// Bytes in the unit that suits.
pub fn bytes(bytes: u64) -> String {
    let units = ["KiB", "MiB", "GiB", "TiB"];
    let mut value = bytes as f64;
    let mut unit = "bytes";
    for larger in units {
        if value < 1024.0 {
            break;
        }
        (value, unit) = (value / 1024.0, larger);
    }
    match unit {
        "bytes" => format!("{bytes} bytes"),
        _ => format!("{value:.1} {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_aligned_and_empty_columns_left_out() {
        let mut text = String::new();
        let columns = [Column::Text("name"), Column::Text("none"), Column::Number("size")];
        let row = |name: &str, size: &str| [name.to_owned(), String::new(), size.to_owned()];
        write(&mut text, columns, [row("a", "12345"), row("longer", "6")].into_iter()).unwrap();
        assert_eq!(text, "  name     size\n  a       12345\n  longer      6\n");
    }

    #[test]
    fn long_lists_are_cut() {
        let mut text = String::new();
        let rows = (0..30).map(|row| [row.to_string()]);
        write(&mut text, [Column::Number("n")], rows).unwrap();
        assert_eq!(text.lines().count(), 1 + MOST_ROWS + 1);
        assert!(text.ends_with("  ... and 10 more\n"), "{text}");
    }

    #[test]
    fn cells_are_one_short_line() {
        let long = format!("a\nb{}", "x".repeat(100));
        assert_eq!(clip(&long).chars().count(), MOST_CHARACTERS);
        assert_eq!(clip("a\nb"), "a b");
    }

    #[test]
    fn numbers_have_five_digits() {
        for (value, text) in [
            (0.0, "0"),
            (0.5, "0.5"),
            (1.0 / 3.0, "0.33333"),
            (12345.678, "12346"),
            (-273.15, "-273.15"),
            (1200.0, "1200"),
            (1.5e9, "1.5000e9"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn bytes_have_units() {
        assert_eq!(
            [0, 1023, 1536, 3 << 30].map(bytes),
            ["0 bytes", "1023 bytes", "1.5 KiB", "3.0 GiB"]
        );
    }
}
