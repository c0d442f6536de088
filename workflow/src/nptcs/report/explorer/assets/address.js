// The state in the address of the page, and choices that depend on each other.

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

// Take what is valid from the address; anything that does not exist here is left out.
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

// The solver with the most responses comes first; the published archive has only the stiffness.
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

// The plane shows a response that exists: at another load, the stiffness at that load.
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

// Two per cent to each side of the stiffness of the reference design.
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
