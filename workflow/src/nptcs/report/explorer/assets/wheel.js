// The three regions of the ring joined, and a wheel solved at a load: nptcs.lca.system and newton.

function compressionColumns(arc, theta, start, end) {
  return [...falling(arc, theta - start), ...growing(arc, end - theta), [0, 1, 1, 0, 0, 0], uniform(arc, theta - end)];
}

function tensionColumns(arc, theta, start) {
  return [...symmetricModes(arc, Math.PI - theta, Math.PI - start), uniform(arc, theta - Math.PI)];
}

function joinRegions(ring, thetaC, thetaT) {
  const contact = solveContact(ring.epsilon, ring.kappa2, thetaC);
  const atT = compressionColumns(ring.arcs.compression, thetaT, thetaC, thetaT);
  const atC = compressionColumns(ring.arcs.compression, thetaC, thetaC, thetaT);
  const beyond = tensionColumns(ring.arcs.tension, thetaT, thetaT);
  const matrix = [];
  const right = [];
  [0, 1, 2, 4, 5].forEach((row, i) => {
    const line = new Array(11).fill(0);
    for (let k = 0; k < 5; k++) line[k] = atT[k][row];
    line[5] = -beyond[0][row];
    line[6] = -beyond[1][row];
    line[7] = atT[5][row] - beyond[2][row];
    matrix.push(line);
    right.push([0, 0, 0, i === 3 ? -1 : 0]);
  });
  for (let row = 0; row < 6; row++) {
    const line = new Array(11).fill(0);
    for (let k = 0; k < 5; k++) line[k] = atC[k][row];
    line[7] = atC[5][row];
    for (let k = 0; k < 3; k++) line[8 + k] = -contact.edge[row][k];
    matrix.push(line);
    right.push([contact.edge[row][3], row === 3 ? -1 : 0, row === 4 ? -1 : 0, 0]);
  }
  matrix.forEach((line, i) => {
    const scale = 1 / Math.max(...line.map(Math.abs));
    for (let k = 0; k < 11; k++) line[k] *= scale;
    right[i] = right[i].map((value) => value * scale);
  });
  const solved = solveLinear(matrix, right);
  const x = solved.map((row) => row[0]);
  const along = (row) => row[0] * x[8] + row[1] * x[9] + row[2] * x[10];
  const edgeU = contact.edge[0][3] + along(contact.edge[0]);
  const pressure = contact.pressure[3] + along(contact.pressure);
  const coefficients = [0, 1, 2, 3, 4, 7];
  const atTransition = (row, values) => coefficients.reduce((sum, column, k) => sum + atT[k][row] * values[column], 0);
  const u = atTransition(0, x);
  const jump = ring.compression * edgeU - pressure * Math.cos(thetaC);
  const byC = solved.map((row) => row[1] * pressure * Math.sin(thetaC) + row[2] * jump);
  const byT = solved.map((row) => row[3] * (ring.compression - ring.tension) * u);
  const slopeU = atTransition(4, x) + atTransition(1, x) - atTransition(2, x);
  const end = contact.vertical[contact.vertical.length - 1];
  const resultant = (values) => end[0] * values[8] + end[1] * values[9] + end[2] * values[10];
  return {
    contact,
    x,
    sinking: [x[10], byC[10], byT[10]],
    force: [
      2 * (resultant(x) + end[3] + ring.compression * x[10] * thetaC),
      2 * (resultant(byC) + pressure + ring.compression * (byC[10] * thetaC + x[10])),
      2 * (resultant(byT) + ring.compression * byT[10] * thetaC),
    ],
    transition: [u, atTransition(0, byC), atTransition(0, byT) + slopeU],
  };
}

// ---- a wheel at a load -------------------------------------------------------------------------

function cubicAt(knots, cubics, x) {
  let place = 0;
  while (place < cubics.length - 1 && x >= knots[place + 1]) place++;
  const d = x - knots[place];
  return cubics[place].reduce((sum, c) => sum * d + c, 0);
}

// Section and spokes of a design; null where the table of spokes has no such rubber.
function wheelOf(plain, bandC10, spokeC10) {
  const knots = plain.c10_mpa;
  if (!(spokeC10 >= knots[0] && spokeC10 <= knots[knots.length - 1])) return null;
  const [axial, shear, bending] = plain.section.map(([zero, slope]) => zero + slope * bandC10);
  return {
    axial,
    shear,
    bending,
    tension: cubicAt(knots, plain.tension, spokeC10),
    compression: cubicAt(knots, plain.compression, spokeC10),
    plain,
  };
}

