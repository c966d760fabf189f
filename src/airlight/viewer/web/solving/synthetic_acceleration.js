/**
 * Synthetic acceleration of the iteration in optically thick air: see
 * solver/moments/synthetic_acceleration.py, whose elimination and lateral diffusion are emitted.
 *
 * The operator K is assembled from the textures of each ray that the passes have filled: `factors`
 * of the moments at its points, `shares`, `bounces` and `projections`, see gpu/solver/passes.py.
 * Light is an array as in the solver's textures: moments (radius, sun, term), then irradiances
 * (radius, sun), four wavelengths each. Matrices have one wavelength.
 */
import {
  factorise,
  floor_below,
  lateral_diffusion_equations,
  node_value,
  substitute,
} from "../generated/formulas.js";
import { LANES } from "../generated/sizes.js";

export class SyntheticAcceleration {
  /**
   * @param {object} plan Plan of the solver.
   * @param {(name: string) => object} table Table of the plan, as emitted functions read it.
   * @param {object} fixed Largest `degree` and `order` of the moments in K, and `cubics`.
   * @param {Object<string, Float32Array>} rays Contents of the four textures.
   * @param {{diffusion_length: number, grid_diffusion: number, deep: boolean}} diffusion Lengths of
   *   lateral and numerical diffusion [rad], and whether the air is optically deep.
   */
  constructor(plan, table, fixed, rays, diffusion) {
    const { degree, order, cubics } = fixed;
    this.sizes = plan.sizes;
    this.pairs = [];
    this.blocks = [];
    for (let m = 0; m <= order; m++) {
      this.blocks.push({ m, first: this.pairs.length, width: degree + 1 - m });
      for (let l = m; l <= degree; l++) this.pairs.push((l * (l + 1)) / 2 + m);
    }
    this.cubics = sparse(cubics, this.sizes.radii);
    const { diffusion_length, grid_diffusion, deep } = diffusion;
    const cosines = table("sun_cosines");
    this.deep = deep;
    this.both = lateralDiffusionMatrix(cosines, diffusion_length, grid_diffusion);
    this.diffusion = lateralDiffusionMatrix(cosines, diffusion_length, 0);
    this.gridDiffusion = lateralDiffusionMatrix(cosines, 0, grid_diffusion);
    this.points = pointsOf(plan.sizes, table);
    this.rays = rays;
    this.start = table("start");
  }

  /**
   * Eliminate the equations of each wavelength.
   *
   * @param {() => Promise<void>} breathe Awaited between two wavelengths.
   * @returns {Promise<SyntheticAcceleration>} This object, which no longer needs the rays.
   */
  async eliminate(breathe) {
    this.lanes = [];
    for (let lane = 0; lane < LANES; lane++) {
      await breathe();
      this.lanes.push(this.equations(lane));
    }
    this.rays = this.points = null;
    return this;
  }

  /** Factors of 1 - K for each order in azimuth, and rows that give the irradiances. */
  equations(lane) {
    const { radii, angles, terms } = this.sizes;
    const { bounces, projections } = this.rays;
    const sizes = this.blocks.map(({ m, width }) => radii * width + (m === 0 ? 1 : 0));
    const factors = sizes.map((size) => new Float64Array(size * size));
    const toSky = new Float64Array(radii * radii * this.blocks[0].width);
    for (let i = 0; i < radii; i++) {
      const seen = Array.from({ length: angles }, (_, a) => this.seen(i * angles + a, lane));
      this.blocks.forEach(({ m, first, width }, block) => {
        const turn = m === 0 ? 2 * Math.PI : Math.PI;
        const size = sizes[block];
        const target = factors[block];
        for (let a = 0; a < angles; a++) {
          const ray = i * angles + a;
          const flux = turn * projections[radii * angles * terms + ray];
          for (let l = 0; l < width; l++) {
            const weight = turn * projections[ray * terms + this.pairs[first + l]];
            const row = (i * width + l) * size;
            for (let r = 0; r < radii; r++) {
              for (let k = 0; k < width; k++) {
                target[row + r * width + k] -= weight * seen[a][r * this.pairs.length + first + k];
              }
            }
            if (m === 0) target[row + size - 1] -= weight * bounces[ray * LANES + lane];
          }
          if (m > 0 || flux === 0) continue;
          const sky = i * radii * width;
          for (let r = 0; r < radii; r++) {
            for (let k = 0; k < width; k++) {
              toSky[sky + r * width + k] += flux * seen[a][r * this.pairs.length + first + k];
            }
          }
        }
      });
    }
    // The ground's irradiance is one more unknown beside the moments of m = 0.
    const moments = sizes[0] - 1;
    for (let k = 0; k < moments; k++) factors[0][moments * sizes[0] + k] -= toSky[k];
    factors.forEach((matrix, block) => {
      for (let k = 0; k < sizes[block]; k++) matrix[k * sizes[block] + k] += 1;
      factorise(matrix, sizes[block]);
    });
    return { sizes, factors, toSky };
  }

