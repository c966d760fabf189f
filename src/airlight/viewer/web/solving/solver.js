/**
 * Moments solver on a device: successive orders of scattering as fragment passes.
 *
 * A description from viewer/browser/page_solver.py has the `plan` of gpu/solver/plan.py, its
 * `uniforms`, `scalars` (its tables in order) and `shaders`, the coefficients of the `air`, and the
 * stopping criteria. In thick air, where successive orders converge too slowly, the iteration has
 * synthetic acceleration (synthetic_acceleration.js), as in solver/moments/iterate.py.
 */
import { SyntheticAcceleration } from "./synthetic_acceleration.js";
import {
  accelerationWeights,
  brightest,
  counts,
  andersonStep,
  mixingWeights,
  momentOf,
  relativeChange,
  replaceUnless,
  estimatedTail,
} from "./convergence.js";
import { numbersOf, textOf } from "../drawing/package.js";
import { LANES, ROW } from "../generated/sizes.js";

const FORMAT = "rgba32float";
const VERTEX = "full_screen_triangle";

export class Solver {
  /**
   * @param {object} device See devices/device.js.
   * @param {object} description
   * @param {object} plain Picture of the unedited planet, which has the `ratios` if these are null.
   * @returns {Promise<Solver>} Solver with compiled passes.
   */
  static async make(device, description, plain) {
    const shaders = JSON.parse(await textOf(description.shaders));
    const tables = Object.values(description.scalars);
    const parts = await Promise.all(tables.map((one) => (one ? numbersOf(one) : columnsOf(plain))));
    const solver = new Solver(device, description, Float32Array.from(parts.flatMap((p) => [...p])));
    await solver.build(shaders);
    return solver;
  }

  constructor(device, description, scalars) {
    this.device = device;
    this.fixed = description;
    this.plan = description.plan;
    this.scalars = scalars;
    this.solve = Float32Array.from(description.uniforms);
    this.mix = new Float32Array((this.plan.iterates.length + 2) * LANES);
    this.textures = new Map();
    this.passes = new Map();
    this.ring = [...this.plan.iterates];
    this.sweeps = 0;
    this.residual = 0;
  }

  async build(shaders) {
    const { device } = this;
    const work = Object.entries(shaders).map(async ([name, shader]) => {
      const text = {
        ...shader,
        glsl: { vertex: shader.glsl?.[VERTEX], fragment: shader.glsl?.fill },
        vertex: VERTEX,
        entry: "fill",
        reads: Object.keys(shader.reads),
      };
      const pipeline = await device.pipeline(text, Array(shader.targets).fill(FORMAT));
      this.passes.set(name, { pipeline, reads: shader.reads, uniforms: shader.uniforms });
    });
    await Promise.all(work);
    for (const [name, texels] of Object.entries(this.plan.textures)) {
      this.textures.set(name, device.target(FORMAT, ROW, Math.ceil(texels / ROW)));
    }
  }

  /**
   * Solve for an atmosphere.
   *
   * @param {object} air See edited_air.js.
   * @param {() => boolean} stale Whether the request is superseded.
   * @param {(share: number) => void} onProgress Receives how far it is, from 0 to 1, after each order.
   * @returns {Promise<object | null>} Texture of the light, owned by the caller; null if stale.
   * @throws {Error} If the orders do not converge; one line.
   */
  async light(air, stale, onProgress = () => {}) {
    this.load(air);
    this.guess = "first";
    this.run("once");
    const thick = Math.max(...air.transport) > this.fixed.synthetic.thicker;
    const solved = await (thick ? this.accelerate(air, stale, onProgress) : this.sum(air, stale, onProgress));
    if (!solved) return null;
    if (this.sweeps > this.fixed.most_sweeps) {
      const most = this.fixed.most_sweeps;
      throw new Error(`after ${most} orders light still changes: less air is needed`);
    }
    this.run("pack");
    const packed = this.textures.get("packed");
    this.textures.set("packed", this.device.target(FORMAT, ROW, packed.height));
    return packed;
  }

  /** Sum order after order; false if stale. */
  async sum(air, stale, onProgress) {
    const { fixed } = this;
    const tolerance = fixed.tolerance * (1 - fixed.stricter * Math.max(...air.thick));
    const residuals = [];
    for (this.sweeps = 1; this.sweeps <= fixed.most_sweeps; this.sweeps++) {
      if (stale()) return false;
      this.ring.unshift(this.ring.pop());
      this.run("pack");
      this.run("sweep");
      const [mean, sky, before] = await this.means();
      if (!mean.some((x) => x > 0)) break;
      const change = relativeChange(before, mean);
      const counted = counts(mean, air.thick);
      residuals.push(change.map((x, i) => x * counted[i]));
      if (residuals.length > this.ring.length) residuals.shift();
      this.residual = this.remainingError(change, mean, residuals, air.thick, fixed.night);
      onProgress(shareOf(this.residual, tolerance));
      this.updateWeights(residuals, mean, sky);
      this.run("mix");
      this.guess = "light";
      if (this.residual <= tolerance && this.sweeps > 1) break;
    }
    return true;
  }

