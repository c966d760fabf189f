"""What a planet file may hold: each key declared once, on the object that it becomes a field of."""
