/**
 * Viewer: panel, picture and flight on one state, in any element of a page.
 *
 * A *source* provides the contents:
 *
 * - `title`;
 * - `parameters` and `values`, declared and initial, or a `state` that has them;
 * - `picture(device, onProgress)` — promise of the renderer, see drawing/picture.js, which tells how many
 *   of its shaders are compiled;
 * - `first` — optional image that is shown until the first picture is drawn;
 * - `edits(viewer)` — optional solver of the planet after edits, see solving/edits.js;
 * - `radius()` — radius of the planet; [m]
 * - `status()` — optional short status of the solution;
 * - `stale()` — optional words while the picture shows another planet than the controls, or none;
 * - `link(fragment)` — optional address that shows the state again;
 * - `body` — world whose sky the planet has, where no parameter says it;
 * - `space` — optional scene of several bodies, see drawing/scene_space.js;
 * - `lost(reason)` — optional replacement of a lost device;
 * - `note` — optional line about parameters that cannot be edited here;
 * - `device` — auto, webgpu, webgl2, or a name of `devices`;
 * - `devices` — optional further devices, see devices/device.js.
 */
import { openDevice } from "../devices/device.js";
import { fitting } from "../drawing/view.js";
import { KEYS } from "../generated/keys.js";
import { timeText } from "../state/number_text.js";
import { State } from "../state/state.js";
import { BUTTONS, MENU, actionsOf } from "./actions.js";
import { copyByHand } from "./clipboard.js";
import { Controls } from "./controls.js";
import { element } from "./element.js";
import { Film } from "./film.js";
import { Flight } from "./flight.js";
import { FrameLoop, painted } from "./frame_loop.js";
import { FrameScale } from "./frame_scale.js";
import { helpPanel } from "./help_panel.js";
import { Keyboard } from "./keyboard.js";
import { Pointer } from "./pointer.js";
import { Probe } from "./probe.js";
import { searchField } from "./search.js";
import { toolbar } from "./toolbar.js";

/** Delay from the last change to a full-size frame after a smaller one. [ms] */
const REST = 150;
/** Time for which is said what was done. [ms] */
const FLASH = 5000;
/** Time after which the preview has faded. [ms] */
const FADING = 600;

export class Viewer {
  /**
   * Show a source in an element.
   *
   * @param {HTMLElement} place Parent element, whose children are replaced.
   * @param {object} source
   */
  constructor(place, source) {
    this.source = source;
    const { parameters, values, body, space } = source;
    this.state = source.state ?? new State(parameters, values, body, space);
    this.flight = new Flight(this.state, () => this.request(), () => source.radius());
    this.build(place);
    const { root, canvas, tools, controls } = this.parts;
    this.actions = actionsOf(this);
    this.updateTools = toolbar(tools, BUTTONS, MENU, this);
    this.controls = new Controls(controls, this.state, (text) => this.explain(text));
    this.turn = Promise.resolve();
    this.loop = new FrameLoop((now) =>
      this.alone(() => this.draw(now)).catch((error) => this.say(error.message)),
    );
    this.listening = [
      new Pointer(canvas, this.flight, (x, y) => this.probe?.pin(x, y)),
      new Keyboard(root, canvas, this.flight, (action) => this.do(action)),
    ];
    this.device = null;
    this.picture = null;
    this.edits = null;
    this.film = null;
    this.scale = new FrameScale();
    this.lastChange = -Infinity;
    this.milliseconds = 0;
    this.closed = false;
    this.listening.push({ close: this.state.subscribe(() => this.changed()) });
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
      destinations: part("select", "destinations", { ariaLabel: "view or place to go to" }),
      search: searchField((words) => this.controls.search(words)),
      controls: part("div", "controls"),
      note: part("div", "note", { textContent: this.source.note ?? "" }),
      status: part("div", "status"),
      canvas: element("canvas", { tabIndex: 0, ariaLabel: "picture" }),
      message: element("div", { className: "airlight-over airlight-message" }),
      done: element("div", { className: "airlight-over airlight-done", role: "status" }),
      working: element("div", { className: "airlight-over airlight-working", hidden: true }),
      fold: element("button", {
        type: "button",
        className: "airlight-fold",
        textContent: "☰",
        title: "Hide or show the panel (Tab).",
        ariaLabel: "panel",
      }),
      probe: element("div", { className: "airlight-over airlight-probe" }),
      progress: element("div", {
        className: "airlight-over airlight-progress",
        textContent: "preview — loading",
      }),
      help: helpPanel(),
    };
    const panel = part("div", "panel");
    const { title, tools, destinations, search, controls, note, status } = parts;
    panel.append(title, tools, destinations, search, controls, note, status);
    destinations.addEventListener("change", () => {
      this.goTo(destinations.value);
      destinations.value = "";
    });
    parts.fold.addEventListener("click", () => this.do("panels"));
    parts.view = part("div", "view");
    const { canvas, probe, help, message, done, working, progress, fold } = parts;
    parts.view.append(canvas);
    if (this.source.first) parts.view.append(this.source.first);
    parts.view.append(progress, probe, working, help, message, done, fold);
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

