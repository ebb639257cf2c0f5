// The measurements as a table.

const tableState = { by: null, down: false, open: new Set() };

/// Columns: a heading, what it is sorted by, and what its cells show.
function columns(scene) {
  const spread = (id, name, of, title) => ({
    id,
    name,
    title,
    value: (row) => of(row)?.mean,
    cell: (row) => spreadCell(of(row)),
  });
  const metrics = METRICS.map(({ id, name }) => ({
    ...spread(id, name, (row) => row.total?.[id], "against the reference"),
    current: state.against === "total" && state.metric === id,
    cell: (row) => (id === "bias" ? [signed(row.total?.bias.mean)] : spreadCell(row.total?.[id])),
  }));
  const clustering = state.against === "clustering" ? state.metric : "nrmse";
  return [
    { id: "setting", name: "setting", first: true, value: (row) => row.setting, cell: settingCell },
    {
      id: "experiment",
      name: "curve",
      text: true,
      value: (row) => row.experiment,
      cell: (row) => [row.experiment],
    },
    { id: "method", name: "method", text: true, value: (row) => row.method, cell: (row) => [row.method] },
    spread("seconds", "seconds", (row) => row.seconds, "the wall clock of a warm frame"),
    spread("preprocess", "pT", (row) => row.preprocess, "VPLs and clusters"),
    spread("render", "rT", (row) => row.render, "visibility and shading"),
    ...thesisColumns(scene),
    ...metrics.map((column) => (column.id === "bias" ? { ...column, name: "bias" } : column)),
    {
      ...spread(
        "clustering",
        `${metricName(clustering)} of clustering`,
        (row) => row.clustering?.[clustering],
        "against the unclustered frame",
      ),
      current: state.against === "clustering",
    },
    { id: "vpls", name: "VPLs", value: (row) => row.vpls, cell: (row) => [count(row.vpls)] },
    {
      id: "rays",
      name: "shadow rays",
      value: (row) => row.shadow_rays,
      cell: (row) => [count(row.shadow_rays)],
    },
    {
      id: "efficiency",
      name: "efficiency",
      title: "1 / (MSE · seconds)",
      value: (row) => row.efficiency,
      cell: (row) => [number(row.efficiency)],
    },
    {
      id: "best",
      name: "best",
      title: "no other is both faster and better",
      value: (row) => Number(isBest({ row })),
      cell: (row) => [isBest({ row }) ? "●" : ""],
    },
    {
      id: "command",
      name: "command",
      text: true,
      value: (row) => row.command,
      cell: (row) => [command(row.command)],
    },
  ];
}

function thesisColumns(scene) {
  if (!scene.rows.some((row) => row.thesis)) return [];
  const column = (id, name, of) => ({ id, name, value: of, cell: (row) => [number(of(row))] });
  return [
    column("thesis", "thesis, s", (row) => row.thesis?.total),
    column("thesis-ratio", "thesis / ours", (row) => row.thesis && row.thesis.total / row.seconds.mean),
  ];
}

function showTable() {
  const holder = byId("rows");
  if (!RESULTS.scenes.length || !currentScene().rows.length) {
    holder.replaceChildren(make("p", { class: "quiet" }, "Nothing was measured yet."));
    return;
  }
  const scene = currentScene();
  const shown = columns(scene);
  const head = make(
    "tr",
    {},
    shown.map((column) => headCell(column)),
  );
  const body = make(
    "tbody",
    {},
    sorted(scene, shown).flatMap((index) => tableRow(scene, index, shown)),
  );
  holder.replaceChildren(make("table", {}, make("thead", {}, head), body));
}

function classes(column) {
  const names = [column.first && "first", column.text && "text", column.current && "current"];
  return names.filter(Boolean).join(" ") || null;
}

function headCell(column) {
  const sort = () => {
    tableState.down = tableState.by === column.id && !tableState.down;
    tableState.by = column.id;
    showTable();
    byId("rows").querySelector(`th[data-column="${column.id}"] button`).focus();
  };
  const direction = tableState.down ? "descending" : "ascending";
  const isSorted = tableState.by === column.id;
  const arrow = isSorted ? (tableState.down ? " ↓" : " ↑") : "";
  return make(
    "th",
    {
      class: classes(column),
      scope: "col",
      title: column.title,
      "data-column": column.id,
      "aria-sort": isSorted ? direction : null,
    },
    make("button", { type: "button", onclick: sort }, column.name + arrow),
  );
}

