/** Ground map: an image converted to linear reflectances and their mip levels. */

/**
 * Table of the ground map.
 *
 * @param {{image: string, levels: number[][], decoded: number[]} | null} map From
 *     viewer/browser/ground_map.py; null for a ground of uniform colour.
 * @returns {Promise<{numbers: Float32Array, places: {levels: number[], texels: number[]}}>} Table,
 *     and offsets of its two parts.
 */
export async function groundTable(map) {
  if (!map) {
    const numbers = new Float32Array([0, 1, 1, 0, 0, 0]);
    return { numbers, places: { levels: [0, 1, 3, 0], texels: [3, 3, 0, 0] } };
  }
  const head = map.levels.flat();
  const [start, height, width] = map.levels.at(-1);
  const count = start + 3 * height * width;
  const numbers = new Float32Array(head.length + count);
  numbers.set(head);
  const texels = numbers.subarray(head.length);
  fill(texels, await pixelsOf(map), map.decoded);
  for (let i = 1; i < map.levels.length; i++) halve(texels, map.levels[i - 1], map.levels[i]);
  const places = { levels: [0, map.levels.length, 3, 0], texels: [head.length, count, 0, 0] };
  return { numbers, places };
}

async function pixelsOf({ image, levels }) {
  const [, height, width] = levels[0];
  const bytes = Uint8Array.from(atob(image.slice(image.indexOf(",") + 1)), (c) => c.charCodeAt(0));
  const kind = image.slice(5, image.indexOf(";"));
  const bitmap = await createImageBitmap(new Blob([bytes], { type: kind }), {
    colorSpaceConversion: "none",
  });
  const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
  context.drawImage(bitmap, 0, 0);
  return context.getImageData(0, 0, width, height).data;
}

function fill(texels, pixels, decoded) {
  let at = 0;
  for (let i = 0; i < pixels.length; i += 4) {
    texels[at++] = decoded[pixels[i]];
    texels[at++] = decoded[pixels[i + 1]];
    texels[at++] = decoded[pixels[i + 2]];
  }
}

/** Fill a level with the means of 2 × 2 texels of the previous one. */
function halve(texels, [from, , wide], [to, height, width]) {
  for (let row = 0; row < height; row++) {
    for (let column = 0; column < width; column++) {
      const upper = from + 3 * (2 * row * wide + 2 * column);
      const lower = upper + 3 * wide;
      const at = to + 3 * (row * width + column);
      for (let c = 0; c < 3; c++) {
        texels[at + c] =
          0.25 * (texels[upper + c] + texels[upper + 3 + c] + texels[lower + c] + texels[lower + 3 + c]);
      }
    }
  }
}
