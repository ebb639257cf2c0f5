// Puts everything in its place.

function buildChoices() {
  const scenes = RESULTS.scenes.map((scene, index) => make("option", { value: index }, scene.scene));
  byId("scene").replaceChildren(...scenes);
  byId("scene").parentElement.hidden = scenes.length < 2;
  byId("scene").addEventListener("change", (event) => chooseScene(Number(event.target.value)));
  byId("metric").replaceChildren(...METRICS.map(({ id, name }) => make("option", { value: id }, name)));
  byId("metric").addEventListener("change", (event) => update({ metric: event.target.value }));
  for (const radio of byId("against").querySelectorAll("input")) {
    radio.addEventListener("change", () => update({ against: radio.value }));
  }
}

function chooseScene(scene) {
  update({ scene, chosen: null, against: possibleAgainst(RESULTS.scenes[scene]) });
}

/// What is shown stays what it is where the scene has it.
function possibleAgainst(scene) {
  const has = (against) => scene.rows.some((row) => row[against]);
  const other = state.against === "total" ? "clustering" : "total";
  return !has(state.against) && has(other) ? other : state.against;
}

/// What the scene has no value of cannot be chosen.
function showChoices() {
  const scene = currentScene();
  const has = (metric, against) => scene && pointsOf(scene, metric, against).length > 0;
  for (const radio of byId("against").querySelectorAll("input")) {
    radio.checked = radio.value === state.against;
    radio.disabled = !METRICS.some(({ id }) => has(id, radio.value));
  }
  for (const option of byId("metric").options) option.disabled = !has(option.value, state.against);
  byId("metric").value = state.metric;
  byId("scene").value = state.scene;
  byId("choices").hidden = !scene;
}

function start() {
  showHeading();
  buildChoices();
  buildViewer();
  showClaims();
  views.push(
    showChoices,
    showPlot,
    showLegend,
    showTable,
    revealRow,
    showParts,
    showFits,
    showReferences,
    followState,
  );
  if (RESULTS.scenes.length) chooseScene(0);
  else update({});
  document.addEventListener("pointerdown", (event) => byId("plot").contains(event.target) || hideTip());
  let width = byId("plot").clientWidth;
  new ResizeObserver(() => {
    if (byId("plot").clientWidth === width) return;
    width = byId("plot").clientWidth;
    showPlot();
  }).observe(byId("plot"));
}

start();
