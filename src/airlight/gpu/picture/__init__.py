"""Pictures of a solution on a graphics device."""
