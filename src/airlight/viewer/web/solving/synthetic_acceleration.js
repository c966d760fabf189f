/**
 * Synthetic acceleration of the iteration in optically thick air, by loops emitted from
 * solver/moments/synthetic_acceleration.py, synthetic_operator.py and elimination.py.
 *
 * The operator K is assembled from the textures of each ray that the passes have filled: `factors`
 * of the moments at its points, `shares`, `bounces` and `projections`, see gpu/solver/passes.py.
 * Light is an array as in the solver's textures: moments (radius, sun, term), then irradiances
 * (radius, sun), four wavelengths each. Matrices have one wavelength.
 */
import {
  factorise,
  floor_below,
  gather_levels,
  lateral_diffusion_equations,
  multiply,
  node_value,
  project_radii,
  spread_onto,
  substitute,
  take_terms,
} from "../generated/formulas.js";
import { LANES } from "../generated/sizes.js";
import { table } from "./convergence.js";

/** Table of one wavelength, and the table of one wavelength among four. */
const alone = (values, ...shape) => ({ values, shape, step: 1, at: 0 });
const lane = (at, values, ...shape) => ({ values, shape, step: LANES, at });

export class SyntheticAcceleration {
  /**
   * @param {object} plan Plan of the solver.
   * @param {(name: string) => object} tableOf Table of the plan, as emitted functions read it.
   * @param {object} fixed Largest `degree` and `order` of the moments in K, and `cubics`.
   * @param {Object<string, Float32Array>} rays Contents of the four textures.
   * @param {{diffusion_length: number, grid_diffusion: number, deep: boolean}} diffusion Lengths of
   *   lateral and numerical diffusion [rad], and whether the air is optically deep.
   */
  constructor(plan, tableOf, fixed, rays, diffusion) {
    const { degree, order, cubics } = fixed;
    this.sizes = plan.sizes;
    this.pairs = [];
    this.blocks = [];
    for (let m = 0; m <= order; m++) {
      this.blocks.push({ m, first: this.pairs.length, width: degree + 1 - m });
      for (let l = m; l <= degree; l++) this.pairs.push((l * (l + 1)) / 2 + m);
    }
    this.degree = degree;
    this.cubics = table(cubics, this.sizes.levels, this.sizes.radii);
    const { diffusion_length, grid_diffusion, deep } = diffusion;
    const cosines = tableOf("sun_cosines");
    this.deep = deep;
    this.both = lateralDiffusionMatrix(cosines, diffusion_length, grid_diffusion);
    this.diffusion = transposed(lateralDiffusionMatrix(cosines, diffusion_length, 0));
    this.gridDiffusion = lateralDiffusionMatrix(cosines, 0, grid_diffusion);
    this.rays = { ...rays, start: tableOf("start").values, radius: tableOf("radius").values };
    this.nodes = [tableOf("first_nodes"), tableOf("row")];
  }

  /**
   * Eliminate the equations of each wavelength.
   *
   * @param {() => Promise<void>} breathe Awaited between two wavelengths.
   * @returns {Promise<SyntheticAcceleration>} This object, which no longer needs the rays.
   */
  async eliminate(breathe) {
    this.lanes = [];
    for (let at = 0; at < LANES; at++) {
      await breathe();
      this.lanes.push(this.equations(at));
    }
    this.rays = null;
    return this;
  }

  /** Factors of 1 - K for each order in azimuth, and rows that give the irradiances. */
  equations(at) {
    const { radii, angles, terms } = this.sizes;
    const { bounces, projections } = this.rays;
    // The ground's irradiance is one more unknown beside the moments of m = 0.
    const sizes = this.blocks.map(({ m, width }) => radii * width + (m === 0 ? 1 : 0));
    const factors = sizes.map((size) => new Float64Array(size * size));
    const columns = radii * this.blocks[0].width;
    const toSky = alone(new Float64Array(radii * columns), radii, columns);
    for (let i = 0; i < radii; i++) {
      const seen = this.seen(i, at);
      this.blocks.forEach(({ m, first, width }, block) => {
        const [turn, size] = [m === 0 ? 2 * Math.PI : Math.PI, sizes[block]];
        const rows = factors[block].subarray(i * width * size, (i + 1) * width * size);
        const weights = Float64Array.from({ length: width * angles }, (_, k) => {
          const ray = i * angles + (k % angles);
          return turn * projections[ray * terms + this.pairs[first + Math.floor(k / angles)]];
        });
        project_radii(table(weights, width, angles), seen, first, width, alone(rows, width, size));
        if (m > 0) return;
        weights.forEach((weight, k) => {
          const row = Math.floor(k / angles);
          rows[(row + 1) * size - 1] += weight * bounces[(i * angles + (k % angles)) * LANES + at];
        });
        const start = radii * angles * terms + i * angles;
        const flux = projections.slice(start, start + angles).map((x) => turn * x);
        const sky = alone(toSky.values.subarray(i * columns, (i + 1) * columns), 1, columns);
        project_radii(table(flux, 1, angles), seen, 0, width, sky);
      });
    }
    factors[0].set(toSky.values.subarray(0, columns), columns * sizes[0]);
    factors.forEach((matrix, block) => {
      const size = sizes[block];
      matrix.forEach((x, k) => (matrix[k] = (k % (size + 1) === 0 ? 1 : 0) - x));
      factorise(matrix, size);
    });
    return { sizes, factors, toSky };
  }

