/** Tables of the picture after an edit: those of the unedited planet, with new ones appended. */
import { numbersOf } from "../drawing/package.js";

/**
 * Solution data for picture.js.
 *
 * @param {object} plain Picture of the unedited planet.
 * @param {object} solver See solver.js.
 * @param {object} air See edited_air.js.
 * @param {object} light Texture of the solved light.
 * @param {number} ground Factor of the ground's reflectance.
 */
export async function editedPicture(plain, { plan, scalars, fixed }, air, light, ground) {
  const { shared, ends, levels, peaks } = fixed.picture;
  const { sun_angles, terms, degree } = plan.sizes;
  const { broadened } = peaks;
  const uniforms = { ...plain.uniforms, radii: levels, sun_angles, degree, broadened };
  const old = {
    scalars: await numbersOf(plain.tables.scalars.data),
    spectra: await numbersOf(plain.tables.spectra.data),
  };
  const numbers = { strongest: air.strongest, brightest: air.brightest, ends };
  for (const [name, one] of Object.entries(shared)) {
    const { start, shape } = plan.tables[one];
    numbers[name] = scalars.subarray(start, start + shape.reduce((all, n) => all * n, 1));
  }
  const [start, length] = plain.uniforms.table_basis;
  const basis = old.spectra.slice(4 * start, 4 * (start + length)).map((x) => x * ground);
  const { scattering, moments, polarised_moments, albedo } = air;
  const [scaled_extinction, extinction] = [air.extinction, air.unscaled_extinction];
  const tables = { scaled_extinction, extinction, scattering, moments };
  const inverse_peak_fraction = Float32Array.from(peaks.inverse_peak_fraction.values);
  const broadening = await numbersOf(peaks.broadening);
  const spectra = {
    ...tables,
    polarised_moments,
    albedo,
    basis,
    inverse_peak_fraction,
    broadening,
  };
  const constituents = scattering.length / 4;
  const shapes = {
    moments: [constituents, degree + 1],
    polarised_moments: [constituents, 4],
    broadening: peaks.shape,
  };
  const nodes = levels * sun_angles;
  uniforms.table_field = [0, levels, sun_angles, terms + 1];
  uniforms.table_sky = [nodes * (terms + 1), levels, sun_angles, 2];
  return {
    ...plain,
    uniforms,
    tables: {
      scalars: { format: "r32float", data: appended(old.scalars, numbers, 1, uniforms, {}) },
      spectra: {
        format: "rgba32float",
        data: appended(old.spectra, spectra, 4, uniforms, shapes),
      },
      fields: { texture: light },
    },
  };
}

/** Append tables, in texels of `width` numbers, and set the uniforms of their offsets and shapes. */
function appended(before, tables, width, uniforms, shapes) {
  const all = [before];
  let at = before.length / width;
  for (const [name, table] of Object.entries(tables)) {
    const texels = table.length / width;
    uniforms[`table_${name}`] = [at, ...(shapes[name] ?? [texels]), 0, 0].slice(0, 4);
    all.push(table);
    at += texels;
  }
  const joined = new Float32Array(at * width);
  let place = 0;
  for (const table of all) {
    joined.set(table, place);
    place += table.length;
  }
  return joined;
}
