// Drawing on a canvas: axes, scales and profiles. Colours come from the style sheet.

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
