/**
 * Renderer of a planet: its tables on the device, and the passes over them.
 *
 * A description from viewer/browser/package.py has data that are the same for every planet — `plan`
 * and `shaders` (see program.js), `sky` (shapes of the sky table), `layers` (its textures), `glance` (longer side of the
 * picture from which the exposure is measured), `projections` with their fields of view,
 * `tone_maps` with the luminance that each shows as middle grey, `encodings`, `orders`, and
 * `view_uniforms`, the uniforms that are view values — and data of a solution: `uniforms`, `tables`
 * (`{format, data}` by name, or a `texture` whose ownership is transferred), `ground` (see
 * ground.js), `radius`, `thickness`, `star` and `paths` (see view_uniforms.js).
 */
import { automaticExposure } from "./exposure.js";
import { groundTable } from "./ground.js";
import { numbersOf } from "./package.js";
import { Program } from "./program.js";
import { cameraNumbers, observerNumbers } from "./view_uniforms.js";
import { cameraOf } from "./view.js";
import { ROW } from "../generated/sizes.js";

/** Time limits of a sky table while the view moves, and while it rests. [ms] */
const SMOOTH = 60;
const PATIENT = 2500;
/** Time per texel of the sky table on a processor, assumed until it is measured. [ms] */
const SLOW = 0.05;

export class Picture {
  /**
   * Compile the shaders and upload a solution.
   *
   * @param {object} device See devices/device.js.
   * @param {object} description
   * @returns {Promise<Picture>}
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

  /** Upload another solution, as after an edit. */
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
   * The promise resolves directly after the last pass, so that the canvas can be copied then.
   *
   * @param {Object<string, number | string | boolean>} values Values of all parameters, by path.
   * @param {number} width Width of the canvas. [pixel]
   * @param {number} height Height of the canvas. [pixel]
   * @param {string} effort `moving`: at once; `resting`: within a time limit; `best`: unlimited.
   * @returns {Promise<boolean>} Whether a finer picture is possible while the view rests.
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

  /** Draw the sky table of the observer, unless it is up to date. */
  async drawSky(values, camera, effort) {
    const { program, fixed, planet } = this;
    const numbers = this.seenBy(values, camera);
    const seen = this.key(numbers);
    const shape = this.shapeFor(effort);
    if (seen === this.seen && this.texels(this.shape) >= this.texels(shape)) return;
    if (shape !== this.shape) this.reshape(shape);
    const peaks = planet.uniforms.first_peak >= 0;
    const [columns, rows] = fixed.sky[shape];
    program.setAll({ ...numbers, keeps_peaks: Number(peaks) });
    program.setAll({ sky_columns: columns, sky_rows: rows });
    const began = performance.now();
    program.run("sky_air", ...(peaks ? ["sky_peaks"] : []));
    this.seen = seen;
    // The time is measured occasionally on a GPU, always on a software device.
    if (this.drawings++ % 16 === 0 || this.texelTime > SLOW) {
      await this.device.finished();
      const time = (performance.now() - began) / this.texels(shape);
      // The first time includes the driver's compilation.
      this.texelTime = this.drawings > 1 ? time : SLOW;
    }
  }

  /** Largest sky table that an effort allows; the very first one is the smallest. */
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

  /** Values on which the sky table depends. */
  seenBy(values, camera) {
    return {
      ...observerNumbers(this.planet, values["view.altitude"], camera.sun),
      orders: this.fixed.orders[values["light.orders"]],
    };
  }

  /** Uniforms that are view values, by name: `uniforms_of` in Python. */
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
    for (const name of this.fixed.layers) {
      this.program.resize(name, ROW, Math.ceil((2 * columns * rows) / ROW));
    }
    this.shape = shape;
  }

  /**
   * Description of a pixel's light.
   *
   * @param {Object<string, number | string | boolean>} values Values of all parameters, by path.
   * @param {[number, number]} size Size of the picture as displayed. [pixel]
   * @param {[number, number]} place Position of the pixel, from the left and the top. [pixel]
   * @returns {Promise<string>} Text; empty if the picture does not show this view yet.
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

  /** Automatic exposure of the view. [EV] */
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

/** Text of luminance and chromaticity of linear sRGB light. [W m⁻² sr⁻¹] */
function described(rgb, { xyz, efficacy }) {
  const [x, y, z] = [0, 1, 2].map((i) => xyz.reduce((sum, row, c) => sum + row[i] * rgb[c], 0));
  if (!(y > 0)) return "no light";
  const sum = x + y + z;
  const bright = `${(efficacy * y).toPrecision(3)} cd/m²`;
  return `luminance ${bright}\nx ${(x / sum).toFixed(4)}, y ${(y / sum).toFixed(4)}`;
}
