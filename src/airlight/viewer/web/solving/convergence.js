/**
 * Convergence test and acceleration of the orders of scattering.
 *
 * Arrays of light have shape (node, wavelength), with four wavelengths per node. The formulas per
 * node or wavelength are those of solvers/moments/convergence.py and acceleration.py.
 */
import { change_at, combine, count_at, rest_after } from "../generated/formulas.js";
import { LANES } from "../generated/sizes.js";

/** Largest value of each wavelength. */
export function brightest(light) {
  const most = new Float64Array(LANES).fill(-Infinity);
  light.forEach((value, i) => {
    most[i % LANES] = Math.max(most[i % LANES], value);
  });
  return most;
}

/** Relative change; 0 where it is dark. */
export function relativeChange(before, after) {
  const most = brightest(after);
  return Float64Array.from(after, (value, i) => change_at(before[i], value, most[i % LANES]));
}

/** Weight of a relative change, which is smaller on the night side of a thick atmosphere. */
export function counts(mean, thick) {
  const most = brightest(mean);
  return Float64Array.from(mean, (value, i) => count_at(value, most[i % LANES], thick[i % LANES]));
}

/** Ratio of the sum of all later changes to the last one, from `back` steps, by wavelength. */
export function whatFollows(residuals, back) {
  const size = (one, lane) => Math.sqrt(product(one, one, lane));
  const steps = Math.min(residuals.length, back + 1) - 1;
  const [before, last] = [residuals.length - 1 - steps, residuals.length - 1];
  return Array.from({ length: LANES }, (_, lane) =>
    rest_after(size(residuals[last], lane), size(residuals[before], lane), steps),
  );
}

/**
 * Weights of the last images that minimise the combined residual, the latest last.
 *
 * @param {Float64Array[]} residuals
 * @param {number} lane Index of the wavelength.
 */
export function mixingWeights(residuals, lane) {
  const weights = new Float64Array(residuals.length);
  const last = residuals[residuals.length - 1];
  const changes = residuals.slice(1).map((one, i) => one.map((x, k) => x - residuals[i][k]));
  const products = changes.flatMap((a) => [...changes, last].map((b) => product(a, b, lane)));
  combine(products, residuals.length, weights);
  return [...weights];
}

function product(a, b, lane) {
  let sum = 0;
  for (let i = lane; i < a.length; i += LANES) sum += a[i] * b[i];
  return sum;
}
