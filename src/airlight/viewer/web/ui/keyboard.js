/** Keyboard input: held keys fly, others trigger actions; see navigation/keys.py. */
import { KEYS } from "../generated/keys.js";

/** Keys that move a slider or the focus when the focus is outside the picture. */
const FOCUS = /^(arrow|page|tab|home|end|enter| )/;

export class Keyboard {
  /**
   * @param {HTMLElement} root Root element of the viewer.
   * @param {HTMLCanvasElement} canvas
   * @param {Flight} flight
   * @param {(action: string) => void} act
   */
  constructor(root, canvas, flight, act) {
    this.canvas = canvas;
    this.flight = flight;
    this.act = act;
    this.ending = new AbortController();
    const { signal } = this.ending;
    root.addEventListener("keydown", (event) => this.press(event), { signal });
    root.addEventListener("keyup", (event) => flight.release(event.code), { signal });
    root.addEventListener("focusout", () => flight.release(), { signal });
    addEventListener("blur", () => flight.release(), { signal });
  }

  press(event) {
    const { target, key } = event;
    const control = event.ctrlKey || event.metaKey;
    const types = target.tagName === "INPUT" && /^(text|search)$/.test(target.type);
    if (types && key !== "Escape") return;
    if (target.tagName === "SELECT" && !control) return;
    if (target !== this.canvas && !control && FOCUS.test(key.toLowerCase())) return;
    if (!control && this.flight.press(event.code, key)) return event.preventDefault();
    const words = [control && "Control", event.shiftKey && "Shift"].filter(Boolean);
    const action = KEYS.once[[...words, key.length === 1 ? key.toLowerCase() : key].join("+")];
    if (!action || event.altKey) return;
    event.preventDefault();
    this.act(action);
  }

  close() {
    this.ending.abort();
  }
}
