// Where the error comes from: a bar for each row whose error was taken apart, and what is left.

/// Parts into which errors are taken apart, in the order of bars, with their names. Colours are those
/// of curves; the interaction has none, as it is of no part.
const SINGLE_PARTS = [
  ["direct", "direct light"],
  ["antialiasing", "antialiasing, textures"],
  ["clamp", "clamp"],
  ["sharing", "shared visibility"],
  ["interleaving", "interleaving"],
  ["vpls", "VPLs"],
];
/// Columns of the table.
const PART_COLUMNS = [
  ["direct", "direct"],
  ["indirect", "indirect"],
  ["antialiasing", "antialiasing"],
  ["clamp", "clamp"],
  ["sharing", "sharing"],
  ["interleaving", "interleaving"],
  ["vpls", "VPLs"],
  ["all", "all but VPLs"],
];

function partOf(row, id) {
  return row.decomposition.parts.find(({ part }) => part === id);
}

/// The shares of a row's relMSE: of each part that it has, and of their interaction.
function sharesOf(row) {
  const { relmse, interaction } = row.decomposition;
  const known = SINGLE_PARTS.map(([id, name], style) => {
    return { id, name, style, share: partOf(row, id)?.share.mean };
  });
  const all = [...known, { id: "interaction", name: "interaction", style: null, share: interaction.mean }];
  return all
    .filter(({ share }) => isNumber(share) && relmse.mean > 0)
    .map((part) => ({ ...part, share: part.share / relmse.mean }));
}

/// Where shares lie: those above 0 one after the other to the right of it, the others to the left.
function stacked(shares) {
  let [right, left] = [0, 0];
  return shares.map((part) => {
    if (part.share >= 0) right += part.share;
    else left += part.share;
    return { ...part, start: part.share >= 0 ? right - part.share : left };
  });
}

function showParts() {
  const scene = currentScene();
  const rows = (scene?.rows ?? []).filter((row) => row.decomposition);
  byId("parts-section").hidden = !rows.length;
  if (!rows.length) return;
  const bars = rows.map((row) => ({ row, parts: stacked(sharesOf(row)) }));
  const parts = bars.flatMap((bar) => bar.parts);
  const ends = parts.flatMap(({ start, share }) => [start, start + Math.abs(share)]);
  const low = Math.min(0, ...ends);
  const axis = { low, size: Math.max(1, ...ends) - low };
  byId("parts").replaceChildren(
    partsLegend(bars),
    ...bars.map((bar) => partsBar(bar, axis)),
    make("div", { class: "scroll" }, partsTable(rows)),
  );
  const known = rows.every(({ decomposition }) => isNumber(decomposition.reference_noise));
  byId("parts-noise").textContent = known
    ? "The reference’s own noise is subtracted."
    : "The reference’s own noise is not known, and is in every figure but those without indirect light or VPLs.";
}

function partTint(style) {
  return style === null ? null : tint(STYLES[style]);
}

function partsLegend(bars) {
  const shown = new Map(bars.flatMap(({ parts }) => parts.map((part) => [part.id, part])));
  const entry = ({ id, name, style }) =>
    make("span", { class: "key" }, make("i", { class: `part tint ${id}`, style: partTint(style) }), name);
  const order = [...SINGLE_PARTS.map(([id]) => id), "interaction"];
  return make(
    "p",
    { class: "parts-legend" },
    order.filter((id) => shown.has(id)).map((id) => entry(shown.get(id))),
  );
}

function partsBar({ row, parts }, { low, size }) {
  const place = (value) => `${(100 * (value - low)) / size}%`;
  const segment = ({ id, name, style, share, start }) => {
    const text = `${name}: ${signed(100 * share)} %`;
    const where = `left:${place(start)};width:${(100 * Math.abs(share)) / size}%`;
    const look = [partTint(style), where].filter(Boolean).join(";");
    return make("i", { class: `part tint ${id}`, style: look, title: text });
  };
  const line = (value) => make("b", { style: `left:${place(value)}` });
  const setting = `${row.experiment}, ${row.setting}`;
  const shares = parts.map(({ name, share }) => `${name} ${signed(100 * share)} %`);
  return make(
    "div",
    { class: "parts-row" },
    make("span", {}, `${setting}: relMSE ${spreadText(row.decomposition.relmse)}`),
    make(
      "div",
      { class: "parts-bar", role: "img", "aria-label": `${setting}: ${shares.join(", ")}` },
      parts.map(segment),
      line(0),
      line(1),
    ),
  );
}

function partsTable(rows) {
  const quiet = (text) => make("span", { class: "sd" }, text);
  const bias = (own) => quiet(` ${signed(100 * own.bias.mean, 2)} %`);
  const left = (own) => (own ? [number(own.relmse.mean), bias(own)] : [NOTHING]);
  const noise = (own) => (own ? [quiet(number(own.noise, 2))] : [NOTHING]);
  const parts = (row, show) => PART_COLUMNS.map(([id]) => show(partOf(row, id)));
  const lines = rows.flatMap((row) => [
    [[`${row.experiment}, ${row.setting}`], left(row.decomposition), ...parts(row, left)],
    [[quiet("noise of the converged part, at most")], [""], ...parts(row, noise)],
  ]);
  return table([["left with converged"], ["nothing"], ...PART_COLUMNS.map(([, name]) => [name])], lines);
}
