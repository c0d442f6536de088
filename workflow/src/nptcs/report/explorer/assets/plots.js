// Drawing: axes, profiles, contour map, surface in space. Colours come from the style sheet.

const COLOURS = {};

function readColours(root) {
  const style = getComputedStyle(root);
  for (const name of ["ink", "soft", "grid", "paper", "model", "interval", "bias", "band", "case", "mark", "tension", "compression"]) {
    COLOURS[name] = style.getPropertyValue(`--ex-${name}`).trim();
  }
}

// Size a canvas for the screen and clear it; the context draws in CSS pixels.
function prepared(canvas) {
  const { clientWidth: width, clientHeight: height } = canvas;
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  context.font = "12px system-ui, sans-serif";
  context.lineJoin = "round";
  return { context, width, height };
}

// Round ticks within low…high, about `count` of them.
function ticksOf(low, high, count = 4) {
  if (!(high > low)) return [low];
  const raw = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) found.push(Number((k * step).toPrecision(12)));
  return found;
}

function scaleOf(low, high, start, end) {
  const span = high - low || 1;
  const to = (value) => start + ((value - low) / span) * (end - start);
  to.back = (pixel) => low + ((pixel - start) / (end - start)) * span;
  return to;
}

function axes(context, frame, x, y, xRange, yRange, xCount, yCount, labelled = true) {
  context.strokeStyle = COLOURS.grid;
  context.fillStyle = COLOURS.soft;
  context.lineWidth = 1;
  context.textBaseline = "top";
  context.textAlign = "center";
  for (const tick of ticksOf(...xRange, xCount)) {
    line(context, [[x(tick), frame.top], [x(tick), frame.bottom]]);
    context.fillText(shortNumber(tick), x(tick), frame.bottom + 4);
  }
  context.textBaseline = "middle";
  context.textAlign = "right";
  for (const tick of ticksOf(...yRange, yCount)) {
    line(context, [[frame.left, y(tick)], [frame.right, y(tick)]]);
    if (labelled) context.fillText(shortNumber(tick), frame.left - 4, y(tick));
  }
}

function line(context, points) {
  context.beginPath();
  points.forEach(([px, py], i) => (i ? context.lineTo(px, py) : context.moveTo(px, py)));
  context.stroke();
}

function area(context, upper, lower) {
  if (upper.length < 2) return;
  context.beginPath();
  upper.forEach(([px, py], i) => (i ? context.lineTo(px, py) : context.moveTo(px, py)));
  [...lower].reverse().forEach(([px, py]) => context.lineTo(px, py));
  context.closePath();
  context.fill();
}

function shortNumber(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  return size >= 1e5 || size < 1e-3 ? value.toExponential(1) : String(Number(value.toPrecision(4)));
}

// One profile: the trace over a factor with interval, bias and target band, and cases near it.
function drawProfile(canvas, plot) {
  const { context, width, height } = prepared(canvas);
  const frame = { left: plot.first ? 42 : 8, right: width - 8, top: 6, bottom: height - 20 };
  const x = scaleOf(...plot.xRange, frame.left, frame.right);
  const y = scaleOf(...plot.yRange, frame.bottom, frame.top);
  canvas.scaleBack = x.back;
  context.save();
  context.beginPath();
  context.rect(frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top);
  context.clip();
  if (plot.band) {
    context.fillStyle = COLOURS.band;
    context.globalAlpha = 0.22;
    const [low, high] = plot.band.map(y);
    context.fillRect(frame.left, high, frame.right - frame.left, low - high);
    context.globalAlpha = 1;
  }
  context.restore();
  axes(context, frame, x, y, plot.xRange, plot.yRange, width < 170 ? 2 : 4, 4, plot.first);
  context.save();
  context.beginPath();
  context.rect(frame.left, frame.top - 2, frame.right - frame.left + 2, frame.bottom - frame.top + 4);
  context.clip();
  const inside = plot.trace.filter((p) => p.low !== undefined);
  if (plot.bias) {
    context.fillStyle = COLOURS.bias;
    context.globalAlpha = 0.3;
    const with_ = plot.trace.filter((p) => p.bias);
    area(context, with_.map((p) => [x(p.x), y(p.bias[1])]), with_.map((p) => [x(p.x), y(p.bias[0])]));
  }
  context.fillStyle = COLOURS.interval;
  context.globalAlpha = 0.35;
  const most = plot.yRange[1] + (plot.yRange[1] - plot.yRange[0]);
  area(context, inside.map((p) => [x(p.x), y(Math.min(p.high, most))]), inside.map((p) => [x(p.x), y(p.low)]));
  context.globalAlpha = 1;
  context.strokeStyle = COLOURS.model;
  context.lineWidth = 2;
  for (const [kind, dash] of [["inside", []], ["flagged", [4, 4]]]) {
    context.setLineDash(dash);
    for (const run of runs(plot.trace, kind)) line(context, run.map((p) => [x(p.x), y(p.value)]));
  }
  context.setLineDash([]);
  context.fillStyle = COLOURS.case;
  for (const dot of plot.dots) {
    context.globalAlpha = dot.nearness;
    disc(context, x(dot.x), y(dot.y), 3.2);
  }
  context.globalAlpha = 1;
  context.strokeStyle = COLOURS.mark;
  context.lineWidth = 1.2;
  context.setLineDash([3, 3]);
  line(context, [[x(plot.here.x), frame.top], [x(plot.here.x), frame.bottom]]);
  context.setLineDash([]);
  if (plot.here.value !== undefined) {
    context.fillStyle = COLOURS.mark;
    disc(context, x(plot.here.x), y(plot.here.value), 4.2);
  }
  context.restore();
}

