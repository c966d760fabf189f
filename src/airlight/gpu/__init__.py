"""The same pictures by WebGPU: devices, flat tables and passes. Needs the extra ``view``."""
