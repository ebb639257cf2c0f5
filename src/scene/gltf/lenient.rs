//! JSON that is nearly glTF: what some writers do that the format does not allow, and that says all
//! the same what is meant.
//!
//! Whole numbers written as `4.0` or `4.8e1`; `null` where there is nothing; numbers for names, versions
//! and truth; `NaN` and `Infinity` where nothing reads them; commas before a closing bracket; texts
//! that are not in UTF-8.

use serde_json::{Number, Value};

use super::json::Document;
use crate::scene::text;

/// The document that was meant, if one was.
pub fn read(bytes: &[u8]) -> Option<Document> {
    let (text, _) = text::decode(bytes, None);
    let mut value: Value = serde_json::from_str(&plain(&text)).ok()?;
    mend(&mut value, "");
    serde_json::from_value(value).ok()
}

/// The text, with what no JSON holds left out: outside of strings, numbers that are none become
/// `null`, and commas that nothing follows go.
fn plain(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut rest = text.trim_end_matches(['\0', ' ', '\n', '\r', '\t', '\u{1a}']);
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '"' => string(rest),
            ',' if rest[1..].trim_start().starts_with(['}', ']']) => {
                rest = &rest[1..];
                continue;
            }
            'a'..='z' | 'A'..='Z' | '-' => word(rest),
            _ => first.len_utf8(),
        };
        let (part, after) = rest.split_at(length);
        let bare = part.trim_start_matches('-').to_ascii_lowercase();
        let is_number =
            !["nan", "infinity", "inf", "1.#ind", "1.#qnan", "1.#inf"].contains(&&*bare);
        plain.push_str(if is_number { part } else { "null" });
        rest = after;
    }
    plain
}

/// The length of the string that a text begins with.
fn string(text: &str) -> usize {
    let mut escaped = false;
    for (at, character) in text.char_indices().skip(1) {
        match character {
            '"' if !escaped => return at + 1,
            '\\' => escaped = !escaped,
            _ => escaped = false,
        }
    }
    text.len()
}

/// The length of the word or negative number that a text begins with.
fn word(text: &str) -> usize {
    let ends = |c: char| !(c.is_ascii_alphanumeric() || "-+.#".contains(c));
    text.find(ends).unwrap_or(text.len())
}

/// Gives numbers, truths and names the types that the format asks for. `key` is what the value is
/// under.
fn mend(value: &mut Value, key: &str) {
    match value {
        Value::Object(members) => {
            members.retain(|_, member| !member.is_null());
            members.iter_mut().for_each(|(key, member)| mend(member, key));
        }
        Value::Array(items) => items.iter_mut().for_each(|item| mend(item, "")),
        Value::Number(number) => {
            let real = number.as_f64().unwrap_or_default();
            *value = match key {
                "name" => Value::String(number.to_string()),
                "version" | "minVersion" => Value::String(format!("{real:.1}")),
                "doubleSided" | "normalized" => Value::Bool(real != 0.0),
                _ if number.is_f64() => whole(real).unwrap_or_else(|| value.clone()),
                _ => return,
            };
        }
        _ => {}
    }
}

/// A number that has no fraction, as one that the reader takes for whole.
fn whole(real: f64) -> Option<Value> {
    /// Up to it, each whole number is one of f64.
    const MOST: f64 = 9_007_199_254_740_992.0;
    let number = (real.fract() == 0.0 && real.abs() <= MOST).then_some(real as i64)?;
    Some(Value::Number(Number::from(number)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_outside_of_strings_is_mended() {
        let text = r#"{"a,}": [1, NaN, -Infinity, ], "b\",]": "NaN,]",}"#;
        assert_eq!(plain(text), r#"{"a,}": [1, null, null ], "b\",]": "NaN,]"}"#);
        assert_eq!(plain("{\"a\": -1.5e-3, \"b\": true}\0\0"), r#"{"a": -1.5e-3, "b": true}"#);
        for broken in ["\"", "\"\\", "{\"a", "-", "[,]", "ä", ","] {
            let _ = plain(broken);
        }
    }
}
