// The contour map of a plane, with the region inside the target band.

// A scale from dark blue through green to yellow, in even steps of lightness.
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
  const wide = context.measureText(label).width + 4;
  const room = middle.map((centre, k) => Math.abs(centre - [x(grid.xRange[0]), y(grid.yRange[0])][k]) - Math.abs(place[k] - centre));
  // a label that would reach over the edge of the map is left out
  if (room[0] < wide / 2 || room[1] < 7) return;
  context.save();
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillStyle = COLOURS.paper;
  context.globalAlpha = 0.85;
  context.fillRect(place[0] - wide / 2, place[1] - 7, wide, 14);
  context.globalAlpha = 1;
  context.fillStyle = COLOURS.ink;
  context.fillText(label, ...place);
  context.restore();
}