/// Indices of rows; those without a value come last in either direction.
function sorted(scene, shown) {
  const indices = [...scene.rows.keys()];
  const column = shown.find(({ id }) => id === tableState.by);
  if (!column) return indices;
  const sign = tableState.down ? -1 : 1;
  const missing = (value) => value === null || value === undefined || value === "";
  return indices.sort((a, b) => {
    const [left, right] = [a, b].map((index) => column.value(scene.rows[index]));
    if (missing(left) || missing(right)) return Number(missing(left)) - Number(missing(right));
    if (typeof left === "string") return sign * left.localeCompare(right, "en", { numeric: true });
    return sign * (left - right);
  });
}

function settingCell(row, index) {
  const open = tableState.open.has(`${state.scene} ${index}`);
  const fold = make(
    "button",
    {
      class: "fold",
      type: "button",
      "aria-expanded": String(open),
      "aria-label": `Details of ${row.setting}`,
      onclick: (event) => toggleDetails(event, index),
    },
    open ? "▾" : "▸",
  );
  const scene = currentScene();
  return [
    make(
      "div",
      { class: "setting" },
      fold,
      swatch(styleOf(scene, row.experiment)),
      make("span", {}, row.setting),
    ),
  ];
}

function toggleDetails(event, index) {
  event.stopPropagation();
  const key = `${state.scene} ${index}`;
  if (!tableState.open.delete(key)) tableState.open.add(key);
  showTable();
  byId("rows").querySelector(`tr[data-row="${index}"] .fold`).focus();
}

function tableRow(scene, index, shown) {
  const row = scene.rows[index];
  const cells = shown.map((column) => make("td", { class: classes(column) }, column.cell(row, index)));
  const choose = () => update({ chosen: index });
  const chosen = state.chosen === index;
  const line = make("tr", { "data-row": index, class: chosen ? "chosen" : null, onclick: choose }, cells);
  if (!tableState.open.has(`${state.scene} ${index}`)) return [line];
  return [line, make("tr", { class: "details" }, make("td", { colspan: shown.length }, details(row)))];
}

function details(row) {
  const list = (facts) =>
    make(
      "dl",
      {},
      facts.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]),
    );
  const options = row.options ? make("code", { class: "wide" }, words(row.options)) : null;
  return make("div", { class: "detail" }, list(phaseFacts(row)), list(countFacts(row)), options, command(row.command));
}

function phaseFacts(row) {
  const phases = Object.entries(row.phases);
  const most = Math.max(...phases.map(([, seconds]) => seconds));
  return phases.map(([name, seconds]) => {
    const width = most > 0 ? (7 * seconds) / most : 0;
    return [
      name.replaceAll("_", " "),
      [make("span", { class: "phase", style: `width:${width}rem` }), `${number(seconds)} s`],
    ];
  });
}

function countFacts(row) {
  const facts = [
    ["light paths", count(row.light_paths)],
    ["bounces", String(row.bounces)],
    ["samples a pixel", count(row.samples)],
    ["seeds", count(row.seeds)],
    ["VPL clusters", count(row.vpl_clusters)],
    ["point clusters", count(row.point_clusters)],
    ["shading terms", count(row.shading_terms)],
    ["bound on G", number(row.clamp)],
    ["removed by it", `${number(100 * row.clamped_fraction)} %`],
    ["over vpl", row.speedup === null ? NOTHING : `${number(row.speedup)}×`],
  ];
  const bad = row.total?.nonfinite;
  return bad ? [...facts, ["pixels not finite", count(bad)]] : facts;
}

/// The chosen row in sight, without moving the page about for a choice made in the table.
function revealRow(change) {
  if (!("chosen" in change) || state.chosen === null) return;
  const line = byId("rows").querySelector("tr.chosen");
  const holder = byId("rows");
  if (line && holder.scrollHeight > holder.clientHeight)
    holder.scrollTop = line.offsetTop - holder.clientHeight / 2;
}
