"""Three-dimensional clouds in pictures of the CPU."""
