// The points of the plot, what they say when pointed at, and the legend.

const REACH = 28;

function pointMark(what, point, [x, y], style) {
  const below = isBelow(what.y, point.error.mean);
  const first = plotElements.points.length === 0;
  const size = what.width < 480 ? 4 : 5;
  const group = draw("g", {
    class: `point${below ? " hollow" : ""}${state.chosen === point.index ? " chosen" : ""}`,
    transform: `translate(${x} ${y})`,
    tabindex: first ? 0 : -1,
    role: "button",
    "aria-label": spoken(point),
    "data-row": point.index,
    onfocus: () => showTip(entry),
    onblur: hideTip,
    onkeydown: (event) => onPointKey(event, entry),
  });
  group.append(draw("circle", { class: "halo", r: 13 }));
  if (isBest(point)) group.append(draw("circle", { class: "ring", r: size + 4 }));
  group.append(draw("path", { class: "mark", d: style.shape, transform: `scale(${size})` }));
  const entry = { point, group, x, y };
  plotElements.points.push(entry);
  return group;
}

function spoken({ row, seconds, error }) {
  return `${row.experiment}, ${row.setting}: ${spreadText(seconds)} seconds, ${metricName(state.metric)} ${spreadText(error)}`;
}

/// The nearest point is the one that is meant: marks are small and fingers are not.
function followPointer(svg, what) {
  const nearest = (event) => {
    const frame = svg.getBoundingClientRect();
    const scale = what.width / frame.width;
    const [x, y] = [(event.clientX - frame.left) * scale, (event.clientY - frame.top) * scale];
    const far = (entry) => Math.hypot(entry.x - x, entry.y - y);
    const entries = [...plotElements.points].sort((a, b) => far(a) - far(b));
    return entries.length && far(entries[0]) < REACH ? entries[0] : null;
  };
  svg.addEventListener("pointermove", (event) => showTip(nearest(event)));
  svg.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && hideTip());
  svg.addEventListener("click", (event) => {
    const entry = nearest(event);
    if (!entry) return hideTip();
    update({ chosen: entry.point.index });
    showTip(entryOf(entry.point.index));
  });
}

function entryOf(index) {
  return plotElements.points.find(({ point }) => point.index === index);
}

/// Left and right along a curve, up and down between curves.
function onPointKey(event, entry) {
  if (event.key === "Enter" || event.key === " ") {
    event.preventDefault();
    update({ chosen: entry.point.index });
    entryOf(entry.point.index)?.group.focus();
    return;
  }
  if (event.key === "Escape") return hideTip();
  const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const step = steps[event.key];
  if (!step) return;
  event.preventDefault();
  const target = step[0] ? along(entry, step[0]) : across(entry, step[1]);
  if (target) moveFocus(entry, target);
}

function along(entry, step) {
  const curve = plotElements.points.filter(
    ({ point }) => point.row.experiment === entry.point.row.experiment,
  );
  return curve[curve.indexOf(entry) + step];
}

function across(entry, step) {
  const names = [...new Set(plotElements.points.map(({ point }) => point.row.experiment))];
  const name = names[names.indexOf(entry.point.row.experiment) + step];
  const curve = plotElements.points.filter(({ point }) => point.row.experiment === name);
  return curve.sort((a, b) => Math.abs(a.x - entry.x) - Math.abs(b.x - entry.x))[0];
}

function moveFocus(from, to) {
  from.group.setAttribute("tabindex", -1);
  to.group.setAttribute("tabindex", 0);
  to.group.focus();
}

function hideTip() {
  byId("tip").hidden = true;
  for (const { group } of plotElements.points) group.classList.remove("near");
}

function showTip(entry) {
  hideTip();
  if (!entry) return;
  entry.group.classList.add("near");
  const tip = byId("tip");
  tip.replaceChildren(...tipContent(entry.point));
  tip.hidden = false;
  placeTip(tip, entry);
}

function tipContent({ row, seconds, error }) {
  const facts = [
    ["seconds", spreadText(seconds)],
    [metricName(state.metric), spreadText(error)],
    ["shadow rays", count(row.shadow_rays)],
    ["VPLs", count(row.vpls)],
    ["efficiency", number(row.efficiency)],
  ];
  const list = make(
    "dl",
    {},
    facts.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]),
  );
  const method = make("span", { class: "quiet" }, `${row.experiment} · ${row.method}`);
  return [make("strong", {}, row.setting), method, list, make("code", {}, words(row.command))];
}

/// Beside the point, on the side where there is room; below it where there is none.
function placeTip(tip, { x, y }) {
  const right = x + 18 + tip.offsetWidth <= byId("plot-section").clientWidth;
  const left = right ? x + 18 : Math.max(0, x - 18 - tip.offsetWidth);
  const covers = !right && left + tip.offsetWidth > x - 10;
  const top = covers ? y + 20 : Math.max(0, y - tip.offsetHeight / 2);
  tip.style.left = `${left}px`;
  tip.style.top = `${top}px`;
}

function showLegend() {
  const holder = byId("legend");
  holder.replaceChildren();
  if (!RESULTS.scenes.length) return;
  const scene = currentScene();
  const points = pointsOf(scene, state.metric, state.against);
  const drawn = scene.experiments.filter((curve) => points.some(({ row }) => row.experiment === curve.name));
  for (const curve of drawn) holder.append(legendEntry(scene, curve));
  if (points.length) holder.append(...keyToSigns(scene, points));
}

function legendEntry(scene, curve) {
  const hidden = state.hidden[state.scene];
  const fit = fitOf(curve, state.metric, state.against);
  const toggle = () => {
    if (!hidden.delete(curve.name)) hidden.add(curve.name);
    update({});
    byId("legend")
      .querySelector(`[data-curve="${CSS.escape(curve.name)}"]`)
      ?.focus();
  };
  return make(
    "button",
    {
      type: "button",
      "aria-pressed": String(!hidden.has(curve.name)),
      "data-curve": curve.name,
      onclick: toggle,
    },
    swatch(styleOf(scene, curve.name)),
    make(
      "span",
      {},
      make("span", { class: "name" }, `${curve.name}. `, marked(curve.title)),
      fit ? make("div", { class: "fitted" }, fitText(fit)) : null,
    ),
  );
}

function fitText({ slope, floor }) {
  const text = `slope ${fixed(slope, 2)}`;
  return isNumber(floor) ? `${text}, floor ${number(floor, 2)}` : text;
}

function keyToSigns(scene, points) {
  const key = (element, text) =>
    make(
      "div",
      { class: "key" },
      draw("svg", { viewBox: "-8 -8 16 16", "aria-hidden": true }, element),
      text,
    );
  const signs = [];
  if (points.some(isBest)) {
    signs.push(key(draw("circle", { class: "ring", r: 6 }), "no other setting is both faster and better"));
  }
  if (scene.experiments.some((curve) => fitOf(curve, state.metric, state.against))) {
    signs.push(key(draw("path", { class: "fit", d: "M-8 0H8" }), "fitted power law, and the reference’s noise"));
  }
  const hidden = points.some(({ error }) => error.mean === 0);
  if (hidden)
    signs.push(
      key(
        draw("g", { class: "hollow" }, draw("circle", { class: "mark", r: 4, style: "stroke-width:1.2" })),
        "an error of zero, at the bottom edge",
      ),
    );
  signs.push(key(draw("path", { class: "bar", d: "M0 -7V7" }), "± one standard deviation over seeds"));
  return signs;
}
