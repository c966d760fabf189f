/**
 * Automatic exposure and white of a view: the formulas of image/exposure.py, star_exposure.py,
 * white_balance.py and scene/metering.py.
 */
import {
  PIXEL_ANGLES,
  cool_share,
  exposure_with_stars,
  left_out,
  luminance_of,
  metered_light,
  metering_weight,
  scene_weight,
  unlit_exposure,
} from "../generated/formulas.js";

/**
 * Automatic exposure of a metered frame.
 *
 * @param {Float32Array} rgba Linear sRGB, four values per pixel, from the top row. [W m⁻² sr⁻¹]
 * @param {[number, number]} size Width and height. [pixel]
 * @param {object} camera See view.js; `suns` are directions and angular radii [rad] of all lights.
 * @param {number} projection Number of its projection.
 * @param {number} star Angular radius of the star. [rad]
 * @param {number} white Luminance of a white surface that faces the star. [W m⁻² sr⁻¹]
 * @returns {number} Exposure, -100 to 100. [EV]
 */
export function automaticExposure(rgba, [width, height], camera, projection, star, white) {
  const { axes, sun, suns = [[sun, star]], fieldOfView } = camera;
  const towards = suns.map(([one]) =>
    axes.map((axis) => axis[0] * one[0] + axis[1] * one[1] + axis[2] * one[2]),
  );
  const angle = PIXEL_ANGLES[camera.projection](width, height, fieldOfView);
  const cosines = suns.map(([, radius]) => left_out(radius, angle));
  const pixels = [];
  let [black, whole, red, blue] = [0, 0, 0, 0];
  for (let i = 0; i < width * height; i++) {
    const bright = metered_light(...rgba.subarray(4 * i, 4 * i + 3));
    const [x, y] = [(i % width) + 0.5, Math.floor(i / width) + 0.5];
    if (!Number.isFinite(bright)) continue;
    const weights = towards.map((seen, i) =>
      metering_weight(projection, x, y, width, height, fieldOfView, seen, cosines[i]),
    );
    const light = weights.findIndex((weight) => weight < 0);
    const solid = Math.abs(weights[0]);
    whole += solid;
    if (bright > 0 && solid > 0) {
      const away = light < 0 ? solid : 0;
      pixels.push([bright, away, solid - away, light, rgba[4 * i], rgba[4 * i + 2]]);
      red += away * rgba[4 * i];
      blue += away * rgba[4 * i + 2];
    } else if (light < 0) black += solid;
  }
  if (!pixels.length) return unlit_exposure(white);
  pixels.sort((a, b) => a[0] - b[0]);
  const table = (numbers) => ({ values: Float64Array.from(numbers), shape: [numbers.length] });
  const mean = blue / Math.max(red, 1e-300);
  for (const one of pixels) one[4] = mean > 0 ? cool_share(one[4], one[5], mean) : 0;
  const columns = [0, 1, 2, 3, 4].map((part) => table(pixels.map((one) => one[part])));
  return exposure_with_stars(...columns, suns.length, black, whole, white);
}

/** Luminance of a white surface that faces a light: white_luminance in scene/metering.py. */
export function whiteOf(numbers) {
  const sums = ["red", "green", "blue"].map((channel) =>
    [0, 1, 2, 3].reduce((sum, i) => sum + numbers[`${channel}_${i}`], 0),
  );
  return Math.max(luminance_of(...sums), 0) / Math.PI;
}

/**
 * Chromaticity of a scene's mean light: `scene_white` in Python.
 *
 * @param {Float32Array} rgba Linear sRGB, four values per pixel. [W m⁻² sr⁻¹]
 * @param {number} factor Factor of the exposure. [1]
 * @param {number[][]} toXyz XYZ of each channel.
 * @returns {[number, number]} x and y; 0 if there is no light.
 */
export function sceneWhite(rgba, factor, toXyz) {
  const total = [0, 0, 0];
  for (let i = 0; i < rgba.length; i += 4) {
    const color = rgba.subarray(i, i + 3);
    const weight = scene_weight(...color, factor);
    if (weight > 0) color.forEach((one, c) => (total[c] += weight * one));
  }
  const [x, y, z] = [0, 1, 2].map((k) => total.reduce((s, one, c) => s + one * toXyz[c][k], 0));
  return y > 0 ? [x / (x + y + z), y / (x + y + z)] : [0, 0];
}
