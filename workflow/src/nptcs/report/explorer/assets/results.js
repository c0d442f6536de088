// The state in the controls, the warning, and the table of predictions.

function showControls() {
  const study = studyOf();
  const solver = solverOf();
  fillSelect(parts.study, DATA.studies.map((one) => [one.name, one.title]), state.study);
  fillSelect(parts.solver, study.solvers.map((one) => [one.name, one.synthetic ? `${one.name} (${say("synthetic")})` : one.name]), state.solver);
  fillSelect(parts.model, [["", say("best")], ...namesOfModels().map((name) => [name, DATA.models[name]])], state.model);
  const varied = study.factors.map((name) => [name, symbolOf(name)]);
  fillSelect(parts.across, varied, state.across);
  fillSelect(parts.up, varied, state.up);
  fillSelect(parts.shown, rowsOf().filter((row) => row.response).map((row) => [row.key, rowTitle(row)]), state.shown);
  parts.across.disabled = parts.up.disabled = study.factors.length < 2;
  parts.solver.title = solver.about;
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
  number.value = value === undefined ? "" : varied ? tidy(value) : shortNumber(value);
  if (!varied) {
    const held = value !== undefined;
    Object.assign(range, held ? { min: value - 1, max: value + 1, value } : { min: 0, max: 1, value: 0 });
    note.textContent = held ? say("held", { value: shortNumber(value), unit: factor.unit }) : say("not_in_study");
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
  if (surface) notes.push(DATA.models[surface.name]);
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
  return make("p", { class: "ex-note" }, `${solver.name}: ${solver.about}. ${words}`);
}
