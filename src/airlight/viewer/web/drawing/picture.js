/**
 * Renderer of a planet: uploads the tables of a solution and runs the rendering passes.
 *
 * A description from viewer/browser/package.py has planet-independent data — `plan`
 * and `shaders` (see program.js), `marched` (whether pixels are marched, and read no LUT), `sky`
 * (sizes of the sky-view LUT), `layers` (its textures),
 * `metering` (longer side of the metered frame), `filter_exposure` (exposure added for a polariser),
 * `projections` with their fields of view, `display` (uniforms of an 8-bit display), `primaries`,
 * `white_balances`, `orders`, and `view_uniforms` (uniforms that are view values) — and data of a
 * solution: `uniforms`, `tables` (`{format, data}` by name, or a `texture` whose ownership is
 * transferred), `ground` (see ground.js), `radius`, `thickness`, `star`, `star_white` and
 * `geometry` (see view_uniforms.js).
 */
import { automaticExposure, sceneWhite, whiteOf } from "./exposure.js";
import { groundTexels } from "./ground.js";
import { numbersOf } from "./package.js";
import { probeText } from "./probe_text.js";
import { Program } from "./program.js";
import { along, combined, dot } from "./scene_space.js";
import { StarLayers, skyFrame } from "./star_layers.js";
import { cameraUniforms, detailUniforms, observerUniforms, raised } from "./view_uniforms.js";
import { EVEN, lightsOf } from "./lights.js";
import { Adaptation } from "../state/adaptation.js";
import {
  CIRCULAR,
  CONNECTED,
  PIXEL_ANGLES,
  dehazed_exposure,
  disc_factor,
  glare_levels,
  glare_share,
  white_gains,
} from "../generated/formulas.js";
import { ALONG, ASLANT, DISC_FORMAT, LEAST_HEIGHT, NONE, PACKED_FORMAT, ROW } from "../generated/sizes.js";

/** Time limits of the sky-view LUT during and after motion. [ms] */
const SMOOTH = 60;
const PATIENT = 2500;
/** Initial estimate of the time per texel of the sky-view LUT. [ms] */
const SLOW = 0.05;

/** Passes that are compiled when the stars are first shown. */
const LATER = ["through", "layered"];

export class Picture {
  /**
   * Compile the shaders and upload a solution.
   *
   * @param {object} device See devices/device.js.
   * @param {object} description
   * @param {(done: number, total: number) => void} [onProgress] Receives the number of shaders compiled.
   * @returns {Promise<Picture>}
   */
  static async make(device, description, onProgress = () => {}) {
    const program = new Program(device, description.plan, description.shaders);
    const picture = new Picture(program, description);
    await Promise.all([
      program.build(onProgress, (pass) => !LATER.includes(pass)),
      picture.take(description),
    ]);
    return picture;
  }

  constructor(program, description) {
    this.program = program;
    this.device = program.device;
    this.fixed = description;
    this.planet = null;
    this.maps = {};
    this.skyViews = ["", ""];
    this.laws = "";
    /** `StarLayers`, once they are shown, and what is behind the planet in a target by its name. */
    this.stars = null;
    this.backdrops = new Map();
    this.rests = false;
    this.rendered = "";
    this.spread = "";
    this.solutions = 0;
    this.exposed = 0;
    this.shape = null;
    this.texelTime = SLOW;
    this.renderings = 0;
    this.exposure = 0;
    this.adaptation = new Adaptation();
  }

  /** Upload another solution, as after an edit. */
  async take(solution) {
    const names = Object.keys(solution.tables).filter((n) => !solution.tables[n].texture);
    const numbers = await Promise.all(names.map((n) => numbersOf(solution.tables[n].data)));
    await Promise.all([
      this.takeMap("ground", solution.ground, ["mapped", "map"]),
      this.takeMap("overlay", solution.overlay ?? null, ["overlaid", "over"]),
    ]);
    names.forEach((n, i) => this.program.setTable(n, solution.tables[n].format, numbers[i]));
    for (const [name, { texture }] of Object.entries(solution.tables)) {
      if (texture) this.program.takeTexture(name, texture);
    }
    for (const [name, value] of Object.entries(solution.uniforms)) this.program.set(name, value);
    if (this.fixed.marched) this.program.setAll({ separated_1: -1, separated_2: -1 });
    const decked = Number(solution.uniforms.decked > 0);
    const mapped = Number(solution.ground !== null);
    this.program.setAll({ mapped: mapped * (1 - decked), decked: mapped * decked });
    if (!this.laws) this.takeLaw(EVEN);
    this.planet = solution;
    this.solutions += 1;
  }

  /** Upload the limb darkening of the second light, if it has changed. */
  takeLaw(law) {
    const key = law.join();
    if (key !== this.laws) this.program.setTable("disc_2", DISC_FORMAT, law);
    this.laws = key;
  }

