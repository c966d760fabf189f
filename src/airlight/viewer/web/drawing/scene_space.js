/**
 * Geometry of a scene of several bodies: positions by time, the observer's frame, and the sun above
 * the planet over which the observer flies.
 *
 * A scene is that of viewer/browser/scene_package.py; vectors are in its frame, unless they are
 * *local*: with x horizontally towards a light and z to the zenith, as in scene/directions.py.
 */
import { camera_frame, direction_of } from "../generated/formulas.js";
import { raised } from "./view_uniforms.js";

const DEGREE = 180 / Math.PI;
/** Time of the page, in hours from that of the scene. [h] */
const HOURS = "scene.hours";
/** Aim of a camera, and its largest error while the camera looks at a body. [deg] */
const AIM = ["view.look_zenith", "view.heading", "view.roll"];
const AIMED = 0.05;

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const minus = (a, b) => a.map((x, i) => x - b[i]);
export const scaled = (a, factor) => a.map((x) => factor * x);
export const unit = (a) => scaled(a, 1 / Math.hypot(...a));
/** Components of a vector along the rows of a matrix. */
export const along = (rows, vector) => rows.map((row) => dot(row, vector));
/** Angle between unit vectors, accurate for small angles. [rad] */
export const between = (a, b) => 2 * Math.asin(Math.min(Math.hypot(...minus(a, b)) / 2, 1));

export function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function sum(...vectors) {
  return [0, 1, 2].map((i) => vectors.reduce((total, one) => total + one[i], 0));
}

/** Combination of the rows of a matrix. */
export function combined(rows, [x, y, z]) {
  return sum(scaled(rows[0], x), scaled(rows[1], y), scaled(rows[2], z));
}

/** Local axes as rows: `level_axes` in Python. */
export function levelAxes(up, towards) {
  let flat = minus(towards, scaled(up, dot(towards, up)));
  if (Math.hypot(...flat) < 1e-12) flat = cross(up, Math.abs(up[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]);
  const x = unit(flat);
  return [x, cross(up, x), up];
}

/** Values between two samples, numbers by numbers. */
function mixed(low, high, share) {
  if (typeof low === "number") return low + (high - low) * share;
  if (Array.isArray(low)) return low.map((one, i) => mixed(one, high[i], share));
  if (low === null || typeof low !== "object") return low;
  return Object.fromEntries(Object.keys(low).map((key) => [key, mixed(low[key], high[key], share)]));
}

/** Zenith angle and bearing of a direction in axes to the north, the west and the zenith. [deg] */
function angles([x, y, z]) {
  return [Math.atan2(Math.hypot(x, y), z) * DEGREE, (Math.atan2(-y, x) * DEGREE + 360) % 360];
}

export class SceneSpace {
  /**
   * @param {object} scene From viewer/browser/scene_package.py.
   * @param {object} planet Planet over which the observer flies, see picture.js.
   */
  constructor(scene, planet) {
    this.scene = scene;
    this.planet = planet;
    this.known = [null, null];
  }

  /** Whether bodies move with time. */
  get timed() {
    return this.scene.moments.length > 1;
  }

  /** Radius of the planet over which the observer flies. [m] */
  get radius() {
    return this.scene.bodies[this.scene.home].radius;
  }

  /** Positions, axes and lights at the time of a view. */
  moment(values) {
    const { moments } = this.scene;
    const hours = this.timed ? values[HOURS] : 0;
    if (this.known[0] === hours) return this.known[1];
    const after = moments.findIndex((one) => one.hours >= hours);
    const high = after < 0 ? moments.length - 1 : after;
    const low = Math.max(high - 1, 0);
    const step = moments[high].hours - moments[low].hours;
    const share = step > 0 ? Math.min((hours - moments[low].hours) / step, 1) : 0;
    const found = mixed(moments[low], moments[high], share);
    for (const body of found.bodies) body.axes = body.axes.map(unit);
    this.known = [hours, found];
    return found;
  }

  /**
   * Observer and camera of a view.
   *
   * @param {Object<string, number>} values View values by path.
   * @returns {{moment: object, eye: number[], up: number[], north: number[][], axes: number[][]}}
   *     Position [m], zenith, axes to the north, the west and the zenith, and right, up and forward
   *     of the camera.
   */
  seen(values) {
    const moment = this.moment(values);
    const { centre, axes: body } = moment.bodies[this.scene.home];
    const [latitude, longitude] = [values["view.latitude"], values["view.longitude"]];
    const up = unit(combined(body, direction_of(90 - latitude, -longitude)));
    const eye = sum(centre, scaled(up, this.radius + values["view.altitude"]));
    const level = minus(body[2], scaled(up, dot(body[2], up)));
    const size = Math.hypot(...level);
    const north = size < 1e-9 ? unit(cross(up, [0, 1, 0])) : scaled(level, 1 / size);
    const frame = [north, cross(up, north), up];
    const { "view.look_zenith": tilt, "view.heading": heading, "view.roll": roll } = values;
    const axes = camera_frame(tilt, heading, roll).map((axis) => combined(frame, axis));
    return { moment, eye, up, north: frame, axes };
  }

  /** Direction of a star from a point. */
  towards({ place, towards }, point) {
    return place ? unit(minus(place, point)) : unit(towards);
  }

  /**
   * Changes of a view, with the sun above its place at its time, and a camera that still looks at
   * the body of the scene, unless it has been turned.
   */
  follow(values, changes) {
    const after = { ...values, ...changes };
    const moved = HOURS in changes && !AIM.some((path) => path in changes);
    const aimed = moved && this.isAimed(values) ? this.aim(after) : {};
    const { moment, eye, north } = this.seen(after);
    const [zenith, azimuth] = angles(along(north, this.towards(moment.stars[0], eye)));
    return { ...changes, ...aimed, "view.sun_zenith": zenith, "view.sun_azimuth": azimuth };
  }

  /** Whether the camera looks at the body of the scene. */
  isAimed(values) {
    if (!this.scene.aim) return false;
    const aim = this.aim(values);
    const apart = (path) => Math.abs(((values[path] - aim[path] + 540) % 360) - 180);
    return AIM.every((path) => apart(path) <= AIMED);
  }

  /** Values of a camera that looks at the body of the scene, as `System.camera_axes`. [deg] */
  aim(values) {
    const { body, star, up, roll } = this.scene.aim;
    const { moment, eye, north } = this.seen(values);
    const centre = body === null ? null : moment.bodies[body].centre;
    const true_ = centre ? unit(minus(centre, eye)) : this.towards(moment.stars[star], eye);
    const straight = along(north, true_);
    const forward = body === this.scene.home ? straight : this.raised(values, straight);
    const right = unit(cross(forward, up ? along(north, unit(up)) : [0, 0, 1]));
    const [zenith, heading] = angles(forward);
    const level = direction_of(90, heading + 90);
    const turn = Math.atan2(-dot(right, cross(level, forward)), dot(right, level)) * DEGREE;
    const found = [zenith, heading, (turn + roll + 720) % 360];
    return Object.fromEntries(AIM.map((path, i) => [path, found[i]]));
  }

  /** Apparent direction of a point behind the air of the planet, in axes to north, west, zenith. */
  raised(values, direction) {
    return raised(this.planet, values["view.altitude"], direction);
  }

  /** View some hours later, between the ends of the known time. [h] */
  later(values, hours) {
    if (!this.timed) return {};
    const time = Math.min(values[HOURS] + hours, this.scene.moments.at(-1).hours);
    return this.follow(values, { [HOURS]: time });
  }
}
