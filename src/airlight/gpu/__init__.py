"""Pictures and solutions on the GPU, from the same formulas as on the CPU."""
