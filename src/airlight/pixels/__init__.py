"""Light of pixels: line march, table of the sky, ground, star's disc. No device, no files."""
