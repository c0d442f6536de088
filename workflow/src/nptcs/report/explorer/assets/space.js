// The same plane in space.

// Pixels between an edge of the foot and its name; the numbers at its ends are nearer.
const NAME_GAP = 30;

// The grid as a surface in space, turned and tilted; far faces first.
function drawSpace(canvas, grid, turn, tilt) {
  const { context, width, height } = prepared(canvas);
  const [a, e] = [(turn * Math.PI) / 180, (tilt * Math.PI) / 180];
  const [low, high] = grid.range;
  const flat = (u, v, w) => {
    const [px, py] = [u * Math.cos(a) - v * Math.sin(a), u * Math.sin(a) + v * Math.cos(a)];
    return [px, -(w * Math.cos(e) + py * Math.sin(e)), py * Math.cos(e) - w * Math.sin(e)];
  };
  const project = fitted(flat, width, height);
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
  baseLabels(context, project, grid, width, height);
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

// The projection, scaled and moved so that the box with its labels fills the canvas.
function fitted(flat, width, height) {
  const corners = [-1, 1].flatMap((u) => [-1, 1].flatMap((v) => [flat(1.1 * u, 1.1 * v, -0.55), flat(u, v, 0.55)]));
  const ends = (k) => [Math.min(...corners.map((c) => c[k])), Math.max(...corners.map((c) => c[k]))];
  const [[left, right], [top, bottom]] = [ends(0), ends(1)];
  const scale = Math.min((width - 24) / (right - left), (height - 44) / (bottom - top));
  const [x, y] = [width / 2 - (scale * (left + right)) / 2, (height - 20) / 2 - (scale * (top + bottom)) / 2];
  return (u, v, w) => {
    const [px, py, depth] = flat(u, v, w);
    return [x + scale * px, y + scale * py, depth];
  };
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
function baseLabels(context, project, grid, width, height) {
  context.textAlign = "center";
  context.textBaseline = "middle";
  const front = (first, second) => (project(...first, -0.55)[2] < project(...second, -0.55)[2] ? -1 : 1);
  const v = front([0, -1], [0, 1]);
  const u = front([-1, 0], [1, 0]);
  const put = (text, p, q, out) => {
    const [px, py] = project(p * out, q * out, -0.55);
    const half = context.measureText(text).width / 2 + 2;
    context.fillText(text, Math.min(width - half, Math.max(half, px)), Math.min(height - 8, py + 8));
  };
  context.fillStyle = COLOURS.ink;
  const centre = project(0, 0, -0.55);
  alongEdge(context, grid.xLabel, project(-1, v, -0.55), project(1, v, -0.55), centre, [width, height]);
  alongEdge(context, grid.yLabel, project(u, -1, -0.55), project(u, 1, -0.55), centre, [width, height]);
  context.fillStyle = COLOURS.soft;
  put(shortNumber(grid.xRange[0]), -0.78, v, 1.1);
  put(shortNumber(grid.xRange[1]), 0.78, v, 1.1);
  put(shortNumber(grid.yRange[0]), u, -0.78, 1.1);
  put(shortNumber(grid.yRange[1]), u, 0.78, 1.1);
}

// A name along an edge of the foot, on the side away from its centre and inside the canvas.
function alongEdge(context, text, from, to, centre, [width, height]) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy) || 1;
  const middle = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
  const away = (middle[0] - centre[0]) * -dy + (middle[1] - centre[1]) * dx < 0 ? -1 : 1;
  const tilt = Math.atan2(dx < 0 ? -dy : dy, Math.abs(dx));
  const half = context.measureText(text).width / 2 + 2;
  const [across, down] = [half * Math.cos(tilt) + 8, half * Math.abs(Math.sin(tilt)) + 8];
  const within = (value, room, most) => Math.min(most - room, Math.max(room, value));
  context.save();
  context.translate(
    within(middle[0] + (away * NAME_GAP * -dy) / length, across, width),
    within(middle[1] + (away * NAME_GAP * dx) / length, down, height),
  );
  context.rotate(tilt);
  context.fillText(text, 0, 0);
  context.restore();
}
