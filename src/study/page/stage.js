// The stage of the viewer: where pictures lie on it, and how hands move them.

/// The place of the pictures: pixels of the page a pixel of the picture, and their corner.
const place = { scale: 1, left: 0, top: 0, fits: true };
const LARGEST_SCALE = 64;

function stageSize() {
  const stage = byId("stage");
  return [stage.clientWidth, stage.clientHeight];
}

function fitScale(picture) {
  const [width, height] = stageSize();
  return Math.min(width / picture.width, height / picture.height);
}

function fit(picture) {
  Object.assign(place, { scale: fitScale(picture), fits: true });
  settle(picture);
}

/// Pictures cover the stage, or are in its middle.
function settle(picture) {
  const [width, height] = stageSize();
  const within = (corner, room, size) =>
    size <= room ? (room - size) / 2 : Math.min(0, Math.max(room - size, corner));
  place.left = within(place.left, width, picture.width * place.scale);
  place.top = within(place.top, height, picture.height * place.scale);
  byId("stage").classList.toggle(
    "zoomed",
    picture.width * place.scale > width + 1 || picture.height * place.scale > height + 1,
  );
}

/// Scales about a point of the stage that stays where it is.
function zoomTo(picture, scale, [x, y]) {
  const least = Math.min(fitScale(picture), 1);
  const next = Math.min(Math.max(scale, least), LARGEST_SCALE);
  const factor = next / place.scale;
  place.left = x - factor * (x - place.left);
  place.top = y - factor * (y - place.top);
  place.scale = next;
  place.fits = next === fitScale(picture);
  settle(picture);
}

function middle() {
  return stageSize().map((extent) => extent / 2);
}

/// The pixel under a point of the stage; null beside the picture.
function pixelAt(picture, [x, y]) {
  const column = Math.floor((x - place.left) / place.scale);
  const row = Math.floor((y - place.top) / place.scale);
  const within = column >= 0 && row >= 0 && column < picture.width && row < picture.height;
  return within ? [column, row] : null;
}

function onStage(event) {
  const frame = byId("stage").getBoundingClientRect();
  return [event.clientX - frame.left, event.clientY - frame.top];
}

/// Listens to hands on the canvas: `picture()` is what lies there, `moved()` draws it anew,
/// `pointed(place)` tells what is pointed at.
function followHands(canvas, { picture, moved, pointed }) {
  const hands = new Map();
  const spread = () => {
    const [a, b] = [...hands.values()];
    return { size: Math.hypot(a[0] - b[0], a[1] - b[1]), centre: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] };
  };
  const drop = (event) => hands.delete(event.pointerId);

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    hands.set(event.pointerId, onStage(event));
    pointed(onStage(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    const now = onStage(event);
    pointed(now);
    const before = hands.get(event.pointerId);
    if (!before || !picture()) return;
    const pinch = hands.size === 2 ? spread() : null;
    hands.set(event.pointerId, now);
    if (pinch) {
      const { size, centre } = spread();
      zoomTo(picture(), (place.scale * size) / Math.max(pinch.size, 1), centre);
    } else {
      place.left += now[0] - before[0];
      place.top += now[1] - before[1];
      settle(picture());
    }
    moved();
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, drop);
  canvas.addEventListener(
    "pointerleave",
    (event) => hands.size || event.pointerType !== "mouse" || pointed(null),
  );
  canvas.addEventListener("wheel", (event) => onWheel(event, picture(), moved), { passive: false });
  canvas.addEventListener("keydown", (event) => onStageKey(event, picture(), moved));
}

/// Zooms; where there is nothing left to shrink the page scrolls on.
function onWheel(event, picture, moved) {
  if (!picture) return;
  const smallest = place.scale <= Math.min(fitScale(picture), 1);
  if (event.deltaY > 0 && smallest) return;
  event.preventDefault();
  const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
  zoomTo(picture, place.scale * Math.exp(-0.002 * lines * event.deltaY), onStage(event));
  moved();
}

function onStageKey(event, picture, moved) {
  const steps = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
  const zooms = { "+": 1.5, "=": 1.5, "-": 1 / 1.5 };
  if (!picture || event.ctrlKey || event.metaKey) return;
  if (steps[event.key]) {
    place.left += steps[event.key][0];
    place.top += steps[event.key][1];
    settle(picture);
  } else if (zooms[event.key]) zoomTo(picture, place.scale * zooms[event.key], middle());
  else if (event.key === "0") fit(picture);
  else if (event.key === "1") zoomTo(picture, 1, middle());
  else return;
  event.preventDefault();
  moved();
}

/// A line between two pictures that pointers and keys move; `moved` draws anew.
function splitHandle(moved) {
  const handle = make("div", {
    id: "split",
    role: "slider",
    tabindex: 0,
    "aria-label": "Where A ends and B begins",
    "aria-valuemin": 0,
    "aria-valuemax": 100,
  });
  const steps = {
    ArrowLeft: -0.02,
    ArrowDown: -0.02,
    ArrowRight: 0.02,
    ArrowUp: 0.02,
    PageDown: -0.1,
    PageUp: 0.1,
    Home: -1,
    End: 1,
  };
  const set = (part) => moved(Math.min(Math.max(part, 0), 1));
  handle.addEventListener("pointerdown", (event) => {
    handle.setPointerCapture(event.pointerId);
    event.preventDefault();
    handle.focus();
  });
  handle.addEventListener("pointermove", (event) => {
    if (handle.hasPointerCapture(event.pointerId)) set(onStage(event)[0] / stageSize()[0]);
  });
  handle.addEventListener("keydown", (event) => {
    if (!(event.key in steps)) return;
    event.preventDefault();
    set(Number(handle.getAttribute("aria-valuenow")) / 100 + steps[event.key]);
  });
  return handle;
}
