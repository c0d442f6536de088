// Predictions of stored surfaces with their intervals: the formulas of nptcs.surface.kinds.
// A point is an array of factor values in natural units, in the order of the surface's factors.

// Full symmetric matrix from its rows, each from the diagonal on.
function symmetric(upper, size) {
  const full = Array.from({ length: size }, () => new Float64Array(size));
  let place = 0;
  for (let i = 0; i < size; i++) {
    for (let j = i; j < size; j++) full[i][j] = full[j][i] = upper[place++];
  }
  return full;
}

// Give each surface its covariance back: polynomials of the same cases and terms share one, in units
// of their own residual variance.
function restoreCovariances(part, shared) {
  if (part === null || typeof part !== "object") return;
  if (typeof part.covariance === "number") {
    part.covariance = shared[part.covariance].map((value) => value * part.sd * part.sd);
  }
  for (const inner of Object.values(part)) restoreCovariances(inner, shared);
}

// x' C x
function quadratic(matrix, x) {
  let sum = 0;
  for (let i = 0; i < x.length; i++) {
    let row = 0;
    for (let j = 0; j < x.length; j++) row += matrix[i][j] * x[j];
    sum += row * x[i];
  }
  return sum;
}

// Solve A x = b for one or several right-hand sides (columns of b), by elimination with row exchange.
function solveLinear(matrix, right) {
  const size = matrix.length;
  const rows = matrix.map((row, i) => Float64Array.from([...row, ...right[i]]));
  for (let column = 0; column < size; column++) {
    let best = column;
    for (let i = column + 1; i < size; i++) {
      if (Math.abs(rows[i][column]) > Math.abs(rows[best][column])) best = i;
    }
    [rows[column], rows[best]] = [rows[best], rows[column]];
    for (let i = column + 1; i < size; i++) {
      const factor = rows[i][column] / rows[column][column];
      if (factor !== 0) for (let j = column; j < rows[i].length; j++) rows[i][j] -= factor * rows[column][j];
    }
  }
  const found = right.map(() => new Float64Array(right[0].length));
  for (let i = size - 1; i >= 0; i--) {
    for (let k = 0; k < right[0].length; k++) {
      let sum = rows[i][size + k];
      for (let j = i + 1; j < size; j++) sum -= rows[i][j] * found[j][k];
      found[i][k] = sum / rows[i][i];
    }
  }
  return found;
}

// Lower factor of a symmetric positive definite matrix, by rows.
function cholesky(matrix) {
  const size = matrix.length;
  const lower = Array.from({ length: size }, (_, i) => new Float64Array(i + 1));
  for (let i = 0; i < size; i++) {
    for (let j = 0; j <= i; j++) {
      let sum = matrix[i][j];
      for (let k = 0; k < j; k++) sum -= lower[i][k] * lower[j][k];
      lower[i][j] = i === j ? Math.sqrt(sum) : sum / lower[j][j];
    }
  }
  return lower;
}

// (L Lᵀ)⁻¹ b
function solveFactored(lower, right) {
  const size = right.length;
  const solved = new Float64Array(size);
  for (let i = 0; i < size; i++) {
    let value = right[i];
    const row = lower[i];
    for (let k = 0; k < i; k++) value -= row[k] * solved[k];
    solved[i] = value / row[i];
  }
  for (let i = size - 1; i >= 0; i--) {
    solved[i] /= lower[i][i];
    for (let k = 0; k < i; k++) solved[k] -= lower[i][k] * solved[i];
  }
  return solved;
}

function dot(a, b) {
  let sum = 0;
  for (let i = 0; i < a.length; i++) sum += a[i] * b[i];
  return sum;
}

// ---- polynomials ---------------------------------------------------------------------------

function polynomialSurface(plain) {
  const covariance = symmetric(plain.covariance, plain.coefficients.length);
  const terms = (point) => {
    const coded = point.map((value, i) => (value - plain.centre[i]) / plain.half[i]);
    return plain.exponents.map((powers) => {
      let product = 1;
      for (let i = 0; i < powers.length; i++) {
        for (let times = 0; times < powers[i]; times++) product *= coded[i];
      }
      return product;
    });
  };
  const value = (row) => row.reduce((sum, term, i) => sum + term * plain.coefficients[i], 0);
  return {
    predict: (point) => value(terms(point)),
    slopes: terms,
    interval(point) {
      const row = terms(point);
      const middle = value(row);
      const half = plain.quantile * Math.sqrt(quadratic(covariance, row) + plain.sd ** 2);
      return [middle - half, middle + half];
    },
  };
}

function linkedSurface(plain) {
  const inner = makeSurface(plain.inner);
  if (plain.link === "log") {
    return {
      predict: (point) => Math.exp(inner.predict(point)),
      slopes: (point) => inner.slopes(point).map((slope) => slope * Math.exp(inner.predict(point))),
      interval: (point) => inner.interval(point).map(Math.exp),
    };
  }
  return {
    predict: (point) => 1 / inner.predict(point),
    slopes: (point) => inner.slopes(point).map((slope) => -slope / inner.predict(point) ** 2),
    interval(point) {
      const [low, high] = inner.interval(point);
      return [1 / high, low > 0 ? 1 / low : Infinity];
    },
  };
}

