/**
 * Ground map: images converted to packed texels of four 8-bit values: sRGB colour and water fraction.
 */

/** Values of a texel. */
const CHANNELS = 4;

/**
 * Texels of the ground map with all its levels, as scene/map_levels.py makes them.
 *
 * @param {{image: string, water: string | null, rows: number, columns: number,
 *     decoded: number[]} | null} map From viewer/browser/package.py; null for a ground of uniform
 *     colour.
 * @returns {Promise<{texels: Uint8Array, size: number[]}>} Texels, and the numbers of rows, columns
 *     and levels.
 */
export async function groundTexels(map) {
  if (!map) return { texels: new Uint8Array(CHANNELS), size: [1, 1, 1] };
  const sizes = [[map.rows, map.columns]];
  while (sizes.at(-1)[0] > 1) sizes.push(sizes.at(-1).map((size) => (size + 1) >> 1));
  const starts = [0];
  for (const [rows, columns] of sizes) starts.push(starts.at(-1) + CHANNELS * rows * columns);
  const texels = new Uint8Array(starts.at(-1));
  texels.set(await pixelsOf(map.image, map));
  const water = map.water && (await pixelsOf(map.water, map));
  for (let i = 3; i < starts[1]; i += CHANNELS) texels[i] = water ? water[i - 3] : 0;
  for (let i = 1; i < sizes.length; i++) {
    const fine = texels.subarray(starts[i - 1], starts[i]);
    halve(fine, sizes[i - 1], texels.subarray(starts[i], starts[i + 1]), sizes[i], map.decoded);
  }
  return { texels, size: [map.rows, map.columns, sizes.length] };
}

/** Bytes of an image, four values per pixel. */
export async function pixelsOf(image, { rows, columns }) {
  const bytes = Uint8Array.from(atob(image.slice(image.indexOf(",") + 1)), (c) => c.charCodeAt(0));
  const kind = image.slice(5, image.indexOf(";"));
  const bitmap = await createImageBitmap(new Blob([bytes], { type: kind }), {
    colorSpaceConversion: "none",
  });
  const context = new OffscreenCanvas(columns, rows).getContext("2d", { willReadFrequently: true });
  context.drawImage(bitmap, 0, 0, columns, rows);
  return context.getImageData(0, 0, columns, rows).data;
}

/** First source texel of each target texel along an axis, and the weights of three texels. */
function areaWeights(size, parts) {
  return Array.from({ length: parts }, (_, part) => {
    const first = Math.floor((part * size) / parts);
    const weights = [0, 1, 2].map((tap) => {
      const low = Math.max((first + tap) * parts, part * size);
      const high = Math.min((first + tap + 1) * parts, (part + 1) * size);
      return Math.max(high - low, 0) / size;
    });
    return { first, weights };
  });
}

/** Fill a mip level with area averages of the previous one, in linear light. */
function halve(fine, [height, width], out, [rows, columns], decoded) {
  const down = areaWeights(height, rows);
  const right = areaWeights(width, columns);
  const total = new Float64Array(CHANNELS);
  let at = 0;
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      total.fill(0);
      for (let y = 0; y < 3; y++) {
        const share = down[row].weights[y];
        for (let x = 0; x < 3 && share > 0; x++) {
          const weight = share * right[column].weights[x];
          if (weight === 0) continue;
          const texel = CHANNELS * ((down[row].first + y) * width + right[column].first + x);
          for (let c = 0; c < 3; c++) total[c] += weight * decoded[fine[texel + c]];
          total[3] += weight * fine[texel + 3];
        }
      }
      for (let c = 0; c < 3; c++) out[at++] = encoded(total[c], decoded);
      out[at++] = Math.round(total[3]);
    }
  }
}

/** Nearest 8-bit value of a linear colour. */
function encoded(linear, decoded) {
  let low = 0;
  let high = 255;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (decoded[middle] <= linear) low = middle;
    else high = middle;
  }
  return linear - decoded[low] < decoded[high] - linear ? low : high;
}
