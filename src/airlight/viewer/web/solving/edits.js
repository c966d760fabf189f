/** Solver loop of the page: solves after each edit; the newest edit wins. */
import { editOf, editedAir, isPlain } from "./edited_air.js";
import { editedPicture } from "./edited_picture.js";
import { Solver } from "./solver.js";

/** Paths whose change needs a new solution. */
const SOLVED = /^air\./;

export class Edits {
  /**
   * @param {object} viewer Viewer with `device`, `state`, `take` and `say`.
   * @param {object} description Description of the solver, see solver.js.
   * @param {object} plain Picture of the unedited planet, see drawing/picture.js.
   */
  constructor(viewer, description, plain) {
    this.viewer = viewer;
    this.description = description;
    this.plain = plain;
    this.solver = null;
    this.wanted = editOf(description.air, viewer.state);
    this.shown = null;
    this.work = null;
    this.text = "";
    this.progress = "";
    this.stop = viewer.state.subscribe((changed) => {
      if ([...changed].some((path) => SOLVED.test(path))) this.follow();
    });
    if (!isPlain(this.wanted)) this.follow();
  }

  follow() {
    this.wanted = editOf(this.description.air, this.viewer.state);
    this.work ??= this.solve().finally(() => {
      this.work = null;
      this.viewer.showWork();
    });
  }

  /** Status while the frame is outdated; empty otherwise. */
  get stale() {
    return this.shown !== this.wanted && this.work ? `solving${this.progress} …` : "";
  }

  /** Promise that the frame is up to date. */
  async settled() {
    await this.work;
  }

  async solve() {
    while (this.shown !== this.wanted) {
      const edit = this.wanted;
      try {
        this.viewer.say("");
        await this.show(edit);
      } catch (error) {
        this.viewer.say(error.message);
      }
      this.shown = edit;
    }
  }

  async show(edit) {
    const { viewer, description, plain } = this;
    this.text = this.progress = "";
    if (isPlain(edit)) return viewer.take(plain);
    const air = editedAir(description.air, edit);
    this.text = "solving";
    viewer.showStatus();
    const began = performance.now();
    this.solver ??= await Solver.make(viewer.device, description, plain);
    const stale = () => edit !== this.wanted || viewer.closed;
    const light = await this.solver.light(air, stale, (share) => {
      this.progress = progressText(share, performance.now() - began);
      viewer.showWork();
    });
    if (!light) return;
    const percent = Number((100 * this.solver.iteration.remainingError).toPrecision(1));
    const seconds = ((performance.now() - began) / 1000).toPrecision(2);
    this.text = `solved in ${seconds} s, within ${percent} %`;
    await viewer.take(await editedPicture(plain, this.solver, air, light, edit.ground));
  }

  /** Short status of the solution. */
  status() {
    return this.text;
  }

  close() {
    this.stop();
  }
}

/** Progress, and estimated time left. [ms] */
function progressText(share, elapsed) {
  if (share >= 1) return " and rendering";
  const left = (elapsed / 1000) * (1 / share - 1);
  return `, ${Math.round(100 * share)} %${left >= 1 ? `, about ${Math.round(left)} s left` : ""}`;
}
