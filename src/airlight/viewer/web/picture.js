/**
 * What draws a planet: its tables on the device, and the passes over them.
 *
 * A description, as viewer/package.py makes it, has `plan` and `shaders` (see program.js), `tables`
 * (`{format, data}` by name, see package.js), `uniforms` (values of fields that belong to the
 * planet), `fields_of_view` (limits of each projection), `grey` (luminance that each tone map shows
 * as middle grey), `luminance` (of red, green and blue) and `radius` of the ground. [m]
 */
import { automaticExposure } from "./exposure.js";
import { numbersOf } from "./package.js";
import { Program } from "./program.js";
import { setDisplay, setView } from "./shown_view.js";
import { cameraOf } from "./view.js";

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
    this.description = description;
    this.exposure = 0;
  }

  /** Other tables and values of the planet, as after an edit; those left out stay. */
  async take({ tables = {}, uniforms = {}, radius = this.description.radius }) {
    const names = Object.keys(tables);
    const numbers = await Promise.all(names.map((name) => numbersOf(tables[name].data)));
    names.forEach((name, i) => this.program.setTable(name, tables[name].format, numbers[i]));
    for (const [field, value] of Object.entries(uniforms)) this.program.set(field, value);
    this.description.radius = radius;
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
   * @returns {Promise<boolean>} Whether the picture must be drawn again.
   */
  async draw(values, width, height) {
    const { program, description } = this;
    const camera = cameraOf(values, description.fields_of_view);
    setView(program, camera, values, width, height, description);
    program.run("sky");
    const exposure = values["display.automatic"] ? await this.found(values) : 0;
    setDisplay(program, values, exposure + values["display.exposure"], description);
    program.run("picture");
    return false;
  }

  /** The exposure that suits what is seen. [EV] */
  async found(values) {
    const { program, description } = this;
    program.run("glance");
    const rgba = await program.read("glance");
    const grey = description.grey[values["display.tone_map"]];
    this.exposure = automaticExposure(rgba, grey, description.luminance);
    return this.exposure;
  }
}
