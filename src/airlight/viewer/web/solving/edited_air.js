/**
 * Optical coefficients for edited amounts of the constituents in viewer/browser/page_solver.py.
 *
 * The formulas are those of solvers/moments/reduced_optics.py and of level_weights in packing.py.
 */
import { cut_part, cut_weight, is_peaked, thick_share } from "../generated/formulas.js";

/** Number of wavelengths in a texel. */
const LANES = [0, 1, 2, 3];

/**
 * Edited amounts and brightness of a state.
 *
 * @param {object} air
 * @param {Object<string, number>} values Values of all parameters, by path.
 */
export function editOf(air, values) {
  return {
    amounts: air.names.map((_, index) => values[`air.amounts[${index}]`] ?? 1),
    ground: values["air.ground"] ?? 1,
  };
}

/** Whether all amounts are the planet's. */
export function isPlain({ amounts, ground }) {
  return ground === 1 && amounts.every((one) => one === 1);
}

/**
 * Tables of an edited atmosphere.
 *
 * @param {object} air
 * @param {{amounts: number[], ground: number}} edit
 * @returns {object} Tables by name, four wavelengths per texel: `extinction` and `moments` without
 *     forward peaks, `scattering`, `albedo`, `level`; `strongest` and `brightest` of each
 *     constituent; and `thick`, the weight of the night side.
 * @throws {RangeError} If the atmosphere is too thick for this solver; one line.
 */
export function editedAir(air, { amounts, ground }) {
  const times = (table) => table.map((row, c) => row.map((x) => x * (amounts[c] ?? 1)));
  const scattering = times(air.scattering);
  const extinction = times(air.absorption).map((row, c) => row.map((x, w) => x + scattering[c][w]));
  const over = (weigh) => LANES.map((w) => air.columns.reduce((sum, h, c) => sum + h * weigh(c, w), 0));
  const transport = over((c, w) => extinction[c][w] - scattering[c][w] * air.phases[c][1][w]);
  if (Math.max(...transport) > air.thickest) {
    throw new RangeError("so much air is too thick to be solved here; the desktop viewer solves it");
  }
  const peaks = forwardPeaks(air, scattering, over);
  const smooth = over((c, w) => scattering[c][w] * (1 - peaks[c][w]));
  const thick = smooth.map(thick_share);
  const degrees = air.phases[0].length - 1;
  return {
    extinction: flat(extinction.map((row, c) => row.map((x, w) => x - peaks[c][w] * scattering[c][w]))),
    scattering: flat(scattering),
    moments: flat(
      scattering.flatMap((row, c) =>
        air.phases[c]
          .slice(0, degrees)
          .map((phase) => row.map((x, w) => (x > 0 ? x * (phase[w] - peaks[c][w]) : 0))),
      ),
    ),
    albedo: Float32Array.from(air.albedo, (x) => x * ground),
    level: flat(air.day.map((day) => thick.map((x) => day * x))),
    strongest: Float32Array.from(extinction, (row) => Math.max(...row)),
    brightest: Float32Array.from(scattering, (row) => Math.max(...row)),
    thick,
  };
}

/** Fraction of each constituent's scattering that is treated as unscattered. [1] */
function forwardPeaks({ phases }, scattering, over) {
  const beyond = phases.map((one) => one[one.length - 1]);
  const depth = over((c, w) => (is_peaked(beyond[c][w]) ? scattering[c][w] : 0));
  const weight = depth.map(cut_weight);
  return beyond.map((row) => row.map((x, w) => cut_part(x, weight[w])));
}

function flat(rows) {
  return Float32Array.from(rows.flat());
}