// ---- lamination ----------------------------------------------------------------------------

function reducedStiffness(ply) {
  const scale = 1 / (1 - (ply.nu12 ** 2 * ply.e2_mpa) / ply.e1_mpa);
  const across = scale * ply.nu12 * ply.e2_mpa;
  return [
    [scale * ply.e1_mpa, across, 0],
    [across, scale * ply.e2_mpa, 0],
    [0, 0, ply.g12_mpa],
  ];
}

function rotatedStiffness(ply, degrees) {
  const c = Math.cos((degrees * Math.PI) / 180);
  const s = Math.sin((degrees * Math.PI) / 180);
  const turn = [
    [c * c, s * s, c * s],
    [s * s, c * c, -c * s],
    [-2 * c * s, 2 * c * s, c * c - s * s],
  ];
  const q = reducedStiffness(ply);
  const qt = q.map((row) => [0, 1, 2].map((j) => row[0] * turn[0][j] + row[1] * turn[1][j] + row[2] * turn[2][j]));
  return [0, 1, 2].map((i) => [0, 1, 2].map((j) => turn[0][i] * qt[0][j] + turn[1][i] * qt[1][j] + turn[2][i] * qt[2][j]));
}

// [[A, B], [B, D]] of [+A/-A]
function laminate(ply, degrees, thickness) {
  const half = thickness / 2;
  const below = rotatedStiffness(ply, degrees);
  const above = rotatedStiffness(ply, -degrees);
  const full = Array.from({ length: 6 }, () => new Float64Array(6));
  for (let i = 0; i < 3; i++) {
    for (let j = 0; j < 3; j++) {
      const sum = below[i][j] + above[i][j];
      full[i][j] = sum * half;
      full[i][j + 3] = full[i + 3][j] = ((above[i][j] - below[i][j]) * half ** 2) / 2;
      full[i + 3][j + 3] = (sum * half ** 3) / 3;
    }
  }
  return full;
}

function laminationSurface(plain) {
  const size = plain.parameters.length;
  const covariance = symmetric(plain.covariance, size);
  const place = { log_r: 2, log_a: 3, log_p: 4 };
  const stiffness = (parameters, point, plate) => {
    const shape = { ...plain.absent };
    plain.shape.forEach((name, i) => (shape[name] = parameters[3 + i]));
    const held = plate.map((row) => Float64Array.from(row));
    for (const name of Object.keys(place)) {
      if (name in shape) held[place[name]][place[name]] += Math.exp(Math.min(shape[name], 50));
    }
    const unit = [[0], [0], [0], [1], [0], [0]];
    const bending = solveLinear(held, unit)[3][0];
    const ratio = point[0] / plain.reference;
    const spacing = plain.reference * ratio ** shape.m;
    const plates = ratio ** shape.n * bending;
    return 1 / (parameters[0] + parameters[1] * spacing + parameters[2] * plates);
  };
  const plateOf = (point) => laminate(plain.ply, point[2], point[1]);
  const slopesOn = (point, plate) =>
    plain.parameters.map((value, i) => {
      const step = 1e-5 * (i < 3 ? Math.abs(value) : 1);
      const moved = (side) => plain.parameters.map((p, j) => (i === j ? p + side * step : p));
      return (stiffness(moved(1), point, plate) - stiffness(moved(-1), point, plate)) / (2 * step);
    });
  return {
    predict: (point) => stiffness(plain.parameters, point, plateOf(point)),
    slopes: (point) => slopesOn(point, plateOf(point)),
    interval(point) {
      const plate = plateOf(point);
      const middle = stiffness(plain.parameters, point, plate);
      const spread = quadratic(covariance, slopesOn(point, plate));
      const half = plain.quantile * Math.sqrt(spread + plain.sd ** 2);
      return [middle - half, middle + half];
    },
  };
}

// ---- Gaussian processes --------------------------------------------------------------------

function matern(distance) {
  const d = Math.sqrt(5) * distance;
  return (1 + d + (d * d) / 3) * Math.exp(-d);
}

function squaredExponential(distance) {
  return Math.exp(-0.5 * distance * distance);
}

// A process over places (rows of numbers): variance, lengths and noise are logarithms in theta.
function makeProcess(theta, places, weights, nugget, shape) {
  const size = places[0].length;
  const variance = Math.exp(theta[0]);
  const lengths = theta.slice(1, 1 + size).map(Math.exp);
  const noise = theta.length > 1 + size ? Math.exp(theta[1 + size]) : 0;
  const scaled = places.map((place) => Float64Array.from(place, (value, i) => value / lengths[i]));
  const covariance = (a, b) => {
    let sum = 0;
    for (let i = 0; i < size; i++) sum += (a[i] - b[i]) ** 2;
    return variance * shape(Math.sqrt(sum));
  };
  const withCases = (place) => {
    const here = Float64Array.from(place, (value, i) => value / lengths[i]);
    return Float64Array.from(scaled, (other) => covariance(here, other));
  };
  let lower = null;
  const factor = () => {
    if (lower === null) {
      lower = cholesky(
        scaled.map((a, i) => scaled.map((b, j) => covariance(a, b) + (i === j ? noise + nugget : 0))),
      );
    }
    return lower;
  };
  return {
    mean: (place) => dot(withCases(place), weights),
    // variance away from the cases, and the weight of each case in the prediction
    error(place) {
      const row = withCases(place);
      const shares = solveFactored(factor(), row);
      return [Math.max(0, variance + noise - dot(row, shares)), shares];
    },
  };
}

