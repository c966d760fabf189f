/**
 * Flat textures: a table of any shape, element after element, in rows of 2048 texels.
 *
 * Shaders read element i at (i & 2047, i >> 11), without filtering, so that the same text runs on
 * WebGPU and on WebGL2.
 */

/** Texels in a row. */
export const ROW = 2048;

/** Numbers in a texel of each format. */
export const CHANNELS = { r32float: 1, rgba32float: 4 };

/**
 * The size of the flat texture that holds so many numbers.
 *
 * @param {number} count Numbers, not texels.
 * @param {string} format r32float or rgba32float.
 * @returns {{width: number, height: number}} In texels.
 */
export function flatSize(count, format) {
  const texels = Math.ceil(count / CHANNELS[format]);
  return { width: ROW, height: Math.max(1, Math.ceil(texels / ROW)) };
}

/**
 * Numbers in whole rows: the last one is filled with zeros.
 *
 * @param {Float32Array} data
 * @param {string} format r32float or rgba32float.
 * @returns {Float32Array} The same array where nothing is missing.
 */
export function wholeRows(data, format) {
  const { width, height } = flatSize(data.length, format);
  const length = width * height * CHANNELS[format];
  if (data.length === length) return data;
  const filled = new Float32Array(length);
  filled.set(data);
  return filled;
}
