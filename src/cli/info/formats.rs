//! What formats have and is not shown, as the readers' own lists tell.

use serde::Serialize;

use crate::scene::omissions;

/// A row of the list.
#[derive(Debug, Serialize)]
struct Row {
    format: &'static str,
    what: &'static str,
    instead: &'static str,
    changes_image: bool,
}

/// The list as text, a row a line under each format, or as JSON.
pub fn text(json: bool) -> String {
    if json {
        let rows: Vec<Row> = omissions()
            .map(|o| Row {
                format: o.format,
                what: o.what,
                instead: o.instead,
                changes_image: o.changes_image,
            })
            .collect();
        return serde_json::to_string_pretty(&rows).unwrap_or_default() + "\n";
    }
    let mut text =
        "What formats have and is not shown as it is: each is warned of, with the file. An \
        asterisk\nmarks what --strict refuses.\n"
            .to_owned();
    let mut format = "";
    for omission in omissions() {
        if omission.format != format {
            format = omission.format;
            text += &format!("\n{format}\n");
        }
        let mark = if omission.changes_image { '*' } else { ' ' };
        text += &format!("{mark} {}: {}\n", omission.what, omission.instead);
    }
    text + "\nTOML\n  nothing: an unknown key is an error\n"
}
