/**
 * What draws a planet: its tables on the device, and the passes over them.
 *
 * A description, as viewer/browser/package.py makes it, has what is the same for every planet — `plan` and
 * `shaders` (see program.js), `sky` (shapes of the table of the sky), `glance` (side of the picture
 * that the exposure is found from), `projections` with their fields of view, `tone_maps` with the
 * luminance that each shows as middle grey, `encodings`, `orders`, and `view_uniforms`, the shaders'
 * numbers that are values of the view — and what belongs
 * to a solution: `uniforms`, `tables` (`{format, data}` by name, or a `texture` that is given away), `ground` (see ground.js), `radius`,
 * `thickness`, `star` and `paths` (see view_uniforms.js).
 */
import { automaticExposure } from "./exposure.js";
import { groundTable } from "./ground.js";
import { numbersOf } from "./package.js";
import { Program } from "./program.js";
import { cameraNumbers, observerNumbers } from "./view_uniforms.js";
import { cameraOf } from "./view.js";

/** A table of the sky may take so long while something moves, and while it rests. [ms] */
const SMOOTH = 60;
const PATIENT = 2500;
/** A texel of it takes so long on a processor; until it is known it is taken to. [ms] */
const SLOW = 0.05;
/** Texels in a row of a flat texture. */
const ROW = 2048;

export class Picture {
  /**
   * @param {object} device See devices/device.js.
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
    this.texelTime = SLOW;
    this.drawings = 0;
    this.exposure = 0;
  }

  /** Another solution, as after an edit. */
  async take(solution) {
    const names = Object.keys(solution.tables).filter((n) => !solution.tables[n].texture);
    const numbers = await Promise.all(names.map((n) => numbersOf(solution.tables[n].data)));
    const image = solution.ground?.image ?? null;
    const ground = this.map === image ? null : await groundTable(solution.ground);
    names.forEach((n, i) => this.program.setTable(n, solution.tables[n].format, numbers[i]));
    for (const [name, { texture }] of Object.entries(solution.tables)) {
      if (texture) this.program.takeTexture(name, texture);
    }
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
   * @param {string} effort `moving`: at once; `resting`: as well as a short while allows; `best`.
   * @returns {Promise<boolean>} Whether it can be drawn better while it rests.
   */
  async draw(values, width, height, effort) {
    const { program, fixed } = this;
    const camera = cameraOf(values, fixed.projections);
    await this.drawSky(values, camera, effort);
    const tone = values["display.tone_map"];
    let exposure = values["display.exposure"];
    if (values["display.automatic"]) exposure += await this.found(camera, width, height, tone);
    this.exposure = exposure;
    program.setAll(cameraNumbers(camera, width, height, fixed.projections));
    program.setAll({
      ...this.viewNumbers(values),
      exposure: 2 ** exposure,
      encoding: fixed.encodings.indexOf("srgb"),
      first_row: 0,
    });
    program.run("picture");
    return this.texels(this.shapeFor("resting")) > this.texels(this.shape);
  }

  /** The table of what this observer sees around himself, unless it is there. */
  async drawSky(values, camera, effort) {
    const { program, fixed, planet } = this;
    const numbers = this.seenBy(values, camera);
    const seen = this.key(numbers);
    const shape = this.shapeFor(effort);
    if (seen === this.seen && this.texels(this.shape) >= this.texels(shape)) return;
    if (shape !== this.shape) this.reshape(shape);
    const peaks = planet.uniforms.first_peak >= 0;
    const [columns, rows] = fixed.sky[shape];
    program.setAll({ ...numbers, keeps_peaks: Number(peaks), exact: 0 });
    program.setAll({ sky_columns: columns, sky_rows: rows });
    const began = performance.now();
    program.run("sky_air", ...(peaks ? ["sky_peaks"] : []));
    this.seen = seen;
    // A GPU is asked now and then what it takes; a processor that stands in for one, always.
    if (this.drawings++ % 16 === 0 || this.texelTime > SLOW) {
      await this.device.finished();
      const time = (performance.now() - began) / this.texels(shape);
      // The first one has the driver's own compilation in it.
      this.texelTime = this.drawings > 1 ? time : SLOW;
    }
  }

  /** The largest table that an effort allows: the first one of all is the smallest. */
  shapeFor(effort) {
    if (effort === "best") return "full";
    if (this.shape === null) return "quick";
    const allowed = effort === "moving" ? SMOOTH : PATIENT;
    const fits = ["full", "medium"].filter((s) => this.texels(s) * this.texelTime < allowed);
    return fits[0] ?? "quick";
  }

  texels(shape) {
    const [columns, rows] = this.fixed.sky[shape];
    return 2 * columns * rows;
  }

  /** The numbers that the table of the sky depends on. */
  seenBy(values, camera) {
    return {
      ...observerNumbers(this.planet, values["view.altitude"], camera.sun),
      orders: this.fixed.orders[values["light.orders"]],
    };
  }

  /** Values of the view that are numbers of the shaders, by name: `uniforms_of` in Python. */
  viewNumbers(values) {
    const numbers = {};
    for (const [name, { path, options }] of Object.entries(this.fixed.view_uniforms)) {
      numbers[name] = options.length ? options.indexOf(values[path]) : Number(values[path]);
    }
    return numbers;
  }

  key(numbers) {
    return JSON.stringify([this.solutions, numbers]);
  }

  reshape(shape) {
    const [columns, rows] = this.fixed.sky[shape];
    for (const name of ["air", "behind", "first", "second"]) {
      this.program.resize(name, ROW, Math.ceil((2 * columns * rows) / ROW));
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
    return automaticExposure(rgba, fixed.tone_maps[tone]);
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
