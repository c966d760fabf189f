/** Clipboard of pages that the browser denies it to. */
import { element } from "./element.js";

/** Copy a text where the clipboard is closed to pages, as in a page from disk. */
export function copyByHand(root, text) {
  const field = element("textarea", { value: text, style: "position: fixed; opacity: 0" });
  root.append(field);
  field.select();
  document.execCommand("copy");
  field.remove();
}
