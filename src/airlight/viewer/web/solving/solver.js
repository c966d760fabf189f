/**
 * Moments solver on a device: successive orders of scattering as fragment passes.
 *
 * A description from viewer/browser/page_solver.py has the `plan` of gpu/solver/plan.py, its
 * `uniforms`, `scalars` (its tables in order) and `shaders`, the coefficients of the `air`, and the
 * stopping criteria. In thick air, where successive orders converge too slowly, the iteration has
 * synthetic acceleration (synthetic_acceleration.js), as in solver/moments/iterate.py.
 */
import { AcceleratedLight } from "./accelerated_light.js";
import { Iteration, brightest } from "./convergence.js";
import { SyntheticAcceleration } from "./synthetic_acceleration.js";
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
    const { fixed } = this;
    const thick = Math.max(...air.transport) > fixed.synthetic.thicker;
    const backend = thick ? await AcceleratedLight.make(this, air) : this;
    this.iteration = new Iteration((thick ? fixed.synthetic : fixed).stopping, air.thick);
    if (!(await this.iterate(backend, stale, onProgress))) return null;
    this.run("pack");
    const packed = this.textures.get("packed");
    this.textures.set("packed", this.device.target(FORMAT, ROW, packed.height));
    return packed;
  }

  /** Sweep until convergence, as solver/moments/fixed_point.py does; false if stale. */
  async iterate(backend, stale, onProgress) {
    const { iteration } = this;
    const most = iteration.stopping.most_sweeps;
    while (iteration.isUnfinished) {
      if (iteration.sweeps >= most) {
        throw new Error(`after ${most} orders light still changes: less air is needed`);
      }
      await breath();
      if (stale()) return false;
      await backend.sweep();
      iteration.update(...(await backend.reduce()));
      if (!Number.isFinite(iteration.remainingError)) {
        throw new Error("this air's light is not a finite number");
      }
      onProgress(iteration.progress);
      backend.combine(iteration.weights());
    }
    return true;
  }

  /** Compute the next iterate by one sweep of the guess. */
  sweep() {
    this.ring.unshift(this.ring.pop());
    this.run("pack");
    this.run("sweep");
  }

  /** Mean radiances of the guess and of its iterate. */
  async reduce() {
    const { radii, sun_angles } = this.plan.sizes;
    const length = radii * sun_angles * LANES;
    const numbers = await this.device.read(this.textures.get("means"));
    const [mean, sky, before] = [0, 1, 2].map((k) => numbers.slice(k * length, (k + 1) * length));
    this.brightest = [...brightest(mean), ...brightest(sky)];
    return [before, mean];
  }

  /** Compute the next guess; the uniform `mix` has the weights, the latest first, and maxima. */
  combine(weights) {
    this.mix.fill(0);
    [...weights].reverse().forEach((one, i) => this.mix.set(one, i * LANES));
    this.mix.set(this.brightest, this.ring.length * LANES);
    this.run("mix");
    this.guess = "light";
  }

  setGuess(light) {
    this.put("given", FORMAT, light);
    this.guess = "given";
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
    return (await this.device.read(this.texture(name))).subarray(0, texels * LANES);
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
}

/** Promise of the ratios of the columns towards the star, from a picture's tables. */
async function columnsOf({ tables, uniforms }) {
  const [start, ...shape] = uniforms.table_columns;
  const count = shape.reduce((all, n) => all * n, 2);
  return (await numbersOf(tables.scalars.data)).subarray(start, start + count);
}

/** Promise of a moment in which the page answers. */
function breath() {
  return new Promise((resolve) => setTimeout(resolve));
}
