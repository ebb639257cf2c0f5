// Elements. Text goes in as text only: no name in the data is ever read as HTML.

const SVG = "http://www.w3.org/2000/svg";

function byId(id) {
  return document.getElementById(id);
}

function filled(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

/// An HTML element; attributes beginning with `on` are listeners.
function make(tag, attributes = {}, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

/// An SVG element.
function draw(tag, attributes = {}, ...children) {
  return filled(document.createElementNS(SVG, tag), attributes, children);
}

/// Text in which `this` is code.
function marked(text) {
  return text.split("`").map((part, index) => (index % 2 ? make("code", {}, part) : part));
}

/// The mark of a curve, for texts.
function swatch(style) {
  const mark = draw("path", { class: "mark", d: style.shape, transform: "scale(4.6)" });
  return draw(
    "svg",
    { class: "swatch tint", viewBox: "-8 -8 16 16", style: tint(style), "aria-hidden": true },
    mark,
  );
}

/// Both colours of a curve; the style sheet chooses.
function tint(style) {
  return `--light:${style.light};--dark:${style.dark}`;
}

/// Words that break within only where a line is too short for one.
function words(text) {
  return text
    .split(" ")
    .flatMap((word) => [make("span", { class: "word" }, word), " "])
    .slice(0, -1);
}

/// A command with a button that copies it.
function command(text) {
  const code = make("code", { title: text }, words(text));
  const button = make(
    "button",
    { class: "copy", type: "button", "aria-label": `Copy: ${text}`, onclick: copy },
    "copy",
  );
  async function copy(event) {
    event.stopPropagation();
    button.textContent = (await copied(text)) ? "copied" : "press Ctrl+C";
    setTimeout(() => (button.textContent = "copy"), 1500);
  }
  return make("div", { class: "command" }, code, button);
}

/// Whether text is in the clipboard; where the browser keeps it shut, it is at least selected.
async function copied(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = make("textarea", { style: "position:fixed;opacity:0" });
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  }
}
