/** Frame loop that draws only after changes. */

export class FrameLoop {
  /**
   * @param {(now: number) => Promise<boolean>} draw Draws one frame, and resolves once it is done
   *     to whether another frame is needed.
   */
  constructor(draw) {
    this.draw = draw;
    this.wanted = false;
    this.running = null;
    this.closed = false;
    this.frames = 0;
  }

  /** Request a frame after a change. */
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

  /** Promise that all requested frames are drawn. */
  async settled() {
    while (this.running) await this.running;
  }

  close() {
    this.closed = true;
  }
}

/** Promise that what the page holds now is on the screen, before work that blocks it. */
export async function painted() {
  await nextFrame();
  await nextFrame();
}

/** Promise of the next frame's time [ms]; hidden pages have no frames, and use a timer. */
function nextFrame() {
  return new Promise((resolve) => {
    const timer = setTimeout(() => resolve(performance.now()), 250);
    requestAnimationFrame((now) => {
      clearTimeout(timer);
      resolve(now);
    });
  });
}
