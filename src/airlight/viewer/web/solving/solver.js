/**
 * Moments solver on a device: successive orders of scattering as fragment passes.
 *
 * A description from viewer/browser/page_solver.py has the `plan` of gpu/solver/plan.py, its
 * `uniforms`, `scalars` (its tables in order) and `shaders`, the coefficients of the `air`, and the
 * stopping criteria. In thick air, where orders alone would not end, each is completed along the
 * vertical (completion.js), as by solvers/moments/iterate.py.
 */
import { Completion } from "./completion.js";
import {
  brightest,
  counts,
  mixed,
  mixingWeights,
  momentOf,
  relativeChange,
  replaceUnless,
  trust,
  whatFollows,
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
   * @param {(share: number) => void} tell Told how far it is, from 0 to 1, after each order.
   * @returns {Promise<object | null>} Texture of the light, owned by the caller; null if stale.
   * @throws {Error} If the orders do not converge; one line.
   */
  async light(air, stale, tell = () => {}) {
    this.load(air);
    this.guess = "first";
    this.run("once");
    const thick = Math.max(...air.transport) > this.fixed.completion.thicker;
    const solved = await (thick ? this.complete(air, stale, tell) : this.sum(air, stale, tell));
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
  async sum(air, stale, tell) {
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
      this.residual = this.toCome(change, mean, residuals, air.thick, fixed.night);
      tell(shareOf(this.residual, tolerance));
      this.weigh(residuals, mean, sky);
      this.run("mix");
      this.guess = "light";
      if (this.residual <= tolerance && this.sweeps > 1) break;
    }
    return true;
  }

  /** Sum orders that are completed along the vertical; false if stale. */
  async complete(air, stale, tell) {
    const { fixed, plan } = this;
    const { further, images: most, least, sidelit, wanders, tolerance } = fixed.completion;
    const { radii, suns, terms } = plan.sizes;
    const nodes = radii * suns;
    const polarised = further.map((_, i) => terms - further.length + i);
    const completion = await this.completion(air);
    const first = await this.numbers("first");
    const sides = air.transport.map(
      (x, w) => air.thick[w] * Math.min(sidelit[0] * Math.max(x / wanders, 1) ** 3, sidelit[1]),
    );
    const lit = (guess, swept) => guess > least * swept;
    let light = completion.finish(first);
    replaceUnless(lit, light, first, nodes, terms);
    const residuals = [];
    const images = [];
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
      const trusted = trust(mean, suns, sides);
      const change = swept.map((x, i) => x - light[i]);
      const all = completion.finish(change, swept);
      const image = light.map((value, i) => {
        const texel = Math.floor(i / LANES);
        const [node, term] =
          texel < nodes * terms
            ? [Math.floor(texel / terms), texel % terms]
            : [texel - nodes * terms, 0];
        const more = change[i] + trusted[node * LANES + (i % LANES)] * (all[i] - change[i]);
        return value + more * (further[term - polarised[0]] ?? 1);
      });
      replaceUnless(lit, image, swept, nodes, terms);
      images.push(image);
      if (images.length > most) images.shift();
      // Mean radiances, and mean radiances that differ by the change of each polarised moment.
      const after = momentOf(image, nodes, terms, 0);
      const steps = [0, ...polarised].map((term) => {
        const [old, now] = [light, image].map((one) => momentOf(one, nodes, terms, term));
        const before = after.map((x, i) => x - (now[i] - old[i]));
        return relativeChange(before, after);
      });
      const counted = counts(after, air.thick);
      residuals.push(Float64Array.from(steps.flatMap((one) => [...one.map((x, i) => x * counted[i])])));
      if (residuals.length > most) residuals.shift();
      this.residual = Math.max(
        ...steps.map((step) => this.toCome(step, after, residuals, air.thick, 1)),
      );
      if (!Number.isFinite(this.residual)) throw new Error("this air's light is not a finite number");
      tell(shareOf(this.residual, tolerance));
      const weights = Array.from({ length: LANES }, (_, lane) => mixingWeights(residuals, lane));
      light = mixed(images, weights, trusted, nodes, terms);
      if (this.residual <= tolerance && this.sweeps > 1) break;
    }
    this.put("given", FORMAT, light);
    this.guess = "given";
    return true;
  }

  /** Inverse along the vertical in an atmosphere, from what the passes know of its rays. */
  async completion(air) {
    const { fixed, plan } = this;
    const { wide, leak, deep, cubics, ...limits } = fixed.completion;
    const names = ["factors", "shares", "bounces", "projections"];
    const rays = {};
    for (const name of names) rays[name] = await this.numbers(name);
    const weights = await numbersOf(cubics);
    const transport = Math.max(...air.transport);
    const reach = { wide, leak: leak * wide * transport, deep: transport > deep };
    const table = (name) => this.table(name);
    return new Completion(plan, table, { ...limits, cubics: weights }, rays, reach).eliminate(breath);
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
  toCome(change, mean, residuals, thick, share) {
    const { fixed } = this;
    const night = counts(mean, thick.map((x) => share * x));
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
