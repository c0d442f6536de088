// Profiles: each response against each factor, with the cases near that slice.

// How near a case is to the slice: 1 on it, 0 at NEAR half ranges and beyond.
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

// The range of a row's axis: that of its cases, with a margin.
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
