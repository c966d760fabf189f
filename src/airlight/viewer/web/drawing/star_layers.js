/** Textures of the stars behind a picture, and the frame of the stars above a planet. */
import { StarSky } from "./star_sky.js";
import { combined, cross, dot, scaled, sum, unit } from "./scene_space.js";
import { PARALLEL, days_of_date, direction_of } from "../generated/formulas.js";
import { DISC_FORMAT } from "../generated/sizes.js";

/** Exposure from which the stars are drawn, as in the window. [EV] */
const STARRY = 3;
const DATE = ["view.year", "view.day", "view.hour"];

export class StarLayers {
  /**
   * @param {object} device See devices/device.js.
   * @param {object} data `star_sky` of viewer/browser/star_sky.py.
   * @param {string[]} projections Names in the order of their numbers.
   */
  static async make(device, data, projections) {
    const layers = new StarLayers();
    Object.assign(layers, { device, projections, sky: await StarSky.make(data) });
    layers.made = new Map();
    return layers;
  }

  /** Whether stars are shown. */
  static visible(exposure, { projection }) {
    return exposure >= STARRY && !PARALLEL.includes(projection);
  }

  /**
   * Stars behind a view: its key and `texture`, rendered if the view has changed.
   *
   * @param {string} name Picture to which they belong.
   * @param {number} width Width. [pixel]
   * @param {number} height Height. [pixel]
   * @param {object} view Argument `camera` of `StarSky.render`, and what else `raised` reads.
   * @param {(true_: number[]) => number[] | null} raised Argument of `StarSky.render`.
   */
  put(name, width, height, view, raised) {
    const key = JSON.stringify([width, height, view]);
    const before = this.made.get(name);
    if (before?.key === key) return before;
    if (before) this.device.release(before.texture);
    const number = this.projections.indexOf(view.projection);
    const texels = this.sky.render(width, height, { ...view, number }, raised);
    const made = { key, texture: this.device.image(DISC_FORMAT, width, height, texels) };
    this.made.set(name, made);
    return made;
  }
}

/**
 * Axes of the observer's frame in that of the J2000 equator, and the direction of the sun there.
 *
 * By the date where the sun follows it; otherwise the sun's declination tells the day, between the
 * northern winter and summer solstice: `horizon_axes_by_sun` in geometry/ephemeris/sky.py.
 *
 * @param {Object<string, number | boolean>} values View values by path.
 * @param {object[]} years `years` of viewer/browser/star_sky.py.
 * @returns {{frame: number[][], sun: number[]}}
 */
export function skyFrame(values, years) {
  const { pole, suns, first, length } = years[Number(Boolean(values["view.clock"]))];
  const here = direction_of(values["view.sun_zenith"], 0);
  const latitude = (values["view.latitude"] * Math.PI) / 180;
  const north = direction_of(90, -values["view.sun_azimuth"]);
  const upright = sum(scaled(north, Math.cos(latitude)), [0, 0, Math.sin(latitude)]);
  const sun = values["view.clock"]
    ? sunAt(suns, (days_of_date(...DATE.map((path) => values[path])) - first) / length)
    : risingSun(suns, pole, dot(upright, here));
  const known = triad(upright, here);
  const wanted = triad(pole, sun);
  const frame = [0, 1, 2].map((i) => combined(wanted, known.map((axis) => axis[i])));
  return { frame, sun };
}

/** Direction of the sun at a part of a year. */
function sunAt(suns, part) {
  const place = (part - Math.floor(part)) * suns.length;
  const before = Math.min(Math.floor(place), suns.length - 1);
  return mixed(suns[before], suns[(before + 1) % suns.length], place - before);
}

/** Direction of the sun with the sine of a declination, in the half of a year in which it rises. */
function risingSun(suns, pole, sine) {
  const height = suns.map((one) => dot(one, pole));
  const count = suns.length;
  let at = height.indexOf(Math.min(...height));
  const next = () => (at + 1) % count;
  while (height[next()] < sine && height[next()] > height[at]) at = next();
  const rise = height[next()] - height[at];
  const share = rise > 0 ? Math.min(Math.max((sine - height[at]) / rise, 0), 1) : 0;
  return mixed(suns[at], suns[next()], share);
}

function mixed(one, other, share) {
  return unit(sum(scaled(one, 1 - share), scaled(other, share)));
}

/** Axes to a pole, to the meridian of a direction, and perpendicular to both. */
function triad(pole, direction) {
  const side = cross(pole, direction);
  const across = Math.hypot(...side) > 1e-9 ? unit(side) : unit(cross(pole, [pole[1], pole[2], pole[0]]));
  return [pole, cross(across, pole), across];
}
