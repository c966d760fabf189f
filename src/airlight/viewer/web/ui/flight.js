/**
 * Controller that turns keys, mouse and wheel into the view, like navigation/flight.py.
 *
 * The formulas are emitted from scene/flight.py and its neighbours, the table of keys from
 * navigation/keys.py.
 */
import {
  angle_dragged,
  angle_flown,
  climbed,
  course_of,
  looked,
  planet_hidden,
  risen,
  sun_at,
  sun_dragged,
  horizon_kept,
  time_of,
  turned,
  turns_planet,
} from "../generated/formulas.js";
import { KEYS } from "../generated/keys.js";

const { held: HELD, factors: FACTORS, rates: RATES } = KEYS;
/** Values changed by flying on a great circle, in the order of `turned`. */
const CARRIED = ["latitude", "longitude", "heading", "sun_zenith", "sun_azimuth"];

/** View values by name. */
function numbers(values, ...names) {
  return names.map((name) => values[`view.${name}`]);
}

/**
 * View values changed by a flight of some time.
 *
 * @param {Object<string, number>} values View values by path.
 * @param {number} right Speed to the right, relative to the usual speed. [1]
 * @param {number} ahead Speed along the line of sight. [1]
 * @param {number} up Speed away from the ground. [1]
 * @param {number} seconds Duration. [s]
 * @param {number} radius Radius of the planet's ground. [m]
 * @returns {Object<string, number>} Values that changed, by path.
 */
export function flown(values, right, ahead, up, seconds, radius) {
  const [altitude, tilt, heading] = numbers(values, "altitude", "look_zenith", "heading");
  const reach = RATES.fly * seconds;
  const higher = climbed(altitude, tilt, ahead, up, reach);
  const changed = ahead === 0 && up === 0 ? {} : lifted(values, higher, radius);
  const angle = angle_flown(altitude, higher, tilt, right, ahead, reach, radius);
  if (angle > 0) Object.assign(changed, carried(values, course_of(tilt, heading, right, ahead), angle));
  return changed;
}

/** Altitude [m], and the tilt that keeps the horizon in the picture. */
function lifted(values, higher, radius) {
  const [altitude, tilt] = numbers(values, "altitude", "look_zenith");
  return { "view.altitude": higher, "view.look_zenith": horizon_kept(tilt, altitude, higher, radius) };
}

/** Position, heading and sun after an angle [rad] of a great circle on a bearing [deg]. */
function carried(values, course, angle) {
  const moved = turned(...numbers(values, ...CARRIED), course, angle);
  return Object.fromEntries(CARRIED.map((name, i) => [`view.${name}`, moved[i]]));
}

export class Flight {
  /**
   * @param {State} state
   * @param {() => void} request Requests frames when a movement starts.
   * @param {() => number} radius Radius of the planet's ground. [m]
   */
  constructor(state, request, radius) {
    this.state = state;
    this.request = request;
    this.radius = radius;
    this.down = new Map();
    this.now = null;
    this.playing = false;
  }

  get moving() {
    return [...this.down.values()].some((name) => name in HELD);
  }

  /**
   * Handle a key press.
   *
   * @param {string} code Code of the key, independent of modifiers.
   * @param {string} key Name of the key.
   * @returns {boolean} Whether the key belongs to the flight.
   */
  press(code, key) {
    const name = key.toLowerCase();
    if (!(name in HELD) && !(name in FACTORS)) return false;
    if (!this.moving) this.now = null;
    if (!this.down.has(code)) this.down.set(code, name);
    this.request();
    return true;
  }

  /** Handle a key release; without a code, of all keys, as when the page loses focus. */
  release(code = null) {
    const moving = this.moving;
    if (code === null) this.down.clear();
    else this.down.delete(code);
    if (moving && !this.moving) this.state.rest();
  }

  /** Start or stop the passage of time. */
  play() {
    this.playing = !this.playing;
    this.now = null;
    this.request();
  }

