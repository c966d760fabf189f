"""Tables for engines: sky light, transmittance and irradiance, with their error and look-ups."""
