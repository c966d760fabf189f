/** Colour space of the screen, as a canvas names it: what it can show, pictures are made for. */
export function screenSpace() {
  return globalThis.matchMedia?.("(color-gamut: p3)").matches ? "display-p3" : "srgb";
}
