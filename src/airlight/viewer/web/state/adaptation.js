/** Automatic exposure of a viewer, with the rules of session/adaptation.py. */
import { eased } from "../generated/formulas.js";
import { KEYS } from "../generated/keys.js";

const { adapted: TIME_CONSTANT, brightest: BRIGHTEST } = KEYS.rates;
/** Tolerance of the metered exposure. [EV] */
const REACHED = 0.02;
/** Longest time step of adaptation. [s] */
const LONGEST = 0.1;

export class Adaptation {
  /** @param {() => number} clock Monotonic clock. [s] */
  constructor(clock = () => performance.now() / 1000) {
    this.clock = clock;
    this.before = 0;
    this.exposure = null;
  }

  /**
   * Exposure of the next frame. [EV]
   *
   * @param {number} measured Automatic exposure of the light that it shows. [EV]
   * @param {boolean} held Whether the exposure stays as it is.
   * @param {boolean} atOnce Whether it does not ease, as in a still picture.
   */
  towards(measured, held, atOnce = false) {
    const now = this.clock();
    const since = Math.min(now - this.before, LONGEST);
    this.before = now;
    if (this.exposure === null || (atOnce && !held)) this.exposure = measured;
    else if (!held) {
      const before = Math.min(this.exposure, measured + BRIGHTEST);
      const near = eased(before, measured, since, TIME_CONSTANT);
      this.exposure = Math.abs(near - measured) < REACHED ? measured : near;
    }
    return this.exposure;
  }
}
