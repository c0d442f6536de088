// The load-bearing analysis (nptcs.lca): ring on spokes, flat contact, two free arcs, joined.
// Lengths in R, forces in GA, moments in GA R; state rows u, v, Φ, N, V, M.

const ODD_ROWS = [1, 2, 4];

// Roots and modes of a free arc on the foundation a: real columns of exp(-λ x).
function foundation(a, epsilon, kappa2) {
  const c = a * (epsilon + kappa2);
  let discriminant = (a * a) / 4 - a - c;
  const floor = 1e-11 * Math.max((a * a) / 4, a + c);
  if (Math.abs(discriminant) < floor) discriminant = -floor;
  const oscillating = discriminant < 0;
  const root = csqrt([discriminant, 0]);
  const r1 = [a / 2 + root[0], root[1]];
  const r2 = cdiv([a + c, 0], r1);
  const r1m = [r1[0] - 1, r1[1]];
  const roots = [csqrt(r1m), csqrt(cdiv([1 + c, 0], r1m))];
  const modes = [r1, r2].map((r, i) => {
    const u = [r[0] / a, r[1] / a];
    return [
      u,
      cdiv([-epsilon - u[0], -u[1]], roots[i]),
      cdiv([kappa2, 0], roots[i]),
      [-1, 0],
      roots[i],
      [1, 0],
    ];
  });
  const moment = (1 + a * epsilon) / (1 + c);
  return {
    roots,
    modes,
    oscillating,
    constant: [-kappa2 / (1 + c), 0, 0, (a * kappa2) / (1 + c), 0, moment],
    rotation: kappa2 * moment,
  };
}

function csqrt([re, im]) {
  const size = Math.hypot(re, im);
  if (size === 0) return [0, 0];
  const real = Math.sqrt((size + Math.abs(re)) / 2);
  const other = im / (2 * real);
  if (re >= 0) return [real, other];
  return [Math.abs(other), im < 0 ? -real : real];
}

function cdiv([a, b], [c, d]) {
  const size = c * c + d * d;
  return [(a * c + b * d) / size, (b * c - a * d) / size];
}

function cmul([a, b], [c, d]) {
  return [a * c - b * d, a * d + b * c];
}

// exp(-λ x)
function decay(root, x) {
  const size = Math.exp(-root[0] * x);
  return [size * Math.cos(root[1] * x), -size * Math.sin(root[1] * x)];
}

// Two real columns of six rows from a factor for even and one for odd rows of each mode.
function realColumns(arc, even, odd) {
  const scaled = arc.modes.map((mode, i) =>
    mode.map((value, row) => cmul(value, ODD_ROWS.includes(row) ? odd[i] : even[i])),
  );
  if (arc.oscillating) return [scaled[0].map((z) => z[0]), scaled[0].map((z) => z[1])];
  return scaled.map((mode) => mode.map((z) => z[0]));
}

function growing(arc, x) {
  const factors = arc.roots.map((root) => decay(root, x));
  return realColumns(arc, factors, factors);
}

function falling(arc, x) {
  const factors = arc.roots.map((root) => decay(root, x));
  return realColumns(arc, factors, factors.map(([re, im]) => [-re, -im]));
}

function symmetricModes(arc, z, length) {
  const down = arc.roots.map((root) => decay(root, length - z));
  const up = arc.roots.map((root) => decay(root, length + z));
  const half = (sign) => down.map((d, i) => [(up[i][0] + sign * d[0]) / 2, (up[i][1] + sign * d[1]) / 2]);
  return realColumns(arc, half(1), half(-1));
}

function uniform(arc, angle) {
  const state = [...arc.constant];
  state[1] += arc.rotation * angle;
  state[2] += arc.rotation * angle;
  return state;
}

// ---- the contact region --------------------------------------------------------------------

// Chebyshev series: value, integral from 0, derivative.
function chebValue(coefficients, x) {
  let b1 = 0;
  let b2 = 0;
  for (let n = coefficients.length - 1; n > 0; n--) [b1, b2] = [2 * x * b1 - b2 + coefficients[n], b1];
  return x * b1 - b2 + coefficients[0];
}

function chebIntegral(coefficients) {
  const size = coefficients.length;
  const found = new Array(size + 1).fill(0);
  for (let n = 0; n < size; n++) {
    const c = coefficients[n];
    if (n === 0) found[1] += c;
    else if (n === 1) found[2] += c / 4;
    else {
      found[n + 1] += c / (2 * (n + 1));
      found[n - 1] -= c / (2 * (n - 1));
    }
  }
  found[0] -= chebValue(found, 0);
  return found;
}

const RULES = new Map();

