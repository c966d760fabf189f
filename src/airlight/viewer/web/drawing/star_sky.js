/** Star catalogue, Milky Way and zodiacal light, on the CPU: `add_sky` in render/star_points.py. */
import { pixelsOf } from "./ground.js";
import { numbersOf } from "./package.js";
import { along, cross, dot, minus, scaled } from "./scene_space.js";
import { projected_ray } from "../generated/formulas.js";

/** Pixels between first guesses of Newton's method, its steps and its difference quotients. */
const GRID = 16;
const STEPS = 6;
const SLOPE = 0.01;
/** Cosine by which a star may be outside the frame: refraction, and the last guess. */
const MARGIN = 0.15;
/** Channels of a texel. */
const CHANNELS = 4;
const DEGREE = 180 / Math.PI;

export class StarSky {
  /** @param {object} data `star_sky` or `planet_sky` of viewer/browser/star_sky.py. */
  static async make(data) {
    const [directions, light] = await Promise.all([data.directions, data.light].map(numbersOf));
    const { rows, columns } = data.map;
    const codes = await pixelsOf(data.map.image, data.map);
    const bright = Float32Array.from({ length: rows * columns }, (_, i) => {
      return data.map.brightest * (codes[CHANNELS * i] / 255) ** 2;
    });
    return new StarSky({ ...data, directions, light, map: { rows, columns, bright } });
  }

  constructor(data) {
    this.data = data;
  }

  /**
   * Linear sRGB of a frame without air, four values per pixel. [W m⁻² sr⁻¹]
   *
   * @param {number} width Width. [pixel]
   * @param {number} height Height. [pixel]
   * @param {object} camera See view.js, with the `number` of its projection, and right, up and
   *     forward as `world` in the frame of the stars; `sun`, the direction of the sun there, for
   *     zodiacal light.
   * @param {(true_: number[]) => number[] | null} raised Apparent direction of a star; null if a
   *     disc hides it.
   */
  render(width, height, camera, raised) {
    const frame = new Float32Array(CHANNELS * width * height);
    const share = camera.filter ? 0.5 : 1;
    this.addMap(frame, width, height, camera, share);
    this.addStars(frame, width, height, camera, raised, share);
    return frame;
  }

  addMap(frame, width, height, { number, fieldOfView, world, sun }, share) {
    const { color, zodiacal } = this.data;
    const dust = sun && zodiacal ? zodiacalLight(zodiacal, sun) : () => 0;
    for (let i = 0; i < width * height; i++) {
      const [x, y] = [(i % width) + 0.5, Math.floor(i / width) + 0.5];
      const [a, b, c] = projected_ray(number, x, y, width, height, fieldOfView);
      if (a === 0 && b === 0 && c === 0) continue;
      const ray = [0, 1, 2].map((k) => a * world[0][k] + b * world[1][k] + c * world[2][k]);
      const light = share * (this.starlight(ray) + dust(ray));
      for (let k = 0; k < 3; k++) frame[CHANNELS * i + k] = light * color[k];
    }
  }

  /** Brightness of the Milky Way in S10, bilinear. */
  starlight([a, b, c]) {
    const { rows, columns, bright } = this.data.map;
    const y = (0.5 - Math.asin(Math.min(Math.max(c, -1), 1)) / Math.PI) * rows - 0.5;
    const x = (0.25 - Math.atan2(b, a) / (2 * Math.PI)) * columns - 0.5;
    const row = Math.min(Math.max(Math.floor(y), 0), rows - 2);
    const left = Math.floor(x);
    const [down, across] = [Math.min(Math.max(y - row, 0), 1), x - left];
    const [west, east] = [left, left + 1].map((one) => ((one % columns) + columns) % columns);
    const at = (one, side) => bright[one * columns + side];
    const line = (one) => at(one, west) * (1 - across) + at(one, east) * across;
    return line(row) * (1 - down) + line(row + 1) * down;
  }

