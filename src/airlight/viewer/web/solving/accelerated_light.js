/** Iteration of thick air in arrays, with synthetic acceleration: `_Sweeps` of moments/iterate.py. */
import {
  accelerate_nodes,
  fill_quantities,
  is_positive,
  lateral_threshold_of,
} from "../generated/formulas.js";
import { LANES } from "../generated/sizes.js";
import { accelerationWeights, andersonStep, meanOf, replaceUnless, table } from "./convergence.js";

export class AcceleratedLight {
  /**
   * @param {object} solver See solver.js; it has computed the first order.
   * @param {object} air See edited_air.js.
   */
  static async make(solver, air) {
    const made = new AcceleratedLight(solver, air);
    made.synthetic = await solver.synthetic(air);
    const first = await solver.numbers("first");
    made.light = made.synthetic.apply(first);
    const swept = made.parts(first);
    made.parts(made.light).forEach((part, i) => replaceUnless(is_positive, part, swept[i]));
    solver.setGuess(made.light);
    return made;
  }

  constructor(solver, air) {
    this.solver = solver;
    this.iterates = [];
    this.thresholds = air.transport.map((x, w) => lateral_threshold_of(x, air.thick[w]));
  }

  /** Moments and irradiances of a light as tables (1, node, term, wavelength). */
  parts(light) {
    const { radii, sun_angles, terms } = this.solver.plan.sizes;
    const nodes = radii * sun_angles;
    const moments = nodes * terms * LANES;
    return [
      table(light.subarray(0, moments), 1, nodes, terms, LANES),
      table(light.subarray(moments), 1, nodes, 1, LANES),
    ];
  }

  /** Compute the next iterate: a sweep of the guess, and its accelerated residual. */
  async sweep() {
    const { solver, light } = this;
    const { over_relaxation, stopping } = solver.fixed.synthetic;
    solver.sweep();
    const swept = await solver.numbers("iterate", solver.plan.textures.light);
    const mean = meanOf(this.parts(swept)[0]);
    const nodes = mean.length / LANES;
    this.weight = accelerationWeights(mean, solver.plan.sizes.sun_angles, this.thresholds);
    const residual = swept.map((x, i) => x - light[i]);
    const iterate = new Float32Array(light.length);
    const all = [light, residual, this.synthetic.apply(residual, swept), swept, iterate];
    for (const [part, factors] of [over_relaxation, []].entries()) {
      const [guess, change, accelerated, once, out] = all
        .map((one) => this.parts(one)[part])
        .map(({ values, shape }) => table(values, ...shape.slice(1)));
      const weight = table(this.weight, nodes, LANES);
      const relaxed = table(factors, factors.length);
      accelerate_nodes(guess, change, accelerated, once, weight, relaxed, 1, out);
    }
    this.iterates.push(iterate);
    if (this.iterates.length > stopping.iterates) this.iterates.shift();
  }

  /** Mean radiances, and their sums with the changes of the polarised moments. */
  reduce() {
    const [[before], [after]] = [this.light, this.iterates.at(-1)].map((one) => this.parts(one));
    const [, nodes, terms] = after.shape;
    const polarised = this.solver.fixed.synthetic.over_relaxation.length;
    const shape = [1, nodes, 1 + polarised, LANES];
    const [earlier, mean] = [0, 1].map(() => new Float32Array(nodes * (1 + polarised) * LANES));
    const filled = [earlier, mean].map((values) => table(values, ...shape));
    fill_quantities(before, after, terms - polarised, ...filled);
    return [earlier, mean];
  }

  /** Compute the next guess, damped by the acceleration weights. */
  combine(weights) {
    this.light = new Float32Array(this.light.length);
    this.parts(this.light).forEach((mixed, part) => {
      const iterates = this.iterates.map((one) => this.parts(one)[part]);
      andersonStep(iterates, weights, table(this.weight, 1, mixed.shape[1], LANES), mixed);
    });
    this.solver.setGuess(this.light);
  }
}