  /** Upload the ground map or overlay, if it has changed. */
  async takeMap(texture, map, [present, prefix]) {
    const image = map && map.image + (map.water ?? "");
    if (this.maps[texture] === image) return;
    const { texels, size } = await groundTexels(map);
    const [rows, columns, levels] = ["rows", "columns", "levels"].map((n) => `${prefix}_${n}`);
    this.maps[texture] = image;
    this.program.setTable(texture, PACKED_FORMAT, texels);
    this.program.setAll({
      [present]: Number(map !== null),
      [rows]: size[0],
      [columns]: size[1],
      [levels]: size[2],
    });
  }

  /**
   * Render and display on the canvas.
   *
   * The promise resolves directly after the last pass, so that the canvas can be copied then.
   *
   * @param {Object<string, number | string | boolean>} values Values of all parameters, by path.
   * @param {number} width Width of the canvas. [pixel]
   * @param {number} height Height of the canvas. [pixel]
   * @param {string} effort `moving`: at once; `resting`: within a time limit; `best`: unlimited.
   * @param {boolean} held Whether the automatic exposure is locked.
   * @param {{strips: number, stopped: () => boolean}} [slow] Number of strips, after each of which
   *     the frame may be stopped.
   * @returns {Promise<boolean | null>} Whether a finer frame is possible at rest, or the exposure
   *     still adapts; null if it was stopped.
   */
  async display(values, width, height, effort, held = false, slow = { strips: 1 }) {
    const { program, fixed } = this;
    const lights = this.lightsOf(values);
    this.rests = effort !== "moving";
    await this.fillSkyView(lights, effort);
    let exposure = values["display.exposure"];
    let eases = false;
    if (values["display.automatic"]) {
      const measured = await this.found(lights, width, height);
      // Eased, an edited planet would be shown too bright or too dark first.
      const atOnce = effort === "best" || this.exposed !== this.solutions;
      this.exposed = this.solutions;
      const adapted = this.adaptation.towards(measured, held, atOnce);
      exposure += adapted;
      eases = !held && adapted !== measured;
    }
    this.exposure = exposure;
    if (!(await this.renderLight(lights, width, height, slow))) return null;
    this.renderGlare(lights[0].camera, width, height, values["display.glare"]);
    program.setAll({
      ...fixed.display,
      ...this.viewUniforms(values),
      ...(await this.whiteUniforms(values, lights, width, height, 2 ** exposure)),
      exposure: 2 ** exposure,
      primaries: fixed.primaries.indexOf(this.device.space),
    });
    this.device.resize(width, height);
    program.run("display");
    return eases || this.texels(this.shapeFor("resting")) > this.texels(this.shape);
  }

  /** Lights of a view, each with the uniforms of its sky-view LUT. */
  lightsOf(values) {
    const { fixed, planet } = this;
    this.values = values;
    const orders = fixed.orders[values["light.orders"]];
    return lightsOf(values, planet, fixed.projections).map((light) => {
      const seen = { ...planet, star: light.star };
      const least = light.camera.detailed ? LEAST_HEIGHT : 0;
      const altitude = Math.max(values["view.altitude"], least);
      const numbers = observerUniforms(seen, altitude, light.camera.sun);
      numbers.disc *= disc_factor(light.left);
      numbers.draws_disc = Number(numbers.disc > 0);
      return { ...light, numbers: { ...light.numbers, ...numbers, orders } };
    });
  }

  /** Render linear radiance, unless only the display has changed; false if it was stopped. */
  async renderLight(lights, width, height, { strips, stopped }) {
    const numbers = lights.map((light) => this.uniformsOf(light, width, height));
    const stars = await this.starsBehind(lights, width, height);
    this.backdrops.set("picture", stars);
    const behind = stars?.key ?? "";
    const rendered = JSON.stringify([this.skyViews, this.shape, this.laws, behind, numbers]);
    if (rendered === this.rendered) return true;
    this.rendered = "";
    this.program.set("first_row", 0);
    this.program.set("first_column", 0);
    for (let k = 0; k < strips; k++) {
      const [top, end] = [k, k + 1].map((n) => Math.round((n * height) / strips));
      this.sum("picture", numbers, width, height, strips > 1 ? [0, top, width, end - top] : null);
      if (k + 1 === strips) break;
      await this.device.finished();
      if (stopped()) return false;
    }
    if (stars) this.coverStars(stars, numbers[0], width, height);
    this.rendered = rendered;
    return true;
  }

  /** The star catalogue behind the picture, which appears when a dark view rests; else null. */
  async starsBehind(lights, width, height) {
    if (!this.rests || !StarLayers.visible(this.exposure, lights[0].camera)) return null;
    const { star_sky: sky, projections } = this.fixed;
    if (!this.stars && sky) {
      await this.program.build(() => {}, (one) => LATER.includes(one));
      this.stars = await StarLayers.make(this.device, sky, Object.keys(projections));
    }
    return this.stars && this.putStars("picture", lights, width, height);
  }

