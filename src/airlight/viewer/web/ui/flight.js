/** Mouse, wheel, touch and keys on the picture. */
import { HIGHEST, LOWEST, cameraInPlace, moved } from "./journey.js";
import { wrapped } from "../state/parameters.js";

/** Shown by the help button. */
export const HELP = [
  "drag: look around",
  "shift + drag, or right button: move the sun",
  "wheel, pinch: altitude; with ctrl: field of view",
  "W S A D: fly ahead, back, to the sides",
  "E Q or page keys: rise, sink; faster the higher you are",
  "arrow keys: turn; + and −: field of view",
  "ctrl + Z, ctrl + Y: undo, redo; tab: A/B; H: hide the panel",
  "point at the picture: colour and luminance",
].join("\n");

/** Altitudes a second that keys fly. [s⁻¹] */
const SPEED = 0.9;
/** At least so fast. [m s⁻¹] */
const SLOWEST = 3;
/** Fields of view a second that arrow keys turn. [s⁻¹] */
const TURN = 0.5;
/** Altitude factor of a wheel's pixel, as a logarithm. [pixel⁻¹] */
const WHEEL = 0.0015;
/** Longest time between two frames that counts. [s] */
const LONGEST = 0.1;

const KEYS = {
  w: "ahead", s: "back", a: "left", d: "right", e: "rise", q: "sink",
  pageup: "rise", pagedown: "sink",
  arrowup: "up", arrowdown: "down", arrowleft: "turn left", arrowright: "turn right",
  "+": "nearer", "=": "nearer", "-": "wider",
};

export class Flight {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {State} state
   * @param {() => void} request Called when a key is down, so that frames come.
   * @param {() => number} radius Of the planet. [m]
   */
  constructor(canvas, state, request, radius) {
    this.canvas = canvas;
    this.state = state;
    this.request = request;
    this.radius = radius;
    this.down = new Set();
    this.pointers = new Map();
    this.time = null;
    this.ending = new AbortController();
    const listen = (name, act, more = {}) =>
      canvas.addEventListener(name, act, { signal: this.ending.signal, ...more });
    listen("pointerdown", (event) => this.press(event));
    listen("pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel"]) listen(name, (event) => this.lift(event));
    listen("wheel", (event) => this.wheel(event), { passive: false });
    listen("contextmenu", (event) => event.preventDefault());
    listen("keydown", (event) => this.key(event, true));
    listen("keyup", (event) => this.key(event, false));
    listen("blur", () => this.down.clear());
  }

  /** Values of the view, changed as far as they may be. */
  change(changes, gesture) {
    const sound = {};
    for (const [path, value] of Object.entries(changes)) {
      const parameter = this.state.parameters.get(path);
      if (!parameter) continue;
      const { least, most, wraps } = parameter;
      sound[path] = wraps ? wrapped(value, least, most) : Math.min(Math.max(value, least), most);
    }
    this.state.set(sound, gesture);
  }

  press(event) {
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    this.gesture = `drag ${event.timeStamp}`;
    this.movesSun = event.shiftKey || event.button === 2;
  }

  move(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const others = [...this.pointers].filter(([id]) => id !== event.pointerId);
    const here = [event.clientX, event.clientY];
    this.pointers.set(event.pointerId, here);
    if (others.length) {
      const [, other] = others[0];
      const spread = (point) => Math.hypot(point[0] - other[0], point[1] - other[1]);
      this.climb(spread(before) / Math.max(spread(here), 1), this.gesture);
      return;
    }
    const [dx, dy] = [here[0] - before[0], here[1] - before[1]];
    const { values } = this.state;
    const angle = Math.min(values["view.field_of_view"], 120) / this.canvas.clientWidth;
    if (this.movesSun) {
      this.change(
        {
          "view.sun_azimuth": values["view.sun_azimuth"] + dx * angle,
          "view.sun_zenith": values["view.sun_zenith"] + dy * angle,
        },
        this.gesture,
      );
    } else {
      this.turn(-dx * angle, -dy * angle, this.gesture);
    }
  }

  lift(event) {
    this.pointers.delete(event.pointerId);
    this.state.rest();
  }

  turn(right, down, gesture) {
    const { values } = this.state;
    const flat = Math.max(Math.sin((values["view.look_zenith"] * Math.PI) / 180), 0.2);
    this.change(
      {
        "view.heading": values["view.heading"] + right / flat,
        "view.look_zenith": values["view.look_zenith"] + down,
      },
      gesture,
    );
  }

  climb(factor, gesture) {
    const altitude = Math.max(this.state.get("view.altitude"), LOWEST) * factor;
    this.change({ "view.altitude": Math.min(Math.max(altitude, LOWEST), HIGHEST) }, gesture);
  }

  widen(factor, gesture) {
    const field = this.state.get("view.field_of_view") * factor;
    this.change({ "view.field_of_view": Math.min(Math.max(field, 0.01), 360) }, gesture);
  }

  wheel(event) {
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 30 : event.deltaMode === 2 ? 300 : 1);
    const factor = Math.exp(WHEEL * Math.min(Math.max(pixels, -600), 600));
    if (event.ctrlKey) this.widen(factor, "wheel field");
    else this.climb(factor, "wheel");
  }

  key(event, pressed) {
    const act = KEYS[event.key.toLowerCase()];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    if (pressed && !this.down.has(act)) {
      if (this.down.size === 0) this.time = null;
      this.down.add(act);
      this.gesture = `keys ${event.timeStamp}`;
      this.request();
    } else if (!pressed) {
      this.down.delete(act);
      if (this.down.size === 0) this.state.rest();
    }
  }

  /**
   * Move as the keys say; called before each frame.
   *
   * @param {number} now [ms]
   * @returns {boolean} Whether something moves, so that another frame must follow.
   */
  advance(now) {
    if (this.down.size === 0) return false;
    const seconds = this.time === null ? 1 / 60 : Math.min((now - this.time) / 1000, LONGEST);
    this.time = now;
    const way = (plus, minus) => Number(this.down.has(plus)) - Number(this.down.has(minus));
    const { values } = this.state;
    const { forward, right } = cameraInPlace(values);
    const [ahead, aside, rise] = [way("ahead", "back"), way("right", "left"), way("rise", "sink")];
    const speed = Math.max(values["view.altitude"] * SPEED, SLOWEST) * seconds;
    if (ahead || aside || rise) {
      const step = [0, 1, 2].map((i) => speed * (ahead * forward[i] + aside * right[i]));
      step[2] += speed * rise;
      this.change(moved(values, this.radius(), step), this.gesture);
    }
    const angle = TURN * Math.min(values["view.field_of_view"], 120) * seconds;
    const [turn, tilt] = [way("turn right", "turn left"), way("down", "up")];
    if (turn || tilt) this.turn(turn * angle, tilt * angle, this.gesture);
    const zoom = way("wider", "nearer");
    if (zoom) this.widen(Math.exp(zoom * seconds), this.gesture);
    return true;
  }

  close() {
    this.ending.abort();
  }
}
