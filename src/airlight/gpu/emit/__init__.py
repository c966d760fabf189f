"""From functions in restricted Python to shaders: scope, types, expressions, statements."""
