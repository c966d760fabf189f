/** Mouse, wheel and touch input on the picture. */
import { KEYS } from "../generated/keys.js";

const { rates: RATES, factors: FACTORS } = KEYS;
/** Pixels per line and per page of a wheel event. */
const LINE = 30;
const SHEET = 300;
/** Largest number of notches of one wheel event. */
const MOST_NOTCHES = 6;
/** Movement of a finger below which a touch is a tap. [pixel] */
const FINGER = 10;

export class Pointer {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Flight} flight
   * @param {(x: number, y: number) => void} click Called with the place of a click. [pixel]
   */
  constructor(canvas, flight, click) {
    this.canvas = canvas;
    this.flight = flight;
    this.click = click;
    this.pressed = null; // where the only finger or button is down, until it moves
    this.points = new Map();
    this.movesSun = false;
    this.ending = new AbortController();
    const listen = (name, act, more = {}) =>
      canvas.addEventListener(name, act, { signal: this.ending.signal, ...more });
    listen("pointerdown", (event) => this.press(event));
    listen("pointermove", (event) => this.move(event));
    listen("pointerup", (event) => {
      this.move(event); // the last movement of a flick arrives with its release
      const clicked = this.pressed && !this.movesSun;
      this.lift(event);
      if (clicked) this.click(event.clientX, event.clientY);
    });
    listen("pointercancel", (event) => this.lift(event));
    listen("wheel", (event) => this.wheel(event), { passive: false });
    listen("contextmenu", (event) => event.preventDefault());
  }

  press(event) {
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
    this.points.set(event.pointerId, [event.clientX, event.clientY]);
    const single = this.points.size === 1 && event.button === 0;
    this.pressed = single ? [event.clientX, event.clientY] : null;
    this.movesSun = event.shiftKey || event.ctrlKey || event.button === 2;
  }

  move(event) {
    const before = this.points.get(event.pointerId);
    if (!before) return;
    const others = [...this.points].filter(([id]) => id !== event.pointerId);
    const here = [event.clientX, event.clientY];
    this.points.set(event.pointerId, here);
    if (this.pressed) {
      const far = Math.hypot(here[0] - this.pressed[0], here[1] - this.pressed[1]);
      if (far >= (event.pointerType === "touch" ? FINGER : RATES.click)) this.pressed = null;
    }
    if (others.length) {
      const [, other] = others[0];
      const spread = (point) => Math.hypot(point[0] - other[0], point[1] - other[1]);
      const factor = Math.max(spread(before), 1) / Math.max(spread(here), 1);
      this.flight.rise(Math.log(factor) / Math.log(RATES.climb), true);
      return;
    }
    const parts = here.map((x, i) => (x - before[i]) / this.canvas.clientWidth);
    if (this.movesSun) this.flight.dragSun(...parts);
    else this.flight.look(...parts);
  }

  lift(event) {
    this.pressed = null;
    if (this.points.delete(event.pointerId)) this.flight.state.rest();
  }

  wheel(event) {
    event.preventDefault();
    // With Shift a browser may report horizontal scrolling.
    const turned = event.deltaY || event.deltaX;
    const pixels = turned * (event.deltaMode === 1 ? LINE : event.deltaMode === 2 ? SHEET : 1);
    const notches = Math.min(Math.max(pixels / RATES.wheel, -MOST_NOTCHES), MOST_NOTCHES);
    if (event.ctrlKey) this.flight.widen(notches);
    else {
      const { shift, alt } = FACTORS;
      this.flight.rise(notches * (event.shiftKey ? shift : 1) * (event.altKey ? alt : 1));
    }
  }

  close() {
    this.ending.abort();
  }
}
