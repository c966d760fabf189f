/**
 * When the orders of scattering have arrived, and what the next guess is.
 *
 * Light is (node, wavelength), four wavelengths a node. The formulas are those of
 * solvers/moments/convergence.py and acceleration.py, which have the reasons.
 */

/** Wavelengths of a texel. */
const LANES = 4;
/** Where the combination is not told, by how much diagonals are larger. */
const RIDGE = 1 + 1e-10;

/** The largest value of each wavelength. */
export function brightest(light) {
  const most = new Float64Array(LANES).fill(-Infinity);
  light.forEach((value, i) => {
    most[i % LANES] = Math.max(most[i % LANES], value);
  });
  return most;
}

/** Relative change where it is not dark, else 0. */
export function relativeChange(before, after, dark) {
  const most = brightest(after);
  return Float64Array.from(after, (value, i) =>
    value > dark * most[i % LANES] ? (value - before[i]) / value : 0,
  );
}

/** How much a relative change counts: less in the night of thick air. */
export function counts(mean, thick, dim) {
  const most = brightest(mean);
  return Float64Array.from(mean, (value, i) => {
    const bright = Math.max(value / (dim * most[i % LANES]), 1e-30);
    return Math.min(bright, 1) ** thick[i % LANES];
  });
}

/** All later changes together over the last one, of each wavelength. */
export function whatFollows(residuals, [least, most]) {
  const size = (one, lane) => Math.sqrt(product(one, one, lane));
  const back = Math.min(residuals.length, 3);
  const last = residuals[residuals.length - 1];
  return Array.from({ length: LANES }, (_, lane) => {
    const before = size(residuals[residuals.length - back], lane);
    const ratio = back > 1 && before > 0 ? size(last, lane) / before : 0.5;
    const shrinkage = Math.min(Math.max(ratio ** (1 / Math.max(back - 1, 1)), least), most);
    return shrinkage / (1 - shrinkage);
  });
}

/**
 * Weights of the last images whose residuals combine to the smallest one, the latest last.
 *
 * @param {Float64Array[]} residuals
 * @param {number} lane Wavelength.
 */
export function mixingWeights(residuals, lane) {
  const steps = residuals.length;
  const plain = Array.from({ length: steps }, (_, i) => Number(i === steps - 1));
  if (steps < 2) return plain;
  const changes = residuals.slice(1).map((one, i) => one.map((x, k) => x - residuals[i][k]));
  const normal = changes.map((a, i) =>
    changes.map((b, j) => product(a, b, lane) * (i === j ? RIDGE : 1)),
  );
  const mixed = solved(normal, changes.map((one) => product(one, residuals[steps - 1], lane)));
  if (!mixed.every(Number.isFinite)) return plain;
  mixed.forEach((x, i) => {
    plain[i + 1] -= x;
    plain[i] += x;
  });
  return plain;
}

function product(a, b, lane) {
  let sum = 0;
  for (let i = lane; i < a.length; i += LANES) sum += a[i] * b[i];
  return sum;
}

/** The solution of a few linear equations, by elimination. */
function solved(matrix, right) {
  const rows = matrix.map((row, i) => [...row, right[i]]);
  const n = rows.length;
  for (let k = 0; k < n; k++) {
    let best = k;
    for (let i = k + 1; i < n; i++) {
      if (Math.abs(rows[i][k]) > Math.abs(rows[best][k])) best = i;
    }
    [rows[k], rows[best]] = [rows[best], rows[k]];
    for (let i = k + 1; i < n; i++) {
      const share = rows[i][k] / rows[k][k];
      for (let j = k; j <= n; j++) rows[i][j] -= share * rows[k][j];
    }
  }
  const found = new Array(n).fill(0);
  for (let k = n - 1; k >= 0; k--) {
    const known = found.reduce((sum, x, j) => (j > k ? sum + rows[k][j] * x : sum), 0);
    found[k] = (rows[k][n] - known) / rows[k][k];
  }
  return found;
}