// Solve for the load; `factor` multiplies both stiffnesses of the spokes. Null if not found.
function solveWheel(wheel, load, factor = 1, start = null) {
  const { plain } = wheel;
  const radius = plain.radius_mm;
  const density = (plain.spoke_count / (2 * Math.PI * radius)) * factor;
  const ring = {
    epsilon: wheel.shear / wheel.axial,
    kappa2: (wheel.shear * radius * radius) / wheel.bending,
    compression: (radius * radius * wheel.compression * density) / wheel.shear,
    tension: (radius * radius * wheel.tension * density) / wheel.shear,
  };
  ring.arcs = {
    compression: foundation(ring.compression, ring.epsilon, ring.kappa2),
    tension: foundation(ring.tension, ring.epsilon, ring.kappa2),
  };
  const force = load / wheel.shear;
  let [thetaC, thetaT] = start ?? [];
  if (!start) {
    thetaC = Math.min(Math.atan((force / 2) * (1 + ring.compression * force) ** -0.25), 1.2);
    const stiffness = (1 + ring.tension) * (1 + ring.compression);
    thetaT = Math.min(thetaC + 1.35 * stiffness ** -0.18, 0.5 * (Math.PI + thetaC));
  }
  for (let step = 0; step < 40; step++) {
    const joined = joinRegions(ring, thetaC, thetaT);
    const [m, mc, mt] = [joined.force[0] - force, joined.force[1], joined.force[2]];
    const [u, uc, ut] = joined.transition;
    const determinant = mc * ut - mt * uc;
    let byC = (u * mt - m * ut) / determinant;
    let byT = (m * uc - u * mc) / determinant;
    if (u * byT > 0 || ut <= 0) {
      byT = u > 0 ? -0.4 * (thetaT - thetaC) : 0.3 * (Math.PI - thetaT);
      byC = -m / mc;
    }
    byC = Math.min(Math.max(byC, -0.5 * thetaC), Math.min(thetaC, 0.3 * (Math.PI / 2 - thetaC)));
    byT = Math.min(Math.max(byT, -0.5 * (thetaT - thetaC)), 0.5 * (Math.PI - thetaT));
    if (!Number.isFinite(byC + byT)) return null;
    const done = Math.abs(byC) < 1e-7 * thetaC && Math.abs(byT) < 1e-7;
    thetaC += byC;
    thetaT = Math.max(thetaT + byT, thetaC * (1 + 1e-6));
    if (done) return finished(wheel, ring, thetaC, thetaT, load, factor);
  }
  return null;
}

function finished(wheel, ring, thetaC, thetaT, load, factor) {
  const joined = joinRegions(ring, thetaC, thetaT);
  if (Math.abs(joined.force[0] * wheel.shear - load) > 1e-9 * load) return null;
  const radius = wheel.plain.radius_mm;
  return {
    wheel,
    ring,
    joined,
    thetaC,
    thetaT,
    factor,
    displacement: joined.sinking[0] * radius,
    contactLength: 2 * radius * thetaC,
  };
}

// Factor of the spokes' stiffness with which the wheel has a displacement; null if there is none.
function wheelWithDisplacement(wheel, load, displacement) {
  let solved = solveWheel(wheel, load);
  if (!solved) return null;
  let [x0, y0] = [0, Math.log(solved.displacement / displacement)];
  if (Math.abs(y0) < 1e-12) return solved;
  let x1 = y0 * 1.3;
  for (let step = 0; step < 30; step++) {
    solved = solveWheel(wheel, load, Math.exp(x1));
    if (!solved) return null;
    const y1 = Math.log(solved.displacement / displacement);
    if (Math.abs(y1) < 1e-10) return solved;
    const next = x1 - (y1 * (x1 - x0)) / (y1 - y0);
    if (!Number.isFinite(next) || Math.abs(next) > 5) return null;
    [x0, y0, x1] = [x1, y1, next];
  }
  return null;
}

// Radial and tangential displacement (mm) at angles (radians, 0 is the centre of the contact).
function displacementsAt(solved, theta) {
  const { ring, joined, thetaC, thetaT } = solved;
  const radius = solved.wheel.plain.radius_mm;
  const { x } = joined;
  return theta.map((angle) => {
    const side = Math.sign(angle) || 1;
    const here = Math.abs(angle);
    if (here <= thetaC) {
      const [u, v] = contactState(solved, here);
      return [u * radius, side * v * radius];
    }
    const near = here <= thetaT;
    const columns = near
      ? compressionColumns(ring.arcs.compression, here, thetaC, thetaT)
      : tensionColumns(ring.arcs.tension, here, thetaT);
    const values = near ? [x[0], x[1], x[2], x[3], x[4], x[7]] : [x[5], x[6], x[7]];
    const row = (i) => columns.reduce((sum, column, k) => sum + column[i] * values[k], 0);
    return [row(0) * radius, side * row(1) * radius];
  });
}

function contactState(solved, theta) {
  const { joined, ring, thetaC } = solved;
  const { rule, vertical } = joined.contact;
  const [m, h, delta] = [joined.x[8], joined.x[9], joined.x[10]];
  const w = vertical.map((row) => row[3] + row[0] * m + row[1] * h + row[2] * delta);
  const slope = rule.nodes.map((node, i) => w[i] * Math.tan(thetaC * node));
  const coefficients = new Array(2 * w.length).fill(0);
  rule.toEven.forEach((row, i) => {
    coefficients[2 * i] = row.reduce((sum, value, k) => sum + value * slope[k], 0);
  });
  const slip = h * theta - thetaC * chebValue(chebIntegral(coefficients), theta / thetaC);
  const [s, c] = [Math.sin(theta), Math.cos(theta)];
  const horizontal = Math.atanh(s) - s + ring.epsilon * slip;
  const sunk = 2 * Math.sin(theta / 2) ** 2 - delta;
  return [sunk * c + horizontal * s, horizontal * c - sunk * s];
}
