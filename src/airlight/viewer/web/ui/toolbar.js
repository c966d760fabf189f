/** The buttons above the controls. */
import { element } from "./controls.js";

/**
 * @param {HTMLElement} place Filled with buttons.
 * @param {[string, string, string, (state: State, viewer: Viewer) => object][]} buttons Action, text,
 *     explanation, and `disabled` and `pressed` of the moment.
 * @param {Viewer} viewer Does the actions, and has the `state`.
 * @returns {() => void} Brings the buttons up to date.
 */
export function toolbar(place, buttons, viewer) {
  const made = buttons.map(([action, text, help, moment]) => {
    const button = element("button", { type: "button", textContent: text, title: help });
    button.dataset.action = action;
    button.addEventListener("click", () => viewer.do(action));
    return [button, moment];
  });
  place.replaceChildren(...made.map(([button]) => button));
  const update = () => {
    for (const [button, moment] of made) {
      const { disabled = false, pressed } = moment(viewer.state, viewer);
      button.disabled = disabled;
      if (pressed !== undefined) button.ariaPressed = String(pressed);
    }
  };
  update();
  return update;
}
