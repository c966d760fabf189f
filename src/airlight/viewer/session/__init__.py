"""Planet, view and display under edit, with undo, files and comparison. No window."""
