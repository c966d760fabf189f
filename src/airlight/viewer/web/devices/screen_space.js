/** Colour space of the screen, as a canvas names it, for which frames are encoded. */
export function screenSpace() {
  return globalThis.matchMedia?.("(color-gamut: p3)").matches ? "display-p3" : "srgb";
}
