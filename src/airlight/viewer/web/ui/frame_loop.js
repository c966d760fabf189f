/** Draws when something has changed, and only then. */

export class FrameLoop {
  /**
   * @param {(now: number) => Promise<boolean>} draw Draws once, waits until it is done, and says
   *     whether another frame must follow.
   */
  constructor(draw) {
    this.draw = draw;
    this.wanted = false;
    this.running = null;
    this.closed = false;
    this.frames = 0;
  }

  /** Something has changed. */
  request() {
    this.wanted = true;
    if (!this.running && !this.closed) {
      this.running = this.run().finally(() => {
        this.running = null;
      });
    }
  }

  async run() {
    while (this.wanted && !this.closed) {
      const now = await nextFrame();
      if (this.closed) return;
      this.wanted = false;
      this.frames += 1;
      if (await this.draw(now)) this.wanted = true;
    }
  }

  /** A promise that nothing is left to draw. */
  async settled() {
    while (this.running) await this.running;
  }

  close() {
    this.closed = true;
  }
}

/** The time of the next frame; hidden pages have none, so that a timer stands in. [ms] */
function nextFrame() {
  return new Promise((resolve) => {
    const timer = setTimeout(() => resolve(performance.now()), 250);
    requestAnimationFrame((now) => {
      clearTimeout(timer);
      resolve(now);
    });
  });
}
