// The plane of two factors and its view in space.

// The shown response and the stiffness over the plane of two factors.
function gridOf(point, study, solver) {
  const rows = rowsOf();
  const row = rows.find((one) => one.key === state.shown);
  const stiffness = rows.find((one) => one.kind === "surface" && one.response?.name === "secant_stiffness");
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
      const found = rowAt(row, place, study, solver, row === stiffness);
      const k = row === stiffness ? found : stiffness ? rowAt(stiffness, place, study, solver) : {};
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
    columns,
    xRange: ranges[0],
    yRange: ranges[1],
    range: [Math.min(...values), Math.max(...values)],
    band: state.band,
    xLabel: label(state.across),
    yLabel: label(state.up),
    rails: state.across === SPACING && solver.whole_plates ? pitches(ranges[0]) : [],
    dots: dotsOf(row, study, solver, point, [state.across, state.up]).map((dot) => ({ ...dot, x: dot.place[columns[0]], y: dot.place[columns[1]] })),
    shares: [inside, sure].map((count) => (known ? (100 * count) / known : 0)),
  };
}

let kept = { key: "", grid: null };

// The grid of the last plane, as long as nothing that it depends on has changed.
function keptGrid(point, study, solver) {
  const others = point.filter((_, i) => ![state.across, state.up].includes(study.factors[i]));
  const { model, load, band, across, up, shown } = state;
  const key = JSON.stringify([study.name, solver.name, model, load, band, across, up, shown, others]);
  if (kept.key !== key) kept = { key, grid: gridOf(point, study, solver) };
  return kept.grid;
}

function pitches([low, high]) {
  const { width_mm: width } = DATA.tyre;
  const found = [];
  for (let count = Math.ceil(width / high - 1e-9); width / count >= low - 1e-9; count++) found.push(width / count);
  return found;
}

function showPlane(point, study, solver) {
  const grid = study.factors.length < 2 ? null : keptGrid(point, study, solver);
  if (!grid) {
    prepared(parts.map);
    prepared(parts.space);
    const words = say(study.factors.length < 2 ? "plane_one" : "plane_none");
    parts.planeNote.textContent = words;
    parts.map.setAttribute("aria-label", words);
    parts.space.setAttribute("aria-label", words);
    return;
  }
  grid.here = grid.columns.map((column) => point[column]);
  grid.hereValue = rowAt(grid.row, point, study, solver, false).value;
  drawMap(parts.map, grid);
  drawSpace(parts.space, grid, state.turn, state.tilt);
  const [share, sure] = grid.shares.map((value) => value.toFixed(1));
  const names = { response: rowTitle(grid.row), across: symbolOf(state.across), up: symbolOf(state.up) };
  parts.planeNote.textContent = say("plane_share", { share, sure });
  parts.map.setAttribute("aria-label", say("plane_alt", { ...names, share }));
  parts.space.setAttribute("aria-label", say("view3d_alt", { ...names, turn: state.turn }));
}
