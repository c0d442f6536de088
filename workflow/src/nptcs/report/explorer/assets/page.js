// The controls of the explorer and what they show.

const ROOT = document.getElementById("explorer");
const GRID = 41;
const TRACE = 45;
const NEAR = 0.6;
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

// An interval in words; one narrower than the digits shown is written as its half width.
function intervalText(found, half) {
  if (found.low === undefined) return "–";
  if (half <= 1e-9 * Math.abs(found.value)) return say("exact");
  const [low, high] = [digits(found.low, half), digits(found.high, half)];
  return low === high ? `± ${shortNumber(Number(half.toPrecision(1)))}` : `${low} – ${high}`;
}

const unitText = (unit) => (unit ? ` ${unit}` : "");
const rootFactor = (name) => FACTOR[name];
const symbolOf = (name) => rootFactor(name).label;

// ---- controls ----------------------------------------------------------------------------------

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

// One factor: label, slider, number, and what is known of it.
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

// ---- the page ----------------------------------------------------------------------------------

function build() {
  const canvas = (key, className) => (parts[key] = make("canvas", { class: className, role: "img" }));
  const settings = make(
    "div",
    { class: "ex-settings", role: "group", "aria-label": say("settings") },
    chooser("study", say("study"), chooseStudy),
    chooser("solver", say("solver"), chooseSolver),
    chooser("model", say("model"), (value) => (state.model = value)),
    (parts.conditions = make("p", { class: "ex-note" })),
    ...DATA.factors.map(factorControl),
    loadControl(),
    bandControl(),
    (parts.plates = make("p", { class: "ex-plates", id: "ex-plates" })),
  );
  parts.warning = make("p", { class: "ex-warning", role: "status", id: "ex-warning" });
  parts.results = make("div", { class: "ex-results", id: "ex-results" });
  parts.profiles = make("div", { class: "ex-profiles", id: "ex-profiles" });
  const main = make(
    "div",
    { class: "ex-main" },
    parts.warning,
    make("h3", {}, say("results")),
    parts.results,
    copyButtons(),
    make("h3", {}, say("profiles")),
    legend(),
    parts.profiles,
  );
  const pair = make("div", { class: "ex-pair-plots" }, planeBlock(canvas), spaceBlock(canvas));
  const ring = make(
    "div",
    { class: "ex-pair-plots" },
    make("div", {}, make("h3", {}, say("ring")), canvas("ring", "ex-ring"), (parts.ringNote = make("p", { class: "ex-note", id: "ex-ring-note" })), ringLegend()),
    make("div", {}, make("h3", {}, say("curve")), canvas("curve", "ex-curve"), make("h3", {}, say("models")), (parts.models = make("div", { class: "ex-models", id: "ex-models", tabindex: 0, role: "region", "aria-label": say("models") }))),
  );
  parts.readout = make("p", { class: "ex-readout", "aria-hidden": "true" });
  ROOT.replaceChildren(parts.readout, make("div", { class: "ex-top" }, settings, main), pair, ring);
}

const item = (key, className) => make("span", { class: "ex-key" }, make("i", { class: `ex-swatch ${className}` }), say(key));

function legend() {
  return make(
    "p",
    { class: "ex-legend" },
    item("legend_value", "ex-s-model"),
    item("legend_interval", "ex-s-interval"),
    item("legend_bias", "ex-s-bias"),
    item("legend_band", "ex-s-band"),
    item("case", "ex-s-case"),
  );
}

function planeLegend() {
  return make("p", { class: "ex-legend" }, item("legend_edge", "ex-s-edge"), item("legend_sure", "ex-s-sure"), make("span", { class: "ex-key" }, say("legend_dim")), item("case", "ex-s-case"));
}

function ringLegend() {
  return make("p", { class: "ex-legend" }, item("spokes_tension", "ex-s-tension"), item("spokes_compression", "ex-s-compression"), make("span", { class: "ex-key" }, say("magnified")));
}

