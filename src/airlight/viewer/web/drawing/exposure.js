/** Automatic exposure of a view: the formulas of image/exposure.py and scene/metering.py. */
import {
  PIXEL_ANGLES,
  exposure_with_stars,
  left_out,
  luminance_of,
  metering_weight,
} from "../generated/formulas.js";

/**
 * Automatic exposure of a metered frame.
 *
 * @param {Float32Array} rgba Linear sRGB, four values per pixel, from the top row. [W m⁻² sr⁻¹]
 * @param {[number, number]} size Width and height. [pixel]
 * @param {object} camera See view.js; `suns` are directions and angular radii [rad] of all lights.
 * @param {number} projection Number of its projection.
 * @param {number} star Angular radius of the star. [rad]
 * @returns {number} Exposure, -100 to 100. [EV]
 */
export function automaticExposure(rgba, [width, height], camera, projection, star) {
  const { axes, sun, suns = [[sun, star]], fieldOfView } = camera;
  const towards = suns.map(([one]) =>
    axes.map((axis) => axis[0] * one[0] + axis[1] * one[1] + axis[2] * one[2]),
  );
  const angle = PIXEL_ANGLES[camera.projection](width, height, fieldOfView);
  const cosines = suns.map(([, radius]) => left_out(radius, angle));
  const pixels = [];
  let [black, whole] = [0, 0];
  for (let i = 0; i < width * height; i++) {
    const bright = luminance_of(...rgba.subarray(4 * i, 4 * i + 3));
    const [x, y] = [(i % width) + 0.5, Math.floor(i / width) + 0.5];
    if (!Number.isFinite(bright)) continue;
    const weights = towards.map((seen, i) =>
      metering_weight(projection, x, y, width, height, fieldOfView, seen, cosines[i]),
    );
    const light = weights.findIndex((weight) => weight < 0);
    const solid = Math.abs(weights[0]);
    whole += solid;
    if (bright > 0 && solid > 0) {
      pixels.push([bright, light < 0 ? solid : 0, light < 0 ? 0 : solid, light]);
    } else if (light < 0) black += solid;
  }
  // Without any light, as dark as can be: exposed as a night without moon or stars.
  if (!pixels.length) {
    pixels.push([Number.MIN_VALUE, 1, 0, 0]);
    black = 0;
  }
  pixels.sort((a, b) => a[0] - b[0]);
  const table = (numbers) => ({ values: Float64Array.from(numbers), shape: [numbers.length] });
  const columns = [0, 1, 2, 3].map((part) => table(pixels.map((one) => one[part])));
  return exposure_with_stars(...columns, suns.length, black, whole);
}