function gaussianProcess(plain, cases) {
  const coded = (point) => point.map((value, i) => (value - plain.centre[i]) / plain.half[i]);
  const places = cases.map(coded);
  const processes = plain.components.map((one) =>
    makeProcess(one.theta, places, one.weights, plain.nugget, matern),
  );
  const constant = typeof plain.mean === "number";
  const under = constant ? null : makeSurface(plain.mean, cases);
  const columns = constant ? [] : plain.mean.factors.map((name) => plain.factors.indexOf(name));
  const meanAt = (point) => (constant ? plain.mean : under.predict(columns.map((i) => point[i])));
  const slopesAt = (point) => (constant ? [1] : under.slopes(columns.map((i) => point[i])));
  const average = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
  const predict = (point) =>
    average(processes.map((one) => one.mean(coded(point)))) * plain.scale + meanAt(point);
  let basis = null;
  // what the error of the mean's coefficients adds: the cases take up a part of it
  const meanVariance = (one, slopes, shares) => {
    const lever = slopes.map((slope, j) => {
      let sum = slope;
      for (let i = 0; i < shares.length; i++) sum -= shares[i] * basis[i][j];
      return sum;
    });
    return Math.max(0, quadratic(symmetric(one.mean_covariance, lever.length), lever));
  };
  return {
    predict,
    interval(point) {
      if (basis === null) basis = cases.map(slopesAt);
      const slopes = slopesAt(point);
      const means = processes.map((one) => one.mean(coded(point)));
      const variances = processes.map((one, i) => {
        const [alone, shares] = one.error(coded(point));
        return alone + meanVariance(plain.components[i], slopes, shares);
      });
      const between = average(means.map((value) => (value - average(means)) ** 2));
      const middle = predict(point);
      const half = plain.quantile * Math.sqrt(average(variances) + between) * plain.scale;
      return [middle - half, middle + half];
    },
  };
}

// ---- spokes that carry several rings -------------------------------------------------------

function legendre(x, degree) {
  const values = [1, x];
  for (let n = 2; n <= degree; n++) values.push(((2 * n - 1) * x * values[n - 1] - (n - 1) * values[n - 2]) / n);
  return values;
}

function spokeFeatures(ply, [spacing, thickness, angle, c10]) {
  const stiffness = rotatedStiffness(ply, angle);
  const free = 1 / solveLinear(stiffness, [[1], [0], [0]])[0][0];
  return [
    Math.log(1 / spacing),
    Math.log(thickness),
    angle,
    Math.log(c10),
    Math.log((thickness ** 3 * free) / c10),
    Math.log((thickness * stiffness[0][0]) / c10),
  ];
}

function spokeProcess(plain) {
  const processes = plain.processes.map((one) => ({
    ...one,
    process: makeProcess(one.theta, plain.unit, one.weights, one.nugget, squaredExponential),
  }));
  const highest = Math.max(...plain.exponents.flat());
  const moments = (point, errors) => {
    const spoke = plain.spoke.map((column) => point[column]);
    const unit = spokeFeatures(plain.ply, spoke).map((f, i) => (f - plain.middle[i]) / plain.spread[i]);
    const lines = plain.ring.map((column, i) => {
      const [low, high] = [plain.low[i], plain.high[i]];
      return legendre((2 * Math.log(point[column]) - low - high) / (high - low), highest);
    });
    const ring = plain.exponents.map((powers) => powers.reduce((product, power, i) => product * lines[i][power], 1));
    const along = (direction) => direction.reduce((sum, value, i) => sum + value * ring[i], 0);
    let value = along(plain.mean);
    let variance = plain.misfit ** 2;
    processes.forEach((one, i) => {
      const weight = along(plain.directions[i]);
      value += weight * (one.process.mean(unit) * one.spread + one.middle);
      if (errors) variance += (one.inflation * weight * one.spread) ** 2 * one.process.error(unit)[0];
    });
    return [value, Math.sqrt(variance)];
  };
  const back = plain.logarithmic ? Math.exp : (value) => value;
  return {
    predict: (point) => back(moments(point, false)[0]),
    interval(point) {
      const [middle, deviation] = moments(point, true);
      return [back(middle - plain.quantile * deviation), back(middle + plain.quantile * deviation)];
    },
  };
}

const KINDS = {
  Surface: polynomialSurface,
  LinkedSurface: linkedSurface,
  Lamination: laminationSurface,
  GaussianProcess: gaussianProcess,
  SpokeProcess: spokeProcess,
};

// A surface that predicts, from its plain values; a process also needs the cases it was fitted to.
function makeSurface(plain, cases) {
  return KINDS[plain.kind](plain, cases);
}
