/** Readout of the pixel under the pointer, or of one that was clicked. */
import { element } from "./element.js";

/** Shortest time between readouts. [ms] */
const PAUSE = 100;

export class Probe {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {HTMLElement} place Element that shows the text.
   * @param {object} viewer Viewer with `state`, `picture.probe`, and optionally `source.probe`.
   */
  constructor(canvas, place, viewer) {
    this.canvas = canvas;
    this.place = place;
    this.viewer = viewer;
    this.pointed = null;
    this.pinned = false; // whether a click chose the point
    this.mark = element("div", { className: "airlight-mark", hidden: true });
    canvas.after(this.mark);
    this.busy = this.stale = false;
    this.ending = new AbortController();
    const { signal } = this.ending;
    canvas.addEventListener("pointermove", (event) => this.point(event), { signal });
    canvas.addEventListener("pointerleave", () => this.leave(), { signal });
    place.addEventListener("click", () => this.release(), { signal });
    this.stop = viewer.state.subscribe(() => this.ask());
  }

  point({ clientX, clientY }) {
    if (this.pinned) return;
    const box = this.canvas.getBoundingClientRect();
    const shares = [(clientX - box.left) / box.width, (clientY - box.top) / box.height];
    this.pointed = shares.map((share) => Math.min(Math.max(share, 0), 0.9999));
    this.ask();
  }

  /** Read a point, and go on reading it until `release`. */
  pin(clientX, clientY) {
    this.pinned = false;
    this.point({ clientX, clientY });
    this.pinned = true;
    const [left, top] = this.pointed.map((share) => `${100 * share}%`);
    Object.assign(this.mark.style, { left, top });
    this.mark.hidden = this.place.hidden = false;
    this.place.classList.add("airlight-pinned");
  }

  release() {
    this.pinned = false;
    this.mark.hidden = true;
    this.place.classList.remove("airlight-pinned");
    this.leave();
  }

  leave() {
    if (this.pinned) return;
    this.pointed = null;
    this.place.textContent = "";
  }

  /** Read the point once the picture is at rest; again if asked meanwhile. */
  async ask() {
    this.stale = true;
    if (this.busy) return;
    this.busy = true;
    try {
      while (this.stale && this.pointed) {
        this.stale = false;
        await this.read(this.pointed);
        await new Promise((resolve) => setTimeout(resolve, PAUSE));
      }
    } finally {
      this.busy = false;
    }
  }

  async read(asked) {
    await this.viewer.loop.settled();
    const { drawn, state, picture, closed } = this.viewer;
    if (closed || !drawn) return;
    const place = asked.map((share, i) => Math.min(Math.floor(share * drawn[i]), drawn[i] - 1));
    const text = await this.viewer.alone(() => picture.probe(state.values, drawn, place));
    if (this.pointed) this.place.textContent = text;
  }

  close() {
    this.ending.abort();
    this.mark.remove();
    this.stop();
  }
}
