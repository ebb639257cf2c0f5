// Two pictures of a scene against each other.

const viewer = {
  a: null,
  b: null,
  mode: "split",
  isSigned: false,
  exposure: 0,
  split: 0.5,
  /// The difference at the end of the colours, null for that which 99 % are within.
  scale: null,
  pointed: null,
  /// What is drawn: pictures, their codes and layers; null until they are decoded.
  shown: null,
};

const MODES = [["split", "split"], ["a", "A"], ["b", "B"], ["difference", "difference"]];

function buildViewer() {
  const canvas = make("canvas", { id: "view", tabindex: 0, role: "img" });
  const handle = splitHandle((part) => showSplit(part));
  const stage = make("div", { id: "stage" }, canvas, handle, make("div", { class: "caption left", id: "caption-a" }), make("div", { class: "caption right", id: "caption-b" }), make("div", { id: "says", role: "status", hidden: true }));
  const side = make("div", { id: "side" }, toolBar(), scaleBar(), probeTable());
  byId("viewer").replaceChildren(make("div", { id: "stage-holder" }, stage), side);
  followHands(canvas, { picture: () => viewer.shown?.pictures[0], moved: drawStage, pointed: showProbe });
  new ResizeObserver(() => resizeStage()).observe(byId("stage-holder"));
}

function chooser(which) {
  const change = (event) => choosePictures({ [which]: Number(event.target.value) });
  return make("label", { class: "field" }, which.toUpperCase(), make("select", { id: `picture-${which}`, onchange: change }));
}

function button(text, title, onclick) {
  return make("button", { type: "button", title, "aria-label": title, onclick }, text);
}

function onPicture(change) {
  return () => {
    if (!viewer.shown) return;
    change(viewer.shown.pictures[0]);
    drawStage();
  };
}

function toolBar() {
  const radio = ([value, text]) =>
    make("label", {}, make("input", { type: "radio", name: "mode", value, checked: value === viewer.mode, onchange: () => setViewer({ mode: value }) }), make("span", {}, text));
  const kind = make(
    "select",
    { id: "kind", onchange: (event) => setViewer({ isSigned: event.target.value === "signed", scale: null }) },
    make("option", { value: "size" }, "|A − B|"),
    make("option", { value: "signed" }, "A − B"),
  );
  const exposure = make("input", { type: "range", id: "exposure", min: -8, max: 8, step: 0.25, oninput: (event) => setViewer({ exposure: Number(event.target.value) }) });
  const scale = make("input", { type: "range", id: "difference-scale", min: -18, max: 12, step: 1, oninput: (event) => setViewer({ scale: stepped(Number(event.target.value)) }) });
  return make(
    "div",
    { class: "tools" },
    chooser("a"),
    chooser("b"),
    make("fieldset", { class: "switch", id: "mode" }, make("legend", {}, "show"), MODES.map(radio)),
    make("label", { class: "field only-difference" }, "of", kind),
    make("label", { class: "field only-difference" }, "scale ", make("output", { id: "scale-value" }), scale),
    make("label", { class: "field not-difference" }, "exposure ", make("output", { id: "exposure-value" }), exposure),
    make(
      "div",
      { class: "buttons", role: "group", "aria-label": "Zoom" },
      button("−", "Zoom out", onPicture((picture) => zoomTo(picture, place.scale / 1.5, middle()))),
      button("+", "Zoom in", onPicture((picture) => zoomTo(picture, place.scale * 1.5, middle()))),
      button("1:1", "One pixel a pixel", onPicture((picture) => zoomTo(picture, 1, middle()))),
      button("fit", "Show all", onPicture(fit)),
      button("A ⇄ B", "Exchange A and B", () => choosePictures({ a: viewer.b, b: viewer.a })),
    ),
  );
}

/// 1, 2 and 5 of every decade.
function stepped(index) {
  const digit = [1, 2, 5][((index % 3) + 3) % 3];
  return Number(`${digit}e${Math.floor(index / 3)}`);
}

/// The least step that is not below a value.
function stepOf(value) {
  let index = -18;
  while (index < 12 && stepped(index) < value) index += 1;
  return index;
}

function scaleBar() {
  return make("div", { id: "scale", hidden: true }, make("span", { id: "scale-low" }), make("canvas", { width: 256, height: 1 }), make("span", { id: "scale-high" }));
}

function probeTable() {
  const line = (name, id) => make("tr", { id: `probe-${id}` }, make("th", { scope: "row" }, name), [0, 1, 2].map(() => make("td", {}, NOTHING)));
  const head = make("tr", {}, make("th", { id: "probe-place" }, "pixel"), ["red", "green", "blue"].map((name) => make("td", { class: "quiet" }, name)));
  return make("table", { id: "probe", "aria-label": "Values of the pixel pointed at" }, make("tbody", {}, head, line("A", "a"), line("B", "b"), line("A − B", "difference")));
}