  /** Named places of the planet's world: name, latitude, longitude. [deg] */
  get places() {
    return KEYS.places[this.state.body] ?? [];
  }

  /** List the viewpoints, and the places of the planet's world. */
  showDestinations() {
    const option = (value, text, title = "") => element("option", { value, title }, text);
    const group = (label, ...options) =>
      options.length ? [element("optgroup", { label }, ...options)] : [];
    this.parts.destinations.replaceChildren(
      element("option", { value: "", hidden: true }, "go to …"),
      ...group(
        "view",
        ...this.viewpoints.map(({ name, sentence }, i) =>
          option(`viewpoint ${i + 1}`, `${name}: ${sentence}`),
        ),
      ),
      ...group("place", ...this.places.map(([name]) => option(name, name))),
    );
    this.parts.destinations.value = "";
  }

  /** Go to a viewpoint, or to a place under the same view. */
  goTo(destination) {
    const place = this.places.find(([name]) => name === destination);
    if (!place) return this.do(destination);
    this.flight.goTo({ view: { "view.latitude": place[1], "view.longitude": place[2] } });
  }

  async start() {
    try {
      await painted();
      this.device = await openDevice(this.parts.canvas, this.source.device ?? "auto", this.source.devices);
      if (this.closed) return this.device.close();
      this.device.lost.then((reason) => {
        if (this.closed) return;
        if (this.source.lost) this.source.lost(reason);
        else this.say(`the GPU was lost (${reason}): reload`);
      });
      this.picture = await this.source.picture(this.device, (done, total) =>
        this.prepare(`compiling shaders ${done} of ${total}`),
      );
      this.prepare("rendering");
      this.edits = this.source.edits?.(this) ?? null;
      this.showWork();
      this.showDestinations();
      if (this.picture.probe) this.probe = new Probe(this.parts.canvas, this.parts.probe, this);
      this.request();
    } catch (error) {
      this.say(error.message);
    }
  }

  /** Say what is done before the first picture. */
  prepare(text) {
    this.parts.progress.textContent = `preview — ${text}`;
  }

  /** Fade from the preview to the first picture. */
  reveal() {
    const { view, progress } = this.parts;
    view.classList.add("airlight-drawn");
    setTimeout(() => {
      this.source.first?.remove();
      progress.remove();
    }, FADING);
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
    this.probe?.ask();
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
    this.showWork();
    this.request();
  }

