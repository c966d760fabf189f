/** Toolbar of buttons above the controls. */
import { element } from "./element.js";

/**
 * Fill a toolbar.
 *
 * @param {HTMLElement} place Parent element of the buttons.
 * @param {[string, string, string, (state: State, viewer: Viewer) => object][]} buttons Action,
 *     text, explanation, and a function of the current `disabled`, `hidden` and `pressed`.
 * @param {Viewer} viewer Viewer that performs the actions and has the `state`.
 * @returns {() => void} Function that updates the buttons.
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
      const { disabled = false, hidden = false, pressed } = moment(viewer.state, viewer);
      Object.assign(button, { disabled, hidden });
      if (pressed !== undefined) button.ariaPressed = String(pressed);
    }
  };
  update();
  return update;
}