function planeBlock(canvas) {
  const other = (key, mine) => (value) => {
    if (state[mine] === value) state[mine] = state[key];
    state[key] = value;
  };
  const map = canvas("map", "ex-map");
  drag(map, (event) => {
    const box = map.getBoundingClientRect();
    const { x, y, frame } = map.scaleBack ?? {};
    if (!x) return;
    const within = (value, low, high) => Math.min(Math.max(value, low), high);
    const px = within(event.clientX - box.left, frame.left, frame.right);
    const py = within(event.clientY - box.top, frame.top, frame.bottom);
    setRounded(state.across, x(px));
    setRounded(state.up, y(py));
    changed();
  });
  return make(
    "div",
    {},
    make("h3", {}, say("plane")),
    make("div", { class: "ex-choices" }, chooser("across", say("across"), other("across", "up")), chooser("up", say("up"), other("up", "across")), chooser("shown", say("plane_response"), (value) => (state.shown = value))),
    map,
    planeLegend(),
    (parts.planeNote = make("p", { class: "ex-note", id: "ex-plane-note" })),
  );
}

function spaceBlock(canvas) {
  const angle = (key, low, high) => {
    const range = make("input", { type: "range", min: low, max: high, step: 1, id: `ex-${key}`, on: { input: () => ((state[key] = Number(range.value)), changed()) } });
    parts[key] = range;
    return make("label", { class: "ex-choice" }, make("span", {}, say(key)), range);
  };
  const space = canvas("space", "ex-space");
  let from = null;
  drag(space, (event, start) => {
    if (start) from = [event.clientX, event.clientY, state.turn, state.tilt];
    const turned = from[2] + (event.clientX - from[0]) * 0.6;
    state.turn = Math.round(((turned + 540) % 360) - 180);
    state.tilt = Math.round(Math.min(85, Math.max(5, from[3] + (event.clientY - from[1]) * 0.4)));
    changed();
  });
  return make("div", {}, make("h3", {}, say("view3d")), make("div", { class: "ex-choices" }, angle("turn", -180, 180), angle("tilt", 5, 85)), space);
}

// Call back while a pointer is down; vertical swipes on a phone still scroll past profiles.
function drag(canvas, listener) {
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    listener(event, true);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (canvas.hasPointerCapture(event.pointerId)) listener(event, false);
  });
}

// A pointer sets a factor to a step of its slider; a spacing to a whole number of plates.
function setRounded(name, value) {
  if (name === SPACING && solverOf().whole_plates) setValue(name, Number(wholePlates(value).pitch.toPrecision(12)));
  else {
    const { step } = sliderRange(name);
    setValue(name, Number((Math.round(value / step) * step).toPrecision(10)));
  }
}

// ---- what a state shows ------------------------------------------------------------------------

function showControls() {
  const study = studyOf();
  const solver = solverOf();
  fillSelect(parts.study, DATA.studies.map((one) => [one.name, one.title]), state.study);
  fillSelect(parts.solver, study.solvers.map((one) => [one.name, one.synthetic ? `${one.name} (${say("synthetic")})` : one.name]), state.solver);
  fillSelect(parts.model, [["", say("best")], ...namesOfModels().map((name) => [name, name])], state.model);
  const varied = study.factors.map((name) => [name, symbolOf(name)]);
  fillSelect(parts.across, varied, state.across);
  fillSelect(parts.up, varied, state.up);
  fillSelect(parts.shown, rowsOf().filter((row) => row.response).map((row) => [row.key, rowTitle(row)]), state.shown);
  parts.across.disabled = parts.up.disabled = study.factors.length < 2;
  parts.conditions.textContent = solver.about;
  for (const factor of DATA.factors) showFactor(factor, study);
  showLoad(solver);
  parts.band.forEach((input, i) => (input.value = tidy(state.band[i])));
  parts.turn.value = state.turn;
  parts.tilt.value = state.tilt;
}

function rowTitle(row) {
  return row.response?.at && row.kind === "surface" ? `${row.title} (${row.response.at})` : row.title;
}

