// The controls of the explorer and what they show.

const ROOT = document.getElementById("explorer");
const GRID = 41;
const TRACE = 45;
const NEAR = 0.6;
const PAUSE_MS = 60;
const NARROW = matchMedia("(max-width: 760px)");

// An element with attributes and children; `on` holds listeners.
function make(tag, attributes = {}, ...children) {
  const { on = {}, ...rest } = attributes;
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(rest)) {
    if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== undefined) element.setAttribute(name, value);
  }
  for (const [name, listener] of Object.entries(on)) element.addEventListener(name, listener);
  element.append(...children.filter((child) => child !== null));
  return element;
}

// Digits that the interval's half width justifies, three to six significant ones.
function digits(value, half) {
  if (!Number.isFinite(value)) return say("unbounded");
  let count = 4;
  if (half > 0 && value !== 0) count = Math.ceil(Math.log10(Math.abs(value) / half)) + 2;
  return Number(value.toPrecision(Math.min(5, Math.max(3, count)))).toString();
}

// An interval in words; one narrower than the digits shown is written as "± <" the last digit.
function intervalText(found, half) {
  if (found.low === undefined) return "–";
  if (half <= 1e-9 * Math.abs(found.value)) return say("exact");
  const [low, high] = [digits(found.low, half), digits(found.high, half)];
  if (low !== high) return `${low} – ${high}`;
  const last = 10 ** (Math.floor(Math.log10(Math.abs(found.value))) - 4);
  return `± < ${shortNumber(Number(last.toPrecision(1)))}`;
}

const unitText = (unit) => (unit ? ` ${unit}` : "");
const rootFactor = (name) => FACTOR[name];
const symbolOf = (name) => rootFactor(name).label;


const parts = {};

function chooser(key, words, change) {
  const select = make("select", { id: `ex-${key}`, on: { change: () => (change(select.value), changed()) } });
  parts[key] = select;
  return make("label", { class: "ex-choice" }, make("span", {}, words), select);
}

function fillSelect(select, options, value) {
  select.replaceChildren(...options.map(([key, words]) => make("option", { value: key }, words)));
  select.value = value;
}

// One factor: label, slider, number, and what is known about it.
function factorControl(factor) {
  const label = factor.label;
  const slide = (event) => (setValue(factor.name, Number(event.target.value)), changed());
  const range = make("input", { type: "range", "aria-label": say("slider", { label }), on: { input: slide } });
  const number = make("input", {
    type: "number",
    inputmode: "decimal",
    "aria-label": say("number", { label }),
    on: { change: slide },
  });
  const note = make("p", { class: "ex-note", id: `ex-note-${factor.key}` });
  range.setAttribute("aria-describedby", note.id);
  parts.factors ??= {};
  parts.factors[factor.name] = { range, number, note };
  return make(
    "div",
    { class: "ex-factor", "data-factor": factor.key },
    make("div", { class: "ex-row" }, make("strong", {}, label), make("span", { class: "ex-pair" }, number, make("span", { class: "ex-unit" }, factor.unit))),
    range,
    note,
  );
}

function loadControl() {
  const label = say("load");
  const pick = (index) => ((state.load = loadsOf(solverOf())[index]), changed());
  const nearest = (event) => {
    const loads = loadsOf(solverOf());
    const wanted = Number(event.target.value);
    pick(loads.reduce((best, load, i) => (Math.abs(load - wanted) < Math.abs(loads[best] - wanted) ? i : best), 0));
  };
  const range = make("input", { type: "range", min: 0, step: 1, "aria-label": say("slider", { label }), on: { input: (event) => pick(Number(event.target.value)) } });
  const number = make("input", { type: "number", inputmode: "decimal", "aria-label": say("number", { label }), on: { change: nearest } });
  const note = make("p", { class: "ex-note", id: "ex-note-load" });
  range.setAttribute("aria-describedby", note.id);
  parts.load = { range, number, note };
  return make(
    "div",
    { class: "ex-factor", "data-factor": "load" },
    make("div", { class: "ex-row" }, make("strong", {}, label), make("span", { class: "ex-pair" }, number, make("span", { class: "ex-unit" }, "N"))),
    range,
    note,
  );
}

function bandControl() {
  const end = (index) => (event) => {
    const value = Number(event.target.value);
    const band = state.band.map((old, i) => (i === index ? value : old));
    if (Number.isFinite(value) && band[0] < band[1]) state.band = band;
    changed();
  };
  parts.band = [0, 1].map((i) =>
    make("input", { type: "number", step: "any", inputmode: "decimal", "aria-label": say(i ? "band_high" : "band_low"), on: { change: end(i) } }),
  );
  return make(
    "div",
    { class: "ex-factor" },
    make("div", { class: "ex-row" }, make("strong", {}, say("band")), make("span", { class: "ex-pair" }, parts.band[0], "–", parts.band[1], make("span", { class: "ex-unit" }, "N/mm"))),
  );
}

function copyButtons() {
  const button = (key, text) => make("button", { type: "button", id: `ex-${key}`, on: { click: () => copy(text()) } }, say(key));
  const address = () => `${location.href.split("#")[0]}#${stateText()}`;
  parts.copied = make("p", { class: "ex-note", role: "status", id: "ex-copied" });
  parts.text = make("textarea", { readonly: true, rows: 3, hidden: true, "aria-label": say("copy_by_hand"), id: "ex-text" });
  return make(
    "div",
    { class: "ex-buttons" },
    button("copy_find", () => designCommand(false)),
    button("copy_judge", () => designCommand(true)),
    button("copy_config", configBlock),
    button("copy_link", address),
    make("button", { type: "button", id: "ex-reset", on: { click: () => (resetState(), changed()) } }, say("reset")),
    parts.copied,
    parts.text,
  );
}

// Put a text on the clipboard; it is also shown, for pages that may not use the clipboard.
async function copy(text) {
  parts.text.hidden = false;
  parts.text.value = text;
  parts.text.rows = Math.min(6, text.split("\n").length + 1);
  try {
    await navigator.clipboard.writeText(text);
    parts.copied.textContent = say("copied");
  } catch {
    parts.text.select();
    parts.copied.textContent = say("copy_by_hand");
  }
}