  /**
   * Advance the movement of keys and time; called before each frame.
   *
   * @param {number} now Time of the frame. [ms]
   * @returns {boolean} Whether something moves, so that another frame is needed.
   */
  advance(now) {
    if (!this.moving && !this.playing) return false;
    const passed = this.now === null ? 1 / 60 : (now - this.now) / 1000;
    const seconds = Math.min(Math.max(passed, 0), RATES.longest_step);
    this.now = now;
    if (this.moving) this.step(seconds);
    if (this.playing) {
      const hours = (seconds * RATES.time) / 3600;
      this.state.take(this.state.later(hours) ?? this.laterToday(hours));
    }
    return true;
  }

  /** Sun some hours later, by local solar time. [h] */
  laterToday(hours) {
    const latitude = this.state.get("view.latitude");
    const [declination, hour] = time_of(latitude, ...this.sun());
    return sunValues(sun_at(latitude, declination, (hour + hours) % 24));
  }

  step(seconds) {
    const names = [...this.down.values()];
    const ways = { right: 0, ahead: 0, up: 0, turn: 0, tilt: 0, widen: 0 };
    for (const name of new Set(names.filter((one) => one in HELD))) {
      const [axis, sign] = HELD[name];
      ways[axis] += sign;
    }
    const factors = new Set(names.filter((one) => one in FACTORS));
    const time = [...factors].reduce((product, one) => product * FACTORS[one], seconds);
    const { values } = this.state;
    const length = Math.hypot(ways.right, ways.ahead, ways.up);
    const changed = length
      ? flown(values, ways.right, ways.ahead, ways.up, time / length, this.radius())
      : {};
    const view = { ...values, ...changed };
    const field = view["view.field_of_view"];
    if (ways.turn || ways.tilt) {
      const angle = RATES.turn * field * time;
      Object.assign(changed, lookedValues(view, ways.turn * angle, ways.tilt * angle));
    }
    if (ways.widen) {
      const factor = Math.exp(ways.widen * RATES.widen * time);
      Object.assign(changed, this.widened(field * factor));
    }
    this.state.set(changed, "keys");
  }

  /** Whether a far planet is outside the picture. */
  get planetHidden() {
    const [tilt, altitude, field] = numbers(
      this.state.values,
      "look_zenith",
      "altitude",
      "field_of_view",
    );
    return planet_hidden(tilt, altitude, this.radius(), field);
  }

  /** Turn the camera, or a planet seen whole, by a drag in fractions of the width. [1] */
  look(right, down) {
    const { values } = this.state;
    const [field, altitude, heading] = numbers(values, "field_of_view", "altitude", "heading");
    if (!turns_planet(altitude, this.radius())) {
      this.state.set(lookedValues(values, -right * field, -down * field), "look");
      return;
    }
    const course = heading + (Math.atan2(-right, down) * 180) / Math.PI;
    const angle = angle_dragged(altitude, this.radius(), field, Math.hypot(right, down));
    this.state.set(carried(values, course, angle), "look");
  }

  /** Move the sun by a mouse drag, in fractions of the picture's width. [1] */
  dragSun(right, down) {
    const field = this.state.get("view.field_of_view");
    this.state.set(sunValues(sun_dragged(...this.sun(), right * field, down * field)), "sun");
  }

  /** Change the altitude by wheel notches, away from the ground if positive. */
  rise(notches, held = false) {
    const { values } = this.state;
    const higher = risen(values["view.altitude"], notches);
    this.state.set(lifted(values, higher, this.radius()), "wheel", held);
  }

  /** Change the field of view by wheel notches, wider if positive. */
  widen(notches) {
    const field = this.state.get("view.field_of_view") * RATES.notch ** notches;
    this.state.set(this.widened(field), "field of view", false);
  }

  widened(field) {
    const { least, most } = this.state.parameters.get("view.field_of_view");
    return { "view.field_of_view": Math.min(Math.max(field, least), most) };
  }

  sun() {
    return numbers(this.state.values, "sun_zenith", "sun_azimuth");
  }

  /** Go to a viewpoint. */
  goTo({ view }) {
    this.state.set(view);
    this.state.rest();
  }
}

function lookedValues(values, right, down) {
  const [tilt, heading] = looked(...numbers(values, "look_zenith", "heading"), right, down);
  return { "view.look_zenith": tilt, "view.heading": heading };
}

function sunValues([zenith, azimuth]) {
  return { "view.sun_zenith": zenith, "view.sun_azimuth": azimuth };
}