function showFactor(factor, study) {
  const { range, number, note } = parts.factors[factor.name];
  const varied = study.factors.includes(factor.name);
  range.disabled = number.disabled = !varied;
  const value = valueOf(factor.name, study);
  number.value = value === undefined ? "" : tidy(value);
  if (!varied) {
    const held = value !== undefined;
    Object.assign(range, held ? { min: value - 1, max: value + 1, value } : { min: 0, max: 1, value: 0 });
    note.textContent = held ? say("held", { value: tidy(value), unit: factor.unit }) : say("not_in_study");
    return;
  }
  const { low, high, least, most, step } = sliderRange(factor.name);
  Object.assign(range, { min: Math.min(least, value), max: Math.max(most, value), step });
  range.value = value;
  number.step = step;
  range.setAttribute("aria-valuetext", `${tidy(value)} ${factor.unit}`);
  note.textContent = say("box", { low: shortNumber(low), high: shortNumber(high), unit: factor.unit });
}

function showLoad(solver) {
  const { range, number, note } = parts.load;
  const loads = loadsOf(solver);
  range.max = loads.length - 1;
  range.value = loads.indexOf(state.load);
  range.disabled = number.disabled = loads.length < 2;
  range.setAttribute("aria-valuetext", `${state.load} N`);
  number.value = state.load;
  note.textContent = loads.length < 2 ? say("one_load") : say("load_stops", { loads: loads.join(", ") });
}

function showPlates(study, solver) {
  const spacing = valueOf(SPACING, study);
  parts.plates.hidden = spacing === undefined;
  if (spacing === undefined) return;
  const { count, pitch } = wholePlates(spacing);
  const values = { solver: solver.name, count, pitch: pitch.toFixed(3), width: tidy(DATA.tyre.width_mm) };
  parts.plates.textContent = say(solver.whole_plates ? "plates_used" : "plates_given", values);
}

function showWarning(study, solver, point) {
  const stray = strayOf(study, solver, solver.responses[0], point);
  const list = stray.map((one) =>
    say("outside_one", { label: symbolOf(one.name), value: shortNumber(one.value), unit: FACTOR[one.name].unit, low: shortNumber(one.low), high: shortNumber(one.high) }),
  );
  parts.warning.textContent = stray.length ? say("outside", { list: list.join("; ") }) : say("inside");
  parts.warning.classList.toggle("ex-bad", stray.length > 0);
}

// One row of the prediction as cells of text.
function cellsOf(row, point, study, solver) {
  if (row.kind === "constant") return constantCells(row, study, solver);
  const surface = chosenSurface(row.response);
  const found = rowAt(row, point);
  const half = found.low === undefined ? 0 : (Math.min(found.high, 2 * found.value - found.low) - found.low) / 2;
  const bias = biasBand(study, solver, row, found.value);
  const notes = [];
  if (found.status === "absent") notes.push(say("not_by_model"));
  if (found.status === "refused") notes.push(say("refused"));
  if (found.status === "flagged") notes.push(say("flagged"));
  if (surface) notes.push(surface.name);
  if (row.kind === "displacement") notes.push(say("derived"));
  else if (surface && surface.rms !== null) notes.push(say("left_out", { rms: shortNumber(Number(surface.rms.toPrecision(2))), unit: row.unit }));
  let inBand = "";
  if (row.key === keyOf(row.response) && row.response.name === "secant_stiffness" && found.value !== undefined) {
    const [low, high] = state.band;
    inBand = found.value >= low && found.value <= high ? say(found.low >= low && found.high <= high ? "band_sure" : "band_in") : say("band_out");
  }
  return {
    title: rowTitle(row),
    value: found.value === undefined ? "–" : digits(found.value, half) + unitText(row.unit),
    interval: intervalText(found, half),
    bias: bias ? `${digits(bias[0], half)} – ${digits(bias[1], half)}` : "–",
    inBand,
    notes: notes.join(" · "),
  };
}

function constantCells(row, study, solver) {
  const { constant } = row;
  const known = constant.value !== null;
  const values = { name: constant.name, study: study.name, count: constant.solved, solver: solver.name };
  const notes = known ? say("constant", values) : constant.solved ? say("not_fitted", values) : say("not_given", values);
  return { title: row.title, value: known ? digits(constant.value, 0) + unitText(row.unit) : "–", interval: "–", bias: "–", inBand: "", notes };
}

