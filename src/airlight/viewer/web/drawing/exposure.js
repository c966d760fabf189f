/** Automatic exposure, as color/exposure.py finds it: the picture's mean is shown as middle grey. */

/** Pixels darker than this part of the picture's bright end do not count. */
const DARK = 1e-4;

/**
 * @param {Float32Array} rgba Linear sRGB of a small picture, four numbers a pixel.
 * @param {number} grey Luminance that the tone map shows as middle grey.
 * @param {number[]} weights Luminance of red, green and blue.
 * @returns {number} -100 to 100; 0 for a black picture. [EV]
 */
export function automaticExposure(rgba, grey, weights) {
  const bright = [];
  for (let i = 0; i < rgba.length; i += 4) {
    const y = weights[0] * rgba[i] + weights[1] * rgba[i + 1] + weights[2] * rgba[i + 2];
    if (Number.isFinite(y) && y > 0) bright.push(y);
  }
  if (bright.length === 0) return 0;
  bright.sort((a, b) => a - b);
  const dark = DARK * percentile(bright, 0.99);
  const logs = bright.filter((y) => y >= dark).map(Math.log2);
  const mean = logs.reduce((sum, x) => sum + x, 0) / logs.length;
  return Math.min(Math.max(Math.log2(grey) - mean, -100), 100);
}

/** Between the two neighbours of the place, as NumPy does. */
function percentile(sorted, share) {
  const place = share * (sorted.length - 1);
  const low = Math.floor(place);
  const high = Math.min(low + 1, sorted.length - 1);
  return sorted[low] + (place - low) * (sorted[high] - sorted[low]);
}
