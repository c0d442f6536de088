// The state of the explorer and what the stored surfaces say about it. No access to the document.

const DATA = JSON.parse(document.getElementById("explorer-data").textContent);
restoreCovariances(DATA.studies, DATA.covariances);
const WORDS = DATA.words;

// A text with its values inserted.
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

// Surfaces are made when they are first needed.

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

// What one surface says about a point: {status, value, low, high}.
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

// Where the published value would be if it differed as at the blind cases: for the stiffness at
// the study's load, and the displacement that follows from it.
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

// What the chosen model says about a row at a point.
function rowAt(row, point, study = studyOf(), solver = solverOf(), withInterval = true) {
  const surface = chosenSurface(row.response);
  if (!surface) return { status: "absent" };
  const found = evaluate(study, solver, row.response, surface, point, withInterval);
  return row.kind === "displacement" ? asDisplacement(found, state.load) : found;
}