  /** Render the star catalogue and the Milky Way for a target; see `StarLayers.put`. */
  putStars(name, [{ camera, suns }], width, height) {
    const { projection, fieldOfView, filter, axes } = camera;
    const altitude = this.values["view.altitude"];
    const { frame, sun } = skyFrame(this.values, this.fixed.star_sky.years);
    const world = axes.map((axis) => combined(frame, axis));
    const view = { projection, fieldOfView, filter, world, sun, altitude, suns };
    const hidden = (one) => suns.some(([towards, radius]) => dot(one, towards) > Math.cos(radius));
    return this.stars.put(name, width, height, view, (true_) => {
      const here = along(frame, true_);
      return hidden(here) ? null : combined(frame, raised(this.planet, altitude, here));
    });
  }

  /** Put the picture in front of the stars. */
  coverStars({ texture }, numbers, width, height) {
    const { program } = this;
    const [through, front] = ["layer_through", "layer_layered"];
    for (const name of [through, front]) program.resize(name, width, height);
    program.setAll(numbers);
    program.run("through");
    const [level, coarser, into] = ["picture", through, front].map((n) => program.textures.get(n));
    program.runIn("layered", null, { picture: texture, level, coarser }, [into]);
    program.textures.set("picture", into).set(front, level);
  }

  /** Uniforms of a frame of one light. */
  uniformsOf({ camera, numbers }, width, height) {
    return {
      ...numbers,
      ...cameraUniforms(camera, width, height, this.fixed.projections),
      ...detailUniforms(this.planet, camera),
    };
  }

  /** Render the sum over lights into a target or an area of it. */
  sum(name, numbers, width, height, area = null) {
    const { program } = this;
    program.resize(name, width, height);
    if (numbers.length === 1) {
      program.setAll(numbers[0]);
      program.runIn(name, area);
      return;
    }
    numbers.forEach((one, i) => {
      const part = `${name}_${i + 1}`;
      program.resize(part, width, height);
      program.setAll(one);
      program.runIn(part, area);
    });
    program.runIn(`${name}_sum`, area);
  }

  /** Render the glare pyramid, unless it is up to date: see image/glare.py. */
  renderGlare({ projection, fieldOfView }, width, height, amount) {
    const { program } = this;
    const connected = CONNECTED.includes(projection);
    const angle = connected ? PIXEL_ANGLES[projection](width, height, fieldOfView) : 0;
    const shorter = Math.min(width, height);
    const count = amount > 0 ? glare_levels(angle, shorter) : 0;
    const shares = Array.from({ length: count }, (_, i) => glare_share(i + 1, angle, shorter));
    program.set("circle", Number(CIRCULAR.includes(projection)));
    program.set("glare_total", shares.reduce((sum, one) => sum + one, 0));
    if (count === 0 || this.spread === this.rendered) return;
    let [wide, high] = [width, height];
    for (let level = 1; level <= count; level++) {
      [wide, high] = [Math.ceil(wide / 2), Math.ceil(high / 2)];
      program.resize(`level_${level}`, wide, high);
      program.resize(`spread_${level}`, wide, high);
      program.run(`coarser_${level}`);
    }
    for (let level = count; level > 0; level--) {
      program.setAll({ level_share: shares[level - 1], level_more: Number(level < count) });
      program.run(`spread_${level}`);
    }
    this.spread = this.rendered;
  }

  /** Fill the sky-view LUTs of the lights, unless they are up to date. */
  async fillSkyView(lights, effort) {
    const { program, fixed, planet } = this;
    const peaks = !fixed.marched && planet.uniforms.separated_1 >= 0;
    const keys = lights.map((light) => (light.air ? this.skyViewKey(light) : ""));
    const shape = this.shapeFor(effort);
    if (lights.length > 1) this.takeLaw(lights[1].law ?? EVEN);
    const stale = keys.some((key, i) => key && key !== this.skyViews[i]);
    if (!stale && this.texels(this.shape) >= this.texels(shape)) return;
    if (shape !== this.shape) this.skyViews = ["", ""];
    this.shape = shape;
    const [columns, rows] = fixed.sky[shape];
    program.setAll({ separated_phases: Number(peaks), sky_columns: columns, sky_rows: rows });
    if (fixed.marched && !planet.uniforms.wet) {
      this.skyViews = keys;
      return;
    }
    const began = performance.now();
    let rendered = 0;
    lights.forEach((light, i) => {
      if (!keys[i] || keys[i] === this.skyViews[i]) return;
      const suffix = i ? "_2" : "";
      for (const name of fixed.layers) {
        program.resize(name + suffix, ROW, Math.ceil((3 * columns * rows) / ROW));
      }
      program.setAll(light.numbers);
      program.run(
        `sky_air${suffix}`,
        ...(peaks ? [`sky_peaks${suffix}`] : []),
        ...(light.camera.filter ? [`sky_polarised${suffix}`] : []),
        ...(planet.uniforms.wet ? [`sky_mirrored${suffix}`] : []),
      );
      this.skyViews[i] = keys[i];
      rendered += 1;
    });
    // The time is measured occasionally on a GPU, always on a software GPU.
    if (rendered && (this.renderings++ % 16 === 0 || this.texelTime > SLOW)) {
      await this.device.finished();
      const time = (performance.now() - began) / this.texels(shape) / rendered;
      // The first time includes the driver's compilation.
      this.texelTime = this.renderings > 1 ? time : SLOW;
    }
  }