function setViewer(change) {
  Object.assign(viewer, change);
  refreshLayers();
  drawStage();
}

/// Follows the scene and the chosen row: A is the row's picture, B its reference's.
function followState(change) {
  const scene = currentScene();
  byId("viewer").parentElement.hidden = !scene || !picturesOf(scene).length;
  if (byId("viewer").parentElement.hidden) return;
  if ("scene" in change) {
    fillChoosers(scene);
    byId("exposure").value = scene.exposure ?? 0;
    viewer.exposure = Number(byId("exposure").value);
    place.fits = true;
    choosePictures(firstChoice(scene));
  } else if ("chosen" in change && state.chosen !== null) {
    const row = scene.rows[state.chosen];
    const picture = pictureOf(scene, row.image);
    if (picture === null) return;
    choosePictures({ a: picture, b: referencePicture(scene, row) ?? viewer.b });
  }
}

function referencePicture(scene, row) {
  const reference = scene.references.find(({ id }) => id === row.reference);
  return reference ? pictureOf(scene, reference.image) : null;
}

/// The best row of the plot against its reference; without one, the first two pictures.
function firstChoice(scene) {
  const points = pointsOf(scene, state.metric, state.against).filter(({ row }) => pictureOf(scene, row.image) !== null);
  const best = points.filter(isBest).sort((a, b) => a.error.mean - b.error.mean)[0] ?? points[0];
  const pictures = picturesOf(scene);
  const a = best ? pictureOf(scene, best.row.image) : pictures[0];
  const other = pictures.find((index) => index !== a) ?? a;
  return { a, b: (best && referencePicture(scene, best.row)) ?? other };
}

function fillChoosers(scene) {
  for (const which of ["a", "b"]) {
    const options = picturesOf(scene).map((index) => make("option", { value: index }, PICTURES[index].label));
    byId(`picture-${which}`).replaceChildren(...options);
  }
}

async function choosePictures(change) {
  Object.assign(viewer, change, { scale: null });
  const { a, b } = viewer;
  byId("picture-a").value = a;
  byId("picture-b").value = b;
  say("unpacking …");
  try {
    const codes = await Promise.all([codesOf(a), codesOf(b)]);
    if (viewer.a !== a || viewer.b !== b) return;
    const pictures = [PICTURES[a], PICTURES[b]];
    const alike = pictures[0].width === pictures[1].width && pictures[0].height === pictures[1].height;
    viewer.shown = { pictures, codes, alike, layers: {} };
    say(alike ? null : "These pictures differ in size.");
    resizeStage();
    refreshLayers();
    drawStage();
  } catch (error) {
    viewer.shown = null;
    say(error.message);
    drawStage();
  }
}

function say(text) {
  byId("says").hidden = !text;
  byId("says").textContent = text ?? "";
}

/// Colours of what the mode shows, computed when they are first asked for.
function refreshLayers() {
  const { shown, mode, exposure } = viewer;
  if (!shown) return;
  const { pictures, codes, layers } = shown;
  const toneKey = String(exposure);
  if (layers.toneKey !== toneKey) Object.assign(layers, { toneKey, a: null, b: null });
  const wanted = { split: ["a", "b"], a: ["a"], b: ["b"], difference: [] }[mode];
  for (const which of wanted) {
    const index = which === "a" ? 0 : 1;
    layers[which] ??= toned(codes[index], pictures[index].width, pictures[index].height, exposure);
  }
  if (mode === "difference" && shown.alike) refreshDifference(shown);
}

function refreshDifference({ pictures, codes, layers }) {
  const { isSigned } = viewer;
  if (layers.valuesOf !== isSigned) {
    Object.assign(layers, { values: differences(...codes, isSigned), valuesOf: isSigned, scale: null });
  }
  viewer.scale ??= stepped(stepOf(usualSize(layers.values)));
  if (layers.scale === viewer.scale) return;
  const { width, height } = pictures[0];
  layers.difference = mapped(layers.values, width, height, isSigned, viewer.scale);
  layers.scale = viewer.scale;
}

function resizeStage() {
  const picture = viewer.shown?.pictures[0];
  const stage = byId("stage");
  const ratio = picture ? picture.height / picture.width : 0.75;
  const room = byId("stage-holder").clientWidth;
  const height = Math.round(Math.min(room * ratio, Math.max(0.78 * innerHeight, 240)));
  stage.style.height = `${height}px`;
  stage.style.width = `${Math.min(room, Math.round(height / ratio))}px`;
  if (!picture) return;
  if (place.fits) fit(picture);
  else settle(picture);
  drawStage();
}

