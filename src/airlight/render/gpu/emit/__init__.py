"""Translation of restricted Python to shaders: scope, types, expressions, statements."""
