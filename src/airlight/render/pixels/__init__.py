"""Radiance of pixels: sky-view LUT, ground and discs, as kernels for CPU and GPU."""
