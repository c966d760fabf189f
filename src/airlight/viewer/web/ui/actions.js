/** Actions of buttons and keys, by the names of navigation/keys.py, and the buttons. */
import { KEYS } from "../generated/keys.js";

/**
 * Actions of a viewer.
 *
 * @param {Viewer} viewer
 * @returns {Object<string, () => void>} Actions by name.
 */
export function actionsOf(viewer) {
  const { state, parts, flight } = viewer;
  const expose = (stops) =>
    state.set({ "display.exposure": state.get("display.exposure") + stops });
  const viewpoints = Array.from({ length: 9 }, (_, i) => [
    `viewpoint ${i + 1}`,
    () => viewer.viewpoints[i] && flight.goTo(viewer.viewpoints[i]),
  ]);
  return {
    ...Object.fromEntries(viewpoints),
    home: () => {
      // the whole planet, over the same place and under the same sun
      const planet = viewer.viewpoints.find(({ name }) => name === "planet");
      const kept = ([path]) => !path.startsWith("view.sun_");
      flight.goTo({ view: Object.fromEntries(Object.entries(planet?.view ?? {}).filter(kept)) });
    },
    undo: () => state.undo(),
    redo: () => state.redo(),
    reset: () => state.reset(),
    "keep as b": () => state.keepOther(),
    swap: () => state.swap(),
    "one camera": () => state.shareCamera(!state.sharesCamera),
    advanced: () => viewer.toggleAdvanced(),
    "save picture": () => viewer.save(),
    help: () => {
      parts.help.hidden = !parts.help.hidden;
    },
    panels: () => parts.root.classList.toggle("airlight-hidden"),
    leave: () => viewer.leave(),
    "copy link": () => viewer.source.link && viewer.copyLink(),
    fullscreen: () => viewer.toggleFullscreen(),
    film: () => viewer.toggleFilm(),
    probe: () => {
      viewer.probe?.release();
      parts.probe.hidden = !parts.probe.hidden;
    },
    time: () => flight.play(),
    brighter: () => expose(KEYS.rates.stop),
    darker: () => expose(-KEYS.rates.stop),
    "automatic exposure": () => {
      const automatic = state.get("display.automatic");
      // The picture keeps its brightness when automatic exposure is switched off.
      const exposure = automatic ? (viewer.picture?.exposure ?? 0) : 0;
      state.rest();
      state.set({ "display.automatic": !automatic, "display.exposure": exposure });
      state.rest();
    },
  };
}

/** Buttons: action, text, explanation, and a function of their current state. */
export const BUTTONS = [
  ["undo", "undo", "Take back the last change (Ctrl+Z).", (s) => ({ disabled: !s.canUndo })],
  [
    "time",
    "time",
    "Let time pass, or stop it (T).",
    (s, v) => ({ pressed: v.flight.playing, disabled: Boolean(s.space) && !s.space.timed }),
  ],
  ["save picture", "save", "The picture, as a PNG (Ctrl+S).", () => ({})],
];

/** Entries of the menu, as the buttons. */
export const MENU = [
  ["redo", "redo", "Bring back what was taken back (Ctrl+Y).", (s) => ({ disabled: !s.canRedo })],
  ["reset", "reset", "Everything as it began.", () => ({})],
  ["keep as b", "keep as B", "Keep what is shown, to compare it (B).", () => ({})],
  [
    "swap",
    "change A and B over",
    "Show the other of the two (V).",
    (s) => ({ disabled: !s.hasOther, pressed: s.showing === "B" }),
  ],
  [
    "one camera",
    "one camera for A and B",
    "Both are seen from the same place under the same sun.",
    (s) => ({ hidden: !s.hasOther, pressed: s.sharesCamera }),
  ],
  [
    "advanced",
    "advanced parameters",
    "Show the parameters of the air's composition too.",
    (s, viewer) => ({
      hidden: ![...s.parameters.values()].some((one) => one.mode === "advanced"),
      pressed: viewer.controls?.advanced ?? false,
    }),
  ],
  [
    "film",
    "film",
    "Film what is shown, until this is pressed again (O).",
    (s, viewer) => ({ pressed: Boolean(viewer.film) }),
  ],
  [
    "copy link",
    "copy link",
    "Copy the address that shows this again (U).",
    (s, viewer) => ({ disabled: !viewer.source.link }),
  ],
  ["fullscreen", "fullscreen", "Fill the screen, or return (F).", () => ({})],
  ["help", "keys and mouse", "Keys and mouse (F1).", () => ({})],
];
