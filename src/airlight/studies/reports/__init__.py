"""Report pages: tables, pictures and text, as HTML and as Markdown."""
