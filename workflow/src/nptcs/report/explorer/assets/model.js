// The state of the explorer and what the stored surfaces say of it. No document here.

const DATA = JSON.parse(document.getElementById("explorer-data").textContent);
const WORDS = DATA.words;

// A text with its values put in.
function say(key, values = {}) {
  return WORDS[key].replace(/\{(\w+)\}/g, (whole, name) => (name in values ? values[name] : whole));
}

const FACTOR = Object.fromEntries(DATA.factors.map((factor) => [factor.name, factor]));
const SPACING = "spacing_mm";
const SLACK = 1e-9;

const state = {
  study: "",
  solver: "",
  model: "",
  load: 0,
  values: {},
  band: [0, 0],
  across: "",
  up: "",
  shown: "",
  turn: 30,
  tilt: 30,
};

const studyOf = (name = state.study) => DATA.studies.find((study) => study.name === name);
const solverOf = (study = studyOf(), name = state.solver) => study.solvers.find((solver) => solver.name === name);
const keyOf = (response) => `${response.name}@${response.at}`;

// Loads of the chosen solver that have a surface of the secant stiffness.
function loadsOf(solver) {
  return solver.responses.filter((r) => r.name === "secant_stiffness" && r.load_n).map((r) => r.load_n);
}

// Number of plates and their pitch when they share the width: TyreGeometry.plates_across.
function wholePlates(spacing) {
  const { width_mm: width, plate_width_mm: plate } = DATA.tyre;
  const count = Math.floor((width - plate) / spacing + 1e-9) + 1;
  return { count, pitch: width / count };
}

// Value of a factor of this design: held by the study, or the slider's.
function valueOf(name, study = studyOf()) {
  if (study.factors.includes(name)) return state.values[name];
  return name in study.fixed ? study.fixed[name] : undefined;
}

// Values of a study's factors as a solver uses them.
function pointOf(study, solver, changes = {}) {
  return study.factors.map((name) => {
    if (name in changes) return changes[name];
    const value = state.values[name];
    return name === SPACING && solver.whole_plates ? wholePlates(value).pitch : value;
  });
}

// ---- surfaces, made when first asked for -------------------------------------------------------

const MADE = new Map();

function made(study, solver, response, surface) {
  const key = [study.name, solver.name, keyOf(response), surface.name].join("|");
  if (!MADE.has(key)) {
    const columns = surface.plain.factors.map((name) => study.factors.indexOf(name));
    const cases = solver.points[response.points];
    const ordered = cases.map((row) => columns.map((column) => row[column]));
    MADE.set(key, { columns, surface: makeSurface(surface.plain, ordered) });
  }
  return MADE.get(key);
}

function boxOf(solver, response) {
  const cases = solver.points[response.points];
  if (!response.box) {
    const of = (choose) => cases[0].map((_, i) => choose(...cases.map((row) => row[i])));
    response.box = { low: of(Math.min), high: of(Math.max) };
  }
  return response.box;
}

// Factors of a point that lie outside the box of a response's cases.
function strayOf(study, solver, response, point) {
  const { low, high } = boxOf(solver, response);
  return study.factors
    .map((name, i) => ({ name, value: point[i], low: low[i], high: high[i] }))
    .filter((one) => {
      const slack = SLACK * (one.high - one.low);
      return !(one.value >= one.low - slack && one.value <= one.high + slack);
    });
}

// What one surface says of a point: {status, value, low, high}.
function evaluate(study, solver, response, surface, point, withInterval = true) {
  const outside = strayOf(study, solver, response, point).length > 0;
  if (outside && surface.outside === "refused") return { status: "refused" };
  const { columns, surface: computed } = made(study, solver, response, surface);
  const ordered = columns.map((column) => point[column]);
  const value = computed.predict(ordered);
  if (outside) return { status: "flagged", value };
  if (!withInterval) return { status: "inside", value };
  const [low, high] = computed.interval(ordered);
  return { status: "inside", value, low, high };
}

// The chosen surface of a response: the named one, or that with the smallest left-out error.
function chosenSurface(response) {
  if (state.model) return response.surfaces.find((surface) => surface.name === state.model) ?? null;
  const rank = (surface) => surface.rms ?? Infinity;
  return response.surfaces.reduce((best, one) => (rank(one) < rank(best) ? one : best));
}

// Displacement F/K with its bounds from those of the stiffness.
function asDisplacement(found, load) {
  if (found.value === undefined) return found;
  if (!(found.value > 0)) return { status: "refused" };
  const turned = { status: found.status, value: load / found.value };
  if (found.low !== undefined) {
    turned.low = load / found.high;
    turned.high = found.low > 0 ? load / found.low : Infinity;
  }
  return turned;
}