  /** Largest sky-view LUT within the time limit; the smallest for the first frame. */
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

  /** Uniforms that are view values, by name. */
  viewUniforms(values) {
    const numbers = {};
    for (const [name, { path, options }] of Object.entries(this.fixed.view_uniforms)) {
      numbers[name] = options.length ? options.indexOf(values[path]) : Number(values[path]);
    }
    return numbers;
  }

  /** Uniforms of the white balance: `DisplaySettings.display` in Python. */
  async whiteUniforms(values, lights, width, height, factor) {
    const { fixed, planet } = this;
    const name = values["display.white_balance"];
    let mean = [0, 0];
    if (name === "scene") {
      mean = sceneWhite(await this.metered(lights, width, height), factor, fixed.xyz);
    }
    const which = fixed.white_balances.indexOf(name);
    const kelvin = values["display.white_temperature"];
    const whites = [...planet.star_white, ...mean];
    const [long, medium, short] = white_gains(which, kelvin, ...whites, factor);
    return { gain_long: long, gain_medium: medium, gain_short: short };
  }

  /** Key of the sky-view LUT of a light. */
  skyViewKey({ numbers, camera }) {
    return JSON.stringify([this.solutions, numbers, Boolean(camera.filter)]);
  }

  /**
   * Luminance, chromaticity and polarisation of a pixel, as text.
   *
   * @param {Object<string, number | string | boolean>} values Values of all parameters, by path.
   * @param {[number, number]} size Size of the displayed picture. [pixel]
   * @param {[number, number]} place Position of the pixel, from the left and the top. [pixel]
   * @returns {Promise<string>} Text; empty if the view is not rendered yet.
   */
  async probe(values, size, place) {
    const { program, fixed } = this;
    const lights = this.lightsOf(values);
    if (lights.some((one, i) => one.air && this.skyViews[i] !== this.skyViewKey(one))) return "";
    const area = [...place, 1, 1];
    const elements = lights[0].camera.filter ? [NONE, ALONG, ASLANT] : [NONE];
    const found = [];
    for (const filter of elements) {
      const numbers = lights.map((one) => ({
        ...this.uniformsOf(one, ...size),
        dehaze: 0,
        filter,
      }));
      this.sum("metering", numbers, ...size, area);
      found.push(await program.read("metering", area));
    }
    return probeText(found, fixed);
  }

  /** Size of a metered frame. [pixel] */
  meteredSize(width, height) {
    const share = this.fixed.metering / Math.max(width, height);
    return [width, height].map((x) => Math.max(1, Math.round(x * share)));
  }

  /** Linear sRGB of a small frame, four values per pixel, with other uniforms. [W m⁻² sr⁻¹] */
  async metered(lights, width, height, others = {}) {
    const [wide, high] = this.meteredSize(width, height);
    const numbers = lights.map((one) => ({ ...this.uniformsOf(one, wide, high), ...others }));
    this.sum("metering", numbers, wide, high);
    return this.program.read("metering");
  }

  /** Automatic exposure of the view. [EV] */
  async found(lights, width, height) {
    const { fixed, planet } = this;
    const [wide, high] = this.meteredSize(width, height);
    // A polariser is left out: see unfiltered in scene/metering.py.
    const rgba = await this.metered(lights, width, height, { filter: NONE });
    const { camera, suns, numbers } = lights[0];
    const number = Object.keys(fixed.projections).indexOf(camera.projection);
    const colors = [planet.uniforms, ...lights.slice(1).map((one) => one.numbers)];
    const white = colors.reduce((sum, one) => sum + whiteOf(one), 0);
    const seen = { ...camera, suns };
    const found = automaticExposure(rgba, [wide, high], seen, number, planet.star, white);
    const { sun_z: sun, optical_altitude: altitude } = numbers;
    const exposure = dehazed_exposure(found, white, sun, camera.dehaze, altitude);
    return exposure + (camera.filter ? fixed.filter_exposure : 0);
  }
}
