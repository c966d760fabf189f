"""Light of pixels: table of the sky, ground, star's disc. No device, no files."""