  /** Weights of the moments at all radii in the radiance of a ray. */
  seen(ray, lane) {
    const { radii, angles, terms, levels } = this.sizes;
    const { factors, shares } = this.rays;
    const { length } = this.pairs;
    const row = Math.floor(ray / angles) * (angles + 1) + (ray % angles);
    const fine = new Float64Array(levels * length);
    const share = shares[ray * LANES + lane];
    for (let k = this.start.values[row]; k < this.start.values[row + 1]; k++) {
      const level = this.points.levels[k];
      const f = this.points.fractions[k];
      for (let pair = 0; pair < length; pair++) {
        const value = share * factors[(k * (terms + 1) + this.pairs[pair]) * LANES + lane];
        fine[level * length + pair] += (1 - f) * value;
        fine[(level + 1) * length + pair] += f * value;
      }
    }
    const found = new Float64Array(radii * length);
    this.cubics.forEach((weights, level) => {
      for (const [r, weight] of weights) {
        for (let pair = 0; pair < length; pair++) {
          found[r * length + pair] += weight * fine[level * length + pair];
        }
      }
    });
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
    const { radii, sun_angles, terms } = this.sizes;
    const nodes = radii * sun_angles;
    const all = change.slice();
    for (let lane = 0; lane < LANES; lane++) {
      const { sizes, factors, toSky } = this.lanes[lane];
      const once = this.deep && !light;
      const diffused = (more) => (once ? this.spread(more, this.diffusion) : more);
      const around = once ? this.gridDiffusion : this.both;
      const known = light ?? change;
      let scale;
      this.blocks.forEach((block, index) => {
        const before = this.unknowns(change, block, lane);
        const after = before.slice();
        substitute(factors[index], sizes[index], after, sun_angles);
        const more = diffused(after.map((x, i) => x - before[i]));
        // With the star in the zenith or the nadir no light depends on azimuth.
        const inner = block.m > 0 ? 1 : 0;
        const { first, width } = block;
        if (block.m === 0) {
          scale = this.scaleOf((i, s) => more[i * width * sun_angles + s], known, terms, 0, lane);
        }
        const shares = more
          .subarray(0, radii * width * sun_angles)
          .map((x, k) => x / scale[Math.floor(k / (width * sun_angles)) * sun_angles + (k % sun_angles)]);
        this.spread(shares, around, inner).forEach((x, k) => {
          const [row, s] = [Math.floor(k / sun_angles), k % sun_angles];
          const node = Math.floor(row / width) * sun_angles + s;
          all[(node * terms + this.pairs[first + (row % width)]) * LANES + lane] += x * scale[node];
        });
        if (block.m > 0) return;
        const sky = diffused(this.irradiances(toSky, after));
        const received = this.scaleOf((i, s) => sky[i * sun_angles + s], known, 1, nodes * terms, lane);
        this.spread(sky.map((x, k) => x / received[k]), around).forEach((x, k) => {
          all[(nodes * terms + k) * LANES + lane] += x * received[k];
        });
      });
    }
    return all;
  }

  /** Light plus the magnitude of its change, by node: the scale of ratios in deep air, otherwise 1. */
  scaleOf(more, light, step, first, lane) {
    const { radii, sun_angles } = this.sizes;
    const scale = new Float64Array(radii * sun_angles);
    if (!this.deep) return scale.fill(1);
    for (let i = 0; i < radii; i++) {
      for (let s = 0; s < sun_angles; s++) {
        const node = i * sun_angles + s;
        const here = light[(first + node * step) * LANES + lane];
        scale[node] = Math.max(here, 0) + Math.abs(more(i, s));
      }
    }
    const floor = floor_below(scale.reduce((most, x) => Math.max(most, x), 0));
    return scale.map((x) => Math.max(x, floor));
  }

  /** Rows of values by sun, multiplied by a matrix, but for so many sun_angles at either end: 0. */
  spread(values, matrix, inner = 0) {
    const { sun_angles } = this.sizes;
    const found = new Float64Array(values.length);
    for (let row = 0; row < values.length; row += sun_angles) {
      for (let t = inner; t < sun_angles - inner; t++) {
        let sum = 0;
        for (let s = 0; s < sun_angles; s++) sum += matrix[t * sun_angles + s] * values[row + s];
        found[row + t] = sum;
      }
    }
    return found;
  }

  /** Horizontal irradiances from the moments of m = 0. */
  irradiances(toSky, moments) {
    const { radii, sun_angles } = this.sizes;
    const count = toSky.length / radii;
    const more = new Float64Array(radii * sun_angles);
    for (let i = 0; i < radii; i++) {
      for (let k = 0; k < count; k++) {
        const weight = toSky[i * count + k];
        for (let s = 0; s < sun_angles; s++) more[i * sun_angles + s] += weight * moments[k * sun_angles + s];
      }
    }
    return more;
  }

  /** Moments of one order in azimuth, and the ground's irradiance, by sun. */
  unknowns(light, { m, first, width }, lane) {
    const { radii, sun_angles, terms } = this.sizes;
    const values = new Float64Array((radii * width + (m === 0 ? 1 : 0)) * sun_angles);
    for (let i = 0; i < radii; i++) {
      for (let l = 0; l < width; l++) {
        for (let s = 0; s < sun_angles; s++) {
          const at = (i * sun_angles + s) * terms + this.pairs[first + l];
          values[(i * width + l) * sun_angles + s] = light[at * LANES + lane];
        }
      }
    }
    if (m > 0) return values;
    for (let s = 0; s < sun_angles; s++) {
      values[radii * width * sun_angles + s] = light[(radii * sun_angles * terms + s) * LANES + lane];
    }
    return values;
  }
}

/** Level of the table below each point of the rays, and the point's fraction of the step above. */
function pointsOf({ levels: count, bottom, top }, table) {
  const radius = table("radius").values;
  const levels = new Int32Array(radius.length);
  const fractions = new Float64Array(radius.length);
  const [nodes, rows] = [table("first_nodes"), table("row")];
  radius.forEach((q, k) => {
    const x = node_value(q, bottom, top, nodes, rows);
    levels[k] = Math.min(Math.trunc(x), count - 2);
    fractions[k] = x - levels[k];
  });
  return { levels, fractions };
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
  return matrix;
}

/** Non-zero columns and values of each row of a matrix. */
function sparse(values, columns) {
  const rows = Array.from({ length: values.length / columns }, () => []);
  values.forEach((value, at) => {
    if (value) rows[Math.floor(at / columns)].push([at % columns, value]);
  });
  return rows;
}
