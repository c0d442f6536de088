// The parts of the explorer and their place on the page.

function build() {
  const canvas = (key, className) => (parts[key] = make("canvas", { class: className, role: "img" }));
  const settings = make(
    "div",
    { class: "ex-settings", role: "group", "aria-label": say("settings") },
    chooser("study", say("study"), chooseStudy),
    chooser("solver", say("solver"), chooseSolver),
    chooser("model", say("model"), (value) => (state.model = value)),
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
