"""Content of planet files: each key declared once, on the object that it becomes a field of."""
