"""The notes' equations as printed: trapezoids, a gather over the sphere, order by order."""
