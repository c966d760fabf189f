"""The computations that programs of this kind do today, plainly: in C and in NumPy."""