function showResults(point, study, solver) {
  const head = ["response", "value_head", "interval_head", "bias_head"].map((key) => make("th", { scope: "col" }, say(key)));
  const rows = rowsOf().map((row) => {
    const cells = cellsOf(row, point, study, solver);
    const badge = cells.inBand ? make("span", { class: `ex-badge ${cells.inBand === say("band_out") ? "ex-out" : "ex-in"}` }, cells.inBand) : null;
    return make(
      "tr",
      { "data-row": row.key },
      make("th", { scope: "row" }, cells.title, badge, make("small", {}, cells.notes)),
      make("td", { class: "ex-value", "data-label": say("value_head") }, cells.value),
      make("td", { "data-label": say("interval_head") }, cells.interval),
      make("td", { "data-label": say("bias_head") }, cells.bias),
    );
  });
  const first = rowsOf().filter((row) => row.response).slice(0, 2).map((row) => cellsOf(row, point, study, solver));
  parts.readout.textContent = first.map((cells) => [cells.value, cells.inBand].filter(Boolean).join(", ")).join(" · ");
  parts.results.replaceChildren(make("table", {}, make("thead", {}, make("tr", {}, ...head)), make("tbody", {}, ...rows)), biasNote(solver));
}

function biasNote(solver) {
  const round = (value) => (value > 0 ? "+" : "") + value.toFixed(2);
  const bias = solver.bias;
  const words = bias
    ? say("bias_note", { cases: bias.cases, least: round(bias.low_percent), most: round(bias.high_percent), mean: round(bias.mean_percent) })
    : say(solver.name === "published" ? "bias_reference" : "bias_none");
  return make("p", { class: "ex-note" }, words);
}

// ---- profiles ----------------------------------------------------------------------------------

// How near a case is to the slice: 1 on it, 0 from a share of the half ranges on.
function nearness(study, solver, response, row, point, free) {
  const { low, high } = boxOf(solver, response);
  let far = 0;
  study.factors.forEach((name, i) => {
    if (!free.includes(name)) far = Math.max(far, Math.abs(row[i] - point[i]) / ((high[i] - low[i]) / 2));
  });
  return Math.max(0, 1 - far / NEAR);
}

function dotsOf(row, study, solver, point, free) {
  const turn = (value) => (row.kind === "displacement" ? state.load / value : value);
  return solver.points[row.response.points]
    .map((place, i) => ({ place, y: turn(row.response.values[i]), nearness: nearness(study, solver, row.response, place, point, free) }))
    .filter((dot) => dot.nearness > 0.02);
}

function showProfiles(point, study, solver) {
  const rows = rowsOf().filter((row) => row.response && chosenSurface(row.response));
  const wanted = rows.map((row) => row.key).join() + study.factors.join() + solver.name;
  if (parts.profiles.dataset.rows !== wanted) buildProfiles(rows, study, wanted);
  for (const row of rows) {
    const range = rangeOf(row);
    for (const name of study.factors) showProfile(row, name, point, study, solver, range);
  }
}

function buildProfiles(rows, study, wanted) {
  parts.plots = new Map();
  const blocks = rows.map((row) => {
    const canvases = study.factors.map((name, i) => {
      const canvas = make("canvas", { class: "ex-profile", role: "img" });
      drag(canvas, (event) => {
        const box = canvas.getBoundingClientRect();
        const range = sliderRange(name);
        const value = canvas.scaleBack(event.clientX - box.left);
        setRounded(name, Math.min(Math.max(value, range.least), range.most));
        changed();
      });
      canvas.dataset.place = i;
      parts.plots.set(`${row.key}|${name}`, canvas);
      const place = i % 3 === 0 ? " ex-first" : "";
      return make("div", { class: `ex-cell${place}` }, canvas, make("span", { class: "ex-axis" }, symbolOf(name)));
    });
    return make("div", { class: "ex-line" }, make("p", { class: "ex-name" }, make("strong", {}, row.title), ` ${row.unit}`, make("span", { class: "ex-here" })), make("div", { class: "ex-cells", style: `--count:${study.factors.length}` }, ...canvases));
  });
  parts.profiles.replaceChildren(...blocks);
  parts.profiles.dataset.rows = wanted;
}

// The range of a row's axis: its cases, and the target band where it is near.
function rangeOf(row) {
  const turn = (value) => (row.kind === "displacement" ? state.load / value : value);
  const values = row.response.values.map(turn);
  let [low, high] = [Math.min(...values), Math.max(...values)];
  const pad = (high - low) * 0.08 || Math.abs(high) * 0.05 || 1;
  return [low - pad, high + pad];
}

