"""Light of pixels: sky-view LUT, ground, star's disc. No device, no files."""
