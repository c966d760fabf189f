/** Parts of a picture in which a body or a star may be: `area_of` in gpu/picture/bands.py. */
import { PIXEL_ANGLES, projected_ray } from "../generated/formulas.js";

/** Distance of samples, and margin around a body or star. [pixel] */
const STEP = 16;
const MARGIN = 3;

/**
 * Rectangle with all pixels near a direction.
 *
 * @param {number[]} towards Direction in the camera's frame.
 * @param {number} radius Angle from it. [rad]
 * @param {object} camera See view.js.
 * @param {number} projection Number of its projection.
 * @returns {number[] | null} Left, top, width and height; null if no pixel is near. [pixel]
 */
export function layerArea(towards, radius, camera, projection, width, height) {
  const { fieldOfView } = camera;
  const pixel = PIXEL_ANGLES[camera.projection](width, height, fieldOfView);
  const least = Math.cos(Math.min(radius + (MARGIN + STEP) * pixel, Math.PI));
  let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let row = 0; row <= Math.ceil(height / STEP); row++) {
    for (let column = 0; column <= Math.ceil(width / STEP); column++) {
      const [x, y] = [Math.min(STEP * column, width), Math.min(STEP * row, height)];
      const ray = projected_ray(projection, x, y, width, height, fieldOfView);
      if (ray[0] * towards[0] + ray[1] * towards[1] + ray[2] * towards[2] <= least) continue;
      [left, top] = [Math.min(left, x - STEP), Math.min(top, y - STEP)];
      [right, bottom] = [Math.max(right, x + STEP), Math.max(bottom, y + STEP)];
    }
  }
  if (left > right) return null;
  return overlap([left, top, right - left, bottom - top], [0, 0, width, height]);
}

/** Common part of two rectangles; null if there is none. */
export function overlap([left, top, width, height], [x, y, wide, high]) {
  const [first, above] = [Math.max(left, x), Math.max(top, y)];
  const [last, below] = [Math.min(left + width, x + wide), Math.min(top + height, y + high)];
  return last > first && below > above ? [first, above, last - first, below - above] : null;
}