function traceOf(row, name, point, study, solver, low, high) {
  const column = study.factors.indexOf(name);
  return Array.from({ length: TRACE }, (_, k) => {
    const x = low + ((high - low) * k) / (TRACE - 1);
    const place = point.map((value, i) => (i === column ? x : value));
    const found = rowAt(row, place, study, solver);
    const bias = found.low === undefined ? null : biasBand(study, solver, row, found.value);
    return { x, ...found, bias };
  });
}

function showProfile(row, name, point, study, solver, yRange) {
  const column = study.factors.indexOf(name);
  const { low, high, least, most } = sliderRange(name);
  const pad = (high - low) * 0.06;
  const xRange = [Math.min(Math.max(low - pad, least), point[column]), Math.max(Math.min(high + pad, most), point[column])];
  const trace = traceOf(row, name, point, study, solver, low, high);
  const here = { x: point[column], ...rowAt(row, point, study, solver) };
  const stiffness = row.kind === "surface" && row.response.name === "secant_stiffness";
  const band = stiffness ? state.band : row.kind === "displacement" ? state.band.map((end) => state.load / end).reverse() : null;
  const canvas = parts.plots.get(`${row.key}|${name}`);
  const dots = dotsOf(row, study, solver, point, [name]).map((dot) => ({ ...dot, x: dot.place[column] }));
  const first = Number(canvas.dataset.place) % (NARROW.matches ? 3 : study.factors.length) === 0;
  drawProfile(canvas, { first, xRange, yRange, trace, here, band, dots, bias: trace.some((p) => p.bias) });
  const names = { response: rowTitle(row), factor: symbolOf(name) };
  const ends = [trace[0].value, here.value, trace.at(-1).value];
  const words = ends.every(Number.isFinite)
    ? say("profile_alt", { ...names, start: digits(ends[0], 0), here: digits(ends[1], 0), end: digits(ends[2], 0), low: shortNumber(low), high: shortNumber(high), unit: FACTOR[name].unit })
    : say("profile_refused", names);
  canvas.setAttribute("aria-label", words);
  canvas.closest(".ex-line").querySelector(".ex-here").textContent = here.value === undefined ? ` – ${say("no_value")}` : ` ${digits(here.value, 0)}`;
}

// ---- the plane and the view in space -----------------------------------------------------------

// The shown response and the stiffness over the plane of two factors.
function gridOf(point, study, solver) {
  const row = rowsOf().find((one) => one.key === state.shown);
  const stiffness = rowsOf().find((one) => one.kind === "surface" && one.response?.name === "secant_stiffness");
  const columns = [state.across, state.up].map((name) => study.factors.indexOf(name));
  const ranges = columns.map((column) => {
    const { low, high } = boxOf(solver, row.response);
    return [low[column], high[column]];
  });
  const along = ([low, high]) => Array.from({ length: GRID }, (_, k) => low + ((high - low) * k) / (GRID - 1));
  const [xs, ys] = ranges.map(along);
  const values = [];
  let [inside, sure, known] = [0, 0, 0];
  const cells = ys.map((y) =>
    xs.map((x) => {
      const place = [...point];
      [place[columns[0]], place[columns[1]]] = [x, y];
      const found = rowAt(row, place, study, solver, false);
      const k = stiffness ? rowAt(stiffness, place, study, solver) : {};
      const value = found.status === "inside" ? found.value : undefined;
      if (value !== undefined) values.push(value);
      const feasible = k.value >= state.band[0] && k.value <= state.band[1];
      if (k.value !== undefined) known += 1;
      if (feasible) inside += 1;
      if (feasible && k.low >= state.band[0] && k.high <= state.band[1]) sure += 1;
      return { value, stiffness: k.value, lowStiffness: k.low, highStiffness: k.high, feasible };
    }),
  );
  if (!values.length) return null;
  const label = (name) => `${symbolOf(name)} [${FACTOR[name].unit}]`;
  return {
    xs,
    ys,
    cells,
    row,
    xRange: ranges[0],
    yRange: ranges[1],
    range: [Math.min(...values), Math.max(...values)],
    band: state.band,
    here: [point[columns[0]], point[columns[1]]],
    hereValue: rowAt(row, point, study, solver, false).value,
    xLabel: label(state.across),
    yLabel: label(state.up),
    rails: state.across === SPACING && solver.whole_plates ? pitches(ranges[0]) : [],
    dots: dotsOf(row, study, solver, point, [state.across, state.up]).map((dot) => ({ ...dot, x: dot.place[columns[0]], y: dot.place[columns[1]] })),
    shares: [inside, sure].map((count) => (known ? (100 * count) / known : 0)),
  };
}