  addStars(frame, width, height, camera, raised, share) {
    const { directions, light } = this.data;
    const guesses = firstGuesses(width, height, camera);
    const widest = guesses.found.map(([ray]) => ray[2]).reduce((a, b) => Math.min(a, b), 1);
    for (let star = 0; star < directions.length; star += 3) {
      const one = directions.subarray(star, star + 3);
      if (dot(camera.world[2], one) < widest - MARGIN) continue;
      const shown = raised(one);
      if (!shown) continue;
      const seen = along(camera.world, shown);
      const found = positionOf(seen, guesses, width, height, camera);
      if (!found) continue;
      const [x, y, solid] = found;
      const [column, row] = [Math.floor(x - 0.5), Math.floor(y - 0.5)];
      const [right, down] = [x - 0.5 - column, y - 0.5 - row];
      for (const [i, j, part] of [
        [0, 0, (1 - right) * (1 - down)],
        [0, 1, right * (1 - down)],
        [1, 0, (1 - right) * down],
        [1, 1, right * down],
      ]) {
        if (row + i < 0 || row + i >= height || column + j < 0 || column + j >= width) continue;
        const at = CHANNELS * ((row + i) * width + column + j);
        for (let k = 0; k < 3; k++) frame[at + k] += (share * part * light[star + k]) / solid;
      }
    }
  }
}

/** Brightness of the zodiacal light by direction, in S10: scene/system/zodiacal_light.py. */
function zodiacalLight({ longitudes, latitudes, brightness, pole }, sun) {
  const flat = minus(sun, scaled(pole, dot(sun, pole)));
  const side = cross(pole, flat);
  return (ray) => {
    const latitude = Math.asin(Math.min(Math.abs(dot(ray, pole)), 1)) * DEGREE;
    const longitude = Math.atan2(Math.abs(dot(ray, side)), dot(ray, flat)) * DEGREE;
    const [row, down] = cellOf(longitude, longitudes);
    const [column, right] = cellOf(latitude, latitudes);
    const at = (i) => brightness[i][column] * (1 - right) + brightness[i][column + 1] * right;
    return at(row) * (1 - down) + at(row + 1) * down;
  };
}

/** Node below a value, and share of the way to the next one. */
function cellOf(value, nodes) {
  const after = nodes.findIndex((node) => node > value);
  const low = Math.min(Math.max((after < 0 ? nodes.length : after) - 1, 0), nodes.length - 2);
  const share = (value - nodes[low]) / (nodes[low + 1] - nodes[low]);
  return [low, Math.min(Math.max(share, 0), 1)];
}

/** Rays of a coarse grid, with their places, and the cosine of the reach of one. */
function firstGuesses(width, height, { number, fieldOfView }) {
  const found = [];
  let least = 1;
  for (let y = GRID / 2; y < height + GRID / 2; y += GRID) {
    for (let x = GRID / 2; x < width + GRID / 2; x += GRID) {
      const place = [Math.min(x, width - 0.5), Math.min(y, height - 0.5)];
      const ray = projected_ray(number, ...place, width, height, fieldOfView);
      if (dot(ray, ray) < 0.5) continue;
      const beside = projected_ray(number, place[0], place[1] - 0.4, width, height, fieldOfView);
      if (dot(beside, beside) > 0.5) {
        const pixel = Math.hypot(...minus(beside, ray)) / 0.4;
        least = Math.min(least, Math.cos(Math.min(2 * GRID * pixel, Math.PI)));
      }
      found.push([ray, place]);
    }
  }
  return { found, least };
}

/**
 * Position of a direction in the camera's frame, and the solid angle of a pixel there [sr], by
 * Newton's method, as scene/pixel_position.py; null outside the frame.
 */
function positionOf(direction, { found, least }, width, height, { number, fieldOfView }) {
  let best = least;
  let place = null;
  for (const [ray, at] of found) {
    const near = dot(ray, direction);
    if (near > best) [best, place] = [near, at];
  }
  if (!place) return null;
  let [x, y] = place;
  const ray = (across, down) => projected_ray(number, across, down, width, height, fieldOfView);
  for (let step = 0; step < STEPS; step++) {
    const at = ray(x, y);
    const [right, below] = [ray(x + SLOPE, y), ray(x, y + SLOPE)].map((one) =>
      minus(one, at).map((part) => part / SLOPE),
    );
    const off = minus(direction, at);
    const [rr, bb, rb] = [dot(right, right), dot(below, below), dot(right, below)];
    const square = rr * bb - rb ** 2;
    if (!(square > 0)) return null;
    const [ro, bo] = [dot(right, off), dot(below, off)];
    const [dx, dy] = [(bb * ro - rb * bo) / square, (rr * bo - rb * ro) / square];
    [x, y] = [x + dx, y + dy];
    if (x < -1 || y < -1 || x > width + 1 || y > height + 1) return null;
    if (Math.max(Math.abs(dx), Math.abs(dy)) < 1e-3) return [x, y, Math.sqrt(square)];
  }
  return null;
}