// Where the published value lies if blind cases differ from it as they do: for the stiffness at
// the study's load, and what follows from it.
function biasBand(study, solver, row, value) {
  const bias = solver.bias;
  if (!bias || value === undefined || row.response?.name !== "secant_stiffness") return null;
  if (row.response.load_n !== study.load_n) return null;
  const ends = [1 + bias.high_percent / 100, 1 + bias.low_percent / 100];
  return row.kind === "displacement" ? [value * ends[1], value * ends[0]] : [value / ends[0], value / ends[1]];
}

// Rows of the prediction: stiffness at the load, displacement, other responses, those without one.
function rowsOf(study = studyOf(), solver = solverOf()) {
  const rows = [];
  for (const response of solver.responses) {
    if (response.name === "secant_stiffness" && response.load_n !== state.load) continue;
    rows.push({ kind: "surface", key: keyOf(response), title: response.title, unit: response.unit, response });
    if (response.name === "secant_stiffness") {
      rows.push({ kind: "displacement", key: "displacement", title: say("displacement"), unit: "mm", response });
    }
  }
  for (const constant of solver.constants) {
    rows.push({ kind: "constant", key: constant.name, title: constant.title, unit: constant.unit, constant });
  }
  return rows;
}

// What the chosen model says of a row at a point.
function rowAt(row, point, study = studyOf(), solver = solverOf(), withInterval = true) {
  const surface = chosenSurface(row.response);
  if (!surface) return { status: "absent" };
  const found = evaluate(study, solver, row.response, surface, point, withInterval);
  return row.kind === "displacement" ? asDisplacement(found, state.load) : found;
}

// ---- state in the address ----------------------------------------------------------------------

const tidy = (value) => String(Number(Number(value).toPrecision(10)));

function stateText() {
  const study = studyOf();
  const parts = DATA.factors
    .filter((factor) => study.factors.includes(factor.name))
    .map((factor) => [factor.key, tidy(state.values[factor.name])]);
  parts.push(["load", tidy(state.load)], ["study", state.study], ["solver", state.solver]);
  if (state.model) parts.push(["model", state.model]);
  parts.push(["band", state.band.map(tidy).join("..")], ["x", FACTOR[state.across]?.key ?? ""]);
  parts.push(["y", FACTOR[state.up]?.key ?? ""], ["shown", state.shown]);
  parts.push(["turn", tidy(state.turn)], ["tilt", tidy(state.tilt)]);
  return parts.map(([key, value]) => `${key}=${encodeURIComponent(value)}`).join("&");
}

// Take what can be taken from the address; anything that does not exist here is left out.
function readState(text) {
  if (!text.includes("=")) return false;
  const given = new Map(
    text.split("&").map((part) => {
      const [key, value = ""] = part.split("=");
      try {
        return [key, decodeURIComponent(value)];
      } catch {
        return [key, ""];
      }
    }),
  );
  const number = (key) => (given.get(key)?.trim() ? Number(given.get(key)) : NaN);
  if (studyOf(given.get("study") ?? "")) chooseStudy(given.get("study"));
  if (solverOf(studyOf(), given.get("solver") ?? "")) chooseSolver(given.get("solver"));
  if (namesOfModels().includes(given.get("model"))) state.model = given.get("model");
  for (const factor of DATA.factors) {
    const value = number(factor.key);
    if (Number.isFinite(value) && studyOf().factors.includes(factor.name)) setValue(factor.name, value);
  }
  if (loadsOf(solverOf()).includes(number("load"))) state.load = number("load");
  settleShown();
  const band = (given.get("band") ?? "").split("..").map((end) => (end.trim() ? Number(end) : NaN));
  if (band.length === 2 && band.every(Number.isFinite) && band[0] < band[1]) state.band = band;
  const named = (key) => DATA.factors.find((factor) => factor.key === given.get(key))?.name;
  const [across, up] = [named("x"), named("y")];
  const varied = studyOf().factors;
  if (varied.includes(across) && varied.includes(up) && across !== up) Object.assign(state, { across, up });
  if (rowsOf().some((row) => row.key === given.get("shown") && row.response)) state.shown = given.get("shown");
  for (const [key, low, high] of [["turn", -180, 180], ["tilt", 5, 85]]) {
    if (number(key) >= low && number(key) <= high) state[key] = number(key);
  }
  return true;
}

function namesOfModels() {
  return [...new Set(solverOf().responses.flatMap((response) => response.surfaces.map((one) => one.name)))];
}