// Runs of neighbouring points of one status.
function runs(trace, kind) {
  const found = [];
  let open = null;
  for (const point of trace) {
    if (point.status === kind && Number.isFinite(point.value)) {
      open ??= found[found.push([]) - 1];
      open.push(point);
    } else open = null;
  }
  return found.filter((run) => run.length > 1);
}

function disc(context, px, py, radius) {
  context.beginPath();
  context.arc(px, py, radius, 0, 2 * Math.PI);
  context.fill();
}

// A scale from dark blue over green to yellow, even in lightness.
const RAMP = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];

function rampColour(share) {
  const place = Math.min(Math.max(share, 0), 1) * (RAMP.length - 1);
  const i = Math.min(Math.floor(place), RAMP.length - 2);
  return RAMP[i].map((low, c) => Math.round(low + (place - i) * (RAMP[i + 1][c] - low)));
}

const rgb = ([r, g, b]) => `rgb(${r},${g},${b})`;

// A contour map of a grid: colours, lines with their values, the region inside the band.
function drawMap(canvas, grid) {
  const { context, width, height } = prepared(canvas);
  const frame = { left: 46, right: width - 64, top: 10, bottom: height - 38 };
  const x = scaleOf(...grid.xRange, frame.left, frame.right);
  const y = scaleOf(...grid.yRange, frame.bottom, frame.top);
  canvas.scaleBack = { x: x.back, y: y.back, frame };
  const [low, high] = grid.range;
  context.save();
  context.beginPath();
  context.rect(frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top);
  context.clip();
  const paper = hexColour(COLOURS.paper);
  paintCells(context, frame, grid, (cell) => {
    const colour = rampColour((cell.value - low) / (high - low || 1));
    return cell.feasible ? colour : colour.map((part, i) => 0.45 * part + 0.55 * paper[i]);
  });
  context.restore();
  context.strokeStyle = COLOURS.grid;
  context.lineWidth = 1;
  for (const tick of grid.rails) line(context, [[x(tick), frame.bottom - 6], [x(tick), frame.bottom]]);
  axes(context, frame, x, y, grid.xRange, grid.yRange, 5, 5);
  context.strokeStyle = COLOURS.ink;
  context.fillStyle = COLOURS.ink;
  context.lineWidth = 0.9;
  for (const level of ticksOf(low, high, 8)) contour(context, grid, x, y, (cell) => cell.value, level, shortNumber(level));
  context.lineWidth = 2.6;
  context.strokeStyle = COLOURS.band;
  for (const end of grid.band) contour(context, grid, x, y, (cell) => cell.stiffness, end, "");
  context.lineWidth = 1.6;
  context.setLineDash([5, 4]);
  contour(context, grid, x, y, (cell) => cell.lowStiffness, grid.band[0], "");
  contour(context, grid, x, y, (cell) => cell.highStiffness, grid.band[1], "");
  context.setLineDash([]);
  for (const dot of grid.dots) {
    context.globalAlpha = dot.nearness;
    context.fillStyle = COLOURS.paper;
    disc(context, x(dot.x), y(dot.y), 4.4);
    context.fillStyle = COLOURS.case;
    disc(context, x(dot.x), y(dot.y), 3.2);
    context.globalAlpha = 1;
  }
  context.strokeStyle = COLOURS.paper;
  context.lineWidth = 4;
  cross(context, x(grid.here[0]), y(grid.here[1]));
  context.strokeStyle = COLOURS.mark;
  context.lineWidth = 2;
  cross(context, x(grid.here[0]), y(grid.here[1]));
  axisLabels(context, frame, grid, height);
  colourBar(context, grid, width, frame);
}

