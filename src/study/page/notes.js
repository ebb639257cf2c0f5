// The heading, fits, claims and references.

function showHeading() {
  const { version, name, adapter, threads, seeds, scenes, finished, planned } = RESULTS;
  byId("program").textContent = `gpu-vpl ${version} · error against run time`;
  byId("name").textContent = name;
  const rows = scenes.reduce((sum, scene) => sum + scene.rows.length, 0);
  const names = scenes.map((scene) => scene.scene).join(", ");
  const device = [adapter.backend, adapter.driver].filter(Boolean).join(", ");
  const parts = [
    `${plural(rows, "setting")} of ${plural(scenes.length, "scene")}${names ? ` (${names})` : ""}`,
    ` on ${adapter.name}${device ? ` (${device})` : ""} with ${plural(threads, "host thread")}`,
    `, ${seeds.length === 1 ? `seed ${seeds[0]}` : `${seeds.length} seeds each`}.`,
  ];
  byId("summary").replaceChildren(parts.join(""));
  if (finished < planned) {
    byId("summary").after(
      make(
        "p",
        { class: "warning", id: "interrupted" },
        `Interrupted: ${finished} of ${planned} frames measured. The same command goes on from here.`,
      ),
    );
  }
  byId("repeat").replaceWith(command(RESULTS.command));
}

function table(head, rows) {
  const cell = (tag) => (content, index) => make(tag, { class: index ? null : "text" }, content);
  const body = rows.map((row) => make("tr", {}, row.map(cell("td"))));
  return make("table", {}, make("thead", {}, make("tr", {}, head.map(cell("th")))), make("tbody", {}, body));
}

function showFits() {
  const scene = currentScene();
  const curves = scene ? scene.experiments : [];
  const fits = curves.flatMap((curve) => curve.fits.map((fit) => ({ curve, fit })));
  const shown = fits.filter(({ fit }) => fit.metric === state.metric && fit.against === state.against);
  const rows = shown.map(({ curve, fit }) => [
    [swatch(styleOf(scene, curve.name)), ` ${curve.name}. `, ...marked(curve.title)],
    [fixed(fit.slope, 3)],
    [number(fit.floor)],
  ]);
  const nothing = make("p", { class: "quiet" }, "No curve of this scene has rows enough to fit this error.");
  byId("fits").replaceChildren(
    rows.length ? table([["curve"], [`slope of ${metricName(state.metric)}`], ["floor"]], rows) : nothing,
  );
}

function showClaims() {
  const { claims } = RESULTS;
  byId("claims-section").hidden = !claims.length;
  if (!claims.length) return;
  const text = (content, wrap) => make("td", { class: wrap ? "text wrap" : "text" }, content);
  const line = (claim) =>
    make(
      "tr",
      {},
      text(marked(claim.claim), true),
      text(make("span", { class: "verdict" }, claim.verdict.replaceAll("-", " "))),
      text(
        claim.criteria.map(({ what, value }) => make("div", {}, `${what}: ${number(value)}`)),
        true,
      ),
      text(claim.criteria.map((criterion) => make("div", {}, range(criterion)))),
      text(marked(claim.remark), true),
    );
  const head = ["claim", "verdict", "number", "confirms", "remark"].map((name) =>
    make("th", { class: "text" }, name),
  );
  byId("claims").replaceChildren(
    make("table", {}, make("thead", {}, make("tr", {}, head)), make("tbody", {}, claims.map(line))),
  );
}

function range({ least, most }) {
  if (isNumber(least) && isNumber(most)) return `${number(least)} to ${number(most)}`;
  if (isNumber(most)) return `≤ ${number(most)}`;
  return isNumber(least) ? `≥ ${number(least)}` : "any";
}

function showReferences() {
  const scene = currentScene();
  const nothing = make(
    "p",
    { class: "quiet" },
    "There is no reference: only the error of clustering is known.",
  );
  const references = scene ? scene.references : [];
  byId("references").replaceChildren(...(references.length ? references.map(referenceEntry) : [nothing]));
  if (isNumber(scene?.mask_above)) {
    byId("references").append(
      make(
        "p",
        {},
        `Pixels near any brighter than ${number(scene.mask_above)} are left out of all errors: lights seen directly.`,
      ),
    );
  }
}

function referenceEntry(reference) {
  const { label: title, samples, seconds, mean, noise, warnings } = reference;
  const facts = [
    isNumber(samples) && `${count(samples)} samples a pixel`,
    isNumber(seconds) && `${number(seconds)} s`,
    `mean ${number(mean, 4)}`,
  ];
  return make(
    "div",
    { class: "reference" },
    make("h3", {}, title),
    warnings.map((warning) => make("p", { class: "warning" }, warning)),
    make("p", { class: "quiet" }, facts.filter(Boolean).join(", ")),
    make("p", { class: "quiet" }, noiseText(noise)),
    reference.command ? command(reference.command) : null,
  );
}

function noiseText(noise) {
  if (!noise) return "Its own noise is not known.";
  const known = METRICS.filter(({ id }) => isNumber(noise[id]));
  return `Its own noise alone gives ${known.map(({ id, name }) => `${name} ${number(noise[id], 2)}`).join(", ")}.`;
}
