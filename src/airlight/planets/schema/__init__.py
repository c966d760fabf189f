"""Schema of planet files: keys declared as fields of parameter objects."""