// Ends of a slider: the box of the cases and a fifth on each side, where that is a possible value.
function sliderRange(name) {
  const study = studyOf();
  const solver = solverOf();
  const column = study.factors.indexOf(name);
  const { low, high } = boxOf(solver, solver.responses[0]);
  const width = high[column] - low[column];
  const step = study.steps[name] ?? 10 ** Math.floor(Math.log10(width / 50));
  const round = (value, way) => Number((way(value / step - way(0)) * step).toPrecision(10));
  let [least, most] = [round(low[column] - width / 5, Math.floor), round(high[column] + width / 5, Math.ceil)];
  if (name === "angle_deg") [least, most] = [0, 90];
  else least = Math.max(least, name === SPACING ? DATA.tyre.plate_width_mm : step);
  return { low: low[column], high: high[column], least, most, step };
}

// A factor must stay possible: above zero, an angle within 0 to 90 degrees.
function setValue(name, value) {
  if (name === "angle_deg") state.values[name] = Math.min(90, Math.max(0, value));
  else if (value > 0) state.values[name] = value;
}

function chooseStudy(name) {
  state.study = name;
  const study = studyOf();
  const known = study.solvers.find((solver) => solver.name === state.solver);
  chooseSolver((known ?? bestSolver(study)).name);
  for (const factor of study.factors) {
    if (!(state.values[factor] > 0 || state.values[factor] === 0)) state.values[factor] = referenceOf(study, factor);
  }
  if (!study.factors.includes(state.across) || !study.factors.includes(state.up) || state.across === state.up) {
    [state.across, state.up = ""] = study.factors;
  }
  state.band = study.band ?? defaultBand();
}

// The solver with most responses comes first; the published archive has the stiffness alone.
function bestSolver(study) {
  return study.solvers.reduce((best, one) => (one.responses.length > best.responses.length ? one : best));
}

function chooseSolver(name) {
  state.solver = name;
  const solver = solverOf();
  const loads = loadsOf(solver);
  if (!loads.includes(state.load)) state.load = loads.includes(studyOf().load_n) ? studyOf().load_n : loads.at(-1);
  if (state.model && !namesOfModels().includes(state.model)) state.model = "";
  settleShown();
}

// The plane shows a response that there is: with another load, the stiffness at that load.
function settleShown() {
  const rows = rowsOf().filter((row) => row.response);
  if (!rows.some((row) => row.key === state.shown)) state.shown = rows[0].key;
}

function referenceOf(study, name) {
  if (name in study.reference) return study.reference[name];
  for (const other of DATA.studies) {
    const known = other.fixed[name] ?? other.reference[name];
    const { low, high } = boxOf(bestSolver(study), bestSolver(study).responses[0]);
    const column = study.factors.indexOf(name);
    if (known >= low[column] && known <= high[column]) return known;
  }
  const { low, high } = boxOf(bestSolver(study), bestSolver(study).responses[0]);
  const column = study.factors.indexOf(name);
  return Number(((low[column] + high[column]) / 2).toPrecision(4));
}

// Two per cent about the stiffness of the reference design.
function defaultBand() {
  const study = studyOf();
  const solver = solverOf();
  const row = rowsOf().find((one) => one.kind === "surface");
  const found = rowAt(row, pointOf(study, solver), study, solver, false);
  const middle = found.value ?? row.response.values[0];
  return [0.98, 1.02].map((share) => Number((middle * share).toPrecision(3)));
}

function resetState() {
  state.values = {};
  for (const study of DATA.studies) {
    for (const name of study.factors) state.values[name] ??= referenceOf(study, name);
  }
  chooseStudy(state.study || DATA.studies[0].name);
}

// ---- what can be copied ------------------------------------------------------------------------

function quoted(text) {
  return /^[\w.=@+-]+$/.test(text) ? text : `"${text}"`;
}

// `nptcs design` for the target band; with `held`, of this design alone.
function designCommand(held) {
  const study = studyOf();
  const solver = solverOf();
  const stiffness = rowsOf().find((row) => row.response?.name === "secant_stiffness");
  const surface = chosenSurface(stiffness.response) ?? stiffness.response.surfaces[0];
  const [low, high] = state.band;
  const goal = `K=${tidy((low + high) / 2)}+-${tidy((high - low) / 2)}@${tidy(state.load)}`;
  const parts = ["nptcs design", "--study", study.name, "--solver", solver.name, "--surface", quoted(surface.name)];
  parts.push("--target", quoted(goal));
  if (held) for (const name of study.factors) parts.push("--hold", `${name}=${tidy(state.values[name])}`);
  else {
    if (solver.responses.some((response) => response.name === "plate_mass")) parts.push("--minimise", "plate_mass");
    for (const [name, step] of Object.entries(study.steps)) parts.push("--step", `${name}=${tidy(step)}`);
  }
  return parts.join(" ");
}

// The design as a further case of its study.
function configBlock() {
  const study = studyOf();
  const values = study.factors.map((name) => `${name}: ${tidy(state.values[name])}`).join(", ");
  return `${say("config_lead", { study: study.name })}\n    further_cases:\n      - {${values}}\n`;
}