function pitches([low, high]) {
  const { width_mm: width } = DATA.tyre;
  const found = [];
  for (let count = Math.ceil(width / high - 1e-9); width / count >= low - 1e-9; count++) found.push(width / count);
  return found;
}

function showPlane(point, study, solver) {
  const grid = study.factors.length < 2 ? null : gridOf(point, study, solver);
  if (!grid) {
    prepared(parts.map);
    prepared(parts.space);
    const words = say(study.factors.length < 2 ? "plane_one" : "plane_none");
    parts.planeNote.textContent = words;
    parts.map.setAttribute("aria-label", words);
    parts.space.setAttribute("aria-label", words);
    return;
  }
  drawMap(parts.map, grid);
  drawSpace(parts.space, grid, state.turn, state.tilt);
  const [share, sure] = grid.shares.map((value) => value.toFixed(1));
  const names = { response: rowTitle(grid.row), across: symbolOf(state.across), up: symbolOf(state.up) };
  parts.planeNote.textContent = say("plane_share", { share, sure });
  parts.map.setAttribute("aria-label", say("plane_alt", { ...names, share }));
  parts.space.setAttribute("aria-label", say("view3d_alt", { ...names, turn: state.turn }));
}

// ---- ring, curve, all models -------------------------------------------------------------------

function showRing(point, study, solver) {
  const row = rowsOf().find((one) => one.kind === "displacement");
  const found = row ? rowAt(row, point, study, solver, false) : {};
  const { solved, words, alt } = solvedRing(study, found.value);
  parts.ring.hidden = !solved;
  if (solved) drawRing(parts.ring, solved);
  parts.ringNote.textContent = words;
  parts.ring.setAttribute("aria-label", alt ?? words);
}

function showCurve(point, study, solver) {
  const points = [];
  for (const response of solver.responses.filter((one) => one.name === "secant_stiffness")) {
    const surface = chosenSurface(response);
    if (!surface) continue;
    const found = asDisplacement(evaluate(study, solver, response, surface, point), response.load_n);
    if (found.value !== undefined) points.push({ load: response.load_n, ...found });
  }
  const { context, width, height } = prepared(parts.curve);
  const list = points.map((one) => say("curve_point", { load: one.load, delta: digits(one.value, 0) })).join(", ");
  parts.curve.setAttribute("aria-label", points.length ? say("curve_alt", { list }) : say("no_value"));
  if (!points.length) return;
  const frame = { left: 52, right: width - 12, top: 8, bottom: height - 36 };
  const ranges = [[0, Math.max(...points.map((p) => p.value)) * 1.15], [0, Math.max(...points.map((p) => p.load)) * 1.12]];
  const x = scaleOf(...ranges[0], frame.left, frame.right);
  const y = scaleOf(...ranges[1], frame.bottom, frame.top);
  axes(context, frame, x, y, ...ranges, 5, 4);
  context.strokeStyle = COLOURS.model;
  context.lineWidth = 1.5;
  context.setLineDash([4, 3]);
  line(context, [[x(0), y(0)], ...points.map((p) => [x(p.value), y(p.load)])]);
  context.setLineDash([]);
  context.fillStyle = COLOURS.model;
  for (const p of points) {
    if (p.low !== undefined && Number.isFinite(p.high)) line(context, [[x(p.low), y(p.load)], [x(p.high), y(p.load)]]);
    disc(context, x(p.value), y(p.load), p.load === state.load ? 5 : 3.2);
  }
  axisLabels(context, frame, { xLabel: `${say("displacement")} [mm]`, yLabel: `${say("load")} [N]` }, height);
}