  /** Iterate with synthetic acceleration; false if stale. */
  async accelerate(air, stale, onProgress) {
    const { fixed, plan } = this;
    const { over_relaxation, iterates: most, least, tolerance } = fixed.synthetic;
    const { lateral_threshold, transport_depth_scale } = fixed.synthetic;
    const { radii, sun_angles, terms } = plan.sizes;
    const nodes = radii * sun_angles;
    const polarised = over_relaxation.map((_, i) => terms - over_relaxation.length + i);
    const synthetic = await this.synthetic(air);
    const first = await this.numbers("first");
    const [shallow, deep] = lateral_threshold;
    const thresholds = air.transport.map((x, w) => {
      const ratio = Math.max(x / transport_depth_scale, 1);
      return air.thick[w] * Math.min(shallow * ratio ** 3, deep);
    });
    const lit = (guess, swept) => guess > least * swept;
    let light = synthetic.apply(first);
    replaceUnless(lit, light, first, nodes, terms);
    const residuals = [];
    const iterates = [];
    for (this.sweeps = 1; this.sweeps <= fixed.most_sweeps; this.sweeps++) {
      await breath();
      if (stale()) return false;
      this.put("given", FORMAT, light);
      this.guess = "given";
      this.run("pack");
      this.run("sweep");
      const swept = await this.numbers(this.ring[0], plan.textures.light);
      const mean = momentOf(swept, nodes, terms, 0);
      if (!mean.some((x) => x > 0)) break;
      const acceleration = accelerationWeights(mean, sun_angles, thresholds);
      const residual = swept.map((x, i) => x - light[i]);
      const accelerated = synthetic.apply(residual, swept);
      const iterate = light.map((value, i) => {
        const texel = Math.floor(i / LANES);
        const [node, term] =
          texel < nodes * terms
            ? [Math.floor(texel / terms), texel % terms]
            : [texel - nodes * terms, 0];
        const weight = acceleration[node * LANES + (i % LANES)];
        const change = residual[i] + weight * (accelerated[i] - residual[i]);
        return value + change * (over_relaxation[term - polarised[0]] ?? 1);
      });
      replaceUnless(lit, iterate, swept, nodes, terms);
      iterates.push(iterate);
      if (iterates.length > most) iterates.shift();
      // Mean radiances, and mean radiances that differ by the change of each polarised moment.
      const after = momentOf(iterate, nodes, terms, 0);
      const steps = [0, ...polarised].map((term) => {
        const [old, now] = [light, iterate].map((one) => momentOf(one, nodes, terms, term));
        const before = after.map((x, i) => x - (now[i] - old[i]));
        return relativeChange(before, after);
      });
      const counted = counts(after, air.thick);
      residuals.push(Float64Array.from(steps.flatMap((one) => [...one.map((x, i) => x * counted[i])])));
      if (residuals.length > most) residuals.shift();
      this.residual = Math.max(
        ...steps.map((step) => this.remainingError(step, after, residuals, air.thick, 1)),
      );
      if (!Number.isFinite(this.residual)) throw new Error("this air's light is not a finite number");
      onProgress(shareOf(this.residual, tolerance));
      const weights = Array.from({ length: LANES }, (_, lane) => mixingWeights(residuals, lane));
      light = andersonStep(iterates, weights, acceleration, nodes, terms);
      if (this.residual <= tolerance && this.sweeps > 1) break;
    }
    this.put("given", FORMAT, light);
    this.guess = "given";
    return true;
  }

  /** Synthetic acceleration in an atmosphere, from the textures of its rays. */
  async synthetic(air) {
    const { fixed, plan } = this;
    const { diffusion_length, grid_diffusion, deep, cubics, ...limits } = fixed.synthetic;
    const names = ["factors", "shares", "bounces", "projections"];
    const rays = {};
    for (const name of names) rays[name] = await this.numbers(name);
    const weights = await numbersOf(cubics);
    const transport = Math.max(...air.transport);
    const diffusion = {
      diffusion_length,
      grid_diffusion: grid_diffusion * diffusion_length * transport,
      deep: transport > deep,
    };
    const table = (name) => this.table(name);
    const fixedLimits = { ...limits, cubics: weights };
    return new SyntheticAcceleration(plan, table, fixedLimits, rays, diffusion).eliminate(breath);
  }

