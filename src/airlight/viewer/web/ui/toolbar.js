/** The buttons above the controls. */
import { element } from "./controls.js";

/**
 * @param {HTMLElement} place Filled with buttons.
 * @param {Object<string, {text: string, help: string, act: () => void, state?: () => object}>}
 *     actions By name; `state` gives `disabled` and `pressed` of the moment.
 * @returns {() => void} Brings the buttons up to date.
 */
export function toolbar(place, actions) {
  const buttons = Object.entries(actions).map(([name, action]) => {
    const button = element("button", {
      type: "button",
      textContent: action.text,
      title: action.help,
    });
    button.dataset.action = name;
    button.addEventListener("click", action.act);
    return [button, action];
  });
  place.replaceChildren(...buttons.map(([button]) => button));
  const update = () => {
    for (const [button, action] of buttons) {
      const { disabled = false, pressed } = action.state?.() ?? {};
      button.disabled = disabled;
      if (pressed !== undefined) button.ariaPressed = String(pressed);
    }
  };
  update();
  return update;
}
