"""Direct solver: successive orders of scattering by the equations of the Atmosphere Plus notes."""