function hexColour(text) {
  return [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16));
}

// Cells of the grid as one picture, smooth between them; cells without a value stay empty.
function paintCells(context, frame, grid, colourOf) {
  const size = grid.xs.length;
  const small = document.createElement("canvas");
  small.width = small.height = size;
  const image = new ImageData(size, size);
  grid.cells.forEach((row, j) =>
    row.forEach((cell, i) => {
      if (cell.value === undefined) return;
      image.data.set([...colourOf(cell).map(Math.round), 255], 4 * ((size - 1 - j) * size + i));
    }),
  );
  small.getContext("2d").putImageData(image, 0, 0);
  const [dx, dy] = [(frame.right - frame.left) / (size - 1), (frame.bottom - frame.top) / (size - 1)];
  context.imageSmoothingEnabled = true;
  context.drawImage(small, frame.left - dx / 2, frame.top - dy / 2, size * dx, size * dy);
}

function cross(context, px, py) {
  line(context, [[px - 9, py], [px + 9, py]]);
  line(context, [[px, py - 9], [px, py + 9]]);
}

function axisLabels(context, frame, grid, height) {
  context.fillStyle = COLOURS.ink;
  context.textAlign = "center";
  context.textBaseline = "bottom";
  context.fillText(grid.xLabel, (frame.left + frame.right) / 2, height - 2);
  context.save();
  context.translate(2, (frame.top + frame.bottom) / 2);
  context.rotate(-Math.PI / 2);
  context.textBaseline = "top";
  context.fillText(grid.yLabel, 0, 0);
  context.restore();
}

function colourBar(context, grid, width, frame) {
  const left = width - 54;
  const y = scaleOf(...grid.range, frame.bottom, frame.top);
  for (let py = frame.top; py < frame.bottom; py += 2) {
    context.fillStyle = rgb(rampColour((frame.bottom - py) / (frame.bottom - frame.top)));
    context.fillRect(left, py, 12, 2.5);
  }
  context.fillStyle = COLOURS.soft;
  context.textAlign = "left";
  context.textBaseline = "middle";
  for (const tick of ticksOf(...grid.range, 5)) context.fillText(shortNumber(tick), left + 15, y(tick));
}

// Lines on which a quantity of the grid has a value (marching squares); one label per level.
function contour(context, grid, x, y, quantity, level, label) {
  let place = null;
  let nearest = Infinity;
  const middle = [(x(grid.xRange[0]) + x(grid.xRange[1])) / 2, (y(grid.yRange[0]) + y(grid.yRange[1])) / 2];
  for (let j = 0; j + 1 < grid.ys.length; j++) {
    for (let i = 0; i + 1 < grid.xs.length; i++) {
      const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(([a, b]) => ({
        x: grid.xs[a],
        y: grid.ys[b],
        v: quantity(grid.cells[b][a]),
      }));
      if (corners.some((c) => !Number.isFinite(c.v))) continue;
      const cuts = [];
      corners.forEach((a, k) => {
        const b = corners[(k + 1) % 4];
        if (a.v < level === b.v < level) return;
        const share = (level - a.v) / (b.v - a.v);
        cuts.push([x(a.x + share * (b.x - a.x)), y(a.y + share * (b.y - a.y))]);
      });
      for (let k = 0; k + 1 < cuts.length; k += 2) line(context, [cuts[k], cuts[k + 1]]);
      if (!cuts.length) continue;
      const far = Math.hypot(cuts[0][0] - middle[0], cuts[0][1] - middle[1]);
      if (far < nearest) [nearest, place] = [far, cuts[0]];
    }
  }
  if (!label || !place) return;
  context.save();
  context.textAlign = "center";
  context.textBaseline = "middle";
  const wide = context.measureText(label).width + 4;
  context.fillStyle = COLOURS.paper;
  context.globalAlpha = 0.85;
  context.fillRect(place[0] - wide / 2, place[1] - 7, wide, 14);
  context.globalAlpha = 1;
  context.fillStyle = COLOURS.ink;
  context.fillText(label, ...place);
  context.restore();
}

