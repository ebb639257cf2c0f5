// Error over run time.

const plotElements = { svg: null, points: [] };

/// What is drawn where, for the width at hand.
function chart(width) {
  const scene = currentScene();
  const all = pointsOf(scene, state.metric, state.against);
  const points = all.filter(({ row }) => !state.hidden[state.scene].has(row.experiment));
  const height = Math.round(Math.min(Math.max(width * 0.68, 300), 540));
  const box = { left: width < 480 ? 54 : 66, right: width - 12, top: 30, bottom: height - 52 };
  // Switching a curve off leaves the axes as they are.
  const errors = all.flatMap(({ error }) => extent(error));
  const least = Math.min(...errors.filter((error) => error > 0));
  const noises = noisesOf(scene, state.metric, state.against);
  const near = noises.map(({ noise }) => noise).filter((noise) => noise > least / 10);
  const x = logAxis(
    all.flatMap(({ seconds }) => extent(seconds)),
    box.left,
    box.right,
  );
  const y = logAxis([...errors, ...near], box.bottom, box.top);
  return { scene, all, points, width, height, box, x, y, noises };
}

function showPlot() {
  const holder = byId("plot");
  // Not laid out, as in a tab that closes: there is nothing to draw on.
  if (!holder.clientWidth) return;
  const what = RESULTS.scenes.length ? chart(holder.clientWidth) : { all: [] };
  for (const old of holder.querySelectorAll("svg, .empty")) old.remove();
  hideTip();
  plotElements.points = [];
  if (!what.all.length) {
    holder.append(make("p", { class: "empty" }, "No setting of this scene has this error."));
    return;
  }
  const svg = draw("svg", {
    viewBox: `0 0 ${what.width} ${what.height}`,
    height: what.height,
    role: "group",
    "aria-label": `${errorTitle()} over seconds of a warm frame; arrow keys go from point to point, Enter chooses one`,
  });
  svg.append(definitions(what), gridLines(what), noiseBands(what), front(what));
  for (const curve of what.scene.experiments) svg.append(curveGroup(what, curve));
  followPointer(svg, what);
  holder.prepend(svg);
  plotElements.svg = svg;
}

function errorTitle() {
  const against = state.against === "total" ? "against the reference" : "against the unclustered frame";
  return `${metricName(state.metric)} ${against}`;
}

function definitions({ box }) {
  const stroke = draw("path", { d: "M0 0V7", class: "hatch" });
  const pattern = {
    id: "hatch",
    width: 7,
    height: 7,
    patternUnits: "userSpaceOnUse",
    patternTransform: "rotate(45)",
  };
  const size = { width: box.right - box.left, height: box.bottom - box.top };
  const inside = draw("clipPath", { id: "inside" }, draw("rect", { x: box.left, y: box.top, ...size }));
  return draw("defs", {}, draw("pattern", pattern, stroke), inside);
}

function segment(x1, y1, x2, y2, attributes) {
  return draw("line", { x1, y1, x2, y2, ...attributes });
}

function label(x, y, text, attributes = {}) {
  return draw("text", { x, y, ...attributes }, text);
}

function gridLines({ box, x, y, width, height }) {
  const group = draw("g", { "aria-hidden": true });
  for (const tick of ticks(x)) {
    const place = at(x, tick.value);
    group.append(segment(place, box.top, place, box.bottom, { class: tick.label ? "grid major" : "grid" }));
    if (tick.label)
      group.append(label(place, box.bottom + 18, tick.label, { class: "tick", "text-anchor": "middle" }));
  }
  for (const tick of ticks(y)) {
    const place = at(y, tick.value);
    group.append(segment(box.left, place, box.right, place, { class: tick.label ? "grid major" : "grid" }));
    if (tick.label)
      group.append(label(box.left - 8, place + 4, tick.label, { class: "tick", "text-anchor": "end" }));
  }
  group.append(draw("path", { class: "frame", d: `M${box.left} ${box.top}V${box.bottom}H${box.right}` }));
  group.append(label(0, 16, errorTitle(), { class: "title", id: "y-title" }));
  const middle = (box.left + box.right) / 2;
  group.append(
    label(middle, height - 8, "seconds of a warm frame", { class: "title", "text-anchor": "middle" }),
  );
  return group;
}

/// What lies in a reference's own noise cannot be told from it.
function noiseBands({ noises, box, y }) {
  const group = draw("g", { "aria-hidden": true });
  for (const { noise, reference } of noises) {
    if (isBelow(y, noise)) continue;
    const top = at(y, noise);
    const size = { x: box.left, y: top, width: box.right - box.left, height: box.bottom - top };
    group.append(draw("rect", { ...size, fill: "url(#hatch)" }));
    group.append(segment(box.left, top, box.right, top, { class: "noise-line" }));
    const room = Math.floor((box.right - box.left) / 6.2) - 8;
    const text = `noise of ${reference.label}`;
    const shown = text.length > room ? `${text.slice(0, room - 1)}…` : text;
    group.append(label(box.left + 8, top - 5, shown, { class: "noise" }));
  }
  return group;
}

/// Steps along the rows that no other is both faster and better than, those of hidden curves
/// included.
function front({ all, box, x, y }) {
  const best = all.filter(isBest).sort((a, b) => a.seconds.mean - b.seconds.mean);
  if (!best.length) return draw("g");
  let path = "";
  for (const { seconds, error } of best) {
    const [right, down] = [at(x, seconds.mean), at(y, error.mean)];
    path += path ? `H${right}V${down}` : `M${right} ${box.top}V${down}`;
  }
  return draw("path", { class: "front", d: `${path}H${box.right}` });
}

function polyline(points, attributes) {
  return draw("polyline", { points: points.map((point) => point.join(",")).join(" "), ...attributes });
}

function curveGroup(what, curve) {
  const style = styleOf(what.scene, curve.name);
  const group = draw("g", { class: "curve tint", style: tint(style) });
  const points = what.points.filter(({ row }) => row.experiment === curve.name);
  if (!points.length) return group;
  points.sort((a, b) => a.seconds.mean - b.seconds.mean);
  const place = ({ seconds, error }) => [at(what.x, seconds.mean), at(what.y, error.mean)];
  const fit = fitOf(curve, state.metric, state.against);
  const above = points.filter(({ error }) => !isBelow(what.y, error.mean));
  if (above.length > 1) group.append(polyline(above.map(place), { class: "link" }));
  if (fit) group.append(fitLine(what, curve, fit));
  for (const point of points) group.append(errorBars(what, point, place(point)));
  for (const point of points) group.append(pointMark(what, point, place(point), style));
  return group;
}

/// The fitted line is one without the reference's noise; points have it, and so the line drawn.
function fitLine({ scene, x, y }, curve, { line }) {
  const noise = noiseIn(scene, curve);
  const points = line.map(([seconds, error]) => [beyond(x, seconds), beyond(y, errorSum(error, noise))]);
  return polyline(points, { class: "fit", "clip-path": "url(#inside)" });
}

function errorBars({ x, y }, { seconds, error }, [left, top]) {
  const group = draw("g", { "aria-hidden": true });
  if (seconds.sd > 0) {
    const [from, to] = [-1, 1].map((sign) => at(x, seconds.mean + sign * seconds.sd));
    group.append(segment(from, top, to, top, { class: "bar" }));
  }
  if (error.sd > 0) {
    const [from, to] = [-1, 1].map((sign) => at(y, error.mean + sign * error.sd));
    group.append(segment(left, from, left, to, { class: "bar" }));
  }
  return group;
}
