/**
 * Convergence test and acceleration of the orders of scattering, by formulas and loops emitted from
 * solver/moments/convergence.py, iterate_update.py, stopping.py and acceleration.py.
 *
 * Arrays of light have shape (node, wavelength), with four wavelengths per node.
 */
import {
  acceleration_weight,
  add_weighted,
  combine,
  counted_changes,
  damp_towards,
  geometric_tail,
  is_converged,
  is_near,
  logarithmic_progress,
  replace_unsound,
  stricter_tolerance,
  tail_steps,
} from "../generated/formulas.js";
import { LANES } from "../generated/sizes.js";

/** Table as emitted functions read and write it. */
export const table = (values, ...shape) => ({ values, shape });

/** Decisions of the iteration: `Iteration` of solver/moments/stopping.py, without restarts. */
export class Iteration {
  /**
   * @param {object} stopping Fields of `Stopping`.
   * @param {number[]} thick Weight of optically thick media, by wavelength.
   */
  constructor(stopping, thick) {
    this.stopping = stopping;
    this.thick = table(thick, LANES);
    this.tolerance = stricter_tolerance(stopping.tolerance, stopping.stricter, Math.max(...thick));
    this.sweeps = 0;
    this.remainingError = Infinity;
    this.residuals = [];
  }

  get isUnfinished() {
    return !is_converged(this.sweeps, 2, this.remainingError, this.tolerance);
  }

  get progress() {
    return logarithmic_progress(this.remainingError, this.tolerance);
  }

  /** Update the remaining error by the quantities of a guess and of its iterate. */
  update(before, after) {
    const nodes = after.length / LANES;
    const [changes, largest] = [new Float64Array(after.length), new Float64Array(LANES)];
    counted_changes(
      table(before, 1, nodes, LANES),
      table(after, 1, nodes, LANES),
      this.thick,
      this.stopping.night,
      table(brightest(after), LANES),
      table(changes, nodes, LANES),
      table(largest, LANES),
    );
    this.residuals.push(changes);
    if (this.residuals.length > this.stopping.iterates) this.residuals.shift();
    this.remainingError = Math.max(...largest.map((size, lane) => size * this.tail(lane)));
    this.sweeps += 1;
  }

  /** Sum of all further changes over the last, of a wavelength. */
  tail(lane) {
    const size = (one) => Math.sqrt(product(one, one, lane));
    const steps = tail_steps(this.residuals.length);
    return geometric_tail(size(this.residuals.at(-1)), size(this.residuals.at(-1 - steps)), steps);
  }

  /** Anderson weights, by iterate, the latest last, and wavelength. */
  weights() {
    const { residuals } = this;
    const last = residuals.at(-1);
    const changes = residuals.slice(1).map((one, i) => one.map((x, k) => x - residuals[i][k]));
    const found = residuals.map(() => new Float64Array(LANES));
    const weights = new Float64Array(residuals.length);
    for (let lane = 0; lane < LANES; lane++) {
      const products = changes.flatMap((a) => [...changes, last].map((b) => product(a, b, lane)));
      combine(products, residuals.length, weights);
      found.forEach((one, i) => (one[lane] = weights[i]));
    }
    return found;
  }
}

/** Largest value of each wavelength. */
export function brightest(light) {
  const most = new Float64Array(LANES).fill(-Infinity);
  light.forEach((value, i) => {
    most[i % LANES] = Math.max(most[i % LANES], value);
  });
  return most;
}

/** Weights of synthetic acceleration: `acceleration_weights` of mean radiances (radius, sun). */
export function accelerationWeights(mean, sun_angles, thresholds) {
  const most = brightest(mean).map((x) => Math.max(x, 1e-30));
  const column = new Float64Array(sun_angles * LANES).fill(-Infinity);
  mean.forEach((value, i) => {
    column[i % column.length] = Math.max(column[i % column.length], value);
  });
  return Float32Array.from(mean, (value, i) => {
    const lane = i % LANES;
    const bright = (value / most[lane]) * (column[i % column.length] / most[lane]);
    return acceleration_weight(Math.max(bright, 0), thresholds[lane]);
  });
}

/** Replace moments (node, term) of a part of the light where a test of their means fails. */
export function replaceUnless(test, light, other) {
  const [, nodes, terms] = light.shape;
  const [here, there] = [light, other].map((one) => meanOf(one));
  const sound = Float32Array.from(here, (value, i) => test(value, there[i], i % LANES));
  replace_unsound(light, other, table(sound, 1, nodes, LANES));
}

/** Mean radiances, or irradiances, of a part of the light. */
export function meanOf({ values, shape: [, nodes, terms] }) {
  return Float32Array.from({ length: nodes * LANES }, (_, i) => {
    return values[Math.floor(i / LANES) * terms * LANES + (i % LANES)];
  });
}

/**
 * Next guess of a part of the light, by Anderson acceleration.
 *
 * @param {object[]} iterates Tables, the latest last.
 * @param {Float64Array[]} weights From `Iteration.weights`.
 * @param {object} damping Table from `accelerationWeights`.
 * @param {object} mixed Table that receives the guess; 0 before.
 */
export function andersonStep(iterates, weights, damping, mixed) {
  const last = iterates.at(-1);
  iterates.forEach((one, k) => add_weighted(mixed, one, table(weights[k], LANES)));
  damp_towards(mixed, last, damping);
  const most = brightest(meanOf(last));
  replaceUnless((value, computed, lane) => is_near(value, computed, most[lane]), mixed, last);
}

function product(a, b, lane) {
  let sum = 0;
  for (let i = lane; i < a.length; i += LANES) sum += a[i] * b[i];
  return sum;
}
