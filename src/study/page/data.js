// What the page knows, and what it shows of it at the moment.

const DATA = JSON.parse(byId("data").textContent);
const { results: RESULTS, metrics: METRICS, styles: STYLES, pictures: PICTURES } = DATA;

const state = {
  scene: 0,
  metric: METRICS[0].id,
  against: "total",
  /// Names of curves that are switched off, by scene.
  hidden: RESULTS.scenes.map(() => new Set()),
  /// The row that plot, table and viewer agree on.
  chosen: null,
};

const views = [];

/// Changes the state, and all that shows it.
function update(change) {
  Object.assign(state, change);
  for (const view of views) view(change);
}

function currentScene() {
  return RESULTS.scenes[state.scene];
}

function metricName(id) {
  return METRICS.find((metric) => metric.id === id).name;
}

function styleOf(scene, name) {
  const index = scene.experiments.findIndex((curve) => curve.name === name);
  return STYLES[Math.max(index, 0) % STYLES.length];
}

/// A row's error as it is plotted: the bias without its sign; null where there is none.
function errorOf(row, metric, against) {
  const spread = row[against]?.[metric];
  if (!spread || !isNumber(spread.mean)) return null;
  return metric === "bias" ? { mean: Math.abs(spread.mean), sd: spread.sd } : spread;
}

/// The rows that have the error: what is plotted.
function pointsOf(scene, metric, against) {
  const points = scene.rows.map((row, index) => ({
    row,
    index,
    seconds: row.seconds,
    error: errorOf(row, metric, against),
  }));
  return points.filter(({ seconds, error }) => error && isNumber(seconds.mean) && seconds.mean > 0);
}

function fitOf(curve, metric, against) {
  return curve.fits.find((fit) => fit.metric === metric && fit.against === against);
}

/// References with the errors that their noise gives.
function noisesOf(scene, metric, against) {
  if (against !== "total") return [];
  const noises = scene.references.map((reference) => ({ reference, noise: reference.noise?.[metric] }));
  return noises.filter(({ noise }) => isNumber(noise) && noise > 0);
}

/// The noise that is in a curve's errors.
function noiseIn(scene, curve) {
  const row = scene.rows.find(({ experiment }) => experiment === curve.name);
  const noises = noisesOf(scene, state.metric, state.against);
  return noises.find(({ reference }) => reference.id === row?.reference)?.noise ?? 0;
}

/// The error that two independent ones make together: squares add up, and relMSE is one.
function errorSum(a, b) {
  return state.metric === "relmse" ? a + b : Math.hypot(a, b);
}

function isBest(point) {
  return state.against === "total" && point.row.pareto.includes(state.metric);
}

/// Indices of the scene's pictures.
function picturesOf(scene) {
  return [...PICTURES.keys()].filter((index) => PICTURES[index].scene === scene.scene);
}

function pictureOf(scene, id) {
  const found = picturesOf(scene).find((index) => PICTURES[index].id === id);
  return found === undefined ? null : found;
}
