/**
 * Moments solver on a device: successive orders of scattering as fragment passes.
 *
 * A description from viewer/browser/page_solver.py has the `plan` of gpu/solver/plan.py, its
 * `uniforms`, `scalars` (its tables in order) and `shaders`, the coefficients of the `air`, and the
 * stopping criteria.
 */
import { brightest, counts, mixingWeights, relativeChange, whatFollows } from "./convergence.js";
import { numbersOf, textOf } from "../drawing/package.js";
import { LANES, ROW } from "../generated/sizes.js";

const FORMAT = "rgba32float";
const VERTEX = "full_screen_triangle";

export class Solver {
  /**
   * @param {object} device See devices/device.js.
   * @param {object} description
   * @returns {Promise<Solver>} Solver with compiled passes.
   */
  static async make(device, description) {
    const shaders = JSON.parse(await textOf(description.shaders));
    const parts = await Promise.all(Object.values(description.scalars).map(numbersOf));
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
    this.mix = new Float32Array((this.plan.images.length + 2) * LANES);
    this.textures = new Map();
    this.passes = new Map();
    this.ring = [...this.plan.images];
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
   * @returns {Promise<object | null>} Texture of the light, owned by the caller; null if stale.
   * @throws {Error} If the orders do not converge; one line.
   */
  async light(air, stale) {
    this.load(air);
    const { fixed } = this;
    const tolerance = fixed.tolerance * (1 - fixed.stricter * Math.max(...air.thick));
    const residuals = [];
    this.guess = "first";
    this.run("once");
    for (this.sweeps = 1; this.sweeps <= fixed.most_sweeps; this.sweeps++) {
      if (stale()) return null;
      this.ring.unshift(this.ring.pop());
      this.run("pack");
      this.run("sweep");
      const [mean, sky, before] = await this.means();
      if (!mean.some((x) => x > 0)) break;
      const change = relativeChange(before, mean);
      const counted = counts(mean, air.thick);
      residuals.push(change.map((x, i) => x * counted[i]));
      if (residuals.length > this.ring.length) residuals.shift();
      this.residual = this.toCome(change, mean, residuals, air.thick);
      this.weigh(residuals, mean, sky);
      this.run("mix");
      this.guess = "light";
      if (this.residual <= tolerance && this.sweeps > 1) break;
    }
    if (this.sweeps > fixed.most_sweeps) {
      throw new Error(`after ${fixed.most_sweeps} orders light still changes: less air is needed`);
    }
    this.run("pack");
    const packed = this.textures.get("packed");
    this.textures.set("packed", this.device.target(FORMAT, ROW, packed.height));
    return packed;
  }

  /** Replace the tables of the atmosphere. */
  load(air) {
    const { plan, scalars } = this;
    const lanes = ["extinction", "moments", "polarising", "albedo"].sort(
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

  /** Texture by its name in a shader; images rotate, and the first guess is the first order. */
  texture(name, isTarget = false) {
    if (name === "image") return this.textures.get(this.ring[0]);
    if (name === "light" && !isTarget) return this.textures.get(this.guess);
    const image = this.plan.images.indexOf(name);
    return this.textures.get(image < 0 ? name : this.ring[image]);
  }

  /** Promise of mean radiance and irradiance of the last image, and mean radiance of the guess. */
  async means() {
    const { radii, suns } = this.plan.sizes;
    const length = radii * suns * LANES;
    const numbers = await this.device.read(this.textures.get("means"));
    return [0, 1, 2].map((part) => numbers.slice(part * length, (part + 1) * length));
  }

  /** Largest remaining change, estimated. [1] */
  toCome(change, mean, residuals, thick) {
    const { fixed } = this;
    const night = counts(mean, thick.map((x) => fixed.night * x));
    const largest = brightest(change.map((x, i) => Math.abs(x * night[i])));
    const follows = whatFollows(residuals, fixed.back);
    return Math.max(...largest.map((x, lane) => x * follows[lane]));
  }

  /** Set the inputs of the pass `next_guess`: weights, last image first, and two largest values. */
  weigh(residuals, mean, sky) {
    this.mix.fill(0);
    const images = this.ring.length;
    for (let lane = 0; lane < LANES; lane++) {
      mixingWeights(residuals, lane)
        .reverse()
        .forEach((weight, i) => {
          this.mix[i * LANES + lane] = weight;
        });
    }
    this.mix.set(brightest(mean), images * LANES);
    this.mix.set(brightest(sky), (images + 1) * LANES);
  }
}
