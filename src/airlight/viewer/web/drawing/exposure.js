/** Automatic exposure, which shows the picture's mean as middle grey. */
import { exposure_of, luminance_of } from "../generated/formulas.js";

/**
 * Exposure of a picture.
 *
 * @param {Float32Array} rgba Linear sRGB of a small picture, four values per pixel.
 * @param {number} grey Luminance that the tone map shows as middle grey.
 * @returns {number} Exposure, -100 to 100; 0 for a black picture. [EV]
 */
export function automaticExposure(rgba, grey) {
  const bright = [];
  for (let i = 0; i < rgba.length; i += 4) {
    const y = luminance_of(rgba[i], rgba[i + 1], rgba[i + 2]);
    if (Number.isFinite(y) && y > 0) bright.push(y);
  }
  const values = Float64Array.from(bright).sort();
  return values.length ? exposure_of({ values, shape: [values.length] }, grey) : 0;
}