  /** Mark a picture of a planet that is not the one whose values are shown. */
  showWork() {
    const { working } = this.parts;
    const what = this.edits?.stale ?? this.source.stale?.() ?? "";
    const side = what && this.state.hasOther ? `${this.state.showing}: ` : "";
    working.textContent = side + (what || (this.flight.planetHidden ? KEYS.lost : ""));
    working.hidden = !working.textContent;
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
    const rests = resting && !moving;
    const share = this.scale.next(rests);
    const [width, height] = this.size(share);
    const began = performance.now();
    const effort = rests ? "resting" : "moving";
    const { values, holdsExposure: held } = this.state;
    const again = await this.picture.display(values, width, height, effort, held, {
      strips: rests ? this.scale.strips(share, height) : 1,
      stopped: () => rests && this.loop.wanted,
    });
    if (again === null) return true;
    this.film?.frame();
    await this.device.finished();
    this.milliseconds = performance.now() - began;
    this.scale.measured(share, this.milliseconds);
    if (!this.drawn) this.reveal();
    this.drawn = [width, height];
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
      const { values, holdsExposure: held } = this.state;
      await this.picture.display(values, width, height, "best", held);
      return new Promise((resolve) => this.parts.canvas.toBlob(resolve, "image/png"));
    });
    this.request();
    return blob;
  }

  async save() {
    const size = this.size(1);
    this.keep(await this.png(...size), "png", size.join(" × "));
  }

  /** Start a film of what is shown, or end it and save it. */
  async toggleFilm() {
    if (!this.film) {
      this.film = new Film(this.parts.canvas);
      this.request();
      this.tell("filming what is shown, until film is pressed again (O)");
      return;
    }
    const film = this.film;
    this.film = null;
    const blob = await film.end();
    this.keep(blob, film.suffix, `${(blob.size / 1e6).toFixed(1)} MB`);
  }

  /** Offer a file for download, named after the planet, and say so. */
  keep(blob, suffix, size) {
    const download = `${this.source.title}.${suffix}`;
    const link = element("a", { href: URL.createObjectURL(blob), download });
    link.click();
    this.tell(`saved as ${download}, ${size}: in the browser's downloads`);
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  /** Copy the address of what is shown. */
  async copyLink() {
    const link = this.source.link(this.state.asFragment());
    try {
      await navigator.clipboard.writeText(link);
    } catch {
      copyByHand(this.parts.root, link);
    }
    this.explain(`copied: ${link}`);
    this.flash("the link is copied: it opens what is shown");
  }

  /** Fill the screen with panel and picture, or return. */
  async toggleFullscreen() {
    if (document.fullscreenElement) await document.exitFullscreen();
    else await this.parts.root.requestFullscreen();
  }

  /** Close what is open, one thing at a time: help, a hidden panel, search, fullscreen. */
  leave() {
    const { help, search, root, canvas } = this.parts;
    const typing = root.contains(document.activeElement) && document.activeElement !== canvas;
    const menu = root.querySelector(".airlight-menu[open]");
    if (!help.hidden) help.hidden = true;
    else if (menu) menu.open = false;
    else if (this.probe?.pinned) this.probe.release();
    else if (root.classList.contains("airlight-hidden")) root.classList.remove("airlight-hidden");
    else if (search.value) {
      search.value = "";
      this.controls.search("");
    } else if (typing) canvas.focus({ preventScroll: true });
    else if (document.fullscreenElement) document.exitFullscreen();
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

  /** Say what was done, in the panel and for some seconds over the picture. */
  tell(text) {
    this.explain(text);
    this.flash(text);
  }

  flash(text) {
    const { done } = this.parts;
    done.textContent = text;
    clearTimeout(this.flashing);
    this.flashing = setTimeout(() => (done.textContent = ""), FLASH);
  }

  /** Show an error; an empty text removes it. */
  say(text) {
    this.parts.message.textContent = text;
  }

  showStatus() {
    if (!this.drawn) return;
    const [width, height] = this.drawn;
    const frame = `${width} × ${height} in ${timeText(this.milliseconds)}`;
    const more = this.edits?.status() ?? this.source.status?.() ?? "";
    this.parts.status.textContent = [more, frame, this.device.kind].filter(Boolean).join(" · ");
    this.parts.status.title = this.device.name;
  }

  close() {
    this.closed = true;
    clearTimeout(this.flashing);
    this.film?.end();
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

function pause(milliseconds) {
  return new Promise((resolve) => setTimeout(resolve, Math.max(0, milliseconds)));
}
