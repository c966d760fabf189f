/** The picture's tables after an edit: those of the planet as it is, with new ones behind them. */
import { numbersOf } from "../drawing/package.js";

/**
 * What picture.js takes.
 *
 * @param {object} plain The picture of the planet as it is.
 * @param {object} solver See solver.js.
 * @param {object} air See edited_air.js.
 * @param {object} light The texture of the solved light.
 * @param {number} ground Factor of the ground's reflectance.
 */
export async function editedPicture(plain, { plan, scalars, fixed }, air, light, ground) {
  const { shared, ends, levels } = fixed.picture;
  const { suns, terms, degree } = plan.sizes;
  const uniforms = { ...plain.uniforms, radii: levels, suns, degree };
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
  const { extinction, scattering, moments, albedo } = air;
  const nodes = levels * suns;
  uniforms.table_field = [0, nodes * (terms + 1), 0, 0];
  uniforms.table_sky = [nodes * (terms + 1), 2 * nodes, 0, 0];
  return {
    ...plain,
    uniforms,
    tables: {
      scalars: { format: "r32float", data: appended(old.scalars, numbers, 1, uniforms) },
      spectra: {
        format: "rgba32float",
        data: appended(old.spectra, { extinction, scattering, moments, albedo, basis }, 4, uniforms),
      },
      fields: { texture: light },
    },
  };
}

/** Tables behind others, in texels of so many numbers; the uniforms are told where they are. */
function appended(before, tables, width, uniforms) {
  const all = [before];
  let at = before.length / width;
  for (const [name, table] of Object.entries(tables)) {
    const texels = table.length / width;
    uniforms[`table_${name}`] = [at, texels, 0, 0];
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