// Matrices that integrate functions known at the nodes of 0…1; see nptcs.lca.contact.rule.
function spectralRule(points) {
  if (RULES.has(points)) return RULES.get(points);
  const nodes = Array.from({ length: points }, (_, i) => Math.cos((Math.PI * (points - 1 - i)) / (2 * points - 1)));
  const unit = (n) => Array.from({ length: 2 * points }, (_, i) => (i === n ? 1 : 0));
  const odd = nodes.map((_, i) => unit(2 * i + 1));
  const even = nodes.map((_, i) => unit(2 * i));
  const at = (series) => nodes.map((x) => series.map((c) => chebValue(c, x)));
  const identity = nodes.map((_, i) => nodes.map((__, j) => (i === j ? 1 : 0)));
  const toOdd = solveLinear(at(odd), identity);
  const toEven = solveLinear(at(even), identity);
  const times = (a, b) => a.map((row) => b[0].map((_, j) => row.reduce((sum, value, k) => sum + value * b[k][j], 0)));
  const once = odd.map(chebIntegral);
  const onceOdd = times(at(once), toOdd);
  const twiceOdd = times(at(once.map(chebIntegral)), toOdd);
  const last = onceOdd[points - 1];
  const rule = {
    nodes,
    toOdd,
    toEven,
    onceOdd,
    rotation: twiceOdd.map((row, i) => row.map((value, j) => value - nodes[i] * last[j])),
    endEven: times([even.map((c) => chebValue(chebIntegral(c), 1))], toEven)[0],
  };
  RULES.set(points, rule);
  return rule;
}

function pointsFor(kappa2, angle) {
  const hard = Math.max(angle, (Math.sqrt(kappa2) * angle) / 6);
  return hard <= 0.5 ? 8 : hard <= 1.25 ? 16 : hard <= 13 ? 40 : 64;
}

// Contact states; their columns belong to m, h, δ and the constant.
function solveContact(epsilon, kappa2, angle) {
  const rule = spectralRule(pointsFor(kappa2, angle));
  const theta = rule.nodes.map((node) => angle * node);
  const sine = theta.map(Math.sin);
  const cosine = theta.map(Math.cos);
  const weight = kappa2 * angle * angle;
  const matrix = rule.rotation.map((row, i) =>
    row.map((value, j) => -weight * cosine[i] * value * cosine[j] + (i === j ? cosine[i] ** 2 + epsilon * sine[i] ** 2 : 0)),
  );
  const force = theta.map((t, i) => {
    const bending = rule.rotation[i].reduce((sum, value, j) => sum + value * sine[j], 0);
    return [cosine[i] * kappa2 * t, cosine[i] * (weight * bending - sine[i] * (1 - epsilon)), 0, sine[i]];
  });
  const vertical = solveLinear(matrix, force);
  const edge = edgeStates(theta, vertical, epsilon, kappa2, angle, rule);
  const [s, c, end] = [Math.sin(angle), Math.cos(angle), vertical[vertical.length - 1]];
  const pressure = [0, 1, 2, 3].map((k) => {
    let slope = c * kappa2 * edge[5][k] - s * edge[2][k] + 2 * (1 - epsilon) * s * c * end[k];
    if (k === 1) slope -= (1 - epsilon) * (c * c - s * s);
    if (k === 3) slope += c;
    return slope / (c * c + epsilon * s * s);
  });
  return { vertical, edge, pressure, rule };
}

function edgeStates(theta, vertical, epsilon, kappa2, angle, rule) {
  const size = theta.length;
  const last = rule.rotation[size - 1];
  const [s, c] = [Math.sin(angle), Math.cos(angle)];
  const rows = [[], [], [], [], [], []];
  for (let k = 0; k < 4; k++) {
    const shear = theta.map((t, i) => vertical[i][k] * Math.cos(t) + (k === 1 ? Math.sin(t) : 0));
    const phi = kappa2 * angle * angle * last.reduce((sum, value, i) => sum + value * shear[i], 0) + (k === 0 ? kappa2 * angle : 0);
    let slip = -theta.reduce((sum, t, i) => sum + angle * rule.endEven[i] * Math.tan(t) * vertical[i][k], 0);
    if (k === 1) slip += angle;
    const horizontal = epsilon * slip + (k === 3 ? Math.atanh(s) - s : 0);
    const sinking = k === 2 ? -1 : k === 3 ? 2 * Math.sin(angle / 2) ** 2 : 0;
    rows[0].push(sinking * c + horizontal * s);
    rows[1].push(horizontal * c - sinking * s);
    rows[2].push(phi);
    rows[3].push(-vertical[size - 1][k] * s + (k === 1 ? c : 0));
    rows[4].push(shear[size - 1]);
    rows[5].push(k === 0 ? 1 : 0);
  }
  return rows;
}
