// The controls of the viewer, and what it tells in numbers.

const MODES = [
  ["split", "split"],
  ["a", "A"],
  ["b", "B"],
  ["difference", "difference"],
];

function chooser(which) {
  const change = (event) => choosePictures({ [which]: Number(event.target.value) });
  return make(
    "label",
    { class: "field" },
    which.toUpperCase(),
    make("select", { id: `picture-${which}`, onchange: change }),
  );
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
    make(
      "label",
      {},
      make("input", {
        type: "radio",
        name: "mode",
        value,
        checked: value === viewer.mode,
        onchange: () => setViewer({ mode: value }),
      }),
      make("span", {}, text),
    );
  const kind = make(
    "select",
    {
      id: "kind",
      onchange: (event) => setViewer({ isSigned: event.target.value === "signed", scale: null }),
    },
    make("option", { value: "size" }, "|A − B|"),
    make("option", { value: "signed" }, "A − B"),
  );
  const exposure = make("input", {
    type: "range",
    id: "exposure",
    min: -8,
    max: 8,
    step: 0.25,
    oninput: (event) => setViewer({ exposure: Number(event.target.value) }),
  });
  const scale = make("input", {
    type: "range",
    id: "difference-scale",
    min: -18,
    max: 12,
    step: 1,
    oninput: (event) => setViewer({ scale: stepped(Number(event.target.value)) }),
  });
  return make(
    "div",
    { class: "tools" },
    chooser("a"),
    chooser("b"),
    make("fieldset", { class: "switch", id: "mode" }, make("legend", {}, "show"), MODES.map(radio)),
    make("label", { class: "field only-difference" }, "of", kind),
    make("label", { class: "field only-difference" }, "scale ", make("output", { id: "scale-value" }), scale),
    make(
      "label",
      { class: "field not-difference" },
      "exposure ",
      make("output", { id: "exposure-value" }),
      exposure,
    ),
    make(
      "div",
      { class: "buttons", role: "group", "aria-label": "Zoom" },
      button(
        "−",
        "Zoom out",
        onPicture((picture) => zoomTo(picture, place.scale / 1.5, middle())),
      ),
      button(
        "+",
        "Zoom in",
        onPicture((picture) => zoomTo(picture, place.scale * 1.5, middle())),
      ),
      button(
        "1:1",
        "One pixel a pixel",
        onPicture((picture) => zoomTo(picture, 1, middle())),
      ),
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
  return make(
    "div",
    { id: "scale", hidden: true },
    make("span", { id: "scale-low" }),
    make("canvas", { width: 256, height: 1 }),
    make("span", { id: "scale-high" }),
  );
}

function probeTable() {
  const line = (name, id) =>
    make(
      "tr",
      { id: `probe-${id}` },
      make("th", { scope: "row" }, name),
      [0, 1, 2].map(() => make("td", {}, NOTHING)),
    );
  const head = make(
    "tr",
    {},
    make("th", { id: "probe-place" }, "pixel"),
    ["red", "green", "blue"].map((name) => make("td", { class: "quiet" }, name)),
  );
  return make(
    "table",
    { id: "probe", "aria-label": "Values of the pixel pointed at" },
    make("tbody", {}, head, line("A", "a"), line("B", "b"), line("A − B", "difference")),
  );
}

function fillChoosers(scene) {
  for (const which of ["a", "b"]) {
    const options = picturesOf(scene).map((index) => make("option", { value: index }, PICTURES[index].label));
    byId(`picture-${which}`).replaceChildren(...options);
  }
}

function say(text) {
  byId("says").hidden = !text;
  byId("says").textContent = text ?? "";
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
  const values = Float32Array.from({ length: 256 }, (_, index) =>
    isSigned ? (2 * index) / 255 - 1 : index / 255,
  );
  bar.getContext("2d").drawImage(mapped(values, 256, 1, isSigned, 1), 0, 0);
}

/// The values of the pixel pointed at; without a place, of the same as before.
function showProbe(point = viewer.pointed) {
  viewer.pointed = point;
  const { shown } = viewer;
  const pixel = point && shown ? pixelAt(shown.pictures[0], point) : null;
  byId("probe-place").textContent = pixel ? `${pixel[0]}, ${pixel[1]}` : "pixel";
  const [a, b] =
    pixel && shown.alike ? shown.codes.map((codes) => codesAt(codes, shown.pictures[0].width, pixel)) : [];
  showValues("a", (channel) => number(VALUES[a[channel]]), a);
  showValues("b", (channel) => number(VALUES[b[channel]]), b);
  showValues("difference", (channel) => signed(difference(a[channel], b[channel])), a);
}

function codesAt(codes, width, [column, row]) {
  const first = 3 * (row * width + column);
  return codes.subarray(first, first + 3);
}

/// Fills a line of the table, where there is something to show.
function showValues(id, textOf, known) {
  const cells = byId(`probe-${id}`).querySelectorAll("td");
  cells.forEach((cell, channel) => (cell.textContent = known ? textOf(channel) : NOTHING));
}
