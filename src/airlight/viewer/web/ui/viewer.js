/**
 * Viewer: panel, picture and flight on one state, in any element of a page.
 *
 * A *source* provides the contents:
 *
 * - `title`;
 * - `parameters` and `values`, declared and initial, or a `state` that has them;
 * - `picture(device)` — promise of the renderer, see drawing/picture.js;
 * - `edits(viewer)` — optional solver of the planet after edits, see solving/edits.js;
 * - `radius()` — radius of the planet; [m]
 * - `status()` — optional short status of the solution;
 * - `note` — optional line about parameters that cannot be edited here;
 * - `device` — auto, webgpu or webgl2.
 */
import { openDevice } from "../devices/device.js";
import { fitting } from "../drawing/view.js";
import { KEYS } from "../generated/keys.js";
import { State } from "../state/state.js";
import { BUTTONS, actionsOf } from "./actions.js";
import { Controls, element } from "./controls.js";
import { Flight } from "./flight.js";
import { FrameLoop } from "./frame_loop.js";
import { Keyboard } from "./keyboard.js";
import { Pointer } from "./pointer.js";
import { Probe } from "./probe.js";
import { toolbar } from "./toolbar.js";

/** Time of a frame above which frames are drawn smaller while something moves. [ms] */
const SMOOTH = 40;
/** Delay from the last change to a full-size frame after a smaller one. [ms] */
const REST = 150;
/** Smallest scale of width and height while something moves. [1] */
const COARSEST = 0.2;

export class Viewer {
  /**
   * Show a source in an element.
   *
   * @param {HTMLElement} place Parent element, whose children are replaced.
   * @param {object} source
   */
  constructor(place, source) {
    this.source = source;
    this.state = source.state ?? new State(source.parameters, source.values);
    this.flight = new Flight(this.state, () => this.request(), () => source.radius());
    this.build(place);
    const { root, canvas, tools, controls } = this.parts;
    this.actions = actionsOf(this);
    this.updateTools = toolbar(tools, BUTTONS, this);
    this.controls = new Controls(controls, this.state, (text) => this.explain(text));
    this.turn = Promise.resolve();
    this.loop = new FrameLoop((now) =>
      this.alone(() => this.draw(now)).catch((error) => this.say(error.message)),
    );
    this.listening = [
      new Pointer(canvas, this.flight),
      new Keyboard(root, canvas, this.flight, (action) => this.do(action)),
    ];
    this.device = null;
    this.picture = null;
    this.edits = null;
    this.share = 1;
    this.lastChange = -Infinity;
    this.milliseconds = 0;
    this.closed = false;
    this.state.follow(() => this.changed());
    this.sizes = new ResizeObserver(() => this.request());
    this.sizes.observe(this.parts.view);
    this.ready = this.start();
  }

  build(place) {
    const part = (tag, name, more = {}) =>
      element(tag, { className: `airlight-${name}`, ...more });
    const parts = {
      title: part("div", "title", { textContent: this.source.title }),
      tools: part("div", "tools"),
      viewpoints: part("div", "tools"),
      controls: part("div", "controls"),
      note: part("div", "note", { textContent: this.source.note ?? "" }),
      status: part("div", "status"),
      canvas: element("canvas", { tabIndex: 0, ariaLabel: "picture" }),
      message: element("div", { className: "airlight-over airlight-message" }),
      probe: element("div", { className: "airlight-over airlight-probe" }),
      help: helpPanel(),
    };
    const panel = part("div", "panel");
    const { title, tools, viewpoints, controls, note, status } = parts;
    panel.append(title, tools, viewpoints, controls, note, status);
    parts.view = part("div", "view");
    parts.view.append(parts.canvas, parts.probe, parts.help, parts.message);
    parts.root = element("div", { className: "airlight" }, panel, parts.view);
    // In JupyterLab, single letters are shortcuts that edit cells.
    parts.root.dataset.lmSuppressShortcuts = "true";
    place.replaceChildren(parts.root);
    this.parts = parts;
  }

  /** Perform an action of a button or a key. */
  do(name) {
    this.actions[name]?.();
    this.updateTools();
  }

  /** Viewpoints of the planet that is shown. */
  get viewpoints() {
    return this.picture?.planet.viewpoints ?? [];
  }

  showViewpoints() {
    const buttons = this.viewpoints.map(({ name, sentence }, i) => [
      `viewpoint ${i + 1}`,
      name,
      `${sentence} (${i + 1})`,
      () => ({}),
    ]);
    toolbar(this.parts.viewpoints, buttons, this);
  }

  async start() {
    try {
      this.device = await openDevice(this.parts.canvas, this.source.device ?? "auto");
      if (this.closed) return this.device.close();
      this.device.lost.then((reason) => {
        if (!this.closed) this.say(`the graphics device went away (${reason}): reload`);
      });
      this.picture = await this.source.picture(this.device);
      this.edits = this.source.edits?.(this) ?? null;
      this.showViewpoints();
      if (this.picture.probe) this.probe = new Probe(this.parts.canvas, this.parts.probe, this);
      this.request();
    } catch (error) {
      this.say(error.message);
    }
  }