// Values that a study holds and that are not those of this design.
function otherConditions(study) {
  return Object.entries(study.fixed).filter(([name, value]) => {
    const here = valueOf(name);
    return here !== undefined && Math.abs(here - value) > 1e-9 * Math.abs(value);
  });
}

function showModels(study) {
  const row = rowsOf().find((one) => one.key === state.shown);
  const [name, at] = [row.response.name, row.response.at];
  const body = [];
  const first = (list, mine) => [...list].sort((a, b) => (b.name === mine) - (a.name === mine));
  for (const other of first(DATA.studies, state.study)) {
    const differs = otherConditions(other);
    const list = differs.map(([factor, value]) => `${symbolOf(factor)} ${tidy(value)} ${FACTOR[factor].unit}`).join(", ");
    const place = other.factors.map((factor) => valueOf(factor, study) ?? state.values[factor]);
    for (const solver of first(other.solvers, state.solver)) {
      const response = solver.responses.find((one) => one.name === name && one.at === at);
      for (const surface of response?.surfaces ?? []) body.push(modelRow(other, solver, response, surface, place, row, list));
    }
  }
  const head = ["model", "value_head", "interval_head", "left_out_head"].map((key) => make("th", { scope: "col" }, say(key)));
  parts.models.replaceChildren(
    make("p", { class: "ex-note" }, say("models_lead", { response: rowTitle(row) })),
    make("table", {}, make("thead", {}, make("tr", {}, ...head)), make("tbody", {}, ...body)),
  );
}

function modelRow(study, solver, response, surface, place, row, list) {
  const point = place.map((value, i) => (study.factors[i] === SPACING && solver.whole_plates ? wholePlates(value).pitch : value));
  const stiffness = evaluate(study, solver, response, surface, point);
  const found = row.kind === "displacement" ? asDisplacement(stiffness, response.load_n) : stiffness;
  const half = found.low === undefined ? 0 : (Math.min(found.high, 2 * found.value - found.low) - found.low) / 2;
  const bias = biasBand(study, solver, { kind: row.kind, response }, found.value);
  const notes = [`${study.name}, ${solver.name}`];
  if (list) notes.push(say("not_same", { list }));
  if (found.status !== "inside") notes.push(say(found.status));
  if (bias) notes.push(`${say("bias_head")} ${digits(bias[0], half)} – ${digits(bias[1], half)}`);
  const chosen = study.name === state.study && solver.name === state.solver && chosenSurface(response) === surface;
  return make(
    "tr",
    { class: chosen ? "ex-chosen" : list ? "ex-other" : "" },
    make("th", { scope: "row" }, surface.name, make("small", {}, notes.join(" · "))),
    make("td", { class: "ex-value" }, found.value === undefined ? "–" : digits(found.value, half)),
    make("td", {}, intervalText(found, half)),
    make("td", {}, surface.rms === null || row.kind === "displacement" ? "–" : shortNumber(Number(surface.rms.toPrecision(2)))),
  );
}

// ---- one pass from the state to the page -------------------------------------------------------

function show() {
  readColours(ROOT);
  settleShown();
  const study = studyOf();
  const solver = solverOf();
  const point = pointOf(study, solver);
  showControls();
  showPlates(study, solver);
  showWarning(study, solver, point);
  showResults(point, study, solver);
  showProfiles(point, study, solver);
  showPlane(point, study, solver);
  showRing(point, study, solver);
  showCurve(point, study, solver);
  showModels(study);
}

let waiting = false;

// Draw at the next frame, however many changes there are until then, and keep the state.
function changed() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    show();
    if (location.hash.slice(1) !== stateText()) history.replaceState(null, "", `#${stateText()}`);
  });
}

function start() {
  build();
  resetState();
  const restored = readState(location.hash.slice(1));
  show();
  if (restored) ROOT.scrollIntoView();
  window.addEventListener("hashchange", () => readState(location.hash.slice(1)) && show());
  new ResizeObserver(() => requestAnimationFrame(show)).observe(ROOT);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", show);
  new MutationObserver(show).observe(document.documentElement, { attributeFilter: ["data-theme"] });
}

start();
