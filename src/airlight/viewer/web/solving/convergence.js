/**
 * Convergence test and acceleration of the orders of scattering.
 *
 * Arrays of light have shape (node, wavelength), with four wavelengths per node. The formulas per
 * node or wavelength are those of solver/moments/convergence.py and acceleration.py.
 */
import {
  change_at,
  combine,
  count_at,
  is_near,
  acceleration_weight,
  geometric_tail,
} from "../generated/formulas.js";
import { LANES } from "../generated/sizes.js";

/** Largest value of each wavelength. */
export function brightest(light) {
  const most = new Float64Array(LANES).fill(-Infinity);
  light.forEach((value, i) => {
    most[i % LANES] = Math.max(most[i % LANES], value);
  });
  return most;
}

/** Relative change; 0 below the threshold of darkness. */
export function relativeChange(before, after) {
  const most = brightest(after);
  return Float64Array.from(after, (value, i) => change_at(before[i], value, most[i % LANES]));
}

/** Weight of a relative change, which is smaller on the night side of a thick atmosphere. */
export function counts(mean, thick) {
  const most = brightest(mean);
  return Float64Array.from(mean, (value, i) => count_at(value, most[i % LANES], thick[i % LANES]));
}

/** Geometric tail: sum of all later changes over the last, from `back` steps, by wavelength. */
export function estimatedTail(residuals, back) {
  const size = (one, lane) => Math.sqrt(product(one, one, lane));
  const steps = Math.min(residuals.length, back + 1) - 1;
  const [before, last] = [residuals.length - 1 - steps, residuals.length - 1];
  return Array.from({ length: LANES }, (_, lane) =>
    geometric_tail(size(residuals[last], lane), size(residuals[before], lane), steps),
  );
}

/**
 * Weights of the last iterates that minimise the combined residual, the latest last.
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

/**
 * Weights of synthetic acceleration, by node and wavelength; see `acceleration_weights` in
 * solver/moments/convergence.py.
 *
 * @param {Float32Array} mean Mean radiance, by radius, sun and wavelength.
 * @param {number} sun_angles
 * @param {number[]} thresholds Fraction of the largest mean radiance below which lateral transport
 *   dominates, by wavelength.
 */
export function accelerationWeights(mean, sun_angles, thresholds) {
  const most = brightest(mean).map((x) => Math.max(x, 1e-30));
  const column = new Float64Array(sun_angles * LANES).fill(-Infinity);
  mean.forEach((value, i) => {
    column[i % column.length] = Math.max(column[i % column.length], value);
  });
  return Float64Array.from(mean, (value, i) => {
    const lane = i % LANES;
    const bright = (value / most[lane]) * (column[i % column.length] / most[lane]);
    return acceleration_weight(Math.max(bright, 0), thresholds[lane]);
  });
}

/**
 * Values at the nodes of a light: an array of moments (node, term), then irradiances (node).
 *
 * @param {Float32Array} light
 * @param {number} nodes
 * @param {number} terms
 * @param {number} term Number of the moment.
 */
export function momentOf(light, nodes, terms, term) {
  const values = new Float32Array(nodes * LANES);
  for (let i = 0; i < values.length; i++) {
    values[i] = light[(Math.floor(i / LANES) * terms + term) * LANES + (i % LANES)];
  }
  return values;
}

/** Replace the moments or the irradiance of nodes by others, where a test of both fails. */
export function replaceUnless(test, light, other, nodes, terms) {
  for (let node = 0; node < nodes; node++) {
    for (let lane = 0; lane < LANES; lane++) {
      const mean = node * terms * LANES + lane;
      const sky = (nodes * terms + node) * LANES + lane;
      if (!test(light[sky], other[sky], lane, "sky")) light[sky] = other[sky];
      if (test(light[mean], other[mean], lane, "mean")) continue;
      for (let term = 0; term < terms; term++) light[mean + term * LANES] = other[mean + term * LANES];
    }
  }
}

/**
 * Next guess by Anderson acceleration: each wavelength has its own combination of iterates.
 *
 * @param {Float32Array[]} iterates The latest last.
 * @param {number[][]} weights Weights of the iterates, by wavelength.
 * @param {Float64Array} damping From `accelerationWeights`.
 * @param {number} nodes
 * @param {number} terms
 */
export function andersonStep(iterates, weights, damping, nodes, terms) {
  const last = iterates[iterates.length - 1];
  const most = {
    mean: brightest(momentOf(last, nodes, terms, 0)),
    sky: brightest(last.subarray(nodes * terms * LANES)),
  };
  const light = last.map((value, i) => {
    const texel = Math.floor(i / LANES);
    const node = texel < nodes * terms ? Math.floor(texel / terms) : texel - nodes * terms;
    let total = 0;
    iterates.forEach((iterate, k) => {
      total += weights[i % LANES][k] * iterate[i];
    });
    return value + damping[node * LANES + (i % LANES)] * (total - value);
  });
  const near = (value, computed, lane, part) => is_near(value, computed, most[part][lane]);
  replaceUnless(near, light, last, nodes, terms);
  return light;
}

function product(a, b, lane) {
  let sum = 0;
  for (let i = lane; i < a.length; i += LANES) sum += a[i] * b[i];
  return sum;
}
