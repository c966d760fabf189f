/** Readout of the pixel under the pointer. */

/** Shortest time between readouts. [ms] */
const PAUSE = 100;

export class Probe {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {HTMLElement} place Element that shows the text.
   * @param {object} viewer Viewer with `state`, `picture.probe`, and optionally `source.probe`.
   */
  constructor(canvas, place, viewer) {
    this.place = place;
    this.viewer = viewer;
    this.pointed = null;
    this.busy = false;
    this.ending = new AbortController();
    const { signal } = this.ending;
    canvas.addEventListener("pointermove", (event) => this.point(event), { signal });
    canvas.addEventListener("pointerleave", () => this.leave(), { signal });
    this.stop = viewer.state.subscribe(() => this.ask());
  }

  point(event) {
    const box = event.currentTarget.getBoundingClientRect();
    const shares = [
      (event.clientX - box.left) / box.width,
      (event.clientY - box.top) / box.height,
    ];
    this.pointed = shares.map((share) => Math.min(Math.max(share, 0), 0.9999));
    this.ask();
  }

  leave() {
    this.pointed = null;
    this.place.textContent = "";
  }

  async ask() {
    if (this.busy || !this.pointed) return;
    this.busy = true;
    const asked = this.pointed;
    try {
      await this.viewer.loop.settled();
      const { drawn, state, picture, closed } = this.viewer;
      if (closed || !drawn) return;
      const place = asked.map((share, i) => Math.min(Math.floor(share * drawn[i]), drawn[i] - 1));
      const text = await this.viewer.alone(() => picture.probe(state.values, drawn, place));
      if (this.pointed) this.place.textContent = text;
      await new Promise((resolve) => setTimeout(resolve, PAUSE));
    } finally {
      this.busy = false;
    }
    if (this.pointed && this.pointed !== asked) this.ask();
  }

  close() {
    this.ending.abort();
    this.stop();
  }
}