  /** Replace the parameters, as after a change of a planet's composition. */
  declare(parameters, values) {
    this.state.declare(parameters, values);
    this.controls.build();
  }

  /** Replace the tables, as after an edit of the planet. */
  async take(update) {
    await this.ready;
    if (!this.picture || this.closed) return;
    await this.alone(() => this.picture.take(update));
    this.request();
  }

  retitle(title) {
    this.source.title = title;
    this.parts.title.textContent = title;
  }

  /** Request a frame. */
  request() {
    if (this.picture) this.loop.request();
  }

  changed() {
    this.lastChange = performance.now();
    this.updateTools();
    this.request();
  }

  /**
   * Run a function that needs exclusive use of the device.
   *
   * @template T
   * @param {() => Promise<T>} act
   * @returns {Promise<T>}
   */
  alone(act) {
    const done = this.turn.then(act);
    this.turn = done.catch(() => {});
    return done;
  }

  async draw(now) {
    const moving = this.flight.advance(now);
    const resting = performance.now() - this.lastChange > REST;
    const share = resting && !moving ? 1 : this.share;
    const [width, height] = this.size(share);
    this.device.resize(width, height);
    const began = performance.now();
    const effort = resting && !moving ? "resting" : "moving";
    const again = await this.picture.draw(this.state.values, width, height, effort);
    await this.device.finished();
    this.milliseconds = performance.now() - began;
    this.drawn = [width, height];
    // The time of a frame is proportional to its pixels; half a step damps oscillations.
    const wanted = share * Math.sqrt(SMOOTH / Math.max(this.milliseconds, 1));
    this.share = Math.min(Math.max(0.5 * (this.share + wanted), COARSEST), 1);
    this.showStatus();
    if (share < 1 && !moving) await pause(REST - (performance.now() - this.lastChange));
    return moving || share < 1 || (effort === "resting" && again);
  }

  size(share) {
    const { clientWidth, clientHeight } = this.parts.view;
    const dots = share * (window.devicePixelRatio || 1);
    const window_ = [clientWidth, clientHeight].map((x) => Math.max(1, Math.round(x * dots)));
    return fitting(this.state.get("view.projection"), ...window_);
  }

  /**
   * Render a picture of any size.
   *
   * @param {number} width Width. [pixel]
   * @param {number} height Height. [pixel]
   * @returns {Promise<Blob>} PNG file.
   */
  async png(width, height) {
    await this.ready;
    const blob = await this.alone(async () => {
      this.device.resize(width, height);
      await this.picture.draw(this.state.values, width, height, "best");
      return new Promise((resolve) => this.parts.canvas.toBlob(resolve, "image/png"));
    });
    this.request();
    return blob;
  }

  async save() {
    const link = element("a", {
      href: URL.createObjectURL(await this.png(...this.size(1))),
      download: `${this.source.title}.png`,
    });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  /** Promise that the picture shows the state, in full size. */
  async settled() {
    await this.ready;
    await this.edits?.settled();
    await this.loop.settled();
  }

  toggleAdvanced() {
    this.controls.advanced = !this.controls.advanced;
    this.controls.build();
    this.updateTools();
  }

  explain(text) {
    this.parts.note.textContent = text;
  }

  /** Show an error; an empty text removes it. */
  say(text) {
    this.parts.message.textContent = text;
  }

  showStatus() {
    if (!this.drawn) return;
    const [width, height] = this.drawn;
    const frame = `${width}×${height}, ${this.milliseconds.toFixed(0)} ms`;
    const more = this.edits?.status() ?? this.source.status?.() ?? "";
    this.parts.status.textContent = [more, frame, this.device.kind].filter(Boolean).join(" · ");
    this.parts.status.title = this.device.name;
  }

  close() {
    this.closed = true;
    this.loop.close();
    for (const one of this.listening) one.close();
    this.controls.close();
    this.probe?.close();
    this.edits?.close();
    this.sizes.disconnect();
    this.device?.close();
    this.parts.root.remove();
  }
}

/** Help overlay with the table of keys. */
function helpPanel() {
  const groups = KEYS.help.map(([group, lines]) => {
    const rows = lines.map(([keys, text]) =>
      element("tr", {}, element("th", {}, keys), element("td", {}, text)),
    );
    return element("div", {}, element("h3", {}, group), element("table", {}, ...rows));
  });
  const panel = { className: "airlight-over airlight-help", hidden: true };
  return element("div", panel, ...groups);
}

function pause(milliseconds) {
  return new Promise((resolve) => setTimeout(resolve, Math.max(0, milliseconds)));
}