// The grid as a surface in space, turned and tilted; far faces first.
function drawSpace(canvas, grid, turn, tilt) {
  const { context, width, height } = prepared(canvas);
  const [a, e] = [(turn * Math.PI) / 180, (tilt * Math.PI) / 180];
  const scale = Math.min(width / 3.1, height / 2.5);
  const [low, high] = grid.range;
  const project = (u, v, w) => {
    const [px, py] = [u * Math.cos(a) - v * Math.sin(a), u * Math.sin(a) + v * Math.cos(a)];
    return [width / 2 + scale * px, height * 0.52 - scale * (w * Math.cos(e) + py * Math.sin(e)), py * Math.cos(e) - w * Math.sin(e)];
  };
  const size = grid.xs.length;
  const unit = (i) => (2 * i) / (size - 1) - 1;
  const up = (value) => 1.1 * ((value - low) / (high - low || 1)) - 0.55;
  const faces = [];
  for (let j = 0; j + 1 < size; j++) {
    for (let i = 0; i + 1 < size; i++) {
      const cells = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
      const values = cells.map(([p, q]) => grid.cells[q][p].value);
      if (values.some((value) => value === undefined)) continue;
      const corners = cells.map(([p, q], k) => project(unit(p), unit(q), up(values[k])));
      const mean = values.reduce((sum, value) => sum + value, 0) / 4;
      const feasible = cells.filter(([p, q]) => grid.cells[q][p].feasible).length >= 2;
      faces.push({ corners, depth: corners.reduce((sum, c) => sum + c[2], 0), mean, feasible });
    }
  }
  faces.sort((p, q) => q.depth - p.depth);
  base(context, project);
  for (const face of faces) {
    context.fillStyle = rgb(rampColour((face.mean - low) / (high - low || 1)));
    context.strokeStyle = face.feasible ? COLOURS.band : context.fillStyle;
    context.lineWidth = face.feasible ? 1.4 : 0.7;
    context.beginPath();
    face.corners.forEach(([px, py], k) => (k ? context.lineTo(px, py) : context.moveTo(px, py)));
    context.closePath();
    context.fill();
    context.stroke();
  }
  baseLabels(context, project, grid);
  if (grid.hereValue !== undefined) {
    const share = (value, [from, to]) => (2 * (value - from)) / (to - from) - 1;
    const at = [share(grid.here[0], grid.xRange), share(grid.here[1], grid.yRange)];
    const [foot, top] = [project(...at, -0.55), project(...at, up(grid.hereValue))];
    context.strokeStyle = COLOURS.mark;
    context.lineWidth = 1.2;
    line(context, [foot, top]);
    context.fillStyle = COLOURS.mark;
    disc(context, top[0], top[1], 5);
  }
}

// Foot and edges of the box.
function base(context, project) {
  const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
  context.strokeStyle = COLOURS.soft;
  context.lineWidth = 1;
  line(context, [...corners, corners[0]].map(([u, v]) => project(u, v, -0.55)));
  for (const [u, v] of corners) line(context, [project(u, v, -0.55), project(u, v, 0.55)]);
}

// Names and ends of the two factors, on the sides that face the reader.
function baseLabels(context, project, grid) {
  context.textAlign = "center";
  context.textBaseline = "middle";
  const front = (first, second) => (project(...first, -0.55)[2] < project(...second, -0.55)[2] ? -1 : 1);
  const v = front([0, -1], [0, 1]);
  const u = front([-1, 0], [1, 0]);
  const put = (text, p, q, out) => {
    const [px, py] = project(p * out, q * out, -0.55);
    context.fillText(text, px, py + 8);
  };
  context.fillStyle = COLOURS.ink;
  put(grid.xLabel, 0, v, 1.22);
  put(grid.yLabel, u, 0, 1.22);
  context.fillStyle = COLOURS.soft;
  put(shortNumber(grid.xRange[0]), -0.92, v, 1.1);
  put(shortNumber(grid.xRange[1]), 0.92, v, 1.1);
  put(shortNumber(grid.yRange[0]), u, -0.92, 1.1);
  put(shortNumber(grid.yRange[1]), u, 0.92, 1.1);
}
