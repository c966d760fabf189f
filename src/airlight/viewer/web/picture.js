/**
 * What draws a planet: its tables on the device, and the passes over them.
 *
 * A description, as viewer/package.py makes it, has what is the same for every planet — `plan` and
 * `shaders` (see program.js), `sky` (shapes of the table of the sky), `glance` (side of the picture
 * that the exposure is found from), `projections` with their fields of view, `tone_maps` with the
 * luminance that each shows as middle grey, `encodings`, `orders` and `luminance` — and what belongs
 * to a solution: `uniforms`, `tables` (`{format, data}` by name), `ground` (see ground.js), `radius`,
 * `thickness`, `star` and `paths` (see shown_view.js).
 */
import { automaticExposure } from "./exposure.js";
import { groundTable } from "./ground.js";
import { numbersOf } from "./package.js";
import { Program } from "./program.js";
import { cameraNumbers, observerNumbers } from "./shown_view.js";
import { cameraOf } from "./view.js";

/** A table of the sky that takes longer than this is drawn smaller while something moves. [ms] */
const SMOOTH = 60;
/** Texels in a row of a flat texture. */
const ROW = 2048;

export class Picture {
  /**
   * @param {object} device See device.js.
   * @param {object} description
   */
  static async make(device, description) {
    const program = new Program(device, description.plan, description.shaders);
    const picture = new Picture(program, description);
    await Promise.all([program.build(), picture.take(description)]);
    return picture;
  }

  constructor(program, description) {
    this.program = program;
    this.device = program.device;
    this.fixed = description;
    this.planet = null;
    this.map = undefined;
    this.seen = "";
    this.solutions = 0;
    this.shape = null;
    this.skyTime = Infinity;
    this.exposure = 0;
  }

  /** Another solution, as after an edit. */
  async take(solution) {
    const names = Object.keys(solution.tables);
    const numbers = await Promise.all(names.map((n) => numbersOf(solution.tables[n].data)));
    const image = solution.ground?.image ?? null;
    const ground = this.map === image ? null : await groundTable(solution.ground);
    names.forEach((n, i) => this.program.setTable(n, solution.tables[n].format, numbers[i]));
    for (const [name, value] of Object.entries(solution.uniforms)) this.program.set(name, value);
    if (ground) {
      this.map = image;
      this.program.setTable("ground", "r32float", ground.numbers);
      this.program.set("table_levels", ground.places.levels);
      this.program.set("table_texels", ground.places.texels);
      this.program.set("mapped", Number(image !== null));
      this.program.set("map_levels", ground.places.levels[1]);
    }
    this.planet = solution;
    this.solutions += 1;
  }

  /**
   * Draw on the canvas.
   *
   * The last pass follows without a pause, so that the canvas can be copied when the promise is
   * kept.
   *
   * @param {Object<string, number | string | boolean>} values Of all parameters, by path.
   * @param {number} width
   * @param {number} height [pixel]
   * @param {boolean} rest Whether nothing moves: what is seen is then drawn as well as it can be.
   * @returns {Promise<boolean>} Whether it can be drawn better.
   */
  async draw(values, width, height, rest = true) {
    const { program, fixed } = this;
    const camera = cameraOf(values, fixed.projections);
    await this.drawSky(values, camera, rest);
    const tone = values["display.tone_map"];
    let exposure = values["display.exposure"];
    if (values["display.automatic"]) exposure += await this.found(camera, width, height, tone);
    this.exposure = exposure;
    program.setAll(cameraNumbers(camera, width, height, fixed.projections));
    program.setAll({
      exposure: 2 ** exposure,
      tone_map: Object.keys(fixed.tone_maps).indexOf(tone),
      encoding: fixed.encodings.indexOf("srgb"),
      first_row: 0,
    });
    program.run("picture");
    return this.shape !== "full";
  }

  /** The table of what this observer sees around himself, unless it is there. */
  async drawSky(values, camera, rest) {
    const { program, fixed, planet } = this;
    const numbers = this.seenBy(values, camera);
    const seen = this.key(numbers);
    // The very first one is quick too, so that there is something to look at.
    const quick = this.shape === null || !(rest || this.skyTime < SMOOTH);
    const shape = quick ? "quick" : "full";
    if (seen === this.seen && (shape === this.shape || !rest)) return;
    if (shape !== this.shape) this.reshape(shape);
    const peaks = planet.uniforms.first_peak >= 0;
    const [columns, rows] = fixed.sky[shape];
    program.setAll({ ...numbers, keeps_peaks: Number(peaks), exact: 0 });
    program.setAll({ sky_columns: columns, sky_rows: rows });
    const began = performance.now();
    program.run("sky_air", ...(peaks ? ["sky_peaks"] : []));
    if (shape === "full") {
      await this.device.finished();
      this.skyTime = performance.now() - began;
    }
    this.seen = seen;
  }

  /** The numbers that the table of the sky depends on. */
  seenBy(values, camera) {
    return {
      ...observerNumbers(this.planet, values["view.altitude"], camera.sun),
      orders: this.fixed.orders[values["light.orders"]],
    };
  }

  key(numbers) {
    return JSON.stringify([this.solutions, numbers]);
  }

  reshape(shape) {
    const [columns, rows] = this.fixed.sky[shape];
    for (const name of ["air", "behind", "first", "second"]) {
      this.program.resize(name, ROW, (2 * columns * rows) / ROW);
    }
    this.shape = shape;
  }

  /**
   * What a pixel's light is, in words.
   *
   * @param {Object<string, number | string | boolean>} values Of all parameters.
   * @param {[number, number]} size Of the picture as it is seen. [pixel]
   * @param {[number, number]} place Of the pixel, from the left and the top. [pixel]
   * @returns {Promise<string>} Empty if the picture does not show this view yet.
   */
  async probe(values, size, place) {
    const { program, fixed } = this;
    const camera = cameraOf(values, fixed.projections);
    if (this.seen !== this.key(this.seenBy(values, camera))) return "";
    program.resize("glance", ...size);
    program.setAll(cameraNumbers(camera, ...size, fixed.projections));
    const area = [...place, 1, 1];
    program.runIn("glance", area);
    const rgb = await program.read("glance", area);
    return described(rgb, fixed);
  }

  /** The exposure that suits what is seen. [EV] */
  async found(camera, width, height, tone) {
    const { program, fixed } = this;
    const share = fixed.glance / Math.max(width, height);
    const [wide, high] = [width, height].map((x) => Math.max(1, Math.round(x * share)));
    program.resize("glance", wide, high);
    program.setAll(cameraNumbers(camera, wide, high, fixed.projections));
    program.run("glance");
    const rgba = await program.read("glance");
    return automaticExposure(rgba, fixed.tone_maps[tone], fixed.luminance);
  }
}

/** Luminance and chromaticity of linear sRGB light. [W m⁻² sr⁻¹] */
function described(rgb, { xyz, efficacy }) {
  const [x, y, z] = [0, 1, 2].map((i) => xyz.reduce((sum, row, c) => sum + row[i] * rgb[c], 0));
  if (!(y > 0)) return "no light";
  const sum = x + y + z;
  const bright = `${(efficacy * y).toPrecision(3)} cd/m²`;
  return `luminance ${bright}\nx ${(x / sum).toFixed(4)}, y ${(y / sum).toFixed(4)}`;
}
