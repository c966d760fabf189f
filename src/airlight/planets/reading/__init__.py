"""Reading of planet files: from text to parameter objects."""
