"""Three-dimensional clouds: fields of particles and their optical properties."""
