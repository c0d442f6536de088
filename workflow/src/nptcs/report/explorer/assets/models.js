// The ring, the load-displacement curve, and all models at this design.

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

// Values that a study holds fixed and that differ from this design.
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
    make("th", { scope: "row" }, DATA.models[surface.name], make("small", {}, notes.join(" · "))),
    make("td", { class: "ex-value" }, found.value === undefined ? "–" : digits(found.value, half)),
    make("td", {}, intervalText(found, half)),
    make("td", {}, surface.rms === null || row.kind === "displacement" ? "–" : shortNumber(Number(surface.rms.toPrecision(2)))),
  );
}
