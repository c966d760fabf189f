"""Free flight and viewpoints."""
