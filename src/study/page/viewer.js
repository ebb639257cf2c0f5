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

function buildViewer() {
  const canvas = make("canvas", { id: "view", tabindex: 0, role: "img" });
  const handle = splitHandle((part) => showSplit(part));
  const stage = make(
    "div",
    { id: "stage" },
    canvas,
    handle,
    make("div", { class: "caption left", id: "caption-a" }),
    make("div", { class: "caption right", id: "caption-b" }),
    make("div", { id: "says", role: "status", hidden: true }),
  );
  const side = make("div", { id: "side" }, toolBar(), scaleBar(), probeTable());
  byId("viewer").replaceChildren(make("div", { id: "stage-holder" }, stage), side);
  followHands(canvas, { picture: () => viewer.shown?.pictures[0], moved: drawStage, pointed: showProbe });
  new ResizeObserver(() => resizeStage()).observe(byId("stage-holder"));
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
    viewer.exposure = scene.exposure ?? 0;
    byId("exposure").value = viewer.exposure;
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
  const points = pointsOf(scene, state.metric, state.against).filter(
    ({ row }) => pictureOf(scene, row.image) !== null,
  );
  const best = points.filter(isBest).sort((a, b) => a.error.mean - b.error.mean)[0] ?? points[0];
  const pictures = picturesOf(scene);
  const a = best ? pictureOf(scene, best.row.image) : pictures[0];
  const other = pictures.find((index) => index !== a) ?? a;
  return { a, b: (best && referencePicture(scene, best.row)) ?? other };
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
