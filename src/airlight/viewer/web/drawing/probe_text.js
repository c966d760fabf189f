/** Text of a probe. */
import { luminanceText } from "../state/number_text.js";
import { sky_magnitude } from "../generated/formulas.js";

/**
 * Text of luminance, chromaticity and polarisation.
 *
 * @param {Float32Array[]} found Linear sRGB of I and, if available, of Q and U. [W m⁻² sr⁻¹]
 */
export function probeText([rgb, ...polarised], { xyz, efficacy, dark }) {
  const part = (light, i) => xyz.reduce((sum, row, c) => sum + row[i] * light[c], 0);
  const [x, y, z] = [0, 1, 2].map((i) => part(rgb, i));
  if (!(y > 0)) return "no light";
  const sum = x + y + z;
  const lines = [`luminance ${luminanceText(efficacy * y)}`];
  if (efficacy * y < dark) lines.push(`${sky_magnitude(efficacy * y).toFixed(2)} mag/arcsec²`);
  lines.push(`x ${(x / sum).toFixed(3)}, y ${(y / sum).toFixed(3)}`);
  if (polarised.length) {
    const [q, u] = polarised.map((light) => part(light, 1));
    const degree = Math.min(Math.hypot(q, u) / y, 1);
    const angle = (Math.atan2(u, q) / 2) * (180 / Math.PI);
    lines.push(`polarised ${(100 * degree).toFixed(1)} % at ${angle.toFixed(1)}°`);
  }
  return lines.join("\n");
}