function showSplit(part) {
  viewer.split = part;
  drawStage();
}

function drawStage() {
  const { shown, mode } = viewer;
  const canvas = byId("view");
  const [width, height] = stageSize();
  const density = globalThis.devicePixelRatio || 1;
  const size = [width, height].map((extent) => Math.round(extent * density));
  if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
  const context = canvas.getContext("2d");
  context.setTransform(density, 0, 0, density, 0, 0);
  context.clearRect(0, 0, width, height);
  showTools();
  if (!shown) return;
  const border = width * viewer.split;
  if (mode === "split") {
    drawLayer(context, shown.layers.a, [0, border], height);
    drawLayer(context, shown.layers.b, [border, width], height);
  } else drawLayer(context, shown.layers[mode], [0, width], height);
  showProbe();
}

/// Draws a layer between two columns: smooth when shrunk, in plain squares when enlarged.
function drawLayer(context, layer, [from, to], height) {
  if (!layer) return;
  context.save();
  context.beginPath();
  context.rect(from, 0, to - from, height);
  context.clip();
  context.imageSmoothingEnabled = place.scale * (globalThis.devicePixelRatio || 1) < 1;
  context.imageSmoothingQuality = "high";
  context.drawImage(layer, place.left, place.top, layer.width * place.scale, layer.height * place.scale);
  context.restore();
}

/// Brings the controls in line with what is drawn.
function showTools() {
  const { mode, split, exposure, scale, isSigned, shown } = viewer;
  const isDifference = mode === "difference";
  for (const element of document.querySelectorAll(".only-difference")) element.hidden = !isDifference;
  for (const element of document.querySelectorAll(".not-difference")) element.hidden = isDifference;
  const handle = byId("split");
  const percent = Math.round(100 * split);
  handle.hidden = mode !== "split";
  handle.style.left = `${100 * split}%`;
  handle.setAttribute("aria-valuenow", percent);
  handle.setAttribute("aria-valuetext", `${percent} % A`);
  byId("exposure-value").textContent = `${signed(exposure, 3)} EV`;
  byId("scale").hidden = !isDifference;
  const names = shown ? shown.pictures.map((picture) => picture.label) : ["", ""];
  showCaptions(names);
  if (isDifference && scale) showScale(scale, isSigned);
}

function showCaptions([a, b]) {
  const { mode } = viewer;
  const left = { split: `A: ${a}`, a: `A: ${a}`, b: `B: ${b}`, difference: "A − B" }[mode];
  byId("caption-a").textContent = left;
  byId("caption-b").textContent = `B: ${b}`;
  byId("caption-a").hidden = !a;
  byId("caption-b").hidden = mode !== "split" || !b;
  byId("view").setAttribute("aria-label", mode === "split" ? `A: ${a}; B: ${b}` : left);
}

function showScale(scale, isSigned) {
  byId("scale-value").textContent = number(scale, 1);
  byId("difference-scale").value = stepOf(scale);
  byId("scale-low").textContent = isSigned ? number(-scale, 1) : "0";
  byId("scale-high").textContent = isSigned ? `+${number(scale, 1)}` : number(scale, 1);
  const bar = byId("scale").querySelector("canvas");
  const values = Float32Array.from({ length: 256 }, (_, index) => (isSigned ? (2 * index) / 255 - 1 : index / 255));
  bar.getContext("2d").drawImage(mapped(values, 256, 1, isSigned, 1), 0, 0);
}

/// The values of the pixel pointed at; without a place, of the same as before.
function showProbe(point = viewer.pointed) {
  viewer.pointed = point;
  const { shown } = viewer;
  const pixel = point && shown ? pixelAt(shown.pictures[0], point) : null;
  byId("probe-place").textContent = pixel ? `${pixel[0]}, ${pixel[1]}` : "pixel";
  const values = pixel && shown.alike ? shown.codes.map((codes) => valuesAt(codes, shown.pictures[0].width, pixel)) : null;
  showValues("a", values?.[0]);
  showValues("b", values?.[1]);
  showValues("difference", values?.[0].map((value, channel) => value - values[1][channel]), signed);
}

function valuesAt(codes, width, [column, row]) {
  const first = 3 * (row * width + column);
  return [0, 1, 2].map((channel) => VALUES[codes[first + channel]]);
}

function showValues(id, values, show = number) {
  const cells = byId(`probe-${id}`).querySelectorAll("td");
  cells.forEach((cell, channel) => (cell.textContent = values ? show(values[channel], 3) : NOTHING));
}
