/**
 * Optical coefficients for edited amounts of the constituents in viewer/browser/page_solver.py.
 *
 * What an edit changes is emitted from solver/moments/delta_m.py and packing.py. Tables are
 * `{values, shape}`, as the emitted functions read them, with four wavelengths on their last axis.
 */
import { level_weight, delta_m_scaling, optically_thick_weight } from "../generated/formulas.js";
import { LANES } from "../generated/sizes.js";

/**
 * Edited amounts and brightness of a state, as factors of the planet's own.
 *
 * @param {object} air
 * @param {State} state
 */
export function editOf(air, state) {
  const factor = (path) => {
    const value = state.get(path);
    return value === undefined ? 1 : value / state.parameters.get(path).present;
  };
  return {
    amounts: air.names.map((_, index) => factor(`air.amounts[${index}]`)),
    ground: factor("air.ground"),
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
 * @returns {object} Tables by name, four wavelengths per texel: `extinction`, `moments` and
 *     `polarised_moments` with delta-M scaling, `unscaled_extinction`, `scattering`, `albedo`, `level`; `strongest` and `brightest`
 *     of each constituent; `thick`, the weight of the night side, and `transport`, the depth in which
 *     each scattering counts by 1 - g, of each wavelength.
 * @throws {RangeError} If the atmosphere is too thick for this solver; one line.
 */
export function editedAir(air, { amounts, ground }) {
  const { phases, polarised_elements, columns, degree } = air;
  const scattering = scaled(air.scattering, amounts);
  const absorption = scaled(air.absorption, amounts);
  const size = scattering.values.length;
  const extinction = new Float32Array(size);
  const moments = new Float32Array(size * (degree + 1));
  const polarised_moments = new Float32Array(4 * size);
  const depths = new Float64Array(3 * LANES);
  const read = [scattering, absorption, phases, polarised_elements, columns];
  delta_m_scaling(...read, degree, extinction, moments, polarised_moments, depths);
  const [, depth, transport] = split(depths);
  if (Math.max(...transport) > air.thickest) {
    throw new RangeError("so much air is too thick to be solved here; the desktop viewer solves it");
  }
  const whole = scattering.values.map((x, i) => x + absorption.values[i]);
  return {
    extinction,
    unscaled_extinction: Float32Array.from(whole),
    scattering: Float32Array.from(scattering.values),
    moments,
    polarised_moments,
    albedo: Float32Array.from(air.albedo, (x) => Math.min(x * ground, air.brightest)),
    level: Float32Array.from(air.day.flatMap((day) => depth.map((one) => level_weight(day, one)))),
    strongest: Float32Array.from(split(whole), (row) => Math.max(...row)),
    brightest: Float32Array.from(split(scattering.values), (row) => Math.max(...row)),
    thick: depth.map(optically_thick_weight),
    transport,
  };
}

/** Table whose rows, one for each constituent, are multiplied by its amount. */
function scaled({ values, shape }, amounts) {
  return { values: values.map((x, i) => x * (amounts[Math.floor(i / LANES)] ?? 1)), shape };
}

/** Rows of four wavelengths. */
function split(values) {
  const rows = [];
  for (let i = 0; i < values.length; i += LANES) rows.push([...values.slice(i, i + LANES)]);
  return rows;
}
