//! The tables of errors taken apart.

use std::io::{self, Write};

use super::format::{NOTHING, maybe, signed, small};
use crate::study::parts::{Decomposed, Part};
use crate::study::results::{Row, SceneResults, Spread};

/// Headings of the parts, in their order.
const HEADINGS: [&str; 8] = [
    "direct",
    "indirect",
    "antialiasing",
    "clamp",
    "sharing",
    "interleaving",
    "VPLs",
    "all but VPLs",
];

/// Writes what is left of the errors of a scene's rows; nothing where none was taken apart.
///
/// # Errors
/// The sink fails.
pub fn write(out: &mut (impl Write + ?Sized), scene: &SceneResults) -> io::Result<()> {
    let rows = scene.rows.iter().filter_map(|row| Some((row, row.decomposition.as_ref()?)));
    let rows: Vec<_> = rows.collect();
    let Some((_, first)) = rows.first() else { return Ok(()) };
    writeln!(out, "\n### Where the error comes from\n")?;
    writeln!(
        out,
        "relMSE (and bias) left when a part alone is replaced by its converged one; below, how much \
         of that is noise of the converged part, at most. Direct light: many shadow rays from the \
         same visible points. Indirect light: the reference's, antialiased. Antialiasing: many \
         camera samples a pixel, which average textures, too. Clamp: what the bound took is given \
         back by many short paths. Sharing: the same VPLs, seen from every point. Interleaving: all \
         of them at every pixel. VPLs: what these leave once all that is replaced, in the place of \
         which is what any number of VPLs would give. Parts do not add up: where their errors \
         cancel each other or add up, the interaction is what the shares leave of the whole."
    )?;
    let noise = match first.reference_noise {
        Some(_) => "The reference's noise is subtracted.",
        None => {
            "The reference's noise is not known, and in all but what is left without indirect light \
             or without VPLs."
        }
    };
    writeln!(out, "{noise}\n")?;
    writeln!(out, "| curve, setting | seeds | relMSE | {} | interaction |", HEADINGS.join(" | "))?;
    writeln!(out, "| ---{} |", " | ---:".repeat(HEADINGS.len() + 3))?;
    for (row, decomposed) in rows {
        write_row(out, row, decomposed)?;
    }
    Ok(())
}

fn write_row(
    out: &mut (impl Write + ?Sized),
    row: &Row,
    decomposed: &Decomposed,
) -> io::Result<()> {
    let Decomposed { seeds, relmse, bias, interaction, .. } = decomposed;
    let line = |first: &str, own: [String; 2], part: &dyn Fn(Part) -> String, last: &str| {
        let parts: Vec<_> = Part::ALL.into_iter().map(part).collect();
        format!("| {first} | {} | {} | {last} |", own.join(" | "), parts.join(" | "))
    };
    let left =
        |relmse: Spread, bias: Spread| format!("{} ({})", small(relmse.mean), signed(bias.mean));
    let part = |part| maybe(decomposed.part(part), |own| left(own.relmse, own.bias));
    let noise = |part| maybe(decomposed.part(part), |own| small(own.noise));
    let name = format!("{}, {}", row.experiment, row.setting);
    let own = [seeds.to_string(), left(*relmse, *bias)];
    writeln!(out, "{}", line(&name, own, &part, &small(interaction.mean)))?;
    let own = [String::new(), maybe(decomposed.reference_noise, small)];
    writeln!(out, "{}", line("noise", own, &noise, NOTHING))
}