  /** Weights of the moments at all radii in the radiances of the rays from a radius. */
  seen(i, at) {
    const { radii, angles, terms, levels, bottom, top } = this.sizes;
    const { factors, shares, start, radius } = this.rays;
    const { length } = this.pairs;
    const fine = new Float64Array(angles * levels * length);
    for (let a = 0; a < angles; a++) {
      const share = shares[(i * angles + a) * LANES + at];
      const row = i * (angles + 1) + a;
      for (let k = start[row]; k < start[row + 1]; k++) {
        const x = node_value(radius[k], bottom, top, ...this.nodes);
        const level = Math.min(Math.trunc(x), levels - 2);
        const [below, f] = [(a * levels + level) * length, x - level];
        this.pairs.forEach((pair, n) => {
          const value = share * factors[(k * (terms + 1) + pair) * LANES + at];
          fine[below + n] += (1 - f) * value;
          fine[below + length + n] += f * value;
        });
      }
    }
    const found = alone(new Float64Array(angles * radii * length), angles, radii, length);
    gather_levels(this.cubics, alone(fine, angles, levels, length), found);
    return found;
  }

  /**
   * Accelerated residual (1 - K)⁻¹ r.
   *
   * @param {Float32Array} change Residual of a sweep, or the first order.
   * @param {Float32Array?} light Light after the sweep; null for the first order.
   * @returns {Float32Array}
   */
  apply(change, light = null) {
    const { radii, sun_angles: suns } = this.sizes;
    const all = change.slice();
    this.lanes.forEach(({ sizes, factors, toSky }, at) => {
      const given = this.parts(change, at);
      let sky = alone(new Float64Array(radii * suns), radii, suns);
      let more = this.blocks.map(({ m }, block) => {
        const before = new Float64Array(sizes[block] * suns);
        take_terms(...given, m, this.degree, 0, alone(before, sizes[block], suns));
        const after = before.slice();
        substitute(factors[block], sizes[block], after, suns);
        if (m === 0) multiply(toSky, alone(after, sizes[block], suns), sky);
        return alone(after.map((x, i) => x - before[i]), sizes[block], suns);
      });
      let matrix = this.both;
      if (this.deep && !light) {
        [sky, ...more] = [sky, ...more].map((one) => {
          const spread = { ...one, values: new Float64Array(one.values.length) };
          multiply(one, this.diffusion, spread);
          return spread;
        });
        matrix = this.gridDiffusion;
      }
      const [known, knownSky] = this.parts(light ?? change, at);
      const [out, outSky] = this.parts(all, at);
      const mean = this.scaleOf(known, more[0], this.blocks[0].width);
      const received = this.scaleOf(knownSky, sky, 1);
      for (let i = 0; i < radii; i++) {
        this.blocks.forEach(({ m, first, width }, block) => {
          // With the star in the zenith or the nadir no light depends on azimuth.
          const terms = this.pairs.slice(first, first + width);
          move(matrix, more[block], i, terms, m > 0 ? 1 : 0, mean, out);
        });
        move(matrix, sky, i, [0], 0, received, outSky);
      }
    });
    return all;
  }

  /** Tables (radius, sun, term) of the moments and (radius, sun) of the irradiances of a light. */
  parts(light, at) {
    const { radii, sun_angles, terms } = this.sizes;
    const moments = radii * sun_angles * terms * LANES;
    return [
      lane(at, light.subarray(0, moments), radii, sun_angles, terms),
      lane(at, light.subarray(moments), radii, sun_angles, 1),
    ];
  }

  /** Light plus the magnitude of its change, by node: the scale of ratios in deep air, otherwise 1. */
  scaleOf({ values, shape: [radii, suns, terms], step, at }, more, rows) {
    const scale = new Float64Array(radii * suns);
    if (!this.deep) return scale.fill(1);
    scale.forEach((_, node) => {
      const added = more.values[Math.floor(node / suns) * rows * suns + (node % suns)];
      scale[node] = Math.max(values[node * terms * step + at], 0) + Math.abs(added);
    });
    const floor = floor_below(scale.reduce((most, x) => Math.max(most, x), 0));
    return scale.map((x) => Math.max(x, floor));
  }
}

/** Add ratios to the light at a radius, multiplied by a matrix over sun angles and by the scale. */
function move(matrix, more, i, terms, inner, scale, { values, shape, step, at }) {
  const [, suns, count] = shape;
  const here = scale.subarray(i * suns, (i + 1) * suns);
  const rows = more.values.subarray(i * terms.length * suns, (i + 1) * terms.length * suns);
  const shares = alone(rows.map((x, k) => x / here[k % suns]), terms.length, suns);
  const out = lane(at, values.subarray(i * suns * count * step), suns, count);
  spread_onto(matrix, shares, table(terms, terms.length), inner, alone(here, suns), out);
}

/** Matrix between sun elevations, rows first: `lateral_diffusion_matrix` of synthetic_acceleration.py. */
function lateralDiffusionMatrix(cosines, diffusionLength, gridDiffusion) {
  const sun_angles = cosines.values.length;
  const spread = new Float64Array(sun_angles * sun_angles);
  const measure = new Float64Array(sun_angles);
  lateral_diffusion_equations(cosines, diffusionLength, gridDiffusion, spread, measure);
  const matrix = new Float64Array(sun_angles * sun_angles);
  measure.forEach((value, s) => {
    matrix[s * sun_angles + s] = value;
  });
  factorise(spread, sun_angles);
  substitute(spread, sun_angles, matrix, sun_angles);
  return alone(matrix, sun_angles, sun_angles);
}

function transposed({ values, shape: [rows, columns] }) {
  return alone(values.map((_, k) => values[(k % rows) * columns + Math.floor(k / rows)]), columns, rows);
}