  /** Table of the plan, as emitted functions read it. */
  table(name) {
    const { start, shape } = this.plan.tables[name];
    const count = shape.reduce((all, n) => all * n, 1);
    return { values: this.scalars.subarray(start, start + count), shape };
  }

  /** Promise of the numbers of a texture. */
  async numbers(name, texels = this.plan.textures[name]) {
    return (await this.device.read(this.textures.get(name))).subarray(0, texels * LANES);
  }

  /** Replace the tables of the atmosphere. */
  load(air) {
    const { plan, scalars } = this;
    const lanes = ["extinction", "moments", "polarised_moments", "albedo"].sort(
      (a, b) => plan.tables[a].start - plan.tables[b].start,
    );
    const spectra = Float32Array.from(lanes.flatMap((name) => [...air[name]]));
    scalars.set(air.level, plan.tables.level.start);
    this.put("scalars", "r32float", scalars);
    this.put("spectra", FORMAT, spectra);
  }

  put(name, format, numbers) {
    const before = this.textures.get(name);
    this.textures.set(name, this.device.flatTexture(format, numbers));
    if (before) this.device.release(before);
  }

  /** Run a list of passes of the plan. */
  run(list) {
    for (const { shader, targets, span } of this.plan.passes[list]) {
      const { pipeline, reads, uniforms } = this.passes.get(shader);
      const numbers = { solve: this.solve, span: Float32Array.from(span), mix: this.mix };
      const top = Math.floor(span[0] / ROW);
      this.device.run(
        pipeline,
        Object.fromEntries(Object.entries(uniforms).map(([name, slot]) => [slot, numbers[name]])),
        Object.fromEntries(Object.entries(reads).map(([slot, name]) => [slot, this.texture(name)])),
        targets.map((one) => this.texture(one, true)),
        [0, top, ROW, Math.ceil(span[1] / ROW) - top],
      );
    }
  }

  /** Texture by its name in a shader; iterates rotate, and the first guess is the first order. */
  texture(name, isTarget = false) {
    if (name === "iterate") return this.textures.get(this.ring[0]);
    if (name === "light" && !isTarget) return this.textures.get(this.guess);
    const iterate = this.plan.iterates.indexOf(name);
    return this.textures.get(iterate < 0 ? name : this.ring[iterate]);
  }

  /** Promise of mean radiance and irradiance of the last iterate, and mean radiance of the guess. */
  async means() {
    const { radii, sun_angles } = this.plan.sizes;
    const length = radii * sun_angles * LANES;
    const numbers = await this.device.read(this.textures.get("means"));
    return [0, 1, 2].map((part) => numbers.slice(part * length, (part + 1) * length));
  }

  /** Largest remaining change, estimated. [1] */
  remainingError(change, mean, residuals, thick, share) {
    const { fixed } = this;
    const night = counts(mean, thick.map((x) => share * x));
    const largest = brightest(change.map((x, i) => Math.abs(x * night[i])));
    const follows = estimatedTail(residuals, fixed.back);
    return Math.max(...largest.map((x, lane) => x * follows[lane]));
  }

  /** Set the inputs of the pass `next_guess`: weights, last iterate first, and two largest values. */
  updateWeights(residuals, mean, sky) {
    this.mix.fill(0);
    const iterates = this.ring.length;
    for (let lane = 0; lane < LANES; lane++) {
      mixingWeights(residuals, lane)
        .reverse()
        .forEach((weight, i) => {
          this.mix[i * LANES + lane] = weight;
        });
    }
    this.mix.set(brightest(mean), iterates * LANES);
    this.mix.set(brightest(sky), (iterates + 1) * LANES);
  }
}

/** Promise of the ratios of the columns towards the star, from a picture's tables. */
async function columnsOf({ tables, uniforms }) {
  const [start, ...shape] = uniforms.table_columns;
  const count = shape.reduce((all, n) => all * n, 2);
  return (await numbersOf(tables.scalars.data)).subarray(start, start + count);
}

/** Progress by logarithm: 0 at a change of 1, 1 at the tolerance. */
function shareOf(change, tolerance) {
  return Math.log(Math.max(Math.min(change, 1), tolerance)) / Math.log(tolerance);
}

/** Promise of a moment in which the page answers. */
function breath() {
  return new Promise((resolve) => setTimeout(resolve));
}
