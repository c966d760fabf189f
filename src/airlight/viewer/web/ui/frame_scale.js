/** Scales of frames: small ones while something moves, finer ones in steps at rest. */

/** Time of a frame above which frames are drawn smaller while something moves. [ms] */
const SMOOTH = 40;
/** Smallest scale of width and height, also of the first frame. [1] */
const COARSEST = 0.2;
/** Time of a full-size frame above which frames at rest get finer in steps [ms], by a factor. */
const PATIENT = 2500;
const STEP = 2.5;
/** Time of a strip of a frame at rest, after which a change is answered. [ms] */
const STRIP = 500;

export class FrameScale {
  constructor() {
    this.moving = COARSEST;
    this.drawn = 0;
    this.milliseconds = 0;
  }

  /** Time of a full-size frame, by that of the last frame. [ms] */
  whole() {
    return this.milliseconds / this.drawn ** 2;
  }

  /** Scale of the next frame. */
  next(rests) {
    if (!rests) return this.drawn ? this.moving : COARSEST;
    if (!this.drawn) return COARSEST;
    return this.whole() < PATIENT ? 1 : Math.min(STEP * this.drawn, 1);
  }

  /** Number of strips of a frame at rest, at most its number of rows. */
  strips(scale, rows) {
    if (!this.drawn) return 1;
    return Math.min(Math.floor((this.whole() * scale ** 2) / STRIP) + 1, rows);
  }

  /** Take the scale and the time of a frame that was drawn. [ms] */
  measured(scale, milliseconds) {
    const first = !this.drawn;
    Object.assign(this, { drawn: scale, milliseconds });
    // The time of a frame is proportional to its pixels; half a step damps oscillations.
    const wanted = Math.sqrt(SMOOTH / Math.max(this.whole(), 1));
    this.moving = Math.min(Math.max(first ? wanted : 0.5 * (this.moving + wanted), COARSEST), 1);
  }
}
