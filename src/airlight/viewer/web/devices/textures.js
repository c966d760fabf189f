/**
 * Flat textures: the elements of a table of any shape in sequence, in rows of `ROW` texels.
 *
 * Shaders read element i in column i % ROW of row i / ROW, without filtering, so that the same code
 * runs on WebGPU and on WebGL2.
 */
import { CHANNELS, PACKED_FORMAT, PACKED_ROW, ROW } from "../generated/sizes.js";

/**
 * Size of a flat texture.
 *
 * @param {number} count Number of values, not of texels.
 * @param {string} format r32float, rgba32float or that of packed texels, which has longer rows.
 * @returns {{width: number, height: number}} Size. [texel]
 */
export function flatSize(count, format) {
  const texels = Math.ceil(count / CHANNELS[format]);
  const width = format === PACKED_FORMAT ? PACKED_ROW : ROW;
  return { width, height: Math.max(1, Math.ceil(texels / width)) };
}

/**
 * Pad values with zeros to whole rows.
 *
 * @param {Float32Array | Uint8Array} data Bytes of packed texels, otherwise floats.
 * @param {string} format r32float, rgba32float or that of packed texels.
 * @returns {Float32Array | Uint8Array} The same array if no padding is needed.
 */
export function wholeRows(data, format) {
  const { width, height } = flatSize(data.length, format);
  const length = width * height * CHANNELS[format];
  if (data.length === length) return data;
  const filled = new data.constructor(length);
  filled.set(data);
  return filled;
}
