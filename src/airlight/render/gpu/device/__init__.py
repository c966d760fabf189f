"""WebGPU device, flat textures, fragment passes and their timing."""
